//! One run of a flow under a scheme, and what it gave.

use crate::claim::VerifyError;
use lahar::collision::{CollisionChoice, OddRate};
use lahar::plan::work::{Case, Operator, Scheme, Walls};
use lahar::setup::{Setup, WallRule, YieldTreatment};

/// Largest and least apparent viscosity of the papers' scheme over the plastic one: 80/3 Pa s, their
/// τ = 1.5, and a thousandth of it, τ = 0.501, over the 0.2 Pa s of the channel.
pub(super) const CLAMP: [f64; 2] = [80.0 / 3.0 / 0.2, 80.0 / 3.0 / 0.2 / 1000.0];

/// One run that could be made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// The flow.
    pub case: Case,
    /// How.
    pub scheme: Scheme,
    /// N.
    pub n: f64,
    /// Δt/Δx² over the standard one.
    pub step: f64,
}

/// What a run gave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Its error.
    pub error: f64,
    /// Steps.
    pub steps: u64,
    /// Cell updates.
    pub updates: f64,
}

/// Puts a scheme into a set-up. The clamp keeps the apparent viscosity within [`CLAMP`] times `plastic`.
pub(super) fn put(scheme: Scheme, plastic: f64, setup: &mut Setup) {
    setup.collision = match scheme.operator {
        Operator::CentralMoment => CollisionChoice::default(),
        Operator::Trt => {
            CollisionChoice::Trt(OddRate { floor: OddRate::STANDARD.floor, ..OddRate::fixed(3.0 / 16.0) })
        }
        Operator::Bgk | Operator::LaggedClamp => CollisionChoice::Bgk,
    };
    if scheme.walls == Walls::HalfWay {
        setup.wall_rule = WallRule::HalfWay;
    }
    if scheme.operator == Operator::LaggedClamp {
        let [tau_max, tau_min] = CLAMP.map(|ratio| 0.5 + 3.0 * ratio * plastic);
        setup.yielding = YieldTreatment::LaggedClamped { tau_min, tau_max };
    }
}

/// The budget does not suffice.
pub(super) fn over(steps: u64) -> VerifyError {
    VerifyError::NotSteady { steps, wanted: 0.0, found: "the budget is used up".to_owned() }
}
