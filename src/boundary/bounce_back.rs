//! Half-way bounce-back \[B1\] and the surface velocity of a moving solid.

use crate::lane::Lane;
use crate::lattice::W;
use crate::lattice::equilibrium::dot;
pub(crate) use crate::vector::surface_velocity;

/// f_ī(x, t+1) = f_i*(x) − 6 w_i ρ c_i·u_w
///
/// # Arguments
/// `out`: post-collision population f_i* − w_i leaving towards the wall along c_i, direction `i`.
/// `rho`: density of the cell. `u_wall`: wall velocity at the link, lattice units.
/// # Returns
/// The population that comes back, f_ī − w_i (w_ī = w_i).
/// # Exactness
/// + − × only; bit-stable.
/// # Source
/// 004 Eqs 3.36–3.37; docs/errata.md 14, 15 (factor 6; population returns to the cell it left).
/// # Verified by
/// Claims `couette-newtonian`, `poiseuille-newtonian-bgk-slip`.
#[inline(always)]
pub fn bounce_back<L: Lane>(out: L, i: usize, rho: L, u_wall: &[L; 3]) -> L {
    out - L::splat(6.0 * W[i]) * (rho * dot(i, u_wall))
}

/// −(f_i^eq − f_ī^eq) of third order in u, of the equilibrium with third moments m_aab = ρ u_a² u_b + ρ u_b/3.
///
/// With it a wall that moves with a uniform flow sends back exactly what the flow would bring.
///
/// # Arguments
/// `i`: direction of the leaving population. `rho`, `u`: density of the cell, velocity of the wall.
/// # Source
/// Inverse transform of \[K3\].
/// # Verified by
/// Claim `galilean-twin`.
#[must_use]
pub(crate) fn cubic(i: usize, rho: f64, u: &[f64; 3]) -> f64 {
    let c = crate::lattice::C[i].map(f64::from);
    let along: [f64; 3] = std::array::from_fn(|a| c[a] * u[a]);
    let sum = along[0] + along[1] + along[2];
    match i {
        0 => 0.0,
        1..=6 => {
            let square: f64 = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
            rho * sum * (square - sum * sum)
        }
        _ => {
            // Of the three products of components along c one is not zero: s u_x r u_y.
            let product = along[0] * along[1] + along[0] * along[2] + along[1] * along[2];
            -0.5 * rho * (product * sum)
        }
    }
}
