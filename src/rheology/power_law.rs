//! σ = K γ̇ⁿ.

use super::herschel_bulkley::HerschelBulkley;
use super::{Flow, Rheology};
use crate::lane::Lane;

/// Power-law fluid: Herschel-Bulkley without yield stress.
#[derive(Clone, Debug, PartialEq)]
pub struct PowerLaw(HerschelBulkley);

impl PowerLaw {
    /// From consistency and flow index, both > 0, lattice units.
    #[must_use]
    pub fn new(k: f64, n: f64) -> Self {
        Self(HerschelBulkley::new(0.0, k, n))
    }
}

impl Rheology for PowerLaw {
    #[inline(always)]
    fn stress<L: Lane>(&self, gamma_dot: L) -> L {
        self.0.stress(gamma_dot)
    }

    /// The root of q = K γ̇ⁿ + (ρ/6) γ̇; zero at q = 0.
    ///
    /// # Source
    /// docs/method.md \[Y3\] with σ0 = 0.
    /// # Verified by
    /// Claim `couette-all-laws`; property `solve_is_monotone_and_unique`.
    #[inline(always)]
    fn shear_rate<L: Lane>(&self, rho: L, q: L) -> L {
        self.0.shear_rate(rho, q)
    }

    #[inline(always)]
    fn tangent_viscosity<L: Lane>(&self, gamma_dot: L) -> L {
        self.0.tangent_viscosity(gamma_dot)
    }

    #[inline(always)]
    fn flow<L: Lane>(&self, sigma: L) -> Flow<L> {
        self.0.flow(sigma)
    }

    #[inline(always)]
    fn thickens(&self) -> bool {
        self.0.thickens()
    }
}
