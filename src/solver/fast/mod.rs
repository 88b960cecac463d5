//! The fast backend: the same equations in packs, in blocks that hold fluid, on several threads.

pub(crate) mod around;
pub(crate) mod block;
pub(crate) mod cut_cells;
mod cuts;
pub(crate) mod element;
mod grains;
mod hand_over;
pub mod instructions;
pub(crate) mod kernel;
pub(crate) mod layout;
pub(crate) mod links;
mod loads;
pub(crate) mod memory;
mod moving;
pub(crate) mod place;
pub(crate) mod predict;
pub(crate) mod registers;
mod report;
pub(crate) mod rim;
mod run;
pub(crate) mod sources;
pub(crate) mod stage;
mod state;
pub(crate) mod stores;
pub(crate) mod surface;
pub(crate) mod task;
mod wall_pass;
mod walls;
#[cfg(target_arch = "x86_64")]
mod x86;

use crate::collision::{CentralMoment, CollisionChoice};
use crate::setup::{Precision, Setup};
use crate::solver::compiled::{Compiled, with_newtonian_loop, with_own_loop, with_shared_loop};
use crate::solver::layout::Layout;
use crate::solver::physics::Physics;
use crate::solver::run::{Backend, Run, StartError};
use instructions::{Chosen, Instructions, Passes};
pub use run::FastRun;

/// The fast backend.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fast {
    /// Instruction set; the best one the processor has if `None`.
    pub instructions: Option<Instructions>,
}

impl Backend for Fast {
    fn name(&self) -> &'static str {
        "fast"
    }

    fn layout(&self) -> Layout {
        Layout::Blocks
    }

    fn start(&self, setup: &Setup) -> Result<Box<dyn Run>, StartError> {
        crate::solver::check::check(setup)?;
        let chosen = Chosen::new(self.instructions).ok_or(StartError::Unsupported {
            backend: "fast",
            feature: "an instruction set that this processor lacks",
        })?;
        match setup.precision {
            Precision::Double => double(setup, chosen),
            Precision::Single => single(setup, chosen),
            Precision::SingleStorage => with_shared_loop(setup, Stored(setup, chosen)),
        }
    }
}

fn double(setup: &Setup, chosen: Chosen) -> Result<Box<dyn Run>, StartError> {
    let start = Double(setup, chosen);
    match setup.collision {
        CollisionChoice::CentralMoment(odd) => with_own_loop(setup, CentralMoment { odd }, start),
        CollisionChoice::Bgk | CollisionChoice::Trt(_) | CollisionChoice::Regularised => {
            with_shared_loop(setup, start)
        }
    }
}

/// Compiled for the Newtonian law and for any: more variants would take minutes to build.
fn single(setup: &Setup, chosen: Chosen) -> Result<Box<dyn Run>, StartError> {
    let start = Single(setup, chosen);
    match setup.collision {
        CollisionChoice::CentralMoment(odd) => with_newtonian_loop(setup, CentralMoment { odd }, start),
        CollisionChoice::Bgk | CollisionChoice::Trt(_) | CollisionChoice::Regularised => {
            with_shared_loop(setup, start)
        }
    }
}

/// Starts a run of a setup in one precision.
macro_rules! start {
    ($name:ident, $passes:ident) => {
        struct $name<'a>(&'a Setup, Chosen);

        impl Compiled for $name<'_> {
            type Result = Result<Box<dyn Run>, StartError>;

            fn with<P: Physics>(self, physics: P) -> Self::Result {
                Ok(Box::new(FastRun::start(self.0, physics, self.1, Passes::$passes)?))
            }
        }
    };
}

start!(Double, DOUBLE);
start!(Single, SINGLE);
start!(Stored, STORED);
