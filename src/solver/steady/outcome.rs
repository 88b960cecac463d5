//! What an attempt to become steady found.

use std::fmt;

use super::ROUNDING;
use crate::state::state;

/// How an attempt to become steady ended, or how it stands. Printed, it gives the residual of a steady flow and says why
/// another is not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyOutcome {
    /// Steps taken.
    pub steps: u64,
    /// Largest change of velocity between the last two checks, over the largest speed; infinite before.
    pub residual: f64,
    /// What is still to come of that change if it goes on decaying as it did; of one that does not decay, 1e5 times it;
    /// infinite before the third look.
    pub remaining: f64,
    /// The tolerance that was asked for.
    pub tolerance: f64,
    /// Rate of change of the momentum over (tolerance × body force × volume); at most 1 in steady flow.
    pub imbalance: f64,
    /// Largest difference between a check and the looks after it, over the largest speed; `None` where none were taken.
    pub swing: Option<f64>,
    /// Whether that difference comes and goes about a mean that stays.
    pub alternates: bool,
    /// Whether the flow is steady.
    pub steady: bool,
}

impl SteadyOutcome {
    /// Before anything was seen.
    pub(super) const fn unknown(tolerance: f64) -> Self {
        let (residual, remaining) = (f64::INFINITY, f64::INFINITY);
        let (steps, imbalance, swing) = (0, 0.0, None);
        Self { steps, residual, remaining, tolerance, imbalance, swing, alternates: false, steady: false }
    }

    /// What is beyond the tolerance.
    fn beyond(&self) -> Vec<String> {
        let limit = self.tolerance.max(ROUNDING);
        let mut all = Vec::new();
        if self.residual > self.tolerance {
            all.push(format!("changes by {:.2e} of the largest speed between checks", self.residual));
        }
        if self.remaining > limit {
            all.push(format!("has {:.2e} of the largest speed still to change", self.remaining));
        }
        if self.imbalance > 1.0 {
            let share = self.imbalance * self.tolerance;
            all.push(format!("gains momentum at {share:.2e} of the body force"));
        }
        if let Some(swing) = self.swing.filter(|&swing| swing > limit) {
            all.push(format!(
                "differs by {swing:.2e} of the largest speed within 24 steps or half an interval"
            ));
        }
        all
    }
}

impl fmt::Display for SteadyOutcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.steady {
            return write!(f, "residual {:.2e}", self.residual);
        }
        match self.swing {
            Some(swing) if self.alternates => write!(
                f,
                "not steady: alternates by {swing:.2e} of the largest speed within 24 steps, about a mean that stays"
            ),
            _ if self.residual.is_infinite() => write!(f, "not steady: ended before the second check"),
            _ => match self.beyond() {
                all if all.is_empty() => write!(f, "not steady: ended before two checks in a row"),
                all => write!(f, "not steady: {}", all.join(", ")),
            },
        }
    }
}

state!(SteadyOutcome: steps residual remaining imbalance swing alternates steady; but tolerance);
