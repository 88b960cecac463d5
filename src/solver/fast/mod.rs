//! The fast backend: the same equations in packs, in blocks that hold fluid, on several threads.

pub mod block;
pub mod element;
mod grains;
pub mod instructions;
pub mod kernel;
pub mod layout;
pub mod memory;
pub mod predict;
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
#[cfg(target_arch = "x86_64")]
mod x86_single;

use crate::collision::{CentralMoment, CollisionChoice};
use crate::rheology::{Bingham, HerschelBulkley, Law, Newtonian, Prepared};
use crate::setup::{Precision, Setup};
use crate::solver::layout::Layout;
use crate::solver::physics::{Physics, Standard};
use crate::solver::run::{Backend, Run, StartError};
use element::Element;
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
            Precision::SingleStorage => boxed(setup, any_law(setup), chosen, Passes::STORED),
        }
    }
}

/// Compiled for each of the laws that most scenes have, and for any.
fn double(setup: &Setup, chosen: Chosen) -> Result<Box<dyn Run>, StartError> {
    let treatment = setup.yielding;
    match (setup.collision, setup.fluids.as_slice()) {
        (CollisionChoice::CentralMoment(odd), &[Law::Newtonian { mu }]) => {
            let (laws, collision) = (vec![Newtonian { mu }], CentralMoment { odd });
            boxed(setup, Standard { laws, treatment, collision }, chosen, Passes::DOUBLE)
        }
        (CollisionChoice::CentralMoment(odd), &[Law::Bingham { sigma0, mu }]) => {
            let (laws, collision) = (vec![Bingham { sigma0, mu }], CentralMoment { odd });
            boxed(setup, Standard { laws, treatment, collision }, chosen, Passes::DOUBLE)
        }
        (CollisionChoice::CentralMoment(odd), &[Law::HerschelBulkley { sigma0, k, n }]) => {
            let (laws, collision) = (vec![HerschelBulkley::new(sigma0, k, n)], CentralMoment { odd });
            boxed(setup, Standard { laws, treatment, collision }, chosen, Passes::DOUBLE)
        }
        _ => boxed(setup, any_law(setup), chosen, Passes::DOUBLE),
    }
}

/// Compiled for the Newtonian law and for any: more variants would take minutes to build.
fn single(setup: &Setup, chosen: Chosen) -> Result<Box<dyn Run>, StartError> {
    match (setup.collision, setup.fluids.as_slice()) {
        (CollisionChoice::CentralMoment(odd), &[Law::Newtonian { mu }]) => {
            let (laws, collision) = (vec![Newtonian { mu }], CentralMoment { odd });
            let physics = Standard { laws, treatment: setup.yielding, collision };
            boxed(setup, physics, chosen, Passes::SINGLE)
        }
        _ => boxed(setup, any_law(setup), chosen, Passes::SINGLE),
    }
}

/// Laws and collision operator chosen at run time.
fn any_law(setup: &Setup) -> Standard<Prepared, CollisionChoice> {
    let laws = setup.fluids.iter().map(Law::prepare).collect();
    Standard { laws, treatment: setup.yielding, collision: setup.collision }
}

fn boxed<P: Physics, E: Element>(
    setup: &Setup,
    physics: P,
    chosen: Chosen,
    passes: Passes<P, E>,
) -> Result<Box<dyn Run>, StartError> {
    Ok(Box::new(FastRun::start(setup, physics, chosen, passes)?))
}
