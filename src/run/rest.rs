//! Whether everything has come to rest, and what the looks for it found.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::measure::rest::Pace;
use crate::output::number;
use crate::scene::{Arrested, RestMeasure};
use crate::state::state;

/// What the checks for rest found, as the last one left it. Printed, it says which speed fell below which limit and when,
/// or did not, and what the largest speed still was.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RestOutcome {
    /// Whether all checks of the stretch that was asked for found rest.
    pub reached: bool,
    /// Which speed had to be slow.
    pub measure: RestMeasure,
    /// That speed at the last check; NaN before the first.
    #[serde(with = "number")]
    pub speed_m_per_s: f64,
    /// What it had to stay below.
    #[serde(with = "number")]
    pub limit_m_per_s: f64,
    /// How long.
    #[serde(with = "number")]
    pub for_s: f64,
    /// Time of the first check of the latest unbroken row that found it below; `None` if the last check did not.
    #[serde(default, with = "number::option", skip_serializing_if = "Option::is_none")]
    pub below_since_s: Option<f64>,
    /// Time of the last check; NaN before the first.
    #[serde(with = "number")]
    pub checked_at_s: f64,
    /// Largest speed of any cell or grain at that check, whatever its mass; NaN before the first.
    #[serde(with = "number")]
    pub largest_speed_m_per_s: f64,
}

impl fmt::Display for RestOutcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (speed, limit, at) = (self.speed_m_per_s, self.limit_m_per_s, self.checked_at_s);
        let verdict = if self.reached { "" } else { "not at rest: " };
        if at.is_nan() {
            return write!(f, "{verdict}ended before the first check");
        }
        let measure = Words(self.measure);
        match self.below_since_s {
            Some(since) => write!(
                f,
                "{verdict}{measure} below {limit:.2e} m/s since {since:.6} s, {speed:.2e} m/s at {at:.6} s"
            ),
            None => {
                write!(f, "{verdict}{measure} {speed:.2e} m/s at {at:.6} s, not below {limit:.2e} m/s")
            }
        }?;
        write!(f, "; largest speed then {:.2e} m/s", self.largest_speed_m_per_s)
    }
}

/// A measure for people.
struct Words(RestMeasure);

impl fmt::Display for Words {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            RestMeasure::MassPercentile { share } => write!(f, "speed of {} % of the mass", 100.0 * share),
            RestMeasure::Rms => write!(f, "speed √(2E/m)"),
            RestMeasure::Largest => write!(f, "largest speed (of fluid times the fill)"),
        }
    }
}

state!(RestOutcome:
    reached speed_m_per_s below_since_s checked_at_s largest_speed_m_per_s; but measure limit_m_per_s for_s
);

/// Looks for rest.
pub(super) struct RestWatch {
    found: RestOutcome,
}

state!(RestWatch: found);

impl RestWatch {
    pub fn new(rule: Arrested) -> Self {
        let found = RestOutcome {
            reached: false,
            measure: rule.measure,
            speed_m_per_s: f64::NAN,
            limit_m_per_s: rule.speed_m_per_s,
            for_s: rule.for_s,
            below_since_s: None,
            checked_at_s: f64::NAN,
            largest_speed_m_per_s: f64::NAN,
        };
        Self { found }
    }

    /// Which speed has to be slow.
    pub(crate) fn measure(&self) -> RestMeasure {
        self.found.measure
    }

    /// Whether every check of the last stretch, with this one at `time` s, found everything slower than the limit.
    ///
    /// # Arguments
    /// `step`: duration of a step, s. Checks fall on whole steps: half a step is no difference.
    pub(crate) fn look(&mut self, time: f64, pace: Pace, step: f64) -> bool {
        let found = &mut self.found;
        (found.speed_m_per_s, found.largest_speed_m_per_s) = (pace.speed, pace.largest);
        found.checked_at_s = time;
        // NaN is not below.
        let slow = pace.speed < found.limit_m_per_s;
        found.below_since_s = slow.then(|| found.below_since_s.unwrap_or(time));
        found.reached = found.below_since_s.is_some_and(|since| time - since >= found.for_s - 0.5 * step);
        found.reached
    }

    /// What was found so far.
    pub(crate) fn outcome(&self) -> RestOutcome {
        self.found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn watch() -> RestWatch {
        let measure = RestMeasure::default();
        RestWatch::new(Arrested { measure, speed_m_per_s: 1e-3, for_s: 0.2, check_every_s: 0.1 })
    }

    fn pace(speed: f64) -> Pace {
        Pace { speed, largest: 2.0 }
    }

    #[test]
    fn rest_takes_an_unbroken_row_of_checks() {
        let mut watch = watch();
        let looks =
            [(0.1, 1e-4), (0.2, 1e-3), (0.3, 9e-4), (0.4, f64::NAN), (0.5, 1e-5), (0.6, 2e-5), (0.7, 3e-5)];
        let found = looks.map(|(time, speed)| watch.look(time, pace(speed), 1e-3));
        assert_eq!(found, [false, false, false, false, false, false, true]);
        let outcome = watch.outcome();
        assert_eq!((outcome.below_since_s, outcome.checked_at_s), (Some(0.5), 0.7));
        assert_eq!((outcome.speed_m_per_s, outcome.largest_speed_m_per_s), (3e-5, 2.0));
    }

    #[test]
    fn exact_words() {
        let mut watch = watch();
        assert_eq!(watch.outcome().to_string(), "not at rest: ended before the first check");
        watch.look(0.1, pace(0.5), 1e-3);
        assert_eq!(
            watch.outcome().to_string(),
            "not at rest: speed of 99 % of the mass 5.00e-1 m/s at 0.100000 s, not below 1.00e-3 m/s; largest speed then \
             2.00e0 m/s"
        );
        watch.look(0.2, pace(5e-4), 1e-3);
        watch.look(0.4, pace(4e-4), 1e-3);
        assert_eq!(
            watch.outcome().to_string(),
            "speed of 99 % of the mass below 1.00e-3 m/s since 0.200000 s, 4.00e-4 m/s at 0.400000 s; largest speed then \
             2.00e0 m/s"
        );
    }
}
