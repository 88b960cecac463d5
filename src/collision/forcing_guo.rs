//! The Guo body-force source \[L5\], split into its even and odd parts.

use crate::lane::Lane;
use crate::lattice::equilibrium::dot;
use crate::lattice::unroll::directions;
use crate::lattice::{Q, W};

/// w_i [9 (c·u)(c·F) − 3 u·F]: the even part, before the factor 1 − ω⁺/2.
///
/// # Source
/// 004 Eq 3.28 (docs/errata.md 75: local τ in the factor).
/// # Verified by
/// Claim `shear-rate-uniform-acceleration`.
#[inline(always)]
pub fn even_source<L: Lane>(u: &[L; 3], force: &[L; 3]) -> [L; Q] {
    let uf = L::splat(3.0) * ((u[0] * force[0] + u[1] * force[1]) + u[2] * force[2]);
    directions(
        #[inline(always)]
        |i| L::splat(W[i]) * (L::splat(9.0) * (dot(i, u) * dot(i, force)) - uf),
    )
}

/// 3 w_i c·F: the odd part, before the factor 1 − ω⁻/2.
///
/// # Source
/// 004 Eq 3.28.
/// # Verified by
/// Claim `shear-rate-uniform-acceleration`.
#[inline(always)]
pub fn odd_source<L: Lane>(force: &[L; 3]) -> [L; Q] {
    directions(
        #[inline(always)]
        |i| L::splat(3.0 * W[i]) * dot(i, force),
    )
}
