//! What comes back along cut links \[B4\], between a collision and the next.

use super::block::Block;
use super::cut_cells::CutRim;
use super::element::{Aligned, Element, index};
use super::layout::NONE;
use super::links::{after, half_way_link, stored};
use super::place::Place;
use super::run::FastRun;
use super::task::Task;
use crate::lattice::moments::density_excess;
use crate::lattice::{Q, W};
use crate::solver::cuts::{Brought, cut_link, taken};
use crate::solver::physics::Physics;
use crate::solver::pool::each;

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
        let items: Vec<_> = returned.iter_mut().enumerate().filter(|(_, list)| !list.is_empty()).collect();
        let parts = each(self.pool.as_deref(), items, |(number, list): (usize, &mut Vec<f64>)| {
            let mut brought = Brought::new(bodies);
            self.block_returns(&task, number, list, &mut brought);
            brought
        });
        let mut brought = Brought::new(bodies);
        parts.iter().for_each(|part| brought.merge(part));
        self.settle_all(&mut returned, &brought.surplus());
        self.cut_returned = returned;
    }

    /// From what the links of full cells would bring in to what they return, in all blocks.
    fn settle_all(&mut self, returned: &mut [Vec<f64>], surplus: &[f64]) {
        let mut old = std::mem::take(&mut self.old);
        let both = returned.iter_mut().zip(&mut old).enumerate();
        let items: Vec<_> = both.filter(|(_, (list, _))| !list.is_empty()).collect();
        each(
            self.pool.as_deref(),
            items,
            |(number, (list, own)): (usize, (&mut Vec<f64>, &mut Aligned<E>))| {
                self.settle(number, list, own.get_mut(), surplus);
            },
        );
        self.old = old;
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
                // Between a solid and a grain as between two solids.
                let behind = at.behind.filter(|&(place, _)| self.is_fluid(place));
                let behind = behind.and_then(|(place, direction)| self.sent(place, direction));
                *back = cut_link(&self.physics, &own, &at.link, behind, rho);
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

    /// From what the links of full cells would bring in to what they return. `own`: populations of the block.
    fn settle(&self, number: usize, returned: &mut [f64], own: &mut [E], surplus: &[f64]) {
        let block = &self.blocks[number];
        for (cell, full) in self.wet_cuts(block, number) {
            if !full {
                continue;
            }
            let first = cell.first as usize;
            let links = &block.cuts.links[first..first + cell.arriving.count_ones() as usize];
            let returned = &mut returned[first..first + links.len()];
            let off = taken(returned, surplus[usize::from(cell.body)]);
            let place = |i: usize| index::<E>(usize::from(cell.local), i);
            for i in 0..Q {
                own[place(i)] = E::from_f64(own[place(i)].to_f64() - W[i] * off);
            }
            for (at, back) in links.iter().zip(returned) {
                let leaving = own[place(usize::from(at.link.out))].to_f64();
                *back = stored::<E>(leaving + *back);
            }
        }
    }
}
