//! Densities that balance the weight of a fluid at rest.

use super::Kind;

/// ρ − 1 of every cell so that the pressure along the axis of the largest force component balances it,
/// column by column, in the scheme's own discrete sense: zero gas pressure (ρ = 1) at height φ of the
/// topmost cell, ρ′ − ρ = 3·½(φF + φ′F′) between neighbours. With a level surface this is exact rest.
///
/// # Arguments
/// `extents`: cells along x, y, z. `kinds`, `fill`: per cell. `force`: F, lattice units.
/// # Returns
/// ρ − 1 per cell; 0 in gas and solids, and everywhere when the force is zero.
/// # Source
/// Design \[F3\]; stationary solution of collision and streaming with f = w(ρ − (3/2) c·F).
/// # Verified by
/// Claim `pool-at-rest`.
#[must_use]
pub fn density_excess(extents: [usize; 3], kinds: &[Kind], fill: &[f64], force: &[f64; 3]) -> Vec<f64> {
    let mut excess = vec![0.0; kinds.len()];
    let mut axis = 2;
    for a in [1, 0] {
        if force[a].abs() > force[axis].abs() {
            axis = a;
        }
    }
    let weight = force[axis].abs();
    if weight == 0.0 {
        return excess;
    }
    let strides = [1, extents[0], extents[0] * extents[1]];
    let n = extents[axis];
    let [a, b] = [[1, 2], [0, 2], [0, 1]][axis];
    for ib in 0..extents[b] {
        for ia in 0..extents[a] {
            let start = ia * strides[a] + ib * strides[b];
            // From the top down: against the force first.
            let down = |k: usize| if force[axis] < 0.0 { n - 1 - k } else { k };
            let (mut above, mut rho) = (None, 0.0);
            for k in 0..n {
                let cell = start + down(k) * strides[axis];
                if !kinds[cell].is_fluid() {
                    above = None;
                    continue;
                }
                let own = if kinds[cell] == Kind::Liquid { 1.0 } else { fill[cell] };
                rho = match above {
                    None => 1.5 * own * weight,
                    Some(upper) => rho + 1.5 * ((upper + own) * weight),
                };
                excess[cell] = rho;
                above = Some(own);
            }
        }
    }
    excess
}
