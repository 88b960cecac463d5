//! The rows, and what those nearest to a scene say.

use std::sync::OnceLock;

use serde::Serialize;

use super::likeness::{AXES, Kind, Likeness};
use crate::output::table::{Entry, ExhibitRecord, Table};

/// Head of the only column of the tables, one for each kind. A row is one text, which keeps the file small: the case, the
/// [`AXES`] numbers of [`Likeness::at`] and both errors.
pub const COLUMN: &str = "case, what decides, errors";

/// Rows that are asked.
const NEIGHBOURS: usize = 40;
/// Distance beyond which a row says nothing, units of [`Kind::axes`].
const REACH: f64 = 2.0;
/// Rows within reach that are needed.
const LEAST_ROWS: usize = 8;
/// Factor by which the range of the nearest rows is widened. With it, 40 rows and [`SIDE`], 9 of 1817 rows lie outside of what the
/// others say, none of them at 3 times an end; with 20 rows and a factor of 1.5 it is 43 and 7.
const MARGIN: f64 = 2.0;
/// Least part of the larger end of the range that its other end is: the sign of an error changes with the fill of a cell.
const SIDE: f64 = 0.25;
/// What is added to it on both sides: the tolerance at which runs are taken for steady.
pub(in crate::plan) const FLOOR: f64 = 1e-3;

/// A measured scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Where it is.
    pub likeness: Likeness,
    /// Its errors, see [`Kind::errors`]; the largest at any look for a run that did not become steady, infinite for one that
    /// was stopped.
    pub errors: [f64; 2],
}

/// An error with its range.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Interval {
    /// Of what.
    pub of: &'static str,
    /// Least to expect, relative and signed; 0 at most.
    pub low: f64,
    /// Largest to expect, relative and signed; 0 at least.
    pub high: f64,
}

/// What to expect.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Expectation {
    /// Scenes like it were measured.
    Measured {
        /// Where the scene is.
        like: Likeness,
        /// Rows that were asked.
        rows: usize,
        /// The errors.
        errors: Vec<Interval>,
    },
    /// None were.
    Outside {
        /// Where the scene is, if it is of a kind that was measured.
        like: Option<Likeness>,
        /// Why.
        why: String,
    },
}

/// The rows of a build of lahar.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scenes {
    rows: Vec<Row>,
}

impl Row {
    /// As [`Scenes::of`] reads it: four significant digits.
    #[must_use]
    pub fn entry(&self, case: u64) -> Entry {
        let numbers = self.likeness.at.iter().chain(&self.errors);
        numbers.fold(case.to_string(), |text, x| format!("{text} {x:.3e}")).into()
    }
}

impl Interval {
    /// Whether an error lies within.
    #[must_use]
    pub fn holds(&self, error: f64) -> bool {
        self.low <= error && error <= self.high
    }

    /// The error over the end of the interval on its side.
    #[must_use]
    pub fn times(&self, error: f64) -> f64 {
        error / if error < 0.0 { self.low } else { self.high }
    }

    /// Whether it has ends; not where scenes like this one were stopped, or none had this error.
    #[must_use]
    pub fn is_known(&self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }

    /// The larger of both ends.
    #[must_use]
    pub fn most(&self) -> f64 {
        self.high.max(-self.low)
    }
}

impl Expectation {
    /// By the rows this build of lahar carries, for a scene or the reason why it is like none of them.
    #[must_use]
    pub(in crate::plan) fn of(like: Result<Likeness, &'static str>) -> Self {
        match like {
            Ok(like) => Scenes::built_in().expect(like),
            Err(why) => Self::Outside { like: None, why: why.to_owned() },
        }
    }

    /// Where the scene is among the measured ones.
    #[must_use]
    pub const fn like(&self) -> Option<Likeness> {
        match self {
            Self::Measured { like, .. } => Some(*like),
            Self::Outside { like, .. } => *like,
        }
    }

    /// The errors to expect; none outside of what was measured.
    #[must_use]
    pub fn errors(&self) -> &[Interval] {
        match self {
            Self::Measured { errors, .. } => errors,
            Self::Outside { .. } => &[],
        }
    }
}

impl Scenes {
    /// From the exhibit of the study.
    #[must_use]
    pub fn of(record: &ExhibitRecord) -> Self {
        let rows = |table: &Table| -> Vec<Row> {
            let kind = Kind::ALL.into_iter().find(|kind| kind.name() == table.title);
            kind.map_or_else(Vec::new, |kind| table.rows.iter().filter_map(|row| read(kind, row)).collect())
        };
        Self { rows: record.data.tables.iter().flat_map(rows).collect() }
    }

    /// From rows.
    #[must_use]
    pub const fn from_rows(rows: Vec<Row>) -> Self {
        Self { rows }
    }

