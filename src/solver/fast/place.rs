//! Where a cell lies among the blocks.

use super::layout::Layout;
use crate::setup::Setup;

/// A cell by the place of its block and its place in the block; blocks may come and go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    /// Place of the block in [`Layout`].
    pub block: u32,
    /// Place in the block.
    pub local: u32,
}

/// Place of a cell by its number in the box.
#[must_use]
pub(crate) fn place_of(setup: &Setup, layout: &Layout, cell: usize) -> Place {
    let (block, local) = layout.find(setup.coordinates(cell));
    Place { block: block as u32, local: local as u32 }
}
