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
/// With φ of the cell itself there, the normal would lean by 11° in a corner between a wall and a level surface.
///
/// # Arguments
/// `fill`: φ of the cell. `around(c)`: φ at x + c, `None` where there is no cell.
/// # Source
/// As [`outward`].
/// # Verified by
/// Test `exact_normal_beside_a_wall`.
#[must_use]
pub(crate) fn outward_beside_walls(fill: f64, around: &[Option<f64>; Q]) -> [f64; 3] {
    let open = |c: [i32; 3]| direction(c).and_then(|i| around[i]);
    outward(&std::array::from_fn(|i| {
        let c = C[i];
        around[i].unwrap_or_else(|| {
            let kept = std::array::from_fn(|a| {
                let mut axis = [0; 3];
                axis[a] = c[a];
                if open(axis).is_some() { c[a] } else { 0 }
            });
            if kept == [0; 3] { fill } else { open(kept).unwrap_or(fill) }
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
    fn exact_normal_beside_a_wall() {
        // A level surface at φ = 0.25 beside a wall at smaller x.
        let level = |c: [i32; 3]| [1.0, 0.25, 0.0][(c[2] + 1) as usize];
        let around = std::array::from_fn(|i| (C[i][0] >= 0).then(|| level(C[i])));
        let n = outward_beside_walls(0.25, &around);
        assert!(n[0].abs() < 1e-15 && n[1].abs() < 1e-15 && n[2] > 0.0);
    }
}
