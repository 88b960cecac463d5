//! From a law and the state of a cell to the even relaxation rate ω⁺ = 1/τ.

use super::{Flow, Rheology, YieldTreatment};
use crate::lane::Lane;

/// ω⁺ from a shear rate: 1/τ = ρ γ̇ / (3 q); zero where q is zero.
///
/// # Source
/// docs/method.md \[Y2\] solved for τ.
/// # Verified by
/// Property `solve_is_monotone_and_unique`.
#[inline(always)]
pub fn omega_of_shear_rate<L: Lane>(rho: L, gamma_dot: L, q: L) -> L {
    let flowing = L::zero().less(q);
    let safe = L::select(flowing, q, L::one());
    L::select(flowing, (rho * gamma_dot) / (L::splat(3.0) * safe), L::zero())
}

/// γ̇ = 3 q ω / ρ \[Y2\].
///
/// # Source
/// 004 Eq 3.27, corrected (docs/errata.md 2, 3).
/// # Verified by
/// Claim `shear-rate-couette`.
#[inline(always)]
pub(crate) fn shear_rate_of_omega<L: Lane>(rho: L, omega: L, q: L) -> L {
    L::splat(3.0) * q * omega / rho
}

/// τ = ½ + 3 μ/ρ \[L6\].
///
/// # Source
/// 004 Eq 3.69; docs/errata.md 7–10: μ is dynamic, so it is divided by ρ.
/// # Verified by
/// Claim `shear-wave-axis-bgk`.
#[inline(always)]
pub fn tau_of_viscosity<L: Lane>(rho: L, mu: L) -> L {
    L::splat(0.5) + L::splat(3.0) * mu / rho
}

/// ω⁺ of a cell under the chosen treatment of the yield stress \[Y3\] \[Y4\].
///
/// # Arguments
/// `rho`: density. `q`: √(½ Q:Q) of the cell. `previous`: ω⁺ of the previous step (only the
/// lagged treatment reads it).
/// # Returns
/// ω⁺ in \[0, 2): 0 is a rigid cell.
/// # Exactness
/// Bit-stable; comparison and selection instead of branches.
/// # Source
/// docs/method.md \[Y1\]–\[Y4\]; 000 Eq 14, 001 Eq 8, 004 Eqs 3.34–3.35 for the lagged form.
/// # Verified by
/// Claims `poiseuille-bingham`, `poiseuille-herschel-bulkley`, `poiseuille-clamped-implicit`,
/// `poiseuille-clamped-lagged`.
#[inline(always)]
pub fn omega<L: Lane, R: Rheology>(law: &R, treatment: YieldTreatment, rho: L, q: L, previous: L) -> L {
    if let Some(tau) = law.constant_tau() {
        return L::splat(1.0 / tau);
    }
    match treatment {
        YieldTreatment::Exact => omega_of_shear_rate(rho, law.shear_rate(rho, q), q),
        YieldTreatment::ImplicitClamped { tau_min, tau_max } => {
            let free = omega_of_shear_rate(rho, law.shear_rate(rho, q), q);
            clamp(free, 1.0 / tau_max, 1.0 / tau_min)
        }
        YieldTreatment::LaggedClamped { tau_min, tau_max } => {
            let gamma_dot = shear_rate_of_omega(rho, previous, q);
            let tau = tau_of_viscosity(rho, law.viscosity(gamma_dot));
            // An undefined viscosity (0/0 at rest) compares false and becomes tau_max.
            L::one() / clamp(tau, tau_min, tau_max)
        }
    }
}

/// Where a bound on τ makes a law Newtonian.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlowBranch {
    /// Viscosity of the bound at density 1.
    pub mu: f64,
    /// Stress below which it acts; infinite if it always does.
    pub stress: f64,
    /// What Γ of the law lacks above that stress.
    pub gained: f64,
}

impl SlowBranch {
    /// Of a law under a treatment; `None` if no bound on τ acts.
    ///
    /// # Source
    /// docs/method.md \[Y3\]: the bound acts where σ(γ̇)/γ̇ exceeds its viscosity.
    #[must_use]
    pub fn of<R: Rheology>(law: &R, treatment: YieldTreatment) -> Option<Self> {
        let (YieldTreatment::ImplicitClamped { tau_max, .. } | YieldTreatment::LaggedClamped { tau_max, .. }) =
            treatment
        else {
            return None;
        };
        let mu = (tau_max - 0.5) / 3.0;
        // ln γ̇ over all the rates that a number can hold with its square.
        let (mut low, mut high) = (-300.0, 300.0);
        let is_slow = |x: f64| mu < law.viscosity(libm::exp(x));
        if !is_slow(low) {
            return None;
        }
        if is_slow(high) {
            return Some(Self { mu, stress: f64::INFINITY, gained: 0.0 });
        }
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if is_slow(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        let stress = mu * libm::exp(0.5 * (low + high));
        Some(Self { mu, stress, gained: 0.5 * stress * stress / mu - law.flow(stress).integral })
    }
}

/// The law under a stress σ ≥ 0 as a treatment makes it of a cell with relaxation rate `omega`.
///
/// The bound τ_max belongs to the law: below [`SlowBranch::stress`] it is Newtonian. The bound τ_min acts in cells that
/// have reached it only; as a part of the law it would give the wall a second root.
///
/// # Source
/// docs/method.md \[B3\].
#[inline(always)]
pub fn flow<L: Lane, R: Rheology>(
    law: &R,
    treatment: YieldTreatment,
    slow: Option<&SlowBranch>,
    omega: L,
    sigma: L,
) -> Flow<L> {
    let mut flow = law.flow(sigma);
    if let Some(slow) = slow {
        flow.integral = flow.integral + L::splat(slow.gained);
        let newtonian = Flow::newtonian(L::splat(slow.mu), sigma);
        flow = Flow::select(sigma.less_equal(L::splat(slow.stress)), &newtonian, &flow);
    }
    match treatment {
        YieldTreatment::Exact => flow,
        YieldTreatment::ImplicitClamped { tau_min, .. } | YieldTreatment::LaggedClamped { tau_min, .. } => {
            let newtonian = Flow::newtonian(L::splat((tau_min - 0.5) / 3.0), sigma);
            Flow::select(L::splat(AT_BOUND / tau_min).less_equal(omega), &newtonian, &flow)
        }
    }
}

/// Rates within a few roundings of a bound have reached it.
const AT_BOUND: f64 = 1.0 - 1e-12;

/// x limited to \[low, high\]; NaN becomes `high`.
#[inline(always)]
fn clamp<L: Lane>(x: L, low: f64, high: f64) -> L {
    L::larger(L::smaller(x, L::splat(high)), L::splat(low))
}
