//! Mass exchange between cells \[F1\] and the populations that the gas sends back \[F2\].

use super::Kind;
use crate::lane::Lane;
use crate::lattice::equilibrium::dot;
use crate::lattice::{W, opposite};

/// A: the wetted share of a link from an interface cell.
///
/// 1 to liquid, ½(φ + φ′) to interface, 0 to gas and solid. Symmetric in its two cells, so that what
/// one gains is what the other loses, to the last bit.
///
/// # Arguments
/// `neighbour`: kind of the cell at the other end. `fill`, `neighbour_fill`: φ of the two cells, 0 to 1.
/// # Source
/// 000 Eq 12, 001 Eq 11, 004 Eq 3.31; docs/errata.md 20 (fill, not mass), 21 (sum, not difference).
/// # Verified by
/// Claims `surface-pattern-carried`, `dam-break-mass`; mutants `exchange-of-masses`,
/// `exchange-of-differences`.
#[inline(always)]
#[must_use]
pub fn wetted_share(neighbour: Kind, fill: f64, neighbour_fill: f64) -> f64 {
    match neighbour {
        Kind::Liquid => 1.0,
        Kind::Interface => 0.5 * (fill + neighbour_fill),
        Kind::Gas | Kind::Solid => 0.0,
    }
}

/// Stands for φ of liquid in [`share_with`].
pub(crate) const LIQUID: f64 = 2.0;

/// Stands for φ of gas and solids in [`share_with`].
pub(crate) const GAS: f64 = -1.0;

/// [`wetted_share`] for lanes. `neighbour`: φ′, [`LIQUID`] or [`GAS`].
///
/// # Source
/// As [`wetted_share`].
/// # Verified by
/// Test `exact_share_of_every_kind`.
#[inline(always)]
pub(crate) fn share_with<L: Lane>(fill: L, neighbour: L) -> L {
    let partly = L::splat(0.5) * (fill + neighbour);
    let wet = L::select(L::one().less(neighbour), L::one(), partly);
    L::select(neighbour.less(L::zero()), L::zero(), wet)
}

/// Δm of one link: A (f_ī*(x + c_i) − f_i*(x)).
///
/// # Arguments
/// `share`: A. `arriving`, `leaving`: post-collision populations of the link, f − w.
/// # Source
/// 000 Eq 11, 004 Eq 3.30; docs/errata.md 17 (both post-collision), 19, 23.
/// # Verified by
/// Claim `dam-break-mass`; mutant `exchange-before-collision`.
#[inline(always)]
#[must_use]
pub fn link_mass<L: Lane>(share: L, arriving: L, leaving: L) -> L {
    share * (arriving - leaving)
}

/// f_ī(x, t+1) = f_i^eq(u, ρ_g) + f_ī^eq(u, ρ_g) − f_i*(x), gas density ρ_g = 1.
///
/// # Arguments
/// `leaving`: f_i* − w_i of the interface cell. `i`: direction towards the gas. `u`: its velocity.
/// # Returns
/// f_ī − w_i, at the interface cell itself.
/// # Exactness
/// The odd parts of the two equilibria cancel before rounding.
/// # Source
/// 004 Eq 3.32; docs/errata.md 16 (which node), 17 (post-collision), 24 (ρ_g is the reference density).
/// # Verified by
/// Claims `pool-at-rest`, `film-newtonian`; mutant `reconstruction-at-the-neighbour`.
#[inline(always)]
pub(crate) fn gas_link<L: Lane>(leaving: L, i: usize, u: &[L; 3]) -> L {
    debug_assert_eq!(W[i], W[opposite(i)]);
    let usq = (u[0] * u[0] + u[1] * u[1]) + u[2] * u[2];
    let cu = dot(i, u);
    let both = L::splat(W[i]) * (L::splat(9.0) * (cu * cu) - L::splat(3.0) * usq);
    both - leaving
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_share_of_every_kind() {
        for fill in [0.0, 0.1, 0.7, 1.0] {
            assert_eq!(share_with(fill, LIQUID), wetted_share(Kind::Liquid, fill, 1.0));
            assert_eq!(share_with(fill, GAS), wetted_share(Kind::Gas, fill, 0.0));
            for other in [0.0, 0.3, 1.0] {
                assert_eq!(share_with(fill, other), wetted_share(Kind::Interface, fill, other));
            }
        }
    }
}
