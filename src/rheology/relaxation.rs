//! From a law and the state of a cell to the even relaxation rate ω⁺ = 1/τ.

use super::Rheology;
use crate::lane::Lane;
use crate::solver::setup::YieldTreatment;

/// ω⁺ from a shear rate: 1/τ = ρ γ̇ / (3 q); zero where q is zero.
///
/// # Source
/// Design \[Y2\] solved for τ.
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
/// 004 Eq 3.27, corrected (ERRATA 2, 3).
/// # Verified by
/// Claim `shear-rate-couette`.
#[inline(always)]
pub fn shear_rate_of_omega<L: Lane>(rho: L, omega: L, q: L) -> L {
    L::splat(3.0) * q * omega / rho
}

/// τ = ½ + 3 μ/ρ \[L6\].
///
/// # Source
/// 004 Eq 3.69; ERRATA 7–10: μ is dynamic, so it is divided by ρ.
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
/// Design \[Y1\]–\[Y4\]; 000 Eq 14, 001 Eq 8, 004 Eqs 3.34–3.35 for the lagged form.
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

/// x limited to \[low, high\]; NaN becomes `high`.
#[inline(always)]
fn clamp<L: Lane>(x: L, low: f64, high: f64) -> L {
    L::larger(L::smaller(x, L::splat(high)), L::splat(low))
}
