//! What comes back along cut links \[B4\], between a collision and the next.

use super::block::{Block, Place, place_of};
use super::element::{Element, index};
use super::layout::{Layout, NONE};
use super::links::{after, half_way_link, stored};
use super::run::FastRun;
use super::task::Task;
use crate::boundary::cut::{CutLink, body, cut_links, wall_velocity};
use crate::boundary::links::BoundaryCell;
use crate::lattice::moments::density_excess;
use crate::lattice::opposite;
use crate::setup::Setup;
use crate::solver::cut_law::{CutShape, Memory};
use crate::solver::cuts::{Brought, cut_link, kept};
use crate::solver::physics::Physics;
use crate::solver::pool::each;

/// A cut cell of a block.
#[derive(Clone, Debug)]
pub(crate) struct CutRim {
    /// Place in the block.
    local: u16,
    /// Position in [`Block::rim`].
    rim: u16,
    /// Its first link in [`Cuts::links`].
    first: u32,
    /// Bit i: population i arrives from a wall; the links lie in this order.
    arriving: u32,
    /// Whose mass its links count into.
    body: u8,
    /// What its wall correction depends on.
    pub shape: CutShape,
}

/// A link of a cut cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CutPlace {
    link: CutLink,
    behind: Option<(Place, u8)>,
}

/// The cut cells of a block.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cuts {
    /// In order.
    pub cells: Vec<CutRim>,
    /// All their links into walls.
    pub links: Vec<CutPlace>,
}

impl Cuts {
    /// Adds a cell, if surfaces cut it; returns its place in the list.
    pub(crate) fn add(
        &mut self,
        setup: &Setup,
        layout: &Layout,
        record: Option<&BoundaryCell>,
        local: usize,
        rim: usize,
    ) -> Option<u16> {
        let record = record?;
        let cut = setup.cuts.get(record.cut? as usize)?;
        let first = self.links.len() as u32;
        let mut arriving = 0;
        for link in cut_links(&record.sources, cut) {
            arriving |= 1 << opposite(usize::from(link.out));
            let behind =
                link.behind.map(|(cell, direction)| (place_of(setup, layout, cell as usize), direction));
            self.links.push(CutPlace { link, behind });
        }
        self.cells.push(CutRim {
            local: local as u16,
            rim: rim as u16,
            first,
            arriving,
            body: body(&record.sources, cut),
            shape: CutShape::new(cut, record.walls, wall_velocity(&record.sources)),
        });
        Some((self.cells.len() - 1) as u16)
    }

    /// The link through which population `i` arrives at a cell of the list.
    #[inline]
    pub(crate) fn position(&self, cell: u16, i: usize) -> Option<usize> {
        let cell = self.cells.get(usize::from(cell))?;
        let before = cell.arriving & ((1 << i) - 1);
        (cell.arriving >> i & 1 != 0).then(|| (cell.first + before.count_ones()) as usize)
    }

    /// Place in the list of a cell of the block.
    pub(crate) fn place_of(&self, local: usize) -> Option<usize> {
        self.cells.binary_search_by_key(&local, |cell| usize::from(cell.local)).ok()
    }

    /// Bytes held.
    #[must_use]
    pub(crate) fn bytes(&self) -> u64 {
        (self.cells.capacity() * size_of::<CutRim>() + self.links.capacity() * size_of::<CutPlace>()) as u64
    }
}

/// Bytes of cut cells and of their links, with what comes back.
#[must_use]
pub(crate) const fn cut_bytes([cells, links]: [u64; 2]) -> u64 {
    // Lists grow by doubling.
    let lists = cells * size_of::<CutRim>() as u64 + links * size_of::<CutPlace>() as u64;
    lists * 5 / 4 + cells * size_of::<Memory>() as u64 + links * size_of::<f64>() as u64
}

