//! σ = σ0 + K γ̇ⁿ.

use super::power_sum::PowerSum;
use super::{Flow, Rheology};
use crate::lane::Lane;

/// Herschel-Bulkley fluid, with the table of its local solve.
#[derive(Clone, Debug, PartialEq)]
pub struct HerschelBulkley {
    sigma0: f64,
    k: f64,
    n: f64,
    solve: PowerSum,
}

impl HerschelBulkley {
    /// From yield stress ≥ 0, consistency > 0 (lattice units) and flow index > 0.
    ///
    /// Makes a table of a few kilobytes, which clones share: once per run, not once per cell.
    #[must_use]
    pub fn new(sigma0: f64, k: f64, n: f64) -> Self {
        Self { sigma0, k, n, solve: PowerSum::new(k, n) }
    }
}

/// K γ̇ⁿ.
#[inline(always)]
pub(super) fn power_stress<L: Lane>(k: f64, n: f64, gamma_dot: L) -> L {
    L::splat(k) * (L::splat(n) * gamma_dot.ln()).exp()
}

impl Rheology for HerschelBulkley {
    #[inline(always)]
    fn stress<L: Lane>(&self, gamma_dot: L) -> L {
        L::splat(self.sigma0) + power_stress(self.k, self.n, gamma_dot)
    }

    /// The root of q − σ0 = K γ̇ⁿ + (ρ/6) γ̇; zero where q does not exceed σ0.
    ///
    /// # Source
    /// docs/method.md \[Y3\].
    /// # Verified by
    /// Claim `poiseuille-herschel-bulkley`; property `solve_is_monotone_and_unique`.
    #[inline(always)]
    fn shear_rate<L: Lane>(&self, rho: L, q: L) -> L {
        let excess = q - L::splat(self.sigma0);
        let yielded = L::zero().less(excess);
        if !L::any(yielded) {
            return L::zero();
        }
        let safe = L::select(yielded, excess, L::one());
        let gamma_dot = L::in_double(&self.solve, rho * L::splat(1.0 / 6.0), safe);
        L::select(yielded, gamma_dot, L::zero())
    }

    #[inline(always)]
    fn tangent_viscosity<L: Lane>(&self, gamma_dot: L) -> L {
        L::splat(self.n * self.k) * (L::splat(self.n - 1.0) * gamma_dot.ln()).exp()
    }

    #[inline(always)]
    fn flow<L: Lane>(&self, sigma: L) -> Flow<L> {
        Flow::power(self.k, self.n, sigma - L::splat(self.sigma0))
    }

    #[inline(always)]
    fn thickens(&self) -> bool {
        self.n > 1.0
    }
}
