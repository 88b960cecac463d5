//! The collision operator of a scene, and what is known of each that a plan has to tell.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::collision::{CollisionChoice, OddRate};

/// The four operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Operator {
    /// One relaxation time.
    Bgk,
    /// Two relaxation times.
    Trt,
    /// Central moments about the co-moving state.
    CentralMoment,
    /// Recursive-regularised.
    Regularised,
}

/// What a plan asks of an operator. A new one is an entry in each of these matches, none of which has a `_` arm.
impl Operator {
    /// The operator of a set-up.
    #[must_use]
    pub const fn of(collision: &CollisionChoice) -> Self {
        match collision {
            CollisionChoice::Bgk => Self::Bgk,
            CollisionChoice::Trt(_) => Self::Trt,
            CollisionChoice::CentralMoment(_) => Self::CentralMoment,
            CollisionChoice::Regularised => Self::Regularised,
        }
    }

    /// The operator with its odd rate, if it has one.
    #[must_use]
    pub const fn with(self, odd: OddRate) -> CollisionChoice {
        match self {
            Self::Bgk => CollisionChoice::Bgk,
            Self::Trt => CollisionChoice::Trt(odd),
            Self::CentralMoment => CollisionChoice::CentralMoment(odd),
            Self::Regularised => CollisionChoice::Regularised,
        }
    }

    /// Its key in a scene.
    #[must_use]
    pub(crate) const fn key(self) -> &'static str {
        match self {
            Self::Bgk => "bgk",
            Self::Trt => "trt",
            Self::CentralMoment => "central_moment",
            Self::Regularised => "regularised",
        }
    }

    /// Whether it has an odd relaxation rate of its own \[K2\].
    #[must_use]
    pub(crate) const fn has_odd_rate(self) -> bool {
        match self {
            Self::Trt | Self::CentralMoment => true,
            Self::Bgk | Self::Regularised => false,
        }
    }

    /// Whether it brings a moving plug to rest with the exact yield stress \[K3\].
    #[must_use]
    pub(crate) const fn stops_plugs(self) -> bool {
        match self {
            Self::CentralMoment => true,
            Self::Bgk | Self::Trt | Self::Regularised => false,
        }
    }

    /// τ⁻ − ½ that is left in an unyielded solid, where τ⁺ is infinite; `None` where τ⁻ has no bound either. The
    /// solid slips along walls in proportion to it \[K3\].
    #[must_use]
    pub(crate) const fn odd_excess_of_plugs(collision: &CollisionChoice) -> Option<f64> {
        match collision {
            CollisionChoice::Trt(odd) | CollisionChoice::CentralMoment(odd) => Some(odd.floor),
            // Third moments without memory: ω⁻ = 1.
            CollisionChoice::Regularised => Some(0.5),
            // One rate: τ⁻ = τ⁺.
            CollisionChoice::Bgk => None,
        }
    }

    /// τ⁺ below which fast grains make it fail, as measured with a sphere of 3.3 cells at 0.08 to 0.15 cells per step,
    /// and a way out; `None`: not down to 0.505.
    #[must_use]
    pub(crate) fn fails_around_fast_grains(
        collision: &CollisionChoice,
        half_way: bool,
    ) -> Option<(f64, &'static str)> {
        match collision {
            CollisionChoice::CentralMoment(odd) => (odd.lowered_below < OddRate::AMONG_GRAINS.lowered_below)
                .then_some((0.6, "leave out `numerics.collision.lowered_below`")),
            CollisionChoice::Trt(_) => half_way.then_some((
                0.52,
                "take the surface `central_linear`, a shorter time step or a coarser grid",
            )),
            CollisionChoice::Regularised => Some((0.55, "take another operator")),
            CollisionChoice::Bgk => None,
        }
    }
}

impl fmt::Display for Operator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.key())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_those_of_the_file() {
        for operator in [Operator::Bgk, Operator::Trt, Operator::CentralMoment, Operator::Regularised] {
            assert_eq!(serde_json::to_value(operator).expect("JSON"), operator.key());
            assert_eq!(Operator::of(&operator.with(OddRate::STANDARD)), operator);
        }
    }
}
