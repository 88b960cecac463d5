//! The fast backend: the same equations in packs, in blocks that hold fluid, on several threads.

pub mod block;
pub mod element;
pub mod instructions;
pub mod kernel;
pub mod layout;
pub mod memory;
pub mod registers;
mod report;
pub mod rim;
mod run;
pub mod sources;
pub mod stage;
pub mod stores;
pub mod surface;
#[cfg(target_arch = "x86_64")]
mod x86;

use crate::collision::{CentralMoment, CollisionChoice};
use crate::rheology::{Bingham, HerschelBulkley, Law, Newtonian};
use crate::solver::physics::{Physics, Standard};
use crate::solver::run::{Backend, Run, StartError};
use crate::solver::setup::Setup;
use instructions::{Chosen, Instructions};
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

    fn start(&self, setup: &Setup) -> Result<Box<dyn Run>, StartError> {
        crate::solver::check::check(setup)?;
        let chosen = Chosen::new(self.instructions).ok_or(StartError::Unsupported {
            backend: "fast",
            feature: "an instruction set that this processor lacks",
        })?;
        let treatment = setup.yielding;
        match (setup.collision, setup.fluids.as_slice()) {
            (CollisionChoice::CentralMoment(odd), &[Law::Newtonian { mu }]) => {
                let (laws, collision) = (vec![Newtonian { mu }], CentralMoment { odd });
                boxed(setup, Standard { laws, treatment, collision }, chosen)
            }
            (CollisionChoice::CentralMoment(odd), &[Law::Bingham { sigma0, mu }]) => {
                let (laws, collision) = (vec![Bingham { sigma0, mu }], CentralMoment { odd });
                boxed(setup, Standard { laws, treatment, collision }, chosen)
            }
            (CollisionChoice::CentralMoment(odd), &[Law::HerschelBulkley { sigma0, k, n }]) => {
                let (laws, collision) = (vec![HerschelBulkley::new(sigma0, k, n)], CentralMoment { odd });
                boxed(setup, Standard { laws, treatment, collision }, chosen)
            }
            _ => {
                let (laws, collision) = (setup.fluids.iter().map(Law::prepare).collect(), setup.collision);
                boxed(setup, Standard { laws, treatment, collision }, chosen)
            }
        }
    }
}

fn boxed<P: Physics>(setup: &Setup, physics: P, chosen: Chosen) -> Result<Box<dyn Run>, StartError> {
    Ok(Box::new(FastRun::start(setup, physics, chosen, instructions::double)?))
}
