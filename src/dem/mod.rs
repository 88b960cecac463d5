//! Grains: spheres and rigid clumps of spheres with frictional visco-elastic contact.
//!
//! Everything is in SI units and in one frame. A [`Dem`] is built from a checked [`Setup`], advanced with
//! [`Dem::step`], and coupled through `Dem::external_mut` (force and torque per body, kept until changed).
//!
//! | tag | equation | file | tests |
//! | --- | --- | --- | --- |
//! | D1 | normal force | `contact/hertz.rs`, `tsuji.rs`, `linear.rs` | `exact_hertz_*`, `reference_restitution_*` |
//! | D2 | tangential spring, Coulomb cap, rolling | `contact/friction.rs` | `exact_sliding_to_rolling`, `exact_incline_threshold` |
//! | D3 | velocity Verlet, Gear | `integrate/` | `order_*` |
//! | D4 | clumps, inertia of the union, rotation | `clump.rs`, `union_moments.rs`, `rotation.rs` | `exact_two_spheres_*`, `conserves_*`, `exact_flip_period` |
//! | D5 | walls | `walls/` | `mesh_*`, `wall_*` |
//! | D6 | neighbours, order of sums | `neighbours/` | `parity_*` |
//!
//! # Exactness
//! A run's bits depend on neither the number of threads nor the neighbour skin: forces on a member are summed
//! in the order of the partner's number, contacts that do not touch contribute nothing, and history belongs to
//! the pair. Only the books ([`Energies`]) are summed in fixed blocks of the pair list, which the skin shapes.

pub mod bodies;
mod build;
pub(crate) mod checkpoint;
pub(crate) mod clump;
pub mod contact;
pub(crate) mod energy;
pub mod error;
pub mod integrate;
pub(crate) mod material;
pub mod neighbours;
pub mod packing;
mod retain;
pub(crate) mod rotation;
pub(crate) mod setup;
pub(crate) mod simulation;
mod sphere;
pub(crate) mod stability;
mod state;
pub(crate) mod timestep;
pub mod union_moments;
pub(crate) mod views;
pub mod walls;

#[cfg(test)]
mod tests;

pub use bodies::Bodies;
pub(crate) use build::{Pace, pace};
pub use checkpoint::Checkpoint;
pub use clump::Clump;
pub use contact::{ContactEquations, StandardContact, restitution};
pub use energy::{Energies, Ledger};
pub use error::{DemError, Touching};
pub use integrate::Integrator;
pub use material::{Material, Materials, NormalLaw, PairProperties};
pub(crate) use retain::keep_marked;
pub use setup::{Grain, Period, Setup, Shape};
pub use simulation::Dem;
pub use sphere::Sphere;
pub use views::ContactView;
pub use walls::{Side, Surface, Wall, WallMotion};

/// A vector of three f64: position (m), velocity (m/s), spin (rad/s), force (N) or torque (N m).
pub type V3 = nalgebra::Vector3<f64>;
/// Orientation of a body: turns body-frame vectors into the frame of the scene.
pub type Orientation = nalgebra::UnitQuaternion<f64>;
