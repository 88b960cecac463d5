//! Which error to expect of a scene: that of the random scenes of the study `sweep` most like it, with an interval.

mod likeness;
mod lookup;
mod print;

pub use likeness::{AXES, Kind, Likeness};
pub(in crate::plan) use likeness::{of_flow, of_grains};
pub(in crate::plan) use lookup::FLOOR;
pub use lookup::{COLUMN, Expectation, Interval, Row, Scenes};
pub(in crate::plan) use print::section;
