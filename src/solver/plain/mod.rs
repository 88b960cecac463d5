//! The plain backend: scalar `f64`, one array entry per cell, written to be read beside the design.
//!
//! A step is: wall slip where a wall needs it \[B3\], collide every cell, stream every cell. Each
//! pass reads one array and writes another, so the result does not depend on the number of threads.

mod cell;
mod run;

use crate::collision::for_each_collision;
use crate::collision::{Bgk, CentralMoment, CollisionChoice, Regularised, Trt};
use crate::rheology::{Bingham, HerschelBulkley, Law, Newtonian, Papanastasiou, PowerLaw, for_each_law};
use crate::solver::physics::{Physics, Standard};
use crate::solver::run::{Backend, Run, StartError};
use crate::solver::setup::Setup;

pub use run::PlainRun;

/// The plain backend.
#[derive(Clone, Copy, Debug, Default)]
pub struct Plain;

impl Backend for Plain {
    fn name(&self) -> &'static str {
        "plain"
    }

    fn start(&self, setup: &Setup) -> Result<Box<dyn Run>, StartError> {
        crate::solver::check::check(setup)?;
        let treatment = setup.yielding;
        for_each_collision!(&setup.collision, collision => {
            if let [only] = setup.fluids.as_slice() {
                for_each_law!(only, law => boxed(setup, Standard { laws: vec![law], treatment, collision }))
            } else {
                boxed(setup, Standard { laws: setup.fluids.clone(), treatment, collision })
            }
        })
    }
}

fn boxed<P: Physics>(setup: &Setup, physics: P) -> Result<Box<dyn Run>, StartError> {
    Ok(Box::new(PlainRun::start(setup, physics)?))
}
