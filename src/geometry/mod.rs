//! Shapes in space, in metres: whether a point is inside, and the share of a cell that they cover.

mod combine;
mod heightfield;
mod polygon;
mod shape;

pub(crate) use combine::covered;
pub use heightfield::Heightfield;
pub use shape::{Axis, Bounds, Shape};
