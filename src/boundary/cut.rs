//! Central linear interpolation: fixed solids at their true place \[B4\].

use rayon::prelude::*;

use super::links::{Source, boundary_cell, resolve};
use crate::lane::Lane;
use crate::lattice::{C, Q, opposite};
use crate::setup::{CutCell, Setup};

/// Places along a link that are looked at before the surface is pinned down: features thinner than an eighth of a link
/// may be missed, as they are by the cells themselves.
const LOOKS: u32 = 8;

/// Halvings of an eighth of a link: what is left is below the rounding of a coordinate.
const HALVINGS: u32 = 44;

/// Least share. Where a cell's centre lies on a surface κ would be 1 and the link an extrapolation: such a cell moves away
/// from its neighbours by 5e-3 to 4e-2 per step (Newtonian, τ⁺ = 0.6 to 2, bed of slope 0.4 through the centres of cells),
/// with shares of 0.02 it stands out by a tenth, from 0.05 on not at all. The wall is so far off there at most: with 0.1
/// pipes no longer converge at second order.
const LEAST: f64 = 0.05;

/// Shares this close to ½ are ½: what halvings and rounding of coordinates leave of a surface that lies half-way.
const HALF_WAY: f64 = 1e-9;

/// f_i* + κ (f_i*(x − c_i) − f_ī*): what comes back along a link with its surface at rest.
///
/// # Arguments
/// `leaving`, `opposite`: post-collision populations f_i* and f_ī* of the cell. `behind`: f_i* of the cell straight
/// behind. `pull`: κ = (1 − 2q)/(1 + 2q).
/// # Exactness
/// + − × only; bit-stable. κ = 0 gives f_i* exactly.
/// # Source
/// I. Ginzburg, F. Verhaeghe, D. d'Humières 2008 (docs/method.md \[K2\]), "CLI".
/// # Verified by
/// Claims `pipe-newtonian-cut`, `pipe-bingham-cut`.
#[inline(always)]
pub fn central_linear<L: Lane>(leaving: L, opposite: L, behind: L, pull: L) -> L {
    leaving + pull * (behind - opposite)
}

/// κ = (1 − 2q)/(1 + 2q).
#[inline(always)]
pub(crate) fn pull<L: Lane>(share: L) -> L {
    let twice = L::splat(2.0) * share;
    (L::one() - twice) / (L::one() + twice)
}

/// 1 + κ = 2/(1 + 2q): how much of a wall's velocity enters the link, by that of a half-way link.
#[inline(always)]
pub(crate) fn push<L: Lane>(share: L) -> L {
    L::splat(2.0) / (L::one() + L::splat(2.0) * share)
}

/// A link into a wall of a cell with cut links.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CutLink {
    /// Direction in which populations leave towards the wall.
    pub out: u8,
    /// Population of the cell straight behind that goes along `out`, through mirror planes: cell and direction.
    pub behind: Option<(u32, u8)>,
    /// κ; 0 without a cell behind.
    pub pull: f64,
    /// 1 + κ.
    pub push: f64,
    /// Velocity of the wall where the link meets it.
    pub velocity: [f64; 3],
}

/// The links of a cell into walls, in order of the arriving directions.
pub(crate) fn cut_links<'a>(
    sources: &'a [Source; Q],
    cut: &'a CutCell,
) -> impl Iterator<Item = CutLink> + 'a {
    (1..Q).filter_map(|i| {
        let Source::Wall { velocity, .. } = sources[i] else { return None };
        let out = opposite(i);
        let behind = match sources[out] {
            Source::Cell { cell, direction } => Some((cell, direction)),
            Source::Wall { .. } | Source::Open => None,
        };
        let share = cut.shares[out];
        let (pull, push) = if behind.is_some() { (pull(share), push(share)) } else { (0.0, 1.0) };
        Some(CutLink { out: out as u8, behind, pull, push, velocity })
    })
}

/// Whose mass the links of a cut cell count into: the solid on the first of them that is not half-way.
#[must_use]
pub(crate) fn body(sources: &[Source; Q], cut: &CutCell) -> u8 {
    let on = |i: usize| match sources[i] {
        Source::Wall { body, .. } if cut.shares[opposite(i)] != 0.5 => Some(body),
        _ => None,
    };
    (1..Q).find_map(on).unwrap_or(0)
}

/// Cut cells of a set-up, and their links into walls.
#[must_use]
pub(crate) fn cut_count(setup: &Setup) -> [u64; 2] {
    let links = |cut: &CutCell| {
        let record = boundary_cell(setup, cut.cell as usize);
        record.map_or(0, |record| u64::from(record.walls.count_ones()))
    };
    [setup.cuts.len() as u64, setup.cuts.iter().map(links).sum()]
}

/// The shares of every link that leads from a fluid cell into a solid, for cells where one at least is not half-way.
///
/// # Arguments
/// `setup`: faces and `solids`. `is_inside`: whether a point, in cells, lies in a solid; it must hold the centres of
/// the solid cells and no others.
/// # Returns
/// In order of the cells.
/// # Exactness
/// A share is found to 2⁻⁴⁷ of the link, and is exactly ½ within 1e-9 of it.
/// # Verified by
/// Tests `exact_shares_of_a_tilted_plane`, `limit_half_way_faces_are_not_cut`.
#[must_use]
pub fn cut_cells(setup: &Setup, is_inside: impl Fn([f64; 3]) -> bool + Sync) -> Vec<CutCell> {
    if setup.solids.is_empty() {
        return Vec::new();
    }
    // In index order, whatever the number of threads.
    (0..setup.cells()).into_par_iter().filter_map(|cell| cut_cell(setup, cell, &is_inside)).collect()
}

