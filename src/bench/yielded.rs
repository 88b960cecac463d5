//! How much of a flow is yielded.

use serde::Serialize;

use super::cases::Case;
use crate::solver::plain::Plain;
use crate::solver::run::{Backend, Run};

/// Cells up to which the fields of a run itself are looked at: 100 bytes each.
const CELLS: usize = 3_000_000;
/// Steps of the twin.
const STEPS: u64 = 20;

/// Share of the fluid cells that are yielded.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Yielded {
    /// 0 to 1.
    pub share: f64,
    /// Of a small relative instead of the run itself, which is too large to look at.
    pub of_twin: bool,
}

/// At the end of a run, or of its twin; `None` where everything flows.
pub(super) fn yielded(case: &Case, run: &dyn Run) -> Option<Yielded> {
    let twin = case.twin?;
    if run.setup().cells() <= CELLS {
        return Some(Yielded { share: share(run), of_twin: false });
    }
    let mut run = Plain.start(&twin()).ok()?;
    run.advance(STEPS).ok()?;
    Some(Yielded { share: share(run.as_ref()), of_twin: true })
}

fn share(run: &dyn Run) -> f64 {
    let fields = run.fields();
    let setup = run.setup();
    let (mut fluid, mut flowing) = (0_u64, 0_u64);
    for (cell, &omega) in fields.omega.iter().enumerate() {
        if fields.is_fluid(cell, setup.is_solid(cell)) {
            fluid += 1;
            flowing += u64::from(omega > 0.0);
        }
    }
    flowing as f64 / fluid.max(1) as f64
}
