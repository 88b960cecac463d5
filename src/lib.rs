//! lahar: verification-first lattice-Boltzmann reference implementation for yield-stress fluids.
//!
//! # The way of a scene
//! [`Scene`] (SI, checked) → [`Plan`] (lattice units, what is needed) → [`Setup`] → a [`Run`] of some [`Backend`] →
//! files. Two backends give the same bits: [`Plain`] is written to be read, [`Fast`] to be fast. What is claimed about
//! them is in the package `lahar-verification`, which knows this one; nothing here knows it.
//!
//! # In Rust
//! A flow in lattice units is a [`Setup`]:
//!
//! ```
//! use lahar::{Backend, Fast, Law, Setup};
//!
//! let setup = Setup::channel(16, Law::Newtonian { mu: 0.1 }, 1e-6);
//! let mut run = Fast::default().start(&setup)?;
//! run.advance(100)?;
//! assert!(run.fields().velocity[8][0] > 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The names at the top of this page are what most programs need. The modules below hold the equations, one
//! function each; they are public for the harness and for readers, and may change between versions.
//!
//! # The floors
//! A module imports only from the lines below its own (`tests/architecture.rs` reads the imports):
//!
//! | floor | modules |
//! | --- | --- |
//! | what people call | [`mod@bench`], [`run`], [`plan`], [`scene`], [`output`] |
//! | solvers | [`solver`] |
//! | parts of a step | [`coupling`], [`free_surface`], [`boundary`] |
//! | the contract | [`setup`] |
//! | laws of grains, stability of operators | [`dem`], [`stability`] |
//! | laws of one cell, shapes | [`collision`], [`rheology`], [`geometry`] |
//! | the lattice | [`lattice`] |
//! | numbers | [`lane`], [`vector`], [`units`], [`fingerprint`], [`state`] |
//!
//! # The map
//! Equation tags, where they are written down, and a claim that would notice a mistake. `REPORT.md` has
//! the complete table, with the papers' equation numbers and the equations no claim checks.
//!
//! | tag | equation | file | claim |
//! | --- | --- | --- | --- |
//! | L1 | velocities and weights | `lattice/mod.rs` | `moment-identities` |
//! | L2 | moment identities | `lattice/mod.rs` | `moment-identities`, `moment-defects-sixth-order` |
//! | L3 | equilibrium | `lattice/equilibrium.rs` | `equilibrium-moments` |
//! | L4 | density, velocity | `lattice/moments.rs` | `conservation-collision` |
//! | L5 | body force | `collision/forcing_guo.rs` | `acceleration-without-shear` |
//! | L6 | ν = (τ − ½)/3 | `rheology/relaxation.rs` | `shear-wave-axis-bgk` |
//! | L7 | f − w stored | `lattice/mod.rs`, `solver/initial.rs` | `resting-layer-creep` |
//! | Y1 | non-equilibrium tensor | `lattice/moments.rs` | `strain-tensor-couette` |
//! | Y2 | strain rate, stress | `rheology/relaxation.rs` | `shear-rate-couette` |
//! | Y3 | the local solve | `rheology/*.rs` | `poiseuille-bingham`, `poiseuille-herschel-bulkley` |
//! | Y4 | lagged and implicit clamp | `rheology/relaxation.rs` | `poiseuille-clamped-lagged` |
//! | K1 | one relaxation time | `collision/bgk.rs` | `poiseuille-newtonian-bgk-slip` |
//! | K2 | two relaxation times | `collision/trt.rs`, `odd_rate.rs` | `poiseuille-newtonian-magic` |
//! | K3 | central moments | `collision/central_moment.rs` | `central-moment-galilean` |
//! | K4 | recursive regularised | `collision/regularised.rs` | `shear-wave-order-regularised` |
//! | K5 | stability limits | `stability/` | `neumann-table` |
//! | K6 | third-moment source | `boundary/wall_slip.rs` | exhibit `resting-layer-cures` |
//! | B1 | half-way walls | `boundary/bounce_back.rs` | `poiseuille-newtonian-bgk-slip` |
//! | B2 | mirror planes | `boundary/links.rs` | `mirror-quarter-duct` |
//! | B3 | viscosity-independent walls | `boundary/wall_slip.rs` | `poiseuille-newtonian-b3` |
//! | B4 | solids at their true place | `boundary/cut.rs`, `solver/cuts.rs` | `pipe-newtonian-cut` |
//! | F1 | mass exchange | `free_surface/exchange.rs` | `film-newtonian`, `surface-pattern-carried` |
//! | F2 | gas links | `free_surface/exchange.rs` | `pool-at-rest` |
//! | F3 | force in interface cells | `free_surface/force.rs` | `film-newtonian`, `falling-drop-by-fill` |
//! | F4 | filling and emptying | `free_surface/marks.rs` | `dam-break-mass`, `flat-layer-without-flicker` |
//! | F5 | ledger | `free_surface/ledger.rs` | `dam-break-mass`, `dam-break-momentum` |
//! | F6 | drops, bubbles, single cells | `free_surface/marks.rs` | `isolated-cell`, `random-bubbles-and-drops` |
//! | D1 | normal force of grains | `dem/contact/hertz.rs`, `tsuji.rs`, `linear.rs` | `hertz-contact-time`, `restitution-visco-elastic` |
//! | D2 | tangential spring, Coulomb cap, rolling | `dem/contact/friction.rs` | `sliding-to-rolling`, `spring-turns-with-contact` |
//! | D3 | velocity Verlet, Gear | `dem/integrate/` | `verlet-across-contact`, `gear-fifth-order` |
//! | D4 | clumps: union, rotation | `dem/clump.rs`, `dem/rotation.rs` | `clump-two-spheres`, `free-clump-flip-period` |
//! | D5 | walls of grains | `dem/walls/` | `mesh-edge-and-corner`, `mesh-rolling` |
//! | D6 | neighbours, order of sums | `dem/neighbours/` | `neighbours-complete`, `same-bits-on-threads` |
//! | C1 | covered cells, links, wall velocity | `coupling/coverage.rs`, `link.rs` | `galilean-twin`, `cubic-array-drag` |
//! | C2 | force and torque by momentum exchange | `coupling/exchange.rs` | `galilean-twin`, `sphere-spin-in-shear` |
//! | C3 | covering, uncovering, refill, books | `coupling/cover.rs`, `refill.rs` | `stirred-pool-books`, `moving-sphere-mass` |
//! | C4 | sub-cycling | `coupling/subcycle.rs` | test `parity_of_grains_in_a_fluid` |
//! | C5 | lubrication | `setup/suspension/lubrication.rs` | `lubrication-approach` |
//! | C6 | surface velocity, implicit in link friction | `coupling/predict.rs` | `coupled-density-ratios` |
//! | C7 | load on fixed solids | `solver/books.rs` | `wall-hydrostatic-load` |

