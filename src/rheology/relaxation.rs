//! From a law and the state of a cell to the even relaxation rate ω⁺ = 1/τ.

use super::Rheology;
use super::YieldTreatment;
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

/// 1/(dσ/dγ̇) of a cell under the chosen treatment: how fast the shear rate changes with the stress.
///
/// Zero in a rigid cell; where a clamp acts the law is Newtonian and tangent and apparent viscosity
/// are the same.
///
/// # Source
/// docs/method.md \[B3\]; the apparent viscosity is right there only for a Newtonian fluid.
/// # Verified by
/// Claim `poiseuille-wall-node-error`.
#[inline(always)]
pub fn tangent_fluidity<L: Lane, R: Rheology>(
    law: &R,
    treatment: YieldTreatment,
    rho: L,
    omega: L,
    q: L,
) -> L {
    let half = L::splat(0.5);
    // 1/(ρν) = 3/(ρ(τ − ½)) = 3ω/(ρ(1 − ω/2)), finite at ω = 0.
    let apparent = L::splat(3.0) * omega / (rho * (L::one() - half * omega));
    if law.constant_tau().is_some() {
        return apparent;
    }
    let gamma_dot = shear_rate_of_omega(rho, omega, q);
    let flowing = L::zero().less(gamma_dot);
    let safe = L::select(flowing, gamma_dot, L::one());
    let tangent = L::select(flowing, L::one() / law.tangent_viscosity(safe), L::zero());
    match treatment {
        YieldTreatment::Exact => tangent,
        YieldTreatment::ImplicitClamped { tau_min, tau_max }
        | YieldTreatment::LaggedClamped { tau_min, tau_max } => {
            let slow = omega.less_equal(L::splat(1.0 / tau_max));
            let fast = L::splat(1.0 / tau_min).less_equal(omega);
            L::select(slow, apparent, L::select(fast, apparent, tangent))
        }
    }
}

/// x limited to \[low, high\]; NaN becomes `high`.
#[inline(always)]
fn clamp<L: Lane>(x: L, low: f64, high: f64) -> L {
    L::larger(L::smaller(x, L::splat(high)), L::splat(low))
}
