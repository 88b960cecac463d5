//! Direction of the surface from the fill around a cell.

use crate::lane::Lane;
use crate::lattice::moments::momentum;
use crate::lattice::unroll::{directions, three};
use crate::lattice::{C, Q, W, direction};

/// −∇φ, not normalised: points from fluid to gas.
///
/// # Arguments
/// `fill[i]`: φ at x + c_i; where that is wall or solid, φ of the cell itself.
/// # Exactness
/// Mirror-exact.
/// # Source
/// Σ w_i c_i φ(x + c_i) = c_s² ∇φ + O(Δx³).
/// # Verified by
/// Test `exact_normal_of_a_slope`.
#[inline(always)]
#[must_use]
pub(crate) fn outward<L: Lane>(fill: &[L; Q]) -> [L; 3] {
    let slope = momentum(&directions(
        #[inline(always)]
        |i| L::splat(W[i]) * fill[i],
    ));
    three(
        #[inline(always)]
        |a| L::splat(-3.0) * slope[a],
    )
}

/// [`outward`] of a cell beside walls: behind a wall lies what lies on this side of it.
///
/// A component of c that leads into a wall by itself is left out, also where the cell at x + c is open; a cell that hides
/// behind an edge has the φ that the two beside it go on to. So a level surface is level beside solids of any shape: with φ
/// of the cell itself there, n would lean by 11° in a corner between a wall and a level surface, and more at steps.
///
/// # Arguments
/// `fill`: φ of the cell. `around[i]`: φ at x + c_i, `None` where there is no cell.
/// # Source
/// As [`outward`].
/// # Verified by
/// Test `exact_normal_beside_solids`.
#[must_use]
pub(crate) fn outward_beside_walls(fill: f64, around: &[Option<f64>; Q]) -> [f64; 3] {
    let at = |c: [i32; 3]| if c == [0; 3] { Some(fill) } else { direction(c).and_then(|i| around[i]) };
    let along = |c: [i32; 3], a: usize| {
        let mut axis = [0; 3];
        axis[a] = c[a];
        axis
    };
    outward(&std::array::from_fn(|i| {
        let c = C[i];
        let kept: [i32; 3] = std::array::from_fn(|a| if at(along(c, a)).is_some() { c[a] } else { 0 });
        at(kept).unwrap_or_else(|| {
            let rise = |a: usize| at(along(kept, a)).unwrap_or(fill) - fill;
            (fill + ((rise(0) + rise(1)) + rise(2))).clamp(0.0, 1.0)
        })
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_normal_of_a_slope() {
        let fill = std::array::from_fn(|i| 0.5 - 0.25 * f64::from(C[i][2]) + 0.125 * f64::from(C[i][0]));
        let n = outward(&fill);
        // Ten products of numbers below 1.
        assert!((n[0] + 0.125).abs() < 1e-15 && n[1].abs() < 1e-15 && (n[2] - 0.25).abs() < 1e-15);
    }
    #[test]
    fn exact_normal_beside_solids() {
        // A level surface at φ = 0.25, and every set of solids around: 2¹⁸ of them, each seventh.
        let level = |c: [i32; 3]| [1.0, 0.25, 0.0][(c[2] + 1) as usize];
        for solids in (0..1_u32 << 18).step_by(7) {
            let around = std::array::from_fn(|i| (i == 0 || solids >> (i - 1) & 1 == 0).then(|| level(C[i])));
            let n = outward_beside_walls(0.25, &around);
            assert!(n[0].abs() < 1e-15 && n[1].abs() < 1e-15 && n[2] >= 0.0, "{solids:b}: {n:?}");
        }
    }
}
