//! Shapes in space, in metres: whether a point is inside, and the share of a cell that they cover.

mod beside;
mod combine;
mod crossing;
mod heightfield;
mod polygon;
mod row;
mod samples;
mod shape;
mod volume;

pub(crate) use beside::{Body, drawn};
pub use heightfield::Heightfield;
pub use shape::{Axis, Bounds, Shape};