/// The cut cell at an index; `None` if solid or without a link that is cut elsewhere than half-way.
fn cut_cell(setup: &Setup, cell: usize, is_inside: &impl Fn([f64; 3]) -> bool) -> Option<CutCell> {
    if setup.is_solid(cell) {
        return None;
    }
    let at = setup.coordinates(cell);
    let mut shares = [0.5; Q];
    for out in 1..Q {
        if let (Source::Wall { body, .. }, _) = resolve(setup, at, opposite(out))
            && body > 0
        {
            shares[out] = share(setup, at, out, is_inside);
        }
    }
    (shares != [0.5; Q]).then_some(CutCell { cell: cell as u32, shares })
}

/// The centre of a cell, or its image beyond a periodic face from which the link leads into the solid where that is
/// drawn.
fn start(setup: &Setup, at: [usize; 3], out: usize, is_inside: &impl Fn([f64; 3]) -> bool) -> [f64; 3] {
    let from = at.map(|x| x as f64 + 0.5);
    let to: [f64; 3] = std::array::from_fn(|a| from[a] + f64::from(C[out][a]));
    if is_inside(to) {
        return from;
    }
    std::array::from_fn(|a| {
        let n = setup.extents[a] as f64;
        from[a] - n * (to[a] / n).floor()
    })
}

/// Share of one link outside the solids, ½ where no surface is found on it.
fn share(setup: &Setup, at: [usize; 3], out: usize, is_inside: &impl Fn([f64; 3]) -> bool) -> f64 {
    let start = start(setup, at, out, is_inside);
    let there = |s: f64| is_inside(std::array::from_fn(|a| start[a] + s * f64::from(C[out][a])));
    if there(0.0) || !there(1.0) {
        return 0.5;
    }
    let first = (1..LOOKS).find(|&k| there(f64::from(k) / f64::from(LOOKS))).unwrap_or(LOOKS);
    let (mut low, mut high) = (f64::from(first - 1) / f64::from(LOOKS), f64::from(first) / f64::from(LOOKS));
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if there(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    if (high - 0.5).abs() < HALF_WAY { 0.5 } else { high.max(LEAST) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::direction;
    use crate::rheology::Law;
    use crate::setup::{Face, SolidMotion};
    use crate::vector::{norm_squared, sub};

    /// A box of 8 cells a side, solid where `is_inside` says so at the centres.
    fn painted(is_inside: impl Fn([f64; 3]) -> bool) -> Setup {
        let mut setup = Setup::periodic([8; 3], Law::Newtonian { mu: 0.1 });
        setup.faces[2] = [Face::NoSlip; 2];
        setup.solids = (0..setup.cells())
            .map(|cell| u8::from(is_inside(setup.coordinates(cell).map(|x| x as f64 + 0.5))))
            .collect();
        setup.solid_motion = vec![SolidMotion::default()];
        setup
    }

    #[test]
    fn exact_shares_of_a_tilted_plane() {
        // z < 3.0 + 0.1 x; from (2.5, y, 4.5) straight down the surface is 1.25 away, from (2.5, y, 3.5) 0.25.
        let below = |p: [f64; 3]| p[2] < 3.0 + 0.1 * p[0];
        let setup = painted(below);
        let cuts = cut_cells(&setup, below);
        let cell = setup.index([2, 4, 3]) as u32;
        let cut = cuts.iter().find(|cut| cut.cell == cell).expect("a cut cell");
        let along = |c: [i32; 3]| cut.shares[direction(c).expect("a direction")];
        // 3.5 − s = 3.25 + 0.1 s c_x.
        for (c, share) in [([0, 0, -1], 0.25), ([1, 0, -1], 0.25 / 1.1), ([-1, 0, -1], 0.25 / 0.9)] {
            assert!((along(c) - share).abs() < 1e-12, "{c:?} {}", along(c));
        }
        assert_eq!(along([0, 0, 1]), 0.5);
    }

    #[test]
    fn limit_least_share() {
        // Through the centres of cells.
        let below = |p: [f64; 3]| p[2] < 3.5;
        let cuts = cut_cells(&painted(below), below);
        assert!(!cuts.is_empty());
        assert!(cuts.iter().flat_map(|cut| cut.shares).all(|share| share == LEAST || share == 0.5));
    }

    #[test]
    fn limit_half_way_faces_are_not_cut() {
        let below = |p: [f64; 3]| p[2] < 3.0;
        assert!(cut_cells(&painted(below), below).is_empty());
    }

    #[test]
    fn shares_through_a_periodic_face() {
        // A ball that is drawn once, at the low face of x; links from the high face lead into it.
        let ball = |p: [f64; 3]| norm_squared(sub(p, [0.7, 4.5, 4.5])) < 1.0;
        let setup = painted(ball);
        let cuts = cut_cells(&setup, ball);
        let cell = setup.index([7, 4, 4]) as u32;
        let cut = cuts.iter().find(|cut| cut.cell == cell).expect("a cut cell");
        // From x = 7.5, that is −0.5, to the surface at −0.3.
        assert!((cut.shares[direction([1, 0, 0]).expect("a direction")] - 0.2).abs() < 1e-12);
    }

    #[test]
    fn exact_half_way_link_returns_what_left() {
        assert_eq!(pull(0.5), 0.0);
        assert_eq!(push(0.5), 1.0);
        assert_eq!(central_linear(0.3, 0.1, 0.7, pull(0.5)), 0.3);
    }
}
