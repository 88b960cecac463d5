//! Links between fluid cells and a grain: where they lead, and where the surface cuts them \[C1\].

use super::L3;
use crate::boundary::links::{Source, resolve};
use crate::lattice::{C, Q, opposite};
use crate::setup::{Face, Setup};
use crate::state::state;
use crate::vector::{dot, norm_squared};

/// A sphere of a grain, lattice units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ball {
    /// Centre, inside the box along periodic axes.
    pub centre: L3,
    /// Radius, cells.
    pub radius: f64,
}

/// A link from a cell outside a grain into a covered cell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Link {
    /// The cell outside.
    pub cell: u32,
    /// Direction in which its populations leave towards the grain.
    pub out: u8,
    /// Direction of the covered cell's population that arrives there.
    pub slot: u8,
    /// The covered cell.
    pub covered: u32,
    /// The cell straight behind the one outside, or [`super::coverage::NOBODY`].
    pub behind: u32,
}

/// A link from a covered cell to a wall or a fixed solid: no fluid fits between.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Blocked {
    /// The covered cell.
    pub covered: u32,
    /// Direction from the wall into the grain.
    pub inward: u8,
}

state!(Link: cell out slot covered behind);
state!(Blocked: covered inward);

/// Shape of the box as links see it.
#[derive(Clone, Debug)]
pub(crate) struct Box3 {
    /// Cells along x, y, z.
    pub extents: [usize; 3],
    /// Whether an axis is periodic.
    pub periodic: [bool; 3],
    offset: [isize; Q],
    solid_free: bool,
}

impl Box3 {
    /// Of a set-up.
    #[must_use]
    pub fn new(setup: &Setup) -> Self {
        let [nx, ny, _] = setup.extents.map(|n| n as isize);
        Self {
            extents: setup.extents,
            periodic: setup.faces.map(|faces| faces[0] == Face::Periodic),
            offset: C.map(|c| c[0] as isize + nx * (c[1] as isize + ny * c[2] as isize)),
            solid_free: setup.solids.is_empty(),
        }
    }

    /// Coordinates of a cell.
    #[inline]
    #[must_use]
    pub(crate) fn coordinates(&self, cell: usize) -> [usize; 3] {
        let [nx, ny, _] = self.extents;
        [cell % nx, (cell / nx) % ny, cell / (nx * ny)]
    }

    /// Centre of a cell, cells.
    #[inline]
    #[must_use]
    pub fn centre(&self, cell: usize) -> L3 {
        self.coordinates(cell).map(|x| x as f64 + 0.5)
    }

    /// `to` − `from` by the shortest way along periodic axes.
    #[inline]
    #[must_use]
    pub(crate) fn apart(&self, to: &L3, from: &L3) -> L3 {
        std::array::from_fn(|a| {
            let d = to[a] - from[a];
            if self.periodic[a] {
                let n = self.extents[a] as f64;
                // Nothing to wrap, in most cases.
                if d.abs() < 0.49 * n { d } else { d - n * (d / n).round() }
            } else {
                d
            }
        })
    }

    /// Where population `i` of a cell comes from.
    #[inline]
    #[must_use]
    pub(crate) fn source(&self, setup: &Setup, cell: usize, i: usize) -> Source {
        let at = self.coordinates(cell);
        let inside = (0..3).all(|a| at[a] > 0 && at[a] + 1 < self.extents[a]);
        if inside {
            let from = (cell as isize - self.offset[i]) as usize;
            if self.solid_free || !setup.is_solid(from) {
                return Source::Cell { cell: from as u32, direction: i as u8 };
            }
        }
        resolve(setup, at, i).0
    }

    /// The cell that a population leaving along `out` goes to.
    #[inline]
    #[must_use]
    pub fn target(&self, setup: &Setup, cell: usize, out: usize) -> Option<usize> {
        match self.source(setup, cell, opposite(out)) {
            Source::Cell { cell, .. } => Some(cell as usize),
            Source::Wall { .. } | Source::Open => None,
        }
    }

    /// The cell from which population `out` of a cell comes without being turned by a mirror plane.
    #[inline]
    #[must_use]
    pub(crate) fn straight_behind(&self, setup: &Setup, cell: usize, out: usize) -> Option<u32> {
        match self.source(setup, cell, out) {
            Source::Cell { cell, direction } if usize::from(direction) == out => Some(cell),
            _ => None,
        }
    }
}

/// Share of a link that lies outside the balls: distance from a point to the first of their surfaces along c_out,
/// over the length of the link; ½ if none is cut.
///
/// # Arguments
/// `balls`: of each ball, the vector from its centre to the cell, and its radius, cells.
/// # Source
/// |x + q c − x_b| = r, smaller root.
/// # Verified by
/// Test `exact_cut_of_a_link`.
#[must_use]
pub(crate) fn cut(balls: &[(L3, f64)], out: usize) -> f64 {
    let c = C[out].map(f64::from);
    let length2 = norm_squared(c);
    let mut first = 2.0;
    for &(d, r) in balls {
        let along = dot(d, c);
        let beyond = norm_squared(d) - r * r;
        let discriminant = along * along - length2 * beyond;
        if discriminant < 0.0 || along >= 0.0 {
            continue;
        }
        let q = (-along - discriminant.sqrt()) / length2;
        if q >= 0.0 && q < first {
            first = q;
        }
    }
    if first <= 1.0 { first } else { 0.5 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_cut_of_a_link() {
        // A ball of radius 2 at the origin; cell at (3, 0, 0), link towards −x: cut at x = 2, one cell away.
        let ball = |d: L3| [(d, 2.0)];
        assert_eq!(cut(&ball([2.75, 0.0, 0.0]), 2), 0.75);
        // Along (−1, −1, 0) from (2, 1, 0): (2 − q)² + (1 − q)² = 4 at q = (3 − √7)/2.
        let expected = 0.5 * (3.0 - 7.0_f64.sqrt());
        assert!((cut(&ball([2.0, 1.0, 0.0]), 8) - expected).abs() < 1e-15);
        // A second ball nearer to the cell is met first.
        let two = [([2.75, 0.0, 0.0], 2.0), ([2.5, 0.0, 0.0], 2.0)];
        assert_eq!(cut(&two, 2), 0.5);
    }
}
