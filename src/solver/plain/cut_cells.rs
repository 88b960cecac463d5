//! The cut cells of a run \[B4\].

use crate::boundary::cut::{CutLink, body, cut_links, wall_velocity};
use crate::boundary::links::Links;
use crate::lattice::Q;
use crate::setup::Setup;
use crate::solver::cell::{Cell, State};
use crate::solver::cut_law::{CutShape, Memory, cut_correction};
use crate::solver::physics::Physics;

/// The cut cells of a run, in the order of [`Setup::cuts`].
#[derive(Clone, Debug, Default)]
pub(super) struct Cuts {
    pub(super) cells: Vec<CutAt>,
    pub(super) links: Vec<CutLink>,
    /// What comes back, by link.
    pub(super) returned: Vec<f64>,
    pub(super) shapes: Vec<CutShape>,
    pub(super) memories: Vec<Memory>,
}

/// Bytes of a cut cell.
pub(super) const CUT_CELL: usize = size_of::<CutAt>() + size_of::<CutShape>() + size_of::<Memory>();

/// A cut cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct CutAt {
    /// Its record among those of all boundary cells.
    pub(super) slot: u32,
    /// Whose mass its links count into.
    pub(super) body: u8,
    /// Its first link.
    pub(super) first: u32,
}

impl Cuts {
    /// Of a run.
    #[must_use]
    pub(super) fn new(setup: &Setup, links: &Links) -> Self {
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
        by_stress: Option<u8>,
    ) -> Cell {
        let at = place as usize;
        let (Some(shape), Some(memory)) = (self.shapes.get(at), self.memories.get_mut(at)) else {
            return [0.0; Q];
        };
        let (correction, now) = cut_correction(physics, h, state, shape, residual, by_stress, *memory);
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