impl<P: Physics, E: Element> FastRun<P, E> {
    /// Works out what every cut link sends back: first what each would bring in, then without the surplus of its
    /// solid. Cells that are not full get what stairs return.
    pub(super) fn cut_pass(&mut self) {
        if self.setup.cuts.is_empty() {
            return;
        }
        let mut returned = std::mem::take(&mut self.cut_returned);
        let bodies = self.setup.solid_motion.len();
        let task = self.task([0.0; 3]);
        let full = |returned: &mut [Vec<f64>], work: &(dyn Fn(usize, &mut Vec<f64>) -> Brought + Sync)| {
            let items: Vec<_> =
                returned.iter_mut().enumerate().filter(|(_, list)| !list.is_empty()).collect();
            each(self.pool.as_ref(), items, |(number, list)| work(number, list))
        };
        let parts = full(&mut returned, &|number, list| {
            let mut brought = Brought::new(bodies);
            self.block_returns(&task, number, list, &mut brought);
            brought
        });
        let mut brought = Brought::new(bodies);
        parts.iter().for_each(|part| brought.merge(part));
        let surplus = brought.surplus();
        full(&mut returned, &|number, list| {
            self.settle(number, list, &surplus);
            Brought::default()
        });
        self.cut_returned = returned;
    }

    /// Cut cells of a block that hold fluid, and whether they are full.
    fn wet_cuts<'a>(&'a self, block: &'a Block, number: usize) -> impl Iterator<Item = (&'a CutRim, bool)> {
        block.cuts.cells.iter().filter_map(move |cell| {
            let local = u32::from(cell.local);
            let fluid = self.is_fluid(Place { block: block.place as u32, local });
            fluid.then(|| (cell, self.is_full(number, usize::from(cell.local))))
        })
    }

    /// What the links of full cells would bring in; in interface cells what they return.
    fn block_returns(&self, task: &Task<P, E>, number: usize, returned: &mut [f64], brought: &mut Brought) {
        let block = &self.blocks[number];
        for (cell, full) in self.wet_cuts(block, number) {
            let own = after(task, number, usize::from(cell.local));
            let rho = 1.0 + density_excess(&own);
            let correction = self.rim[number].get(usize::from(cell.rim)).map(|kept| &kept.correction);
            let first = cell.first as usize;
            let links = &block.cuts.links[first..first + cell.arriving.count_ones() as usize];
            for (at, back) in links.iter().zip(&mut returned[first..]) {
                if !full {
                    let out = usize::from(at.link.out);
                    let half = half_way_link(task, own[out], correction, out, rho, &at.link.velocity);
                    *back = stored::<E>(half);
                    continue;
                }
                let behind = at.behind.and_then(|(place, direction)| self.sent(place, direction));
                *back = cut_link(&self.physics, &own, correction, &at.link, behind, rho);
                brought.add(cell.body, *back);
            }
        }
    }

    /// A population after the last collision; `None` where there is no block.
    fn sent(&self, place: Place, direction: u8) -> Option<f64> {
        match self.layout.block_at(place.block as usize) {
            NONE => None,
            number => {
                let list = self.old[number as usize].get();
                Some(list[index::<E>(place.local as usize, usize::from(direction))].to_f64())
            }
        }
    }

    /// From what the links of full cells would bring in to what they return.
    fn settle(&self, number: usize, returned: &mut [f64], surplus: &[f64]) {
        let block = &self.blocks[number];
        let own = self.old[number].get();
        for (cell, full) in self.wet_cuts(block, number) {
            if !full {
                continue;
            }
            let first = cell.first as usize;
            let links = &block.cuts.links[first..first + cell.arriving.count_ones() as usize];
            for (at, back) in links.iter().zip(&mut returned[first..]) {
                let leaving = own[index::<E>(usize::from(cell.local), usize::from(at.link.out))].to_f64();
                *back = stored::<E>(leaving + kept(*back, surplus[usize::from(cell.body)]));
            }
        }
    }
}
