//! Grains in the fluid, coupled both ways \[C1\]–\[C6\].
//!
//! The fluid is computed outside the grains only. A cell whose centre lies inside a grain is *covered*: it is solid
//! until the grain has moved on. Everything here is written once, for any backend that gives access to its cells
//! (`Host`): populations that a grain's surface sends back are put into the covered cell they come from, so that
//! streaming finds them where it would find those of a fluid neighbour. The loops over fluid cells know nothing of
//! grains.
//!
//! | tag | equation | file |
//! | --- | --- | --- |
//! | C1 | covered cells, links, wall velocity | `coverage.rs`, `inside.rs`, `link.rs`, `gather.rs` |
//! | C2 | force and torque by momentum exchange | `exchange.rs`, `held.rs` |
//! | C3 | covering, uncovering, refill, ledger | `cover.rs`, `refill.rs` |
//! | C4 | sub-cycling | `subcycle.rs` |
//! | C5 | lubrication | `setup/suspension/lubrication.rs`, `gaps.rs` |
//! | C6 | velocity of the surface, implicit in the link friction | `predict.rs` |
//!
//! # A fluid step with grains
//! collide → `Immersed::exchange` (links, forces) → stream, free surface → `Immersed::advance` (grains move by the
//! force of this step, cells are covered and uncovered).

mod books;
mod cover;
mod coverage;
mod exchange;
mod gaps;
mod gather;
mod held;
mod host;
mod immersed;
mod inside;
mod link;
mod load;
mod predict;
mod pressure;
mod refill;
mod report;
mod scales;
mod scenery;
mod subcycle;

pub use crate::setup::suspension::lubrication::{
    normal as lubrication_normal, tangential as lubrication_tangential,
};
pub use crate::setup::suspension::{
    CouplingEquations, GrainRefill, GrainWall, Lubrication, StandardCoupling, Suspension,
};
pub use books::CouplingBooks;
pub(crate) use host::{Host, Place, Uncovered};
pub use immersed::{Immersed, body_force};
pub use load::BodyLoad;
pub use report::GrainTotals;

/// A vector in lattice units.
pub(crate) type L3 = [f64; 3];
