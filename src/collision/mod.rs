//! Collision operators.

use serde::{Deserialize, Serialize};

/// How the odd (antisymmetric) relaxation time follows the even one \[K2\] \[K3\] \[K5\].
///
/// With e = τ⁺ − ½: τ⁻ = ½ + max(Λ · min(1/e, e/e₀²), θ), e₀ = `lowered_below`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OddRate {
    /// Λ = (τ⁺ − ½)(τ⁻ − ½); 3/16 puts half-way walls exactly half-way.
    pub magic: f64,
    /// θ, least τ⁻ − ½.
    pub floor: f64,
    /// e₀: below this τ⁺ − ½ the product Λ is given up for stability \[K5\]; 0 keeps it always.
    pub lowered_below: f64,
}

/// The collision operator of a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CollisionChoice {
    /// [K1].
    Bgk,
    /// [K2].
    Trt(OddRate),
    /// [K3].
    CentralMoment(OddRate),
    /// [K4].
    Regularised,
}

impl Default for OddRate {
    fn default() -> Self {
        Self { magic: 3.0 / 16.0, floor: 0.05, lowered_below: 0.05 }
    }
}

impl Default for CollisionChoice {
    /// The central-moment operator: the only one that un-yields a moving plug \[K3\].
    fn default() -> Self {
        Self::CentralMoment(OddRate::default())
    }
}
