//! The plain backend: scalar `f64`, one array entry per cell, written to be read beside the design.
//!
//! A step is: wall slip where a wall needs it \[B3\], collide every cell, stream every cell. Each
//! pass reads one array and writes another, so the result does not depend on the number of threads.

pub mod cell;
pub mod memory;
mod run;
mod surface;

use crate::collision::{Bgk, CentralMoment, CollisionChoice};
use crate::rheology::{Bingham, HerschelBulkley, Law, Newtonian};
use crate::setup::{Precision, Setup, YieldTreatment};
use crate::solver::physics::{Physics, Standard};
use crate::solver::run::{Backend, Run, StartError};

pub use run::{PlainRun, starting_omega};
pub use surface::SurfaceRun;

/// The plain backend.
#[derive(Clone, Copy, Debug, Default)]
pub struct Plain;

impl Backend for Plain {
    fn name(&self) -> &'static str {
        "plain"
    }

    fn start(&self, setup: &Setup) -> Result<Box<dyn Run>, StartError> {
        crate::solver::check::check(setup)?;
        if setup.precision != Precision::Double {
            let feature = "populations in single precision";
            return Err(StartError::Unsupported { backend: "plain", feature });
        }
        let treatment = setup.yielding;
        // The common laws and operators get a loop of their own; the others, and several fluids, share
        // one that chooses per cell. The bits are the same either way, the speed is not. Below a free
        // surface only the default operator has loops of its own: each costs build time.
        macro_rules! own_loop {
            ($collision:expr, $boxed:ident) => {
                match setup.fluids.as_slice() {
                    &[Law::Newtonian { mu }] => {
                        $boxed(setup, standard(Newtonian { mu }, treatment, $collision))
                    }
                    &[Law::Bingham { sigma0, mu }] => {
                        $boxed(setup, standard(Bingham { sigma0, mu }, treatment, $collision))
                    }
                    &[Law::HerschelBulkley { sigma0, k, n }] => {
                        $boxed(setup, standard(HerschelBulkley::new(sigma0, k, n), treatment, $collision))
                    }
                    _ => shared_loop(setup),
                }
            };
        }
        match setup.collision {
            CollisionChoice::Bgk if !with_surface(setup) => own_loop!(Bgk, closed),
            CollisionChoice::CentralMoment(odd) => own_loop!(CentralMoment { odd }, boxed),
            _ => shared_loop(setup),
        }
    }
}

fn standard<R, C>(law: R, treatment: YieldTreatment, collision: C) -> Standard<R, C> {
    Standard { laws: vec![law], treatment, collision }
}

fn shared_loop(setup: &Setup) -> Result<Box<dyn Run>, StartError> {
    let physics = Standard {
        laws: setup.fluids.iter().map(Law::prepare).collect(),
        treatment: setup.yielding,
        collision: setup.collision,
    };
    boxed(setup, physics)
}

fn boxed<P: Physics>(setup: &Setup, physics: P) -> Result<Box<dyn Run>, StartError> {
    if with_surface(setup) { surface::boxed(setup, physics) } else { closed(setup, physics) }
}

/// Grains are coupled to the run that knows kinds of cells, with or without gas.
fn with_surface(setup: &Setup) -> bool {
    setup.free_surface.is_some() || setup.grains.is_some()
}

fn closed<P: Physics>(setup: &Setup, physics: P) -> Result<Box<dyn Run>, StartError> {
    Ok(Box::new(PlainRun::start(setup, physics)?))
}
