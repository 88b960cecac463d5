//! The viscosity-independent wall \[B3\] and the residual force it needs.

use crate::lane::Lane;
use crate::lattice::CS2;

/// Slip of a half-way wall under a tangential force: f_t (2(τ⁻ − ½)/ρ − 1/(8 dσ/dγ̇)).
///
/// The first term is the jump that the odd moments make at the wall, the second the curvature of the
/// profile over the half cell, |u″|/8 = f_t/(8 dσ/dγ̇). For a Newtonian fluid dσ/dγ̇ = ρν and this is
/// the design's (f_t/ρ)(2(τ⁻ − ½) − 3/(8(τ⁺ − ½))); with a yield stress the apparent viscosity would
/// put half the curvature term in the wrong place.
///
/// # Arguments
/// `tangential`: tangential part of F − ∇p. `tangent_fluidity`: 1/(dσ/dγ̇) of the cell, 0 if rigid.
/// `odd_omega`: the cell's ω⁻.
/// # Returns
/// The velocity by which the wall appears to move; subtract it from u_w in \[B1\].
/// # Source
/// Design \[B3\]; for BGK it is G(16Λ − 3)/(24ρν), REFERENCES §1.
/// # Verified by
/// Claims `poiseuille-newtonian-b3`, `poiseuille-newtonian-bgk-slip`, `poiseuille-wall-node-error`.
#[inline(always)]
pub fn wall_slip<L: Lane>(tangential: &[L; 3], rho: L, tangent_fluidity: L, odd_omega: L) -> [L; 3] {
    let odd = L::splat(2.0) * (L::one() / odd_omega - L::splat(0.5)) / rho;
    let curvature = L::splat(1.0 / 8.0) * tangent_fluidity;
    tangential.map(|f| f * (odd - curvature))
}

/// v − (v·n) n
///
/// # Source
/// Design \[B3\].
/// # Verified by
/// Claim `poiseuille-newtonian-b3`.
#[inline(always)]
pub fn tangential<L: Lane>(v: &[L; 3], normal: &[f64; 3]) -> [L; 3] {
    let n = normal.map(L::splat);
    let along = (v[0] * n[0] + v[1] * n[1]) + v[2] * n[2];
    std::array::from_fn(|a| v[a] - along * n[a])
}

/// ∂p from the densities of the two neighbours along one axis; one-sided where one is missing,
/// zero where both are.
///
/// # Source
/// Design \[B3\], \[K6\]: p = c_s² ρ.
/// # Verified by
/// Claim `resting-layer-creep`.
#[must_use]
pub fn pressure_slope(low: Option<f64>, here: f64, high: Option<f64>) -> f64 {
    match (low, high) {
        (Some(a), Some(b)) => 0.5 * CS2 * (b - a),
        (Some(a), None) => CS2 * (here - a),
        (None, Some(b)) => CS2 * (b - here),
        (None, None) => 0.0,
    }
}

/// (2/3) f_a (1 − τ_w/τ⁻) for each third moment a_abb, where the floor θ acts \[K6\].
///
/// The design gives the source for one shear-normal direction b. Here it is divided over the two
/// directions b ≠ a in proportion to Q_ab², so that the direction in which the component a is
/// sheared gets it.
///
/// # Arguments
/// `residual`: f = F − ∇p. `q`: deviator of the non-equilibrium tensor. `excess_wanted`: τ_w − ½.
/// `odd_omega`: ω⁻.
/// # Returns
/// Additions to the six third moments, order of [`crate::lattice::moments::THIRD`].
/// # Source
/// Design \[K6\].
/// # Verified by
/// Claim `resting-layer-creep`.
#[inline(always)]
pub fn stress_source<L: Lane>(residual: &[L; 3], q: &[L; 6], excess_wanted: L, odd_omega: L) -> [L; 6] {
    use crate::lattice::moments::THIRD;
    use crate::lattice::pair;
    let half = L::splat(0.5);
    let share = L::one() - (half + excess_wanted) * odd_omega;
    let share = L::select(L::zero().less(share), share, L::zero());
    std::array::from_fn(|k| {
        // Moment (b, a): Σ c_b² c_a f.
        let [b, a] = THIRD[k];
        let c = 3 - a - b;
        let (own, other) = (q[pair(a, b)] * q[pair(a, b)], q[pair(a, c)] * q[pair(a, c)]);
        let total = own + other;
        let sheared = L::zero().less(total);
        let weight = L::select(sheared, own / L::select(sheared, total, L::one()), L::zero());
        L::splat(2.0 / 3.0) * ((weight * residual[a]) * share)
    })
}
