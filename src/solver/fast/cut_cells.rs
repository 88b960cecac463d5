//! The cut cells of a block \[B4\].

use super::layout::Layout;
use super::place::{Place, place_of};
use crate::boundary::cut::{CutLink, body, cut_links};
use crate::boundary::links::BoundaryCell;
use crate::lattice::opposite;
use crate::setup::Setup;

/// A cut cell of a block.
#[derive(Clone, Debug)]
pub(crate) struct CutRim {
    /// Place in the block.
    pub local: u16,
    /// Position in [`Block::rim`].
    pub rim: u16,
    /// Its first link in [`Cuts::links`].
    pub first: u32,
    /// Bit i: population i arrives from a wall; the links lie in this order.
    pub arriving: u32,
    /// Whose mass its links count into.
    pub body: u8,
}

/// A link of a cut cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CutPlace {
    pub link: CutLink,
    pub behind: Option<(Place, u8)>,
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
    lists * 5 / 4 + links * size_of::<f64>() as u64
}
