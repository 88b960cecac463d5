//! lahar: verification-first lattice-Boltzmann reference implementation for yield-stress fluids.
pub mod boundary;
pub mod collision;
pub mod geometry;
pub mod lane;
pub mod lattice;
pub mod output;
pub mod plan;
pub mod report;
pub mod rheology;
pub mod run_scene;
pub mod scene;
pub mod solver;
pub mod stability;
pub mod units;
pub mod verify;
