//! Viscous momentum is exchanged over the wetted part of links only \[F9\].

use crate::lane::Lane;
use crate::lattice::equilibrium::dot;
use crate::lattice::moments::momentum;
use crate::lattice::unroll::three;
use crate::lattice::{C, Q, W};

/// e_i = w_i [δρ + ρ (9/2 (c_i·u)² − 3/2 u²)]: the equilibrium without its part that is odd in c.
///
/// # Source
/// docs/method.md \[L3\], \[F9\].
/// # Verified by
/// Test `exact_viscous_part_of_equilibrium`.
#[inline(always)]
#[must_use]
pub(crate) fn even<L: Lane>(i: usize, d_rho: L, u: &[L; 3]) -> L {
    let usq = (u[0] * u[0] + u[1] * u[1]) + u[2] * u[2];
    let cu = dot(i, u);
    let flow = L::splat(4.5) * (cu * cu) - L::splat(1.5) * usq;
    L::splat(W[i]) * (d_rho + (L::one() + d_rho) * flow)
}

/// v_i = [f_i* − e_i](x − c_i) + [f_ī* − e_ī](x): c_i v_i is what a link brings of the viscous momentum, without
/// pressure and without what the flow carries.
///
/// # Arguments
/// `arriving`, `leaving`: post-collision populations of the link, f − w. `there`, `here`: e of its two ends.
/// # Source
/// docs/method.md \[F9\], ours.
/// # Verified by
/// Claim `trough-level`.
#[inline(always)]
#[must_use]
pub(crate) fn viscous<L: Lane>(arriving: L, leaving: L, there: L, here: L) -> L {
    (arriving - there) + (leaving - here)
}

/// 1 − A of a link between two interface cells, A as for mass \[F1\].
///
/// # Source
/// docs/method.md \[F9\].
/// # Verified by
/// Claim `trough-level`.
#[inline(always)]
#[must_use]
pub(crate) fn dry_share<L: Lane>(fill: L, other: L) -> L {
    L::one() - L::splat(0.5) * (fill + other)
}

/// 1 − A of a link to a wall: (1 − φ) max(0, 1 − 2|cos(c, n)|). A wall beside the cell is wet over φ of its height, the
/// floor below it wholly.
///
/// # Arguments
/// `fill`: φ. `out`: direction towards the wall. `normal`: of the surface, any length.
/// # Source
/// docs/method.md \[F9\], ours.
/// # Verified by
/// Test `exact_shares_of_walls`; claim `trough-level`.
#[must_use]
pub(crate) fn dry_share_at_wall(fill: f64, out: usize, normal: &[f64; 3]) -> f64 {
    let length2 = (normal[0] * normal[0] + normal[1] * normal[1]) + normal[2] * normal[2];
    if length2 <= 0.0 {
        return 0.0;
    }
    let links: i32 = C[out].iter().map(|c| c * c).sum();
    let cosine = dot(out, normal) / (length2 * f64::from(links)).sqrt();
    (1.0 - fill) * (1.0 - 2.0 * cosine.abs()).max(0.0)
}

/// 1/u² of the speed, 0.2 cells per step, from which on nothing is taken back.
const FAST: f64 = 25.0;

/// −max(0, 1 − u²/0.04) Σ (1 − A_i) c_i v_i: what a partly filled cell takes back in its next collision.
///
/// Where a cell is that fast the flow is not viscous on its scale: what a link brings beside pressure and convection is the
/// noise of an impact, and drove spray to the speed limit.
///
/// # Arguments
/// `parts[i]`: (1 − A_i) v_i. `u`: velocity of the cell.
/// # Source
/// docs/method.md \[F9\].
/// # Verified by
/// Claim `trough-level`.
#[inline(always)]
#[must_use]
pub(crate) fn taken_back<L: Lane>(parts: &[L; Q], u: &[L; 3]) -> [L; 3] {
    let usq = (u[0] * u[0] + u[1] * u[1]) + u[2] * u[2];
    let calm = L::larger(L::one() - L::splat(FAST) * usq, L::zero());
    let brought = momentum(parts);
    three(
        #[inline(always)]
        |a| -(calm * brought[a]),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::equilibrium::equilibrium;
    use crate::lattice::opposite;

    #[test]
    fn exact_viscous_part_of_equilibrium() {
        // Uniform flow has no viscous momentum: three terms below 1 per population, a rounding each.
        let (d_rho, u) = (0.02, [0.03, -0.01, 0.05]);
        let f = equilibrium(d_rho, 1.0 + d_rho, &u);
        for i in 1..Q {
            let (there, here) = (even(i, d_rho, &u), even(opposite(i), d_rho, &u));
            assert!(viscous(f[i], f[opposite(i)], there, here).abs() < 6.0 * f64::EPSILON, "{i}");
        }
    }

    #[test]
    fn exact_shares_of_walls() {
        let along = |c| crate::lattice::direction(c).unwrap_or(0);
        let up = [0.0, 0.0, 0.3];
        assert_eq!(dry_share_at_wall(0.25, along([1, 0, 0]), &up), 0.75);
        assert_eq!(dry_share_at_wall(0.25, along([0, 0, -1]), &up), 0.0);
        assert_eq!(dry_share_at_wall(0.25, along([1, 0, -1]), &up), 0.0);
        assert_eq!(dry_share_at_wall(0.25, along([1, 0, 0]), &[0.0; 3]), 0.0);
    }
}
