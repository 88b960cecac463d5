//! Direction of the surface from the fill around a cell.

use crate::lattice::moments::momentum;
use crate::lattice::{Q, W};

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
#[must_use]
pub(crate) fn outward(fill: &[f64; Q]) -> [f64; 3] {
    let weighted = std::array::from_fn(|i| W[i] * fill[i]);
    momentum(&weighted).map(|g| -3.0 * g)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::C;

    #[test]
    fn exact_normal_of_a_slope() {
        let fill = std::array::from_fn(|i| 0.5 - 0.25 * f64::from(C[i][2]) + 0.125 * f64::from(C[i][0]));
        let n = outward(&fill);
        // Ten products of numbers below 1.
        assert!((n[0] + 0.125).abs() < 1e-15 && n[1].abs() < 1e-15 && (n[2] - 0.25).abs() < 1e-15);
    }
}