    /// The rows this build of lahar carries; none if the golden file was not what the study writes when lahar was built.
    #[must_use]
    pub fn built_in() -> &'static Self {
        static ROWS: OnceLock<Scenes> = OnceLock::new();
        ROWS.get_or_init(|| {
            let text = include_str!("../../../golden/exhibits/scene-sweep-rows.json");
            serde_json::from_str(text).map(|record| Self::of(&record)).unwrap_or_default()
        })
    }

    /// Number of rows of a kind.
    #[must_use]
    pub fn count(&self, kind: Kind) -> usize {
        self.rows.iter().filter(|row| row.likeness.kind == kind).count()
    }

    /// What the rows nearest to a scene say.
    #[must_use]
    pub fn expect(&self, like: Likeness) -> Expectation {
        let mut near: Vec<(f64, [f64; 2])> = self
            .rows
            .iter()
            .filter(|row| row.likeness.kind == like.kind)
            .map(|row| (row.likeness.apart(&like), row.errors))
            .filter(|(apart, _)| *apart <= REACH)
            .collect();
        if near.len() < LEAST_ROWS {
            let why = format!("fewer than {LEAST_ROWS} measured scenes are like this one ({like})");
            return Expectation::Outside { like: Some(like), why };
        }
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        near.truncate(NEIGHBOURS);
        let errors = like.kind.errors().iter().enumerate().map(|(k, of)| range(of, &near, k)).collect();
        Expectation::Measured { like, rows: near.len(), errors }
    }
}

/// The range of an error among rows, with 0, widened by [`SIDE`], [`MARGIN`] and [`FLOOR`].
fn range(of: &'static str, near: &[(f64, [f64; 2])], k: usize) -> Interval {
    // Scenes that do not have this error have NaN.
    let errors = near.iter().map(|(_, errors)| errors[k]).filter(|error| !error.is_nan());
    let mut any = false;
    let [low, high] = errors.inspect(|_| any = true).fold([0.0_f64, 0.0], |[low, high], error| {
        // What was stopped may be anywhere.
        let lowest = if error.is_finite() { error } else { f64::NEG_INFINITY };
        let highest = if error.is_finite() { error } else { f64::INFINITY };
        [low.min(lowest), high.max(highest)]
    });
    if !any {
        return Interval { of, low: f64::NEG_INFINITY, high: f64::INFINITY };
    }
    let [low, high] = [low.min(-SIDE * high), high.max(-SIDE * low)];
    Interval { of, low: MARGIN * low - FLOOR, high: MARGIN * high + FLOOR }
}

fn read(kind: Kind, row: &[Entry]) -> Option<Row> {
    let [Entry::Text(numbers)] = row else { return None };
    let mut numbers = numbers.split(' ').skip(1).map(|text| text.parse::<f64>().ok());
    let mut next = || numbers.next().flatten();
    let mut at = [1.0; AXES];
    for x in &mut at {
        *x = next()?;
    }
    Some(Row { likeness: Likeness { kind, at }, errors: [next()?, next()?] })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn film(cells: f64) -> Likeness {
        Likeness::new(Kind::Film, &[cells, cells, 1.0, 1e-3])
    }

    fn rows(errors: impl IntoIterator<Item = [f64; 2]>) -> Scenes {
        let row = |(k, errors): (usize, [f64; 2])| Row { likeness: film(10.0 + 0.01 * k as f64), errors };
        Scenes::from_rows(errors.into_iter().enumerate().map(row).collect())
    }

    fn interval(scenes: &Scenes, k: usize) -> Option<[f64; 2]> {
        scenes.expect(film(10.0)).errors().get(k).map(|found| [found.low, found.high])
    }

    /// The range of the rows with 0, twice, and the floor; where a scene has no second error its rows do not count.
    #[test]
    fn exact_interval_of_the_nearest_rows() {
        let with = |four: [[f64; 2]; 4]| rows(four.into_iter().chain([[0.0; 2]; LEAST_ROWS - 4]));
        let scenes = with([[0.02, f64::NAN], [0.01, -0.04], [0.0, f64::NAN], [0.005, 0.02]]);
        assert_eq!(interval(&scenes, 0), Some([MARGIN * -SIDE * 0.02 - FLOOR, MARGIN * 0.02 + FLOOR]));
        assert_eq!(interval(&scenes, 1), Some([MARGIN * -0.04 - FLOOR, MARGIN * 0.02 + FLOOR]));
        // A run that failed leaves nothing known.
        let failed = with([[0.0; 2], [f64::INFINITY; 2], [0.0; 2], [0.0; 2]]);
        assert_eq!(interval(&failed, 0), Some([f64::NEG_INFINITY, f64::INFINITY]));
    }

    /// Few rows, rows far away, and rows of another kind give no interval.
    #[test]
    fn limit_outside_of_what_was_measured() {
        assert_eq!(interval(&rows([[0.0; 2]; LEAST_ROWS - 1]), 0), None);
        let scenes = rows([[0.0; 2]; LEAST_ROWS]);
        assert!(interval(&scenes, 0).is_some());
        assert!(
            scenes.expect(film(30.0)).errors().is_empty(),
            "1.5^2 times as many cells are two units away"
        );
        let channel = Likeness::new(Kind::Channel, &[10.0, 10.0, 1.0, 1e-3]);
        assert!(scenes.expect(channel).errors().is_empty());
    }

    #[test]
    fn exact_rows_read_back_as_written() {
        let row = Row { likeness: film(12.5), errors: [-0.0125, f64::INFINITY] };
        assert_eq!(read(Kind::Film, &[row.entry(7)]), Some(row));
    }

    /// The table that is built in can be read, and has rows of every kind.
    #[test]
    fn exact_built_in_table() {
        for kind in Kind::ALL {
            assert!(
                Scenes::built_in().count(kind) >= 20,
                "{}: {}",
                kind.name(),
                Scenes::built_in().count(kind)
            );
        }
    }
}
