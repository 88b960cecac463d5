//! σ = μ γ̇.

use super::{Flow, Rheology};
use crate::lane::Lane;

/// Newtonian fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Newtonian {
    /// Dynamic viscosity, lattice units, > 0.
    pub mu: f64,
}

impl Rheology for Newtonian {
    const VARIES: bool = false;

    /// τ = ½ + 3ν \[L6\].
    ///
    /// # Source
    /// 004 Eq 3.69.
    /// # Verified by
    /// Claim `shear-wave-axis-bgk`.
    #[inline(always)]
    fn constant_tau(&self) -> Option<f64> {
        Some(0.5 + 3.0 * self.mu)
    }

    #[inline(always)]
    fn stress<L: Lane>(&self, gamma_dot: L) -> L {
        L::splat(self.mu) * gamma_dot
    }

    /// γ̇ = q / (μ + ρ/6): the same as τ = ½ + 3μ/ρ \[L6\].
    ///
    /// # Source
    /// 004 Eq 3.69.
    /// # Verified by
    /// Property `solve_is_monotone_and_unique`.
    #[inline(always)]
    fn shear_rate<L: Lane>(&self, rho: L, q: L) -> L {
        q / (L::splat(self.mu) + rho * L::splat(1.0 / 6.0))
    }

    #[inline(always)]
    fn viscosity<L: Lane>(&self, _gamma_dot: L) -> L {
        L::splat(self.mu)
    }

    #[inline(always)]
    fn tangent_viscosity<L: Lane>(&self, _gamma_dot: L) -> L {
        L::splat(self.mu)
    }

    #[inline(always)]
    fn flow<L: Lane>(&self, sigma: L) -> Flow<L> {
        Flow::newtonian(L::splat(self.mu), sigma)
    }
}
