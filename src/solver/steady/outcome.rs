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

#[cfg(test)]
mod tests {
    use super::*;

    /// Nothing beyond a tolerance of 1e-6: every number is at its limit.
    const AT_ITS_LIMITS: SteadyOutcome = SteadyOutcome {
        steps: 1000,
        residual: 1e-6,
        remaining: 1e-6,
        tolerance: 1e-6,
        imbalance: 1.0,
        swing: Some(1e-6),
        alternates: false,
        steady: false,
    };

    /// The next number above.
    fn beyond(limit: f64) -> f64 {
        limit * (1.0 + f64::EPSILON)
    }

    /// One number beyond its limit, one reason: that of this number.
    #[test]
    fn exact_reasons_for_each_number_alone() {
        assert_eq!(AT_ITS_LIMITS.beyond(), [""; 0]);
        let cases = [
            (
                SteadyOutcome { residual: beyond(1e-6), ..AT_ITS_LIMITS },
                "changes by 1.00e-6 of the largest speed",
            ),
            (
                SteadyOutcome { remaining: beyond(1e-6), ..AT_ITS_LIMITS },
                "has 1.00e-6 of the largest speed still",
            ),
            (
                SteadyOutcome { imbalance: beyond(1.0), ..AT_ITS_LIMITS },
                "gains momentum at 1.00e-6 of the body",
            ),
            (
                SteadyOutcome { swing: Some(beyond(1e-6)), ..AT_ITS_LIMITS },
                "differs by 1.00e-6 of the largest speed",
            ),
        ];
        for (outcome, reason) in cases {
            let found = outcome.beyond();
            assert!(found.len() == 1 && found[0].starts_with(reason), "{found:?}, not {reason}");
            assert_eq!(outcome.to_string(), format!("not steady: {}", found[0]));
        }
        assert_eq!(SteadyOutcome { swing: None, ..AT_ITS_LIMITS }.beyond(), [""; 0]);
    }

    /// All at once, each with its own number; the momentum as a share of the body force, 300 tolerances.
    #[test]
    fn exact_numbers_in_the_reasons() {
        let all = SteadyOutcome {
            residual: 2e-4,
            remaining: 3e-3,
            imbalance: 300.0,
            swing: Some(5e-2),
            ..AT_ITS_LIMITS
        };
        let said = all.to_string();
        let places = ["changes by 2.00e-4 ", "has 3.00e-3 ", "momentum at 3.00e-4 ", "differs by 5.00e-2 "];
        let places = places.map(|part| said.find(part).unwrap_or_else(|| panic!("{part} in {said}")));
        assert!(places.is_sorted() && said.matches(", ").count() == 3, "{said}");
    }

    /// Below rounding a tolerance asks for what no number has, except of the residual, which can be zero.
    #[test]
    fn limit_of_a_tolerance_below_rounding() {
        let nearly = SteadyOutcome {
            tolerance: 0.0,
            residual: 0.0,
            remaining: ROUNDING,
            swing: Some(ROUNDING),
            ..AT_ITS_LIMITS
        };
        assert_eq!(nearly.beyond(), [""; 0]);
        assert_eq!(SteadyOutcome { residual: f64::MIN_POSITIVE, ..nearly }.beyond().len(), 1);
        assert_eq!(SteadyOutcome { remaining: beyond(ROUNDING), ..nearly }.beyond().len(), 1);
        assert_eq!(SteadyOutcome { swing: Some(beyond(ROUNDING)), ..nearly }.beyond().len(), 1);
    }
}
