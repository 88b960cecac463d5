//! What a block and its records hold, for the prediction of `plan`.

use super::block::{Block, Link, RimCell};
use super::element::Element;
use super::layout::Layout;
use super::rim::Rim;
use super::sources::Sources;
use super::surface::record::{InterfaceCell, Lanes};
use crate::setup::{Face, Precision, Setup};

/// Cells per pack: a line of the cache.
#[must_use]
pub(crate) const fn line(precision: Precision) -> usize {
    match precision {
        Precision::Double => <f64 as Element>::PER_LINE,
        Precision::Single | Precision::SingleStorage => <f32 as Element>::PER_LINE,
    }
}

/// Links of a cell on a plane wall, mirror plane or open face; most irregular cells are of this kind.
const LINKS: u64 = 5;

/// Of an interface cell; lists grow by doubling, so that on average a quarter is idle.
pub(crate) const INTERFACE_BYTES: u64 = size_of::<InterfaceCell>() as u64 * 5 / 4;

/// Of a cell with irregular links; `corrected`: with what the wall correction keeps; `surface`: with what comes
/// back along the links.
#[must_use]
pub(crate) const fn rim_bytes(corrected: bool, surface: bool) -> u64 {
    let kept = if corrected { size_of::<Rim>() as u64 } else { 0 };
    // Lists grow by doubling here too.
    let returned = if surface { LINKS * size_of::<f64>() as u64 } else { 0 };
    kept + returned + (size_of::<RimCell>() as u64 + LINKS * size_of::<Link>() as u64) * 5 / 4
}

/// Of a block besides what its cells hold; `line`: cells per pack.
#[must_use]
pub(crate) fn block_bytes(layout: &Layout, line: usize, surface: bool) -> u64 {
    let packs = layout.block_cells() / line;
    let lanes = if surface { packs * size_of::<Lanes>() } else { 0 };
    let alignment = 2 * 64;
    (size_of::<Block>()
        + packs * (size_of::<u16>() + size_of::<u32>())
        + size_of::<u32>()
        + alignment
        + lanes) as u64
}

/// Of the table of sources; `line`: cells per pack.
#[must_use]
pub(crate) fn sources_bytes(layout: &Layout, line: usize) -> u64 {
    if layout.is_straight() { (layout.block_cells() / line * size_of::<Sources>()) as u64 } else { 0 }
}

/// Whether any cell may touch a wall.
#[must_use]
pub(crate) fn has_walls(setup: &Setup) -> bool {
    let wall = |face: &Face| matches!(face, Face::NoSlip | Face::Moving(_));
    !setup.solids.is_empty() || setup.faces.iter().flatten().any(wall)
}
