//! The neighbour table: periodic wrap for ordinary cells, a record per cell that touches a wall, a
//! solid or a mirror plane.

use super::bounce_back::surface_velocity;
use super::flat_wall::FlatWall;
use super::owners::owners;
use super::step::{Step, upstream};
use crate::lattice::equilibrium::dot;
use crate::lattice::{C, Q, W, direction, opposite};
use crate::setup::course::Factors;
use crate::setup::{Face, Setup};

/// Where a population comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// Post-collision population `direction` of `cell`.
    Cell {
        /// Linear cell index.
        cell: u32,
        /// Direction index; differs from the arriving one at a mirror plane \[B2\].
        direction: u8,
    },
    /// Bounced back \[B1\].
    Wall {
        /// Velocity of the wall.
        velocity: [f64; 3],
        /// 0: a face of the box; s > 0: the solid `solid_motion[s − 1]`.
        body: u8,
        /// Whether others own part of what comes back, \[C7\].
        edge: bool,
    },
    /// An open face; only with a free surface.
    Open,
}

impl Source {
    /// Whose load each component of what comes back along the link to a wall counts into \[C7\]; `None` where no
    /// solid takes part.
    ///
    /// # Arguments
    /// `at`: the cell; `i`: arriving direction.
    #[inline]
    #[must_use]
    pub(crate) fn owners(&self, setup: &Setup, at: [usize; 3], i: usize) -> Option<[[u8; 2]; 3]> {
        match *self {
            Self::Wall { body, edge: true, .. } => Some(owners(setup, at, i, body)),
            Self::Wall { body, .. } if body != 0 => Some([[body; 2]; 3]),
            _ => None,
        }
    }
}

/// A cell that touches a wall, a solid or a mirror plane.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct BoundaryCell {
    /// Linear index.
    pub cell: u32,
    /// Source of each arriving population; entry 0 is the cell itself.
    pub sources: [Source; Q],
    /// The wall, if the links that hit it are those of one face.
    pub flat: Option<FlatWall>,
    /// Σ 6 w_i c_i (c_i·u_w) over the links that hit a wall: what a moving wall adds to the traction, by density.
    pub drag: [f64; 3],
    /// Whether any link hits a wall or solid (an open face is neither).
    pub touches_wall: bool,
    /// Bit i: the link along c_i hits a wall or solid.
    pub walls: u32,
    /// Its place in [`Setup::cuts`], where it has links that are not half-way.
    pub cut: Option<u32>,
}

/// What a cell is for streaming.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CellKind {
    /// Not computed.
    Solid,
    /// All arriving populations come from fluid cells, directly or through a periodic face.
    Bulk,
    /// Has a [`BoundaryCell`] record at this position of the list.
    Boundary(usize),
}

const SOLID: u32 = u32::MAX;
const BULK: u32 = u32::MAX - 1;
/// Most cells that fit the index.
pub(crate) const MAX_CELLS: u64 = BULK as u64 - 1;

/// Neighbour table of a whole box.
#[derive(Clone, Debug)]
pub struct Links {
    kinds: Vec<u32>,
    boundary: Vec<BoundaryCell>,
    /// `from[axis][coordinate][c + 1]`: index contribution of the upstream coordinate.
    from: [Vec<[usize; 3]>; 3],
    extents: [usize; 3],
    fluid_cells: u64,
}

impl Links {
    /// Builds the table; `setup` must have passed `crate::solver::check::check`.
    #[must_use]
    pub fn new(setup: &Setup) -> Self {
        let stride = [1, setup.extents[0], setup.extents[0] * setup.extents[1]];
        let from = std::array::from_fn(|axis| {
            let n = setup.extents[axis];
            (0..n)
                .map(|x| {
                    let low = if x == 0 { n - 1 } else { x - 1 };
                    let high = if x + 1 == n { 0 } else { x + 1 };
                    // Velocity −1 comes from the higher coordinate.
                    [high * stride[axis], x * stride[axis], low * stride[axis]]
                })
                .collect()
        });
        let mut links = Self {
            kinds: vec![BULK; setup.cells()],
            boundary: Vec::new(),
            from,
            extents: setup.extents,
            fluid_cells: 0,
        };
        for cell in 0..setup.cells() {
            if setup.is_solid(cell) {
                links.kinds[cell] = SOLID;
                continue;
            }
            links.fluid_cells += 1;
            if let Some(record) = boundary_cell(setup, cell) {
                links.kinds[cell] = u32::try_from(links.boundary.len()).unwrap_or(BULK);
                links.boundary.push(record);
            }
        }
        links
    }

