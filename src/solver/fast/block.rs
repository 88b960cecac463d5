//! One block: what surrounds it, which packs are ordinary, and the links that are not.

use super::cut_cells::Cuts;
use super::layout::Layout;
pub(crate) use super::place::{Place, place_of};
use crate::boundary::flat_wall::FlatWall;
use crate::boundary::links::{BoundaryCell, Source, boundary_cell};
use crate::lattice::{C, Q, direction, opposite};
use crate::setup::Setup;

/// Where an irregular population comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Origin {
    /// Population `direction` of another cell.
    Cell {
        /// Its cell.
        cell: Place,
        /// Its direction.
        direction: u8,
    },
    /// Bounced back \[B1\] by a wall with this velocity (number in the run's list); `body` as in
    /// [`Source::Wall`].
    Wall {
        /// Number of the wall velocity.
        velocity: u32,
        /// What it leads to.
        body: u8,
        /// As in [`Source::Wall`].
        edge: bool,
    },
    /// An open face.
    Open,
}

/// One irregular link: population `direction` of a cell does not come from the cell the grid names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Link {
    /// Cell, place in the block.
    pub local: u16,
    /// Arriving direction.
    pub direction: u8,
    /// Its source.
    pub from: Origin,
    /// Position of the cell in [`Block::rim`].
    pub rim: u16,
}

/// A cell with a wall or open link.
#[derive(Clone, Debug)]
pub(crate) struct RimCell {
    /// Place in the block.
    pub local: u16,
    /// Bit i: the link towards c_i hits a wall.
    pub walls: u32,
    /// Whether a link is open.
    pub open: bool,
    /// The wall and its motion, as in [`BoundaryCell`].
    pub flat: Option<FlatWall>,
    /// See [`BoundaryCell::drag`].
    pub drag: [f64; 3],
    /// Its place among [`Block::cuts`].
    pub cut: Option<u16>,
    /// Neighbours along the axes, low and high: for the pressure gradient \[B3\].
    pub neighbours: [[Option<Place>; 2]; 3],
}

/// The parts of a block that follow from the set-up alone.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    /// Its place in [`Layout`].
    pub place: usize,
    /// Cells per pack.
    pub line: u16,
    /// First cell, box coordinates.
    pub origin: [usize; 3],
    /// Bit per lane, by pack: inside the box and not solid.
    pub usable: Vec<u16>,
    /// Irregular links in order of cell and direction.
    pub links: Vec<Link>,
    /// Position in `links` of the first link of every pack, and the end.
    pub first_link: Vec<u32>,
    /// Cells that touch walls or open faces, in order.
    pub rim: Vec<RimCell>,
    /// Which of these have links that are not half-way.
    pub cuts: Cuts,
    /// Number of the fluid by cell; empty if there is only one.
    pub fluid: Vec<u8>,
}

/// The list of wall velocities of a run.
#[derive(Clone, Debug, Default)]
pub(crate) struct Velocities {
    /// Now, lattice units.
    pub list: Vec<[f64; 3]>,
    /// As in the set-up, and what each of them moves with.
    given: Vec<([f64; 3], u16)>,
}

impl Velocities {
    /// `movers`: what moves with it, so that two of one velocity now may differ later.
    fn number(&mut self, velocity: [f64; 3], movers: u16) -> u32 {
        let bits = velocity.map(f64::to_bits);
        let same = |k: &usize| self.given[*k].0.map(f64::to_bits) == bits && self.given[*k].1 == movers;
        // Faces have a few velocities; a spinning solid has one per link, most often new.
        let recent = self.list.len().saturating_sub(16);
        let found = (0..self.list.len().min(8)).find(same).or_else(|| (recent..self.list.len()).find(same));
        let number = found.unwrap_or_else(|| {
            self.list.push(velocity);
            self.given.push((velocity, movers));
            self.list.len() - 1
        });
        number as u32
    }
}

