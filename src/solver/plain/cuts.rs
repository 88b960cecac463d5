//! What comes back along cut links \[B4\], between collision and streaming.

use super::cut_cells::CutAt;
use super::run::PlainRun;
use super::surface::SurfacePhysics;
use crate::boundary::cut::CutLink;
use crate::lattice::moments::density_excess;
use crate::lattice::{Q, W, opposite};
use crate::solver::cell::{Cell, wall_link};
use crate::solver::cuts::{Brought, cut_link, taken};
use crate::solver::physics::Physics;

impl<P: Physics, S: SurfacePhysics> PlainRun<P, S> {
    /// Works out what every cut link sends back: first what each would bring in, then without the surplus of its
    /// solid. Cells that are not full get what stairs return.
    pub(super) fn cut_pass(&mut self) {
        if self.cuts.cells.is_empty() {
            return;
        }
        let mut returned = std::mem::take(&mut self.cuts.returned);
        let mut brought = Brought::new(self.setup.solid_motion.len());
        for k in 0..self.cuts.cells.len() {
            let (at, range) = self.cut_cell(k);
            if self.is_fluid(at) {
                self.cut_cell_returns(k, &mut returned[range], &mut brought);
            }
        }
        let surplus = brought.surplus();
        for k in 0..self.cuts.cells.len() {
            let (at, range) = self.cut_cell(k);
            if self.is_fluid(at) && !self.is_interface(at) {
                let surplus = surplus[usize::from(self.cuts.cells[k].body)];
                let links = &self.cuts.links[range.clone()];
                settle(&mut self.post[at], links, &mut returned[range], surplus);
            }
        }
        self.cuts.returned = returned;
    }

    /// Cell and links of a cut cell.
    fn cut_cell(&self, k: usize) -> (usize, std::ops::Range<usize>) {
        let cuts = &self.cuts;
        let first = cuts.cells[k].first as usize;
        let end = cuts.cells.get(k + 1).map_or(cuts.links.len(), |next| next.first as usize);
        (self.links.boundary()[cuts.cells[k].slot as usize].cell as usize, first..end)
    }

    /// What the links of a full cell would bring in; in interface cells what they return.
    fn cut_cell_returns(&self, k: usize, returned: &mut [f64], brought: &mut Brought) {
        let (at, range) = self.cut_cell(k);
        let CutAt { slot, body, .. } = self.cuts.cells[k];
        let own = &self.post[at];
        let rho = 1.0 + density_excess(own);
        let correction = self.corrections.get(slot as usize);
        let interface = self.is_interface(at);
        for (link, back) in self.cuts.links[range].iter().zip(returned) {
            let arriving = opposite(usize::from(link.out));
            if interface {
                *back = wall_link(&self.physics, own, correction, arriving, rho, &link.velocity);
                continue;
            }
            // Between a solid and a grain as between two solids.
            let behind = link.behind.filter(|&(cell, _)| self.is_fluid(cell as usize));
            let behind = behind.map(|(cell, direction)| self.post[cell as usize][usize::from(direction)]);
            *back = cut_link(&self.physics, own, link, behind, rho);
            brought.add(body, *back);
        }
    }
}

/// From what the links of a full cell would bring in to what they return.
fn settle(own: &mut Cell, links: &[CutLink], returned: &mut [f64], surplus: f64) {
    let off = taken(returned, surplus);
    for i in 0..Q {
        own[i] -= W[i] * off;
    }
    for (link, back) in links.iter().zip(returned) {
        *back += own[usize::from(link.out)];
    }
}
