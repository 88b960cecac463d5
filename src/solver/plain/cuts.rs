//! What comes back along cut links \[B4\], between collision and streaming.

use super::run::PlainRun;
use super::surface::SurfacePhysics;
use crate::boundary::cut::{CutLink, body, cut_links, wall_velocity};
use crate::boundary::links::Links;
use crate::lattice::moments::density_excess;
use crate::lattice::{Q, opposite};
use crate::setup::Setup;
use crate::solver::cell::{Cell, State, wall_link};
use crate::solver::cut_law::{CutShape, Memory, cut_correction};
use crate::solver::cuts::{Brought, cut_link, kept};
use crate::solver::physics::Physics;

/// The cut cells of a run, in the order of [`Setup::cuts`].
#[derive(Clone, Debug, Default)]
pub(super) struct Cuts {
    cells: Vec<CutAt>,
    links: Vec<CutLink>,
    /// What comes back, by link.
    returned: Vec<f64>,
    shapes: Vec<CutShape>,
    memories: Vec<Memory>,
}

/// Bytes of a cut cell.
pub(super) const CUT_CELL: usize = size_of::<CutAt>() + size_of::<CutShape>() + size_of::<Memory>();

/// A cut cell.
#[derive(Clone, Copy, Debug)]
struct CutAt {
    /// Its record among those of all boundary cells.
    slot: u32,
    /// Whose mass its links count into.
    body: u8,
    /// Its first link.
    first: u32,
}

impl Cuts {
    /// Of a run.
    #[must_use]
    pub fn new(setup: &Setup, links: &Links) -> Self {
        let mut cuts = Self::default();
        for (slot, record) in links.boundary().iter().enumerate() {
            let Some(cut) = record.cut.and_then(|place| setup.cuts.get(place as usize)) else { continue };
            let body = body(&record.sources, cut);
            cuts.cells.push(CutAt { slot: slot as u32, body, first: cuts.links.len() as u32 });
            cuts.links.extend(cut_links(&record.sources, cut));
            cuts.shapes.push(CutShape::new(cut, record.walls, wall_velocity(&record.sources)));
            cuts.memories.push([0.0; 4]);
        }
        cuts.returned = vec![0.0; cuts.links.len()];
        cuts
    }

    /// What comes back to the cut cell at a place along the link that leaves along `out`.
    #[inline]
    pub(super) fn returned(&self, place: u32, out: usize) -> Option<f64> {
        let first = self.cells.get(place as usize)?.first as usize;
        let link = self.links[first..].iter().position(|link| usize::from(link.out) == out)?;
        self.returned.get(first + link).copied()
    }

    /// What the wall takes off the populations that leave a cut cell full of fluid.
    #[inline(never)]
    pub(super) fn correction<P: Physics>(
        &mut self,
        place: u32,
        physics: &P,
        h: &Cell,
        state: &State,
        residual: &[f64; 3],
        fluid: u8,
    ) -> Cell {
        let at = place as usize;
        let (Some(shape), Some(memory)) = (self.shapes.get(at), self.memories.get_mut(at)) else {
            return [0.0; Q];
        };
        let (correction, now) = cut_correction(physics, h, state, shape, residual, fluid, *memory);
        *memory = now;
        correction
    }

    /// What a cut cell remembers of its stress.
    #[must_use]
    pub(super) fn memory(&self, place: u32) -> Option<&Memory> {
        self.memories.get(place as usize)
    }

    /// What a cell that is not full remembers: nothing.
    pub(super) fn forget(&mut self, place: u32) {
        if let Some(memory) = self.memories.get_mut(place as usize) {
            *memory = [0.0; 4];
        }
    }

    /// Bytes held.
    #[must_use]
    pub(super) fn bytes(&self) -> u64 {
        let links = self.links.len() * (size_of::<CutLink>() + size_of::<f64>());
        (self.cells.len() * CUT_CELL + links) as u64
    }
}

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
        for (k, cut) in self.cuts.cells.iter().enumerate() {
            let (at, range) = self.cut_cell(k);
            if !self.is_fluid(at) || self.is_interface(at) {
                continue;
            }
            for (link, back) in self.cuts.links[range.clone()].iter().zip(&mut returned[range]) {
                let leaving = self.post[at][usize::from(link.out)];
                *back = leaving + kept(*back, surplus[usize::from(cut.body)]);
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
            let behind =
                link.behind.map(|(cell, direction)| self.post[cell as usize][usize::from(direction)]);
            *back = cut_link(&self.physics, own, correction, link, behind, rho);
            brought.add(body, *back);
        }
    }
}
