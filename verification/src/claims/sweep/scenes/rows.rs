//! The rows that `lahar plan` asks.

use super::outcome::{Outcome, SMALL};
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::plan::expected::{COLUMN, Kind};

/// Scenes of the table; none of the small ones, which the claim judges by this table.
const COUNT: u64 = 2000;
/// The same for the short form.
const FEW: u64 = 40;

/// Rows of all kinds.
pub const ROWS: Exhibit = Exhibit {
    id: "scene-sweep-rows",
    caption: "Random scenes with an exact solution, run as their plans say: what decides their errors, and the errors. `lahar plan` \
              looks up the rows most like a scene.",
    timed: false,
    run: |backend, full| {
        let numbers: Vec<u64> = (SMALL..SMALL + if full { COUNT } else { FEW }).collect();
        let mut tables = Kind::ALL.map(|kind| Table::new(kind.name(), &[COLUMN]));
        for outcome in Outcome::of_all(backend, &numbers)? {
            if let Some(row) = outcome.row() {
                tables[row.likeness.kind as usize].push(vec![row.entry(outcome.number)]);
            }
        }
        Ok(ExhibitData { tables: tables.to_vec(), ..ExhibitData::default() })
    },
};
