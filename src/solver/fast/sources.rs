//! Where ordinary packs are gathered from: the same for every block, hence tabulated.

use super::element::Element;
use super::kernel::index;
use super::layout::Layout;
use super::registers::Registers;
use super::stage::Around;
use super::stores;
use crate::lane::unroll::directions;
use crate::lattice::{C, Q};

/// Sources of one pack, by direction, before the shift along the row: entry of the neighbourhood
/// ([`Layout::around`]) and first number in that block.
#[derive(Clone, Debug)]
pub struct Sources {
    from: [(u32, u32); Q],
    /// The same place in an array with one number per cell.
    cells: [u32; Q],
    /// Numbers between the beginning of the row and the pack, and between the pack and the last one of the row.
    before: u32,
    behind: u32,
    /// Directions that come from rows of other blocks.
    far: Vec<u8>,
}

impl Sources {
    /// Of every pack of a block; empty where rows do not run along x (such boxes are small).
    #[must_use]
    pub fn all<E: Element>(layout: &Layout) -> Vec<Self> {
        if !layout.is_straight() {
            return Vec::new();
        }
        (0..layout.block_cells() / E::PER_LINE).map(|pack| Self::new::<E>(layout, pack)).collect()
    }

    fn new<E: Element>(layout: &Layout, pack: usize) -> Self {
        let local = pack * E::PER_LINE;
        let row = layout.block[0];
        let x = layout.coordinates(local)[0];
        let from = directions(|i| {
            let (entry, first) = layout.upstream_row(local, i);
            (entry as u32, index::<E>(first + x, i) as u32)
        });
        let cells = directions(|i| (layout.upstream_row(local, i).1 + x) as u32);
        let far = (0..Q as u8).filter(|&i| from[usize::from(i)].0 != 13).collect();
        Self { from, cells, before: (x * Q) as u32, behind: ((row - x - E::PER_LINE) * Q) as u32, far }
    }

    /// Asks for the lines of other blocks long before they are used: they come from memory, without a pattern
    /// that the processor could guess. Into the second-level cache: a request for the first level holds one of
    /// its few places for lines on their way until memory has answered, and the loads of the pack in
    /// work wait behind it.
    #[inline(always)]
    pub fn prefetch_far<E: Element>(&self, around: &Around<E>) {
        for &i in &self.far {
            let (entry, base) = self.from[usize::from(i)];
            stores::prefetch_far(around.entry(entry as usize), base as usize);
            // The end of a row that lies one block further has not been touched by the block before.
            if C[usize::from(i)][0] == -1 && self.behind == 0 {
                stores::prefetch_far(around.entry(entry as usize + 1), (base - self.before) as usize);
            }
        }
    }

    /// Asks for all lines of the pack just before they are used, from the second-level cache.
    #[inline(always)]
    pub fn prefetch_near<E: Element>(&self, around: &Around<E>) {
        for (entry, base) in self.from {
            stores::prefetch_near(around.entry(entry as usize), base as usize);
        }
    }
}

/// The populations that arrive in part of an ordinary pack.
///
/// Where they come from along the row, two neighbouring packs are loaded whole and shifted: a load across
/// two lines takes as long as two loads, and to put a single number in takes two more operations.
#[inline(always)]
pub fn gather<R: Registers>(around: &Around<R::Element>, sources: &Sources, part: usize) -> [R::Pack; Q] {
    let line = R::Element::PER_LINE;
    directions(
        #[inline(always)]
        |i| {
            let (entry, base) = (sources.from[i].0 as usize, sources.from[i].1 as usize);
            let from = around.entry(entry);
            let pack = R::load_at(from, base + part);
            match C[i][0] {
                1 => {
                    let before = if part > 0 {
                        R::load_at(from, base + part - R::WIDTH)
                    } else if sources.before > 0 {
                        R::load_at(from, base - Q * line + line - R::WIDTH)
                    } else {
                        let last = base + sources.behind as usize + line - R::WIDTH;
                        R::load_at(around.entry(entry - 1), last)
                    };
                    R::shifted_up(before, pack)
                }
                -1 => {
                    let behind = if part + R::WIDTH < line {
                        R::load_at(from, base + part + R::WIDTH)
                    } else if sources.behind > 0 {
                        R::load_at(from, base + Q * line)
                    } else {
                        R::load_at(around.entry(entry + 1), base - sources.before as usize)
                    };
                    R::shifted_down(pack, behind)
                }
                _ => pack,
            }
        },
    )
}

/// Numbers that belong to cells, from where population `i` of part of an ordinary pack comes from; `fields`: one
/// number per cell for each of the 27 blocks ([`Layout::around`]).
#[inline(always)]
pub fn gather_cells<R: Registers>(
    fields: &[&[f64]; 27],
    sources: &Sources,
    part: usize,
    i: usize,
) -> R::Pack {
    let (entry, at) = (sources.from[i].0 as usize, sources.cells[i] as usize + part);
    // Of the row: what lies before the pack and behind it.
    let before = sources.before as usize / Q + part;
    let behind = sources.behind as usize / Q + R::Element::PER_LINE - part - R::WIDTH;
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
