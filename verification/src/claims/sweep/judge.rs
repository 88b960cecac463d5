//! What is asked of a row: an error of the largest speed of at most 1.5 % from 12 cells on, and more.

use std::fmt;

use super::case::Place;
use super::row::{End, Row};
use lahar::plan::wall_error::{ERROR_MAX, FEW_CELLS, Layer, PUSH_MAX, Sweep, THIN_LAYER};

/// Depth of a film, cells, below which a plan warns.
const SHALLOW: f64 = 4.0;
/// What may come on top of the error with half-way walls.
pub const MARGIN: f64 = 0.01;
/// The same around turning cylinders, which are stairs with an error of tens of per cent: the share of the speed within which
/// two states count as one there.
pub const MARGIN_ON_STAIRS: f64 = 0.05;
/// What is wrong with a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// A guard stopped a run.
    BlewUp,
    /// A run did not become steady, by this much of the largest speed.
    Unsteady(f64),
    /// Two starts, two states.
    TwoStates(f64),
    /// An error beyond what is allowed.
    Error(f64),
    /// An error beyond that with half-way walls and the margin.
    WorseThanHalfWay(f64, f64),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::BlewUp => write!(f, "blew up"),
            Self::Unsteady(by) => write!(f, "unsteady by {by:.1e}"),
            Self::TwoStates(by) => write!(f, "two states {by:.1e} apart"),
            Self::Error(error) => write!(f, "{:+.2} %", 100.0 * error),
            Self::WorseThanHalfWay(error, half_way) => {
                write!(f, "{:+.2} % where half-way has {:+.2} %", 100.0 * error, 100.0 * half_way)
            }
        }
    }
}

/// All that is wrong with a row.
pub struct Judgement {
    /// What is wrong.
    pub faults: Vec<Fault>,
    /// Whether a plan of the same flow warns.
    pub announced: bool,
}

impl Judgement {
    /// Of a row; `sweep`: what the plan knows.
    pub fn of(row: &Row, sweep: &Sweep) -> Self {
        let announced = is_announced(row, sweep);
        let mut faults = Vec::new();
        let flat = row.case.place.is_flat();
        let stairs = matches!(row.case.place, Place::Cylinders { .. });
        for end in [&row.rest, &row.fast] {
            match end {
                End::BlewUp(_) => faults.push(Fault::BlewUp),
                // What stairs keep swinging whatever the wall rule is not the rule's.
                End::Unsteady(..) if stairs && matches!(row.half_way, End::Unsteady(..)) => {}
                End::Unsteady(found, _) => {
                    faults.push(Fault::Unsteady(found.swing.unwrap_or(found.residual)))
                }
                End::Steady(_) => {}
            }
        }
        let apart = row.apart();
        if apart > row.one_state() && apart.is_finite() {
            faults.push(Fault::TwoStates(apart));
        }
        let (error, half_way) = (row.error(), row.half_way_error());
        if !error.is_finite() {
            return Self { faults, announced };
        }
        let fine = row.case.cells >= 12.0 && row.case.n >= 0.25 && flat;
        if fine && error.abs() > ERROR_MAX {
            faults.push(Fault::Error(error));
        }
        let margin = if stairs { MARGIN_ON_STAIRS } else { MARGIN };
        if error.abs() > half_way.abs() + margin {
            faults.push(Fault::WorseThanHalfWay(error, half_way));
        }
        Self { faults, announced }
    }

    /// Whether something is wrong of which no plan warns.
    pub fn is_silent(&self) -> bool {
        !self.announced && !self.faults.is_empty()
    }
}

/// Whether `lahar plan` warns of few cells, a thin sheared layer, a large force per step, or an error beyond what is allowed.
fn is_announced(row: &Row, sweep: &Sweep) -> bool {
    let few = match row.case.place {
        Place::Channel | Place::Duct { .. } | Place::Couette => row.case.cells < FEW_CELLS,
        Place::Film { .. } => row.case.cells < SHALLOW,
        _ => false,
    };
    let layer = Layer { sheared: row.sheared, n: row.case.n, push: row.push };
    let driven = matches!(row.case.place, Place::Channel | Place::Film { .. });
    let large = driven && sweep.expected(&layer).is_some_and(|expected| expected.error > ERROR_MAX);
    few || row.push > PUSH_MAX || driven && row.sheared < THIN_LAYER || large
}
