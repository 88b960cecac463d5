//! Mass exchange between cells \[F1\] and the populations that the gas sends back \[F2\].

use super::Kind;
use crate::lane::Lane;
use crate::lattice::equilibrium::dot;
use crate::lattice::moments::density_excess;
use crate::lattice::{C, Q, W, opposite};

/// A: the wetted share of a link from an interface cell.
///
/// 1 to liquid, ½(c + c′) to interface, 0 to gas and solid. Symmetric in its two cells, so that what
/// one gains is what the other loses, to the last bit.
///
/// # Arguments
/// `neighbour`: kind of the cell at the other end. `share`, `neighbour_share`: c of the two cells (`carried`); φ where the
/// surface does not matter.
/// # Source
/// 000 Eq 12, 001 Eq 11, 004 Eq 3.31; docs/errata.md 20 (fill, not mass), 21 (sum, not difference).
/// # Verified by
/// Claims `surface-pattern-carried`, `dam-break-mass`; mutants `exchange-of-masses`,
/// `exchange-of-differences`.
#[inline(always)]
#[must_use]
pub fn wetted_share(neighbour: Kind, share: f64, neighbour_share: f64) -> f64 {
    match neighbour {
        Kind::Liquid => 1.0,
        Kind::Interface => mean_share(share, neighbour_share),
        Kind::Gas | Kind::Solid => 0.0,
    }
}

/// A of a link between two interface cells: ½(c + c′).
///
/// # Source
/// As [`wetted_share`].
/// # Verified by
/// As [`wetted_share`].
#[inline(always)]
pub(crate) fn mean_share<L: Lane>(own: L, other: L) -> L {
    L::splat(0.5) * (own + other)
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
    let partly = mean_share(fill, neighbour);
    let wet = L::select(L::one().less(neighbour), L::one(), partly);
    L::select(neighbour.less(L::zero()), L::zero(), wet)
}

/// c of an interface cell: the share A of a link between two of them is ½(c + c′).
///
/// Links to liquid carry mass in full and those to gas none, whatever φ; with c the links in between carry what is left, so
/// that a surface that moves along itself with u carries φu:
/// c = φ + [φ G − (1 − φ) D]/L, with G, D, L the sums of t_i = 3 w_i [c_i² − (c_i·n̂)²] over links to gas, liquid and
/// interface. Within −¼ to 5/4, which a level surface does not leave.
///
/// # Arguments
/// `fill`: φ. `gas`, `liquid`, `level`: G, D, L.
/// # Source
/// docs/method.md \[F1\], ours.
/// # Verified by
/// Test `exact_share_of_a_level_surface`; claims `film-wave-*`.
#[inline(always)]
#[must_use]
pub(crate) fn carried<L: Lane>(fill: L, gas: L, liquid: L, level: L) -> L {
    let some = L::zero().less(level);
    let safe = L::select(some, level, L::one());
    let raw = fill + (fill * gas - (L::one() - fill) * liquid) / safe;
    let bounded = L::larger(L::smaller(raw, L::splat(1.25)), L::splat(-0.25));
    L::select(some, bounded, fill)
}

/// t_i = 3 w_i [c_i² − (c_i·n)²/n²]: how much of a flow along the surface a link carries.
///
/// # Arguments
/// `normal`: of the surface, any length. `square`: n².
/// # Source
/// docs/method.md \[F1\], ours.
/// # Verified by
/// As [`carried`].
#[inline(always)]
#[must_use]
pub(crate) fn tangential_weight<L: Lane>(i: usize, normal: &[L; 3], square: L) -> L {
    let links: i32 = C[i].iter().map(|c| c * c).sum();
    let cn = dot(i, normal);
    L::splat(3.0 * W[i]) * (L::splat(f64::from(links)) - cn * cn / square)
}

/// [`carried`] of one cell.
///
/// # Arguments
/// `fill`: φ. `normal`: of the surface, any length. `kind(i)`: of the cell that population `i` comes from, `None` at walls,
/// solids and open faces.
/// # Source
/// docs/method.md \[F1\], ours.
/// # Verified by
/// As [`carried`].
#[must_use]
pub(crate) fn carried_among(
    fill: f64,
    normal: &[f64; 3],
    mut kind: impl FnMut(usize) -> Option<Kind>,
) -> f64 {
    let square = (normal[0] * normal[0] + normal[1] * normal[1]) + normal[2] * normal[2];
    if square <= 0.0 {
        return fill;
    }
    let mut sums = [[0.0; Q]; 3];
    for i in 1..Q {
        let side = match kind(i) {
            Some(Kind::Gas) => 0,
            Some(Kind::Liquid) => 1,
            Some(Kind::Interface) => 2,
            Some(Kind::Solid) | None => continue,
        };
        sums[side][i] = tangential_weight(i, normal, square);
    }
    let [gas, liquid, level] = sums.map(|sum| density_excess(&sum));
    carried(fill, gas, liquid, level)
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
    #[test]
    fn exact_share_of_a_level_surface() {
        // Gas above, liquid below: t of a link with a component along the surface. All carry φ of 2, one for each direction
        // along the surface; a dozen roundings of numbers below 2.
        for normal in [[0.0, 0.0, 0.3], [0.2, 0.0, 0.2], [0.1, 0.2, -0.2]] {
            let square = normal.iter().map(|n| n * n).sum();
            let up = |i: usize| dot(i, &normal);
            let total: f64 = (1..Q).map(|i| tangential_weight(i, &normal, square)).sum();
            assert!((total - 2.0).abs() < 1e-14, "{normal:?}");
            let sum = |side: fn(f64) -> bool| -> f64 {
                (1..Q).filter(|&i| side(up(i))).map(|i| tangential_weight(i, &normal, square)).sum()
            };
            let (gas, liquid, level) = (sum(|c| c > 1e-9), sum(|c| c < -1e-9), sum(|c| c.abs() < 1e-9));
            for fill in [0.2, 0.5, 0.8] {
                let share = carried(fill, gas, liquid, level);
                if share > -0.25 && share < 1.25 {
                    assert!((liquid + level * share - 2.0 * fill).abs() < 1e-14, "{normal:?} {fill}");
                }
            }
        }
        let share = carried(0.3, 1.0 / 3.0, 1.0 / 3.0, 4.0 / 3.0);
        assert!((share - (1.5 * 0.3 - 0.25)).abs() < 1e-15, "{share}");
        assert_eq!(carried(0.3, 1.0, 1.0, 0.0), 0.3);
    }
}