impl Block {
    /// Looks at every cell of the block at a place; `width`: cells per pack.
    #[must_use]
    pub fn new(
        setup: &Setup,
        layout: &Layout,
        place: usize,
        width: usize,
        velocities: &mut Velocities,
    ) -> Self {
        let origin = layout.origin(place);
        let cells = layout.block_cells();
        let packs = cells / width;
        let mut block = Self {
            place,
            line: width as u16,
            origin,
            usable: vec![0; packs],
            links: Vec::new(),
            first_link: Vec::with_capacity(packs + 1),
            rim: Vec::new(),
            cuts: Cuts::default(),
            fluid: Vec::new(),
        };
        if setup.fluids.len() > 1 {
            block.fluid = vec![0; cells];
        }
        let around = layout.around(place);
        let plain = is_plain(setup, layout, place);
        for local in 0..cells {
            if local % width == 0 {
                block.first_link.push(block.links.len() as u32);
            }
            let at = layout.cell(origin, local);
            if !plain && (0..3).any(|a| at[a] >= setup.extents[a]) {
                continue;
            }
            let cell = setup.index(at);
            if !plain && setup.is_solid(cell) {
                continue;
            }
            block.usable[local / width] |= 1 << (local % width);
            if let Some(fluid) = block.fluid.get_mut(local) {
                *fluid = setup.fluid_of_cell.get(cell).copied().unwrap_or(0);
            }
            if !plain {
                block.add_links(setup, layout, local, cell, &around, velocities);
            }
        }
        block.first_link.push(block.links.len() as u32);
        block
    }

    fn add_links(
        &mut self,
        setup: &Setup,
        layout: &Layout,
        local: usize,
        cell: usize,
        around: &[usize; 27],
        velocities: &mut Velocities,
    ) {
        let record = boundary_cell(setup, cell);
        let mut rim = RimCell {
            local: local as u16,
            walls: 0,
            open: false,
            flat: record.as_ref().and_then(|r| r.flat),
            drag: record.as_ref().map_or([0.0; 3], |r| r.drag),
            cut: self.cuts.add(setup, layout, record.as_ref(), local, self.rim.len()),
            neighbours: [[None; 2]; 3],
        };
        let number = self.rim.len() as u16;
        for i in 1..Q {
            let source = source(setup, record.as_ref(), cell, i);
            let from = match source {
                Source::Cell { cell, direction } => {
                    let place = place_of(setup, layout, cell as usize);
                    let (block, there) = layout.upstream(local, i);
                    if usize::from(direction) == i
                        && around[block] == place.block as usize
                        && there == place.local as usize
                    {
                        continue;
                    }
                    Origin::Cell { cell: place, direction }
                }
                Source::Wall { velocity, body, edge } => {
                    rim.walls |= 1 << opposite(i);
                    let movers = movers(setup, layout.cell(self.origin, local), i, body);
                    Origin::Wall { velocity: velocities.number(velocity, movers), body, edge }
                }
                Source::Open => {
                    rim.open = true;
                    Origin::Open
                }
            };
            self.links.push(Link { local: local as u16, direction: i as u8, from, rim: number });
        }
        if rim.walls != 0 || rim.open {
            for (axis, sides) in rim.neighbours.iter_mut().enumerate() {
                for (side, place) in sides.iter_mut().enumerate() {
                    *place = neighbour(setup, layout, record.as_ref(), cell, axis, side == 1);
                }
            }
            self.rim.push(rim);
        }
    }

    /// Whether a cell lies in the box and is not solid.
    #[must_use]
    pub(crate) fn is_usable(&self, local: usize) -> bool {
        let width = self.width();
        self.usable.get(local / width).is_some_and(|lanes| lanes >> (local % width) & 1 != 0)
    }

    fn width(&self) -> usize {
        usize::from(self.line)
    }

    /// Gives everything up; nothing of the block is used after that.
    pub(crate) fn clear(&mut self) {
        self.usable = Vec::new();
        self.links = Vec::new();
        self.first_link = Vec::new();
        self.rim = Vec::new();
        self.cuts = Cuts::default();
        self.fluid = Vec::new();
    }

    /// Irregular links of a cell, in order of the directions.
    #[inline]
    #[must_use]
    pub(crate) fn links_of_cell(&self, local: usize, width: usize) -> &[Link] {
        let links = self.links_of(local / width);
        let first = links.partition_point(|link| usize::from(link.local) < local);
        let last = links.partition_point(|link| usize::from(link.local) <= local);
        &links[first..last]
    }

