//! Random scenes as users write them, run as their plans say, and what the plans said of their errors.

mod claim;
mod counts;
mod draw;
mod fluid;
mod grains;
mod outcome;
mod program;
mod rows;

pub use claim::SCENES;
pub use counts::COUNTS;
pub use program::{many, one};
pub use rows::ROWS;