#![deny(missing_docs)]
// These end the program when nobody reads; `output::terminal` does not.
#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]

pub mod bench;
pub mod boundary;
pub mod collision;
pub mod coupling;
pub mod dem;
pub mod fingerprint;
pub mod free_surface;
pub mod geometry;
pub mod lane;
pub mod lattice;
pub mod output;
pub mod plan;
pub mod rheology;
pub mod run;
pub mod scene;
pub mod setup;
pub mod solver;
pub mod stability;
pub mod state;
pub mod units;
pub mod vector;

pub use collision::CollisionChoice;
pub use fingerprint::Fingerprint;
pub use geometry::{Axis, Shape};
pub use lane::Lane;
pub use plan::{Plan, PlanError, Planned};
pub use rheology::{Law, Rheology, YieldTreatment};
pub use run::{Options as RunOptions, RunError, run as run_scene};
pub use scene::{AnyScene, Scene, SceneError};
pub use setup::guard::{Runaway, StartError, Stopped};
pub use setup::{
    BodyForce, Face, FlowPoint, FreeSurface, Precision, Setup, SolidMotion, Suspension, WallRule,
};
pub use solver::choose::Best;
pub use solver::fast::Fast;
pub use solver::plain::Plain;
pub use solver::run::{Backend, Fields, Ledger, Load, Run, Totals};
pub use solver::steady::{SteadyOutcome, SteadyRule, run_to_steady};
pub use units::Units;