    /// What a cell is.
    #[inline(always)]
    #[must_use]
    pub(crate) fn kind(&self, cell: usize) -> CellKind {
        match self.kinds[cell] {
            SOLID => CellKind::Solid,
            BULK => CellKind::Bulk,
            slot => CellKind::Boundary(slot as usize),
        }
    }

    /// Records of all boundary cells, in cell order.
    #[must_use]
    pub(crate) fn boundary(&self) -> &[BoundaryCell] {
        &self.boundary
    }

    /// Number of fluid cells.
    #[must_use]
    pub(crate) const fn fluid_cells(&self) -> u64 {
        self.fluid_cells
    }

    /// Linear index of x − c_i, periodic in every axis.
    #[inline(always)]
    #[must_use]
    pub(crate) fn upstream(&self, [x, y, z]: [usize; 3], i: usize) -> usize {
        let step = |axis: usize, at: usize| self.from[axis][at][(C[i][axis] + 1) as usize];
        step(0, x) + step(1, y) + step(2, z)
    }

    /// Where population `i` that arrives in a cell comes from; the cell must not be solid.
    #[inline]
    #[must_use]
    pub(crate) fn source(&self, cell: usize, i: usize) -> Source {
        let [nx, ny, _] = self.extents;
        self.source_at(cell, [cell % nx, (cell / nx) % ny, cell / (nx * ny)], i)
    }

    /// As [`Self::source`], for who knows the coordinates `at` of the cell.
    #[inline]
    #[must_use]
    pub(crate) fn source_at(&self, cell: usize, at: [usize; 3], i: usize) -> Source {
        match self.kinds[cell] {
            SOLID | BULK => Source::Cell { cell: self.upstream(at, i) as u32, direction: i as u8 },
            slot => self.boundary[slot as usize].sources[i],
        }
    }

    /// The neighbouring cell that population `i` comes from, its mirror image at a mirror plane; `None`
    /// at walls, solids and open faces.
    #[inline]
    #[must_use]
    pub fn neighbour_along(&self, cell: usize, i: usize) -> Option<usize> {
        match self.source(cell, i) {
            Source::Cell { cell, .. } => Some(cell as usize),
            Source::Wall { .. } | Source::Open => None,
        }
    }

    /// The fluid neighbour along an axis, if there is one: the cell that populations come from.
    #[must_use]
    pub(crate) fn neighbour(&self, cell: usize, axis: usize, positive: bool) -> Option<usize> {
        let mut c = [0; 3];
        c[axis] = if positive { -1 } else { 1 };
        let i = direction(c)?;
        match self.kind(cell) {
            CellKind::Solid => None,
            CellKind::Bulk => {
                let [nx, ny, _] = self.extents;
                Some(self.upstream([cell % nx, (cell / nx) % ny, cell / (nx * ny)], i))
            }
            CellKind::Boundary(slot) => match self.boundary[slot].sources[i] {
                Source::Cell { cell, .. } => Some(cell as usize),
                Source::Wall { .. } | Source::Open => None,
            },
        }
    }

    /// Gives the walls of boundary cells the velocities of a time.
    pub(crate) fn move_walls(&mut self, setup: &Setup, factors: &Factors) {
        for record in &mut self.boundary {
            if record.walls != 0
                && let Some(now) = boundary_cell_at(setup, factors, record.cell as usize)
            {
                *record = now;
            }
        }
    }

    /// Bytes held by the table.
    #[must_use]
    pub(crate) fn bytes(&self) -> u64 {
        let axes: usize = self.from.iter().map(Vec::len).sum();
        (self.kinds.len() * size_of::<u32>()
            + self.boundary.len() * size_of::<BoundaryCell>()
            + axes * size_of::<[usize; 3]>()) as u64
    }
}

/// The record of a cell, or `None` if every link is ordinary; `setup` must have passed
/// [`crate::solver::check::check`] and the cell must not be solid.
pub(crate) fn boundary_cell(setup: &Setup, cell: usize) -> Option<BoundaryCell> {
    boundary_cell_at(setup, &Factors::one(), cell)
}

