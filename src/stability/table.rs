//! The committed table of limits and its interpolation.
//!
//! `table.json` is written by `cargo test --release --lib -- --ignored writes_the_stability_table`: what is missing is computed
//! and what is there kept; with `[]` in it all is computed.

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use super::{Direction, Limit, Search, StabilityError, max_stable_speed_along};
use crate::collision::{CollisionChoice, OddRate};

/// τ⁺ of the table.
pub const TAUS: [f64; 23] = [
    0.5005, 0.501, 0.502, 0.505, 0.51, 0.52, 0.535, 0.55, 0.56, 0.58, 0.6, 0.65, 0.7, 0.8, 0.9, 1.0, 1.2,
    1.5, 1.8, 2.5, 5.0, 20.0, 100.0,
];

/// Limits of one operator at one τ⁺.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// τ⁺.
    pub tau: f64,
    /// Along x, xy, xyz.
    pub limits: [Limit; 3],
}

impl Row {
    /// Computes a row.
    ///
    /// # Errors
    /// Eigenvalues did not converge.
    pub(crate) fn compute(
        collision: &CollisionChoice,
        tau: f64,
        search: &Search,
    ) -> Result<Self, StabilityError> {
        let mut limits = [Limit { speed: 0.0, wave: [0.0; 3] }; 3];
        for (limit, direction) in limits.iter_mut().zip(Direction::ALL) {
            *limit = max_stable_speed_along(collision, tau, direction, search)?;
        }
        Ok(Self { tau, limits })
    }

    /// The least of the three speeds.
    #[must_use]
    pub fn least(&self) -> f64 {
        self.limits.iter().map(|l| l.speed).fold(f64::INFINITY, f64::min)
    }
}

/// Limits of one operator.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// The operator.
    pub collision: CollisionChoice,
    /// Rows with rising τ⁺.
    pub rows: Vec<Row>,
}

/// The operators of the table, with short names.
pub const OPERATORS: [(&str, CollisionChoice); 7] = [
    ("BGK", CollisionChoice::Bgk),
    ("TRT, fixed 3/16", CollisionChoice::Trt(OddRate::fixed(3.0 / 16.0))),
    ("TRT", CollisionChoice::Trt(OddRate::STANDARD)),
    ("central moment", CollisionChoice::CentralMoment(OddRate::STANDARD)),
    ("regularised", CollisionChoice::Regularised),
    ("central moment, fixed 3/16", CollisionChoice::CentralMoment(OddRate::fixed(3.0 / 16.0))),
    ("central moment, among grains", CollisionChoice::CentralMoment(OddRate::AMONG_GRAINS)),
];

static TABLE: LazyLock<Vec<Column>> =
    LazyLock::new(|| serde_json::from_str(include_str!("table.json")).unwrap_or_default());

/// The table.
#[must_use]
pub fn table() -> &'static [Column] {
    &TABLE
}

/// Least limit of the table at τ⁺; `None` for an operator or parameters that are not in it.
///
/// Between rows: linear in ln(τ⁺ − ½). Below the first row: proportional to τ⁺ − ½, the steepest fall
/// of any row. Above the last row: its value; but where the limit still falls there (the central-moment
/// and regularised operators), as τ⁺^(−1/2), hence zero for a cell that never yields.
#[must_use]
pub(crate) fn interpolated(collision: &CollisionChoice, tau: f64) -> Option<f64> {
    let rows = &table().iter().find(|c| c.collision == *collision)?.rows;
    let (first, last) = (rows.first()?, rows.last()?);
    if tau <= first.tau {
        return Some(first.least() * (tau - 0.5) / (first.tau - 0.5));
    }
    if tau >= last.tau {
        let before = rows.iter().rev().nth(1).map_or(last.least(), Row::least);
        let falling = last.least() < 0.9 * before;
        let part = if falling { (last.tau / tau).sqrt() } else { 1.0 };
        return Some(last.least() * part);
    }
    let upper = rows.iter().position(|row| row.tau >= tau)?;
    let (a, b) = (&rows[upper - 1], &rows[upper]);
    let at = |t: f64| libm::log(t - 0.5);
    let part = (at(tau) - at(a.tau)) / (at(b.tau) - at(a.tau));
    Some(a.least() + part * (b.least() - a.least()))
}