    /// Links of a pack.
    #[inline(always)]
    #[must_use]
    pub(crate) fn links_of(&self, pack: usize) -> &[Link] {
        &self.links[self.first_link[pack] as usize..self.first_link[pack + 1] as usize]
    }

    /// Bytes held.
    #[must_use]
    pub(crate) fn bytes(&self) -> u64 {
        (size_of::<Self>()
            + self.usable.capacity() * size_of::<u16>()
            + self.links.capacity() * size_of::<Link>()
            + self.first_link.capacity() * size_of::<u32>()
            + self.rim.capacity() * size_of::<RimCell>()
            + self.fluid.capacity()) as u64
            + self.cuts.bytes()
    }
}

/// Source of population `i` of a cell.
#[must_use]
pub(crate) fn source(setup: &Setup, record: Option<&BoundaryCell>, cell: usize, i: usize) -> Source {
    match record {
        Some(record) => record.sources[i],
        None => {
            // An ordinary cell: the neighbour, through a periodic face where need be.
            let at = setup.coordinates(cell);
            let from = std::array::from_fn(|a| {
                let n = setup.extents[a];
                match C[i][a] {
                    1 if at[a] == 0 => n - 1,
                    1 => at[a] - 1,
                    -1 if at[a] + 1 == n => 0,
                    -1 => at[a] + 1,
                    _ => at[a],
                }
            });
            Source::Cell { cell: setup.index(from) as u32, direction: i as u8 }
        }
    }
}

/// What the wall at the end of a link moves with, where that changes in time: the solid, or the faces that the link leaves
/// through, a bit each.
fn movers(setup: &Setup, at: [usize; 3], i: usize, body: u8) -> u16 {
    if !setup.courses.vary() {
        return 0;
    }
    if body != 0 {
        return 64 + u16::from(body);
    }
    let leaves = |axis: usize| match C[i][axis] {
        1 if at[axis] == 0 => 1 << (2 * axis),
        -1 if at[axis] + 1 == setup.extents[axis] => 2 << (2 * axis),
        _ => 0,
    };
    leaves(0) | leaves(1) | leaves(2)
}

/// The neighbour along an axis that populations come from.
fn neighbour(
    setup: &Setup,
    layout: &Layout,
    record: Option<&BoundaryCell>,
    cell: usize,
    axis: usize,
    high: bool,
) -> Option<Place> {
    let mut c = [0; 3];
    c[axis] = if high { -1 } else { 1 };
    match source(setup, record, cell, direction(c)?) {
        Source::Cell { cell, .. } => Some(place_of(setup, layout, cell as usize)),
        Source::Wall { .. } | Source::Open => None,
    }
}

/// Whether every cell of a block and every neighbour of it lies in the box, or beyond a periodic face that
/// the grid of blocks meets exactly, and none is solid.
fn is_plain(setup: &Setup, layout: &Layout, place: usize) -> bool {
    let origin = layout.origin(place);
    let last = layout.cell(origin, layout.block_cells() - 1);
    let inside = (0..3).all(|a| {
        let n = setup.extents[a];
        let fits = last[a] < n;
        let open = setup.faces[a][0] == crate::setup::Face::Periodic;
        let whole = n.is_multiple_of(last[a] + 1 - origin[a]);
        fits && if open {
            whole || (origin[a] > 0 && last[a] + 1 < n)
        } else {
            origin[a] > 0 && last[a] + 1 < n
        }
    });
    if !inside || setup.solids.is_empty() {
        return inside;
    }
    let range = |a: usize| {
        let n = setup.extents[a];
        (origin[a] + n - 1..=last[a] + n + 1).map(move |x| x % n)
    };
    range(2).all(|z| range(1).all(|y| range(0).all(|x| !setup.is_solid(setup.index([x, y, z])))))
}

/// Block numbers around a place.
#[must_use]
pub(crate) fn numbers_around(layout: &Layout, place: usize) -> [u32; 27] {
    layout.around(place).map(|at| layout.block_at(at))
}

/// Puts the value of a block at its number, which is at most one beyond the end.
pub(in crate::solver::fast) fn put<T>(list: &mut Vec<T>, number: usize, value: T) {
    match list.get_mut(number) {
        Some(place) => *place = value,
        None => list.push(value),
    }
}
