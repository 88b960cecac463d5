//! σ = σ0 + K γ̇ⁿ.

use super::Rheology;
use crate::lane::Lane;

/// Herschel-Bulkley fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HerschelBulkley {
    /// Yield stress, lattice units, ≥ 0.
    pub sigma0: f64,
    /// Consistency, lattice units, > 0.
    pub k: f64,
    /// Flow index, > 0.
    pub n: f64,
    ln_k: f64,
}

impl HerschelBulkley {
    /// From yield stress, consistency and flow index.
    #[must_use]
    pub fn new(sigma0: f64, k: f64, n: f64) -> Self {
        Self { sigma0, k, n, ln_k: libm::log(k) }
    }
}

impl Rheology for HerschelBulkley {
    #[inline(always)]
    fn stress<L: Lane>(&self, gamma_dot: L) -> L {
        L::splat(self.sigma0) + L::splat(self.k) * (L::splat(self.n) * gamma_dot.ln()).exp()
    }

    /// Newton's method in ln γ̇ for q − σ0 = K γ̇ⁿ + (ρ/6) γ̇.
    ///
    /// # Source
    /// Design \[Y3\].
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
        let gamma_dot = two_power_root(self.k, self.ln_k, self.n, rho * L::splat(1.0 / 6.0), safe);
        L::select(yielded, gamma_dot, L::zero())
    }

    #[inline(always)]
    fn tangent_viscosity<L: Lane>(&self, gamma_dot: L) -> L {
        L::splat(self.n * self.k) * (L::splat(self.n - 1.0) * gamma_dot.ln()).exp()
    }
}

/// Rounds of Newton's method after which even the hardest case has converged: quadratic from a
/// start within ln 2 of the root; five suffice in tests over twelve decades.
const MAX_ROUNDS: usize = 12;

/// A Newton step below this leaves an error below its square, 1e-16: below rounding.
const LAST_STEP: f64 = 1e-8;

/// The root γ̇ of K γ̇ⁿ + a γ̇ = s for K, a, s > 0.
///
/// ln(K eⁿˣ + a eˣ) is convex and increasing in x = ln γ̇ with slope between n and 1; started at
/// the smaller of the two single-term roots, where the sum is at least s, Newton's method descends
/// monotonically to the root. A lane that has converged is frozen: its bits do not depend on the
/// other lanes.
#[inline(always)]
pub(super) fn two_power_root<L: Lane>(k: f64, ln_k: f64, n: f64, a: L, s: L) -> L {
    let (k, n) = (L::splat(k), L::splat(n));
    let ln_s = s.ln();
    let mut x = L::smaller((ln_s - L::splat(ln_k)) / n, ln_s - a.ln());
    let mut moving = L::zero().less(s);
    for _ in 0..MAX_ROUNDS {
        let power = k * (n * x).exp();
        let linear = a * x.exp();
        let sum = power + linear;
        let step = (sum / s).ln() * sum / (n * power + linear);
        x = L::select(moving, x - step, x);
        moving = L::and(moving, L::splat(LAST_STEP).less(step.abs()));
        if !L::any(moving) {
            break;
        }
    }
    x.exp()
}
