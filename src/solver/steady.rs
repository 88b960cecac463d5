//! Running until nothing changes any more.

use super::run::{Run, Stopped};

/// When a flow counts as steady.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyRule {
    /// Bound on the residual: largest change of velocity between checks, over the largest speed.
    pub tolerance: f64,
    /// Steps between checks.
    pub interval: u64,
    /// Steps after which the attempt ends.
    pub max_steps: u64,
}

/// How an attempt to become steady ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyOutcome {
    /// Steps taken.
    pub steps: u64,
    /// Residual at the last check.
    pub residual: f64,
    /// Whether it is within the tolerance.
    pub steady: bool,
}

/// Largest change between two velocity fields over the largest speed of the second; zero when both rest.
#[must_use]
pub(crate) fn residual(before: &[[f64; 3]], after: &[[f64; 3]]) -> f64 {
    let mut change = 0.0_f64;
    let mut speed = 0.0_f64;
    for (u, v) in before.iter().zip(after) {
        for a in 0..3 {
            change = change.max((v[a] - u[a]).abs());
            speed = speed.max(v[a].abs());
        }
    }
    if speed > 0.0 { change / speed } else { change }
}

/// Advances until the residual is within the rule's tolerance or the steps are used up.
///
/// # Errors
/// A guard stopped the run.
pub fn run_to_steady(run: &mut dyn Run, rule: SteadyRule) -> Result<SteadyOutcome, Stopped> {
    let start = run.step();
    let mut before = run.fields().velocity;
    loop {
        run.advance(rule.interval)?;
        let after = run.fields().velocity;
        let residual = residual(&before, &after);
        let steps = run.step() - start;
        let steady = residual <= rule.tolerance;
        if steady || steps >= rule.max_steps {
            return Ok(SteadyOutcome { steps, residual, steady });
        }
        before = after;
    }
}
