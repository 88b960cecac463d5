//! Where ordinary packs are gathered from: the same for every block, hence tabulated.

#![allow(unsafe_code, reason = "loads whose places are checked once, when they are tabulated")]

use super::around::Around;
use super::element::{Element, index};
use super::layout::Layout;
use super::registers::Registers;
use super::stores;
use crate::lattice::unroll::directions;
use crate::lattice::{C, Q};

/// A line of the neighbourhood: entry ([`Layout::around`]) and first number in that block.
type Line = (u32, u32);

/// Sources of one pack.
#[derive(Clone, Debug)]
pub(crate) struct Sources {
    /// By direction: the line before the shift along the row.
    from: [Line; Q],
    /// By direction: the line before or behind it in the row, of which the shift brings in one number; the line
    /// itself where there is no shift.
    edge: [Line; Q],
    /// By direction: place of the pack of `from` in an array with one number per cell.
    cells: [u32; Q],
    /// Cells between the beginning of the row and the pack, and between the pack and the end of the row.
    before: u32,
    behind: u32,
    /// Lines of other blocks.
    far: Vec<Line>,
    /// Numbers in a block; all lines above end below it, and their entries below 27.
    block_len: usize,
}

impl Sources {
    /// Of every pack of a block; empty where rows do not run along x (such boxes are small).
    #[must_use]
    pub(crate) fn all<E: Element>(layout: &Layout) -> Vec<Self> {
        if !layout.is_straight() {
            return Vec::new();
        }
        (0..layout.block_cells() / E::PER_LINE).map(|pack| Self::new::<E>(layout, pack)).collect()
    }

    fn new<E: Element>(layout: &Layout, pack: usize) -> Self {
        let local = pack * E::PER_LINE;
        let row = layout.block[0];
        let x = layout.coordinates(local)[0];
        let upstream = directions(|i| layout.upstream_row(local, i));
        let line = |entry: usize, cell: usize, i: usize| (entry as u32, index::<E>(cell, i) as u32);
        let from = directions(|i| line(upstream[i].0, upstream[i].1 + x, i));
        let edge = directions(|i| {
            let (entry, first) = upstream[i];
            match C[i][0] {
                1 if x == 0 => line(entry - 1, first + row - E::PER_LINE, i),
                1 => line(entry, first + x - E::PER_LINE, i),
                -1 if x + E::PER_LINE == row => line(entry + 1, first, i),
                -1 => line(entry, first + x + E::PER_LINE, i),
                _ => from[i],
            }
        });
        let cells = directions(|i| (upstream[i].1 + x) as u32);
        let mut far: Vec<Line> = from.iter().copied().filter(|line| line.0 != 13).collect();
        // The end of a row that lies one block further in x has not been touched by the block before.
        far.extend(
            (0..Q).filter(|&i| C[i][0] == -1 && edge[i].0 > from[i].0 && from[i].0 != 13).map(|i| edge[i]),
        );
        // What the unchecked loads of `gather` rely on.
        let block_len = layout.block_len();
        let inside = |line: &Line| line.0 < 27 && line.1 as usize + E::PER_LINE <= block_len;
        assert!(from.iter().chain(&edge).all(inside), "a pack is gathered from outside the blocks");
        Self { from, edge, cells, before: x as u32, behind: (row - x - E::PER_LINE) as u32, far, block_len }
    }

    /// Asks for the lines of other blocks long before they are used: they come from memory, without a pattern
    /// that the processor could guess. Into the second-level cache: a request for the first level holds one of
    /// its few places for lines on their way until memory has answered, and the loads of the pack in
    /// work wait behind it.
    #[inline(always)]
    pub(crate) fn prefetch_far<E: Element>(&self, around: &Around<E>) {
        for &(entry, base) in &self.far {
            stores::prefetch_far(around.all()[entry as usize], base as usize);
        }
    }
}

