//! The second-order equilibrium \[L3\].

use super::{C, Q, W};
use crate::lane::Lane;
use crate::lattice::unroll::directions;

/// Σ_a c_a v_a for a lattice direction, without multiplications; grouped (x, y), z.
#[inline(always)]
pub fn dot<L: Lane>(i: usize, v: &[L; 3]) -> L {
    (component(i, 0, v) + component(i, 1, v)) + component(i, 2, v)
}

/// c_a v_a.
#[inline(always)]
fn component<L: Lane>(i: usize, a: usize, v: &[L; 3]) -> L {
    match C[i][a] {
        1 => v[a],
        -1 => -v[a],
        _ => L::zero(),
    }
}

/// Second-order equilibrium as h = f − w.
///
/// h_i^eq = w_i [δρ + ρ (3 c·u + 9/2 (c·u)² − 3/2 u²)]
///
/// # Arguments
/// `d_rho`: ρ − 1. `rho`: density. `u`: velocity, lattice units.
/// # Returns
/// The 19 values f_i^eq − w_i.
/// # Exactness
/// + − × only, one order; bit-stable.
/// # Source
/// 004 Eq 3.25 (3.44 corrected: u²/(2c_s²)).
/// # Verified by
/// Claims `equilibrium-moments`, `moment-identities`.
#[inline(always)]
pub fn equilibrium<L: Lane>(d_rho: L, rho: L, u: &[L; 3]) -> [L; Q] {
    let usq = L::splat(1.5) * ((u[0] * u[0] + u[1] * u[1]) + u[2] * u[2]);
    directions(
        #[inline(always)]
        |i| {
            let cu = L::splat(3.0) * dot(i, u);
            L::splat(W[i]) * (d_rho + rho * ((cu + L::splat(0.5) * (cu * cu)) - usq))
        },
    )
}
