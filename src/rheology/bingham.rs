//! σ = σ0 + μ γ̇.

use super::{Flow, Rheology};
use crate::lane::Lane;

/// Bingham fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bingham {
    /// Yield stress, lattice units, ≥ 0.
    pub sigma0: f64,
    /// Plastic viscosity, lattice units, > 0.
    pub mu: f64,
}

impl Rheology for Bingham {
    #[inline(always)]
    fn stress<L: Lane>(&self, gamma_dot: L) -> L {
        L::splat(self.sigma0) + L::splat(self.mu) * gamma_dot
    }

    /// γ̇ = (q − σ0)/(μ + ρ/6) where q > σ0, else 0.
    ///
    /// # Source
    /// docs/method.md \[Y3\]; docs/errata.md 6 (closed form of the implicit relation).
    /// # Verified by
    /// Claim `poiseuille-bingham`; property `solve_is_monotone_and_unique`.
    #[inline(always)]
    fn shear_rate<L: Lane>(&self, rho: L, q: L) -> L {
        let excess = q - L::splat(self.sigma0);
        let gamma_dot = excess / (L::splat(self.mu) + rho * L::splat(1.0 / 6.0));
        L::select(L::zero().less(excess), gamma_dot, L::zero())
    }

    #[inline(always)]
    fn tangent_viscosity<L: Lane>(&self, _gamma_dot: L) -> L {
        L::splat(self.mu)
    }

    #[inline(always)]
    fn flow<L: Lane>(&self, sigma: L) -> Flow<L> {
        Flow::power(self.mu, 1.0, sigma - L::splat(self.sigma0))
    }
}
