//! The cut cells of a run \[B4\].

use crate::boundary::cut::{CutLink, body, cut_links};
use crate::boundary::links::Links;
use crate::setup::Setup;
use crate::state::state;

/// The cut cells of a run, in the order of [`Setup::cuts`].
#[derive(Clone, Debug, Default)]
pub(super) struct Cuts {
    pub(super) cells: Vec<CutAt>,
    pub(super) links: Vec<CutLink>,
    /// What comes back, by link.
    pub(super) returned: Vec<f64>,
}

state!(Cuts: returned; but cells links);

/// Bytes of a cut cell.
pub(super) const CUT_CELL: usize = size_of::<CutAt>();

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

    /// Bytes held.
    #[must_use]
    pub(super) fn bytes(&self) -> u64 {
        let links = self.links.len() * (size_of::<CutLink>() + size_of::<f64>());
        (self.cells.len() * CUT_CELL + links) as u64
    }
}
