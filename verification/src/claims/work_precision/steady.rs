//! When a flow has the error it will have.

use super::trial::Outcome;
use crate::claim::VerifyError;
use lahar::setup::Setup;
use lahar::solver::run::{Backend, Run};

/// Two errors that differ by less than this share of the later one are the same.
const ALIKE: f64 = 0.1;
/// Errors below this are not told apart: nobody aims at them.
const FLOOR: f64 = 1e-6;
/// Looks at the flow in one relaxation time.
const LOOKS: f64 = 20.0;

/// From rest until the error stays within a tenth of what it becomes: the first step from which on this
/// holds, known when half as many steps again have been run.
///
/// While a transient of memory T decays, the error falls by e^(−t/3T) during the last third of a run of t
/// steps, more than a tenth for t > T/3; a run of at least T steps is therefore not taken for settled
/// while its transient outweighs its error.
pub(super) fn until_it_stays(
    backend: &dyn Backend,
    setup: &Setup,
    memory: f64,
    budget: f64,
    error: &dyn Fn(&dyn Run) -> f64,
) -> Result<Outcome, VerifyError> {
    let interval = (memory / LOOKS).ceil().max(5.0) as u64;
    let mut run = backend.start(setup)?;
    let mut updates = 0.0;
    let mut seen: Vec<Outcome> = Vec::new();
    loop {
        updates += interval as f64 * run.fluid_cells() as f64;
        let last = seen.last().map_or(f64::NAN, |o| o.error);
        if updates > budget {
            let found = format!("not steady: the error is {last:.2e} when the budget is used up");
            return Err(VerifyError::NotSteady { steps: run.step(), wanted: FLOOR, found });
        }
        run.advance(interval)?;
        let now = error(run.as_ref());
        seen.push(Outcome { error: now, steps: run.step(), updates });
        let width = (ALIKE * now).max(FLOOR);
        // A NaN is never the same.
        let same = |o: &Outcome| (o.error - now).abs() <= width;
        let settled = seen.iter().rposition(|o| !same(o)).map_or(0, |i| i + 1);
        let Some(first) = seen.get(settled) else { continue };
        if run.step() as f64 >= memory && 2 * run.step() >= 3 * first.steps {
            // Looks an even number of steps apart see nothing of what alternates from step to step.
            let first = *first;
            run.advance(1)?;
            if (error(run.as_ref()) - now).abs() <= width {
                return Ok(first);
            }
        }
    }
}
