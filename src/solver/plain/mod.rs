//! The plain backend: scalar `f64`, one array entry per cell, written to be read beside docs/method.md.
//!
//! A step is: wall slip where a wall needs it \[B3\], collide every cell, exchange mass below a free surface
//! \[F1\], stream every cell, convert cells \[F4\]. Each pass reads one array and writes another, so the result
//! does not depend on the number of threads. `run.rs` has the arrays and the order of the passes, `passes.rs` what
//! every flow needs, `surface` what cells with a kind need besides.

mod cut_cells;
mod cuts;
mod grains;
mod loads;
pub(crate) mod memory;
mod passes;
mod report;
mod run;
mod state;
mod surface;

use crate::collision::{Bgk, CentralMoment, CollisionChoice};
use crate::rheology::Rheology;
use crate::setup::{Precision, Setup};
use crate::solver::compiled::{Compiled, with_own_loop, with_shared_loop};
use crate::solver::physics::{Physics, Standard};
use crate::solver::run::{Backend, Run, StartError};

pub use run::PlainRun;
pub use surface::{Collided, Design, SurfaceLink, SurfacePhysics};

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
        // Each operator with loops of its own costs build time.
        match setup.collision {
            CollisionChoice::Bgk => with_own_loop(setup, Bgk, Start(setup)),
            CollisionChoice::CentralMoment(odd) => with_own_loop(setup, CentralMoment { odd }, Start(setup)),
            CollisionChoice::Trt(_) | CollisionChoice::Regularised => with_shared_loop(setup, Start(setup)),
        }
    }
}

impl Plain {
    /// Starts a run of one fluid whose law is not among those of [`crate::rheology::Law`].
    ///
    /// # Arguments
    /// `setup`: everything else; its own fluid only decides what the initial populations start from.
    /// `law`: one that is monotone, in lattice units.
    /// # Errors
    /// As [`Backend::start`].
    pub fn start_with<R: Rheology>(&self, setup: &Setup, law: R) -> Result<Box<dyn Run>, StartError> {
        let physics = Standard::new(vec![law], setup.yielding, setup.collision);
        Ok(Box::new(PlainRun::start(setup, physics)?))
    }
}

/// Starts a run of a setup.
struct Start<'a>(&'a Setup);

impl Compiled for Start<'_> {
    type Result = Result<Box<dyn Run>, StartError>;

    fn with<P: Physics>(self, physics: P) -> Self::Result {
        Ok(Box::new(PlainRun::start(self.0, physics)?))
    }
}