/// As [`boundary_cell`], at a time at which the velocities have these factors.
pub(crate) fn boundary_cell_at(setup: &Setup, factors: &Factors, cell: usize) -> Option<BoundaryCell> {
    let at = setup.coordinates(cell);
    let cut = setup.cuts.binary_search_by_key(&(cell as u32), |cut| cut.cell).ok();
    let mut sources = [Source::Cell { cell: cell as u32, direction: 0 }; Q];
    let mut ordinary = true;
    let mut drag = [0.0; 3];
    let mut walls = 0;
    for i in 1..Q {
        let (mut source, plain) = resolve_at(setup, factors, at, i);
        if let (Some(cut), Source::Wall { velocity, body, .. }) = (cut, &mut source)
            && *body > 0
        {
            let there = solid_velocity(setup, at, i, *body, setup.cuts[cut].shares[opposite(i)]);
            *velocity = scaled(there, factors.solid(*body));
        }
        sources[i] = source;
        ordinary &= plain;
        if let Source::Wall { velocity, .. } = source {
            // The wall lies along −c_i.
            let out = opposite(i);
            walls |= 1 << out;
            let part = 6.0 * W[out] * dot(out, &velocity);
            for a in 0..3 {
                drag[a] += part * f64::from(C[out][a]);
            }
        }
    }
    (!ordinary).then(|| BoundaryCell {
        cell: cell as u32,
        sources,
        flat: FlatWall::of(walls).filter(|_| cut.is_none()),
        drag,
        touches_wall: walls != 0,
        walls,
        cut: cut.map(|place| place as u32),
    })
}

/// Source of population `i` arriving at `at`, and whether it is the ordinary upstream cell.
///
/// A wall on any axis bounces back; free-slip planes are unfolded: the mirrored component of the
/// velocity is reversed and the source stays on this side \[B2\].
#[must_use]
pub(crate) fn resolve(setup: &Setup, at: [usize; 3], i: usize) -> (Source, bool) {
    resolve_at(setup, &Factors::one(), at, i)
}

/// As [`resolve`], at a time at which the velocities have these factors.
fn resolve_at(setup: &Setup, factors: &Factors, at: [usize; 3], i: usize) -> (Source, bool) {
    let mut source = at;
    let mut c = C[i];
    let mut ordinary = true;
    let mut wall: Option<[f64; 3]> = None;
    let mut open = false;
    for axis in (0..3).filter(|&axis| C[i][axis] != 0) {
        match upstream(setup, at, axis, C[i][axis]) {
            Step::To(x) => source[axis] = x,
            Step::Out(_, Face::FreeSlip) => {
                c[axis] = -c[axis];
                ordinary = false;
            }
            Step::Out(side, Face::Moving(u)) => wall = Some(add(wall, scaled(u, factors.face(axis, side)))),
            Step::Out(_, Face::Open) => open = true,
            Step::Out(_, Face::NoSlip | Face::Periodic) => wall = Some(add(wall, [0.0; 3])),
        }
    }
    if let Some(u) = wall {
        let edge = owners(setup, at, i, 0) != [[0; 2]; 3];
        return (Source::Wall { velocity: u, body: 0, edge }, false);
    }
    if open {
        return (Source::Open, false);
    }
    let cell = setup.index(source);
    if setup.is_solid(cell) {
        let body = setup.solids[cell];
        let velocity = scaled(solid_velocity(setup, at, i, body, 0.5), factors.solid(body));
        let edge = owners(setup, at, i, body) != [[body; 2]; 3];
        return (Source::Wall { velocity, body, edge }, false);
    }
    let direction = direction(c).unwrap_or(0) as u8;
    (Source::Cell { cell: cell as u32, direction }, ordinary)
}

fn scaled(u: [f64; 3], factor: f64) -> [f64; 3] {
    u.map(|u| factor * u)
}

/// A link through the edge of two walls moves with both.
fn add(wall: Option<[f64; 3]>, u: [f64; 3]) -> [f64; 3] {
    let v = wall.unwrap_or([0.0; 3]);
    [v[0] + u[0], v[1] + u[1], v[2] + u[2]]
}

/// Velocity of a solid's surface on the link from the cell towards −c_i, this share of it away.
fn solid_velocity(setup: &Setup, at: [usize; 3], i: usize, body: u8, share: f64) -> [f64; 3] {
    let Some(motion) = setup.solid_motion.get(usize::from(body) - 1) else { return [0.0; 3] };
    let towards = C[opposite(i)];
    let arm =
        std::array::from_fn(|a| (at[a] as f64 + 0.5 + share * f64::from(towards[a])) - motion.centre[a]);
    surface_velocity(motion.velocity, motion.spin, arm)
}
