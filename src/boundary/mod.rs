//! Walls and mirror planes: where each population that arrives in a cell comes from.

pub mod bounce_back;
pub mod flat_wall;
pub mod links;
pub mod wall_law;
pub mod wall_slip;
