//! What comes back along cut links \[B4\], between a collision and the next.

use super::block::Block;
use super::cut_cells::CutRim;
use super::element::{Element, index};
use super::layout::NONE;
use super::links::{after, half_way_link, stored};
use super::place::Place;
use super::run::FastRun;
use super::task::Task;
use crate::lattice::moments::density_excess;
use crate::solver::cuts::{Brought, cut_link, kept};
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
