//! Integrators \[D3\].

pub mod gear;
pub mod verlet;

use serde::{Deserialize, Serialize};

/// Choice of integrator.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Integrator {
    /// Velocity Verlet, second order, forces at the predicted velocity.
    #[default]
    Verlet,
    /// Gear's 6-value predictor–corrector with c₀ = 3/16 (forces that depend on velocity).
    Gear,
    /// The same with c₀ = 3/20 (forces that do not).
    GearConservative,
}
