//! The rows that `lahar plan` asks.

use super::case::{Case, Place, SMALL};
use super::program::rows_of;
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::plan::wall_error::{COLUMNS, TITLE};

/// Last case, of which the table has the channels and films; none of the small ones, which the claim judges by this table.
const CASES: u64 = 900;
/// The same for the short form.
const FEW: u64 = 200;

/// Rows of channels and films.
pub const ROWS: Exhibit = Exhibit {
    id: "walls-sweep-rows",
    caption: "Random channels and films: error of the largest speed (the worse of the runs from rest and from 3 × the speed) and \
              that of half-way walls. `lahar plan` looks up the rows most like a scene.",
    timed: false,
    run: |backend, full| {
        let numbers: Vec<u64> =
            (SMALL..if full { CASES } else { FEW }).filter(|&k| drives(&Case::new(k))).collect();
        let mut table = Table::new(TITLE, &COLUMNS);
        for row in rows_of(backend, &numbers)? {
            let case = &row.case;
            let error = if row.is_one_state() { row.error() } else { f64::INFINITY };
            table.push(vec![
                (case.number as f64).into(),
                case.place.name().into(),
                case.n.into(),
                case.plug.into(),
                case.cells.into(),
                row.sheared.into(),
                case.tau.into(),
                case.operator.name().into(),
                row.push.into(),
                error.into(),
                row.half_way_error().into(),
            ]);
        }
        Ok(ExhibitData { tables: vec![table], ..ExhibitData::default() })
    },
};

/// Whether a force drives the flow along plane walls.
fn drives(case: &Case) -> bool {
    matches!(case.place, Place::Channel | Place::Film { .. })
}
