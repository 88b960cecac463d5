//! Which error to expect from walls: the rows of the study `sweep`.
//!
//! A [`Row`] is a random steady flow between plane walls or down an incline with the error of its largest speed. A plan looks
//! for those most like the flow of a scene, by what decides: cells in the sheared layer, flow index, and the share of its
//! speed that a step of the force adds.

use std::fmt;

use serde::Serialize;

use super::text::short;
use crate::output::table::{Entry, ExhibitRecord};

/// Title of the table.
pub const TITLE: &str = "Errors of random flows between plane walls";

/// Heads of its columns.
pub const COLUMNS: [&str; 11] = [
    "case",
    "flow",
    "n",
    "σ0/σ_w",
    "cells",
    "cells sheared",
    "plastic τ",
    "operator",
    "push per step",
    "error",
    "half-way",
];

/// Error beyond which a plan warns, of the largest speed.
pub const ERROR_MAX: f64 = 0.015;
/// Share of the largest speed that a step of the force may add without a warning.
pub const PUSH_MAX: f64 = 0.05;
/// Cells between walls below which a plan warns.
pub const FEW_CELLS: f64 = 8.0;
/// Sheared layer below which a plan warns, cells: what yields is less than one cell's half step.
pub const THIN_LAYER: f64 = 0.5;

/// Rows that are asked.
const NEIGHBOURS: usize = 6;

/// What decides the error of a wall.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Layer {
    /// Thickness of the sheared layer, cells.
    pub sheared: f64,
    /// Flow index.
    pub n: f64,
    /// Body force over density and largest speed, per step.
    pub push: f64,
}

/// A flow of the sweep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// What decides.
    pub layer: Layer,
    /// Error of the largest speed, over that speed; infinite for a run that did not become steady.
    pub error: f64,
}

/// The rows this build of lahar carries.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    rows: Vec<Row>,
}

/// An error to expect.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Expected {
    /// The layer it is expected of.
    pub layer: Layer,
    /// Of the largest speed, relative; infinite where flows did not become steady: the largest but one of the nearest rows, which a single odd row does not decide.
    pub error: f64,
    /// Rows it comes from.
    pub rows: usize,
}

impl fmt::Display for Expected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Layer { sheared, n, push } = self.layer;
        if self.error.is_finite() {
            write!(f, "{} % of the largest speed is likely", short(100.0 * self.error))?;
        } else {
            write!(f, "flows like this one did not become steady")?;
        }
        write!(
            f,
            " (`study-sweep`: {} cells sheared, n = {}, {} of the speed per step)",
            short(sheared),
            short(n),
            short(push)
        )
    }
}

impl Layer {
    /// Square of the distance of two layers: twice the cells, four times the push, and one and a half times the flow index
    /// count alike.
    fn apart(&self, other: &Self) -> f64 {
        let of = |a: f64, b: f64, unit: f64| {
            let x = libm::log(a / b) / libm::log(unit);
            x * x
        };
        of(self.sheared, other.sheared, 2.0) + of(self.push, other.push, 4.0) + of(self.n, other.n, 1.5)
    }
}

impl Sweep {
    /// From the exhibit of the study.
    #[must_use]
    pub fn of(record: &ExhibitRecord) -> Self {
        let tables = record.data.tables.iter().filter(|table| table.title == TITLE);
        Self { rows: tables.flat_map(|table| &table.rows).filter_map(|row| read(row)).collect() }
    }

    /// From rows.
    #[must_use]
    pub const fn from_rows(rows: Vec<Row>) -> Self {
        Self { rows }
    }

    /// The golden table of the study.
    ///
    /// # Errors
    /// The golden file was not what the study writes when lahar was built.
    pub fn built_in() -> Result<Self, serde_json::Error> {
        let record = serde_json::from_str(include_str!("../../golden/exhibits/walls-sweep-rows.json"))?;
        Ok(Self::of(&record))
    }

    /// The error that the nearest rows make likely; `None` without rows.
    #[must_use]
    pub fn expected(&self, layer: &Layer) -> Option<Expected> {
        let mut near: Vec<(f64, f64)> =
            self.rows.iter().map(|row| (row.layer.apart(layer), row.error.abs())).collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        near.truncate(NEIGHBOURS);
        let mut errors: Vec<f64> = near.into_iter().map(|(_, error)| error).collect();
        errors.sort_by(f64::total_cmp);
        let error = *errors.iter().rev().nth(1).or(errors.last())?;
        Some(Expected { layer: *layer, error, rows: errors.len() })
    }
}

fn read(row: &[Entry]) -> Option<Row> {
    let number = |column: usize| match row.get(column)? {
        Entry::Number(x) => Some(*x),
        Entry::Text(_) => None,
    };
    Some(Row { layer: Layer { n: number(2)?, sheared: number(5)?, push: number(8)? }, error: number(9)? })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(sheared: f64, error: f64) -> Row {
        Row { layer: Layer { sheared, n: 1.0, push: 1e-3 }, error }
    }

    /// Coarse rows are bad, fine ones good: each layer hears its own neighbours, and one odd row is not believed.
    #[test]
    fn exact_nearest_rows_decide() {
        let coarse = (0..8).map(|k| row(2.0 + 0.1 * f64::from(k), 0.05));
        let fine = (0..8).map(|k| row(20.0 + f64::from(k), if k == 3 { f64::INFINITY } else { 1e-3 }));
        let sweep = Sweep::from_rows(coarse.chain(fine).collect());
        let of = |sheared| {
            let expected = sweep.expected(&Layer { sheared, n: 0.9, push: 2e-3 }).unwrap();
            (expected.error, expected.rows)
        };
        assert_eq!(of(2.2), (0.05, NEIGHBOURS));
        assert_eq!(of(23.0), (1e-3, NEIGHBOURS));
        assert_eq!(Sweep::from_rows(Vec::new()).expected(&row(2.0, 0.0).layer), None);
    }

    /// The table that is built in can be read, and knows the flows that it was made for.
    #[test]
    fn exact_built_in_table() {
        let sweep = Sweep::built_in().unwrap();
        assert!(sweep.rows.len() >= 40, "{}", sweep.rows.len());
        // A Newtonian channel on 20 cells is good to a per cent, as every claim on channels says.
        let fine = sweep.expected(&Layer { sheared: 10.0, n: 1.0, push: 5e-4 }).unwrap();
        assert!(fine.error < 0.01, "{}", fine.error);
    }
}