/// Packs between moving a line to the first-level cache and using it.
const NEAR: usize = 2;

/// [`Registers::WIDTH`] numbers of the neighbourhood; a line and a place in it.
///
/// # Safety
/// The entry of the line is below 27, it ends below [`Around::block_len`], and `part + WIDTH` is at most
/// [`Element::PER_LINE`].
#[inline(always)]
unsafe fn load<R: Registers>(around: &Around<R::Element>, line: Line, part: usize) -> R::Pack {
    // SAFETY: the caller's promises; every slice of `Around` has the same length.
    R::load(unsafe {
        stores::numbers(stores::entry(around.all(), line.0 as usize), line.1 as usize + part, R::WIDTH)
    })
}

/// The populations that arrive in part of an ordinary pack.
///
/// Where they come from along the row, two neighbouring packs are loaded whole and shifted: a load across
/// two lines takes as long as two loads, and to put a single number in takes two more operations.
///
/// Asks on the way for the lines that the pack after next will need: those of most packs follow each other
/// in memory, and for the others the request does no harm.
///
/// # Panics
/// The sources are those of other blocks, or `part` is not the beginning of a part of a line.
#[inline(always)]
pub(crate) fn gather<R: Registers>(
    around: &Around<R::Element>,
    sources: &Sources,
    part: usize,
) -> [R::Pack; Q] {
    const { assert!(R::Element::PER_LINE.is_multiple_of(R::WIDTH)) };
    let line = R::Element::PER_LINE;
    assert!(around.block_len() == sources.block_len && part < line && part.is_multiple_of(R::WIDTH));
    directions(
        #[inline(always)]
        |i| {
            let (from, edge) = (sources.from[i], sources.edge[i]);
            let next = part + R::WIDTH;
            // SAFETY: `Sources::new` has checked every line and its entry against the length of a block, which is that of
            // these blocks; WIDTH divides PER_LINE, so that a part begins at its multiples and ends in the line.
            unsafe {
                if part == 0 {
                    let block = stores::entry(around.all(), from.0 as usize);
                    stores::prefetch_near(block, from.1 as usize + NEAR * Q * line);
                }
                let pack = load::<R>(around, from, part);
                match C[i][0] {
                    1 if part > 0 => R::shifted_up(load::<R>(around, from, part - R::WIDTH), pack),
                    1 => R::shifted_up(load::<R>(around, edge, line - R::WIDTH), pack),
                    -1 if next < line => R::shifted_down(pack, load::<R>(around, from, next)),
                    -1 => R::shifted_down(pack, load::<R>(around, edge, 0)),
                    _ => pack,
                }
            }
        },
    )
}

/// Numbers that belong to cells, from where population `i` of part of an ordinary pack comes from; `fields`: one
/// number per cell for each of the 27 blocks ([`Layout::around`]).
#[inline(always)]
pub(crate) fn gather_cells<R: Registers>(
    fields: &[&[f64]; 27],
    sources: &Sources,
    part: usize,
    i: usize,
) -> R::Pack {
    let (entry, at) = (sources.from[i].0 as usize, sources.cells[i] as usize + part);
    // Of the row: what lies before the pack and behind it.
    let before = sources.before as usize + part;
    let behind = sources.behind as usize + R::Element::PER_LINE - part - R::WIDTH;
    let pack = R::load_wide(&fields[entry][at..]);
    match C[i][0] {
        1 => {
            let previous = if before > 0 {
                R::load_wide(&fields[entry][at - R::WIDTH..])
            } else {
                R::load_wide(&fields[entry - 1][at + behind..])
            };
            R::shifted_up(previous, pack)
        }
        -1 => {
            let next = if behind > 0 {
                R::load_wide(&fields[entry][at + R::WIDTH..])
            } else {
                R::load_wide(&fields[entry + 1][at - before..])
            };
            R::shifted_down(pack, next)
        }
        _ => pack,
    }
}
