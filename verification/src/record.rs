//! What is kept of an evaluated claim.

use serde::{Deserialize, Serialize};

use super::claim::{Kind, Metric, Sample};
use super::order::{FittedOrder, Richardson};
use lahar::output::number;

/// An evaluated claim: everything the report shows and the golden files hold.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Id of the claim.
    pub claim: String,
    /// Its sentence.
    pub title: String,
    /// Equations it checks.
    pub tags: Vec<String>,
    /// Verification, validation, predicted failure.
    pub kind: Kind,
    /// What is measured.
    pub measures: String,
    /// What it is compared with.
    pub reference: String,
    /// Relative uncertainty of the reference.
    #[serde(with = "number")]
    pub reference_uncertainty: f64,
    /// How errors are formed.
    pub metric: Metric,
    /// Name and unit of the ladder's parameter.
    pub parameter: String,
    /// The rungs that gave a result, in ladder order.
    pub samples: Vec<Sample>,
    /// The rungs that did not.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub failed: Vec<FailedRung>,
    /// Observed order, if the claim is about one and it could be fitted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub order: Option<OrderRecord>,
    /// The bound and its reason.
    pub tolerance: ToleranceRecord,
    /// Least tolerance / error over the rungs the tolerance applies to; infinite for no error.
    #[serde(with = "number")]
    pub slack: f64,
    /// The outcome.
    pub verdict: Verdict,
}

impl Record {
    /// Whether the claim holds.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.verdict == Verdict::Pass
    }
}

/// A rung without a result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FailedRung {
    /// The rung.
    #[serde(with = "number")]
    pub parameter: f64,
    /// Why, in words.
    pub why: String,
}

/// Observed order beside the expected one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OrderRecord {
    /// Expected order.
    #[serde(with = "number")]
    pub expected: f64,
    /// Accepted deviation.
    #[serde(with = "number")]
    pub band: f64,
    /// Only a lower bound.
    pub at_least: bool,
    /// What was observed.
    pub fitted: FittedOrder,
    /// Extrapolated value, for claims about one number on a ladder of constant ratio.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub richardson: Option<Richardson>,
}

/// A tolerance as it was declared.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ToleranceRecord {
    /// The bound.
    #[serde(with = "number")]
    pub value: f64,
    /// `every rung`, `the last rung`, `N = 64`.
    pub applies_to: String,
    /// The reason.
    pub because: String,
}

/// Whether a claim holds.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Every check passed.
    Pass,
    /// At least one did not; the reasons in words.
    Fail { reasons: Vec<String> },
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn round_trip(x: f64) -> f64 {
        let sample = Sample::absolute(x, x, x).with("x [-]", x);
        let text = serde_json::to_string(&sample).unwrap();
        let back: Sample = serde_json::from_str(&text).unwrap();
        assert_eq!(back.extra["x [-]"].to_bits(), back.computed.to_bits());
        back.computed
    }

    proptest! {
        #[test]
        fn exact_round_trip_of_every_bit(bits: u64) {
            let x = f64::from_bits(bits);
            let back = round_trip(x);
            prop_assert!(back.to_bits() == bits || (x.is_nan() && back.is_nan()));
        }
    }

    #[test]
    fn exact_round_trip_of_special_numbers() {
        for x in [0.0, -0.0, f64::INFINITY, f64::NEG_INFINITY, f64::MIN_POSITIVE, 5e-324, f64::MAX] {
            assert_eq!(round_trip(x).to_bits(), x.to_bits());
        }
        assert!(round_trip(f64::NAN).is_nan());
    }
}
