//! Constitutive laws σ(γ̇) and the local solve [Y3] that turns a stress into a shear rate.

use serde::{Deserialize, Serialize};

/// A constitutive law in lattice units (reference density 1, so dynamic = kinematic values).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Law {
    /// σ = μ γ̇.
    Newtonian { mu: f64 },
    /// σ = σ0 + μ γ̇.
    Bingham { sigma0: f64, mu: f64 },
    /// σ = σ0 + K γ̇ⁿ.
    HerschelBulkley { sigma0: f64, k: f64, n: f64 },
    /// σ = K γ̇ⁿ.
    PowerLaw { k: f64, n: f64 },
    /// σ = σ0 (1 − exp(−m γ̇)) + K γ̇ⁿ.
    Papanastasiou { sigma0: f64, k: f64, n: f64, m: f64 },
}
