//! Shapes in space, in metres. A shape only answers whether a point is inside.

mod polygon;
mod shape;

pub use shape::{Axis, Bounds, Shape};
