//! Walls and mirror planes: where each population that arrives in a cell comes from.

pub mod bounce_back;
pub mod cut;
pub mod flat_wall;
pub(crate) mod hand_over;
pub mod links;
pub(crate) mod owners;
mod step;
mod surface_graph;
pub mod wall_law;
pub mod wall_slip;
