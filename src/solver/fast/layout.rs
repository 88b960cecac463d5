//! Where the cells of a box lie in memory: blocks of rows, and only blocks that hold fluid.
//!
//! A *row* runs along the box axis with the most room for it, so that a box one cell wide in x still fills
//! whole registers. A *slot* is the place of a cell: block number × cells per block + place in the block.

use crate::lattice::{C, Q};

/// No block: nothing but gas or solid there.
pub(crate) const NONE: u32 = u32::MAX;

/// Cells of a full block: small enough that its populations and what they are read from stay in the
/// second-level cache, large enough that the rim does not count.
const BLOCK_CELLS: usize = 512;

/// Shape of the blocks and their places in the box.
#[derive(Clone, Debug)]
pub struct Layout {
    /// `axis[k]`: box axis of block axis k; k = 0 is the direction of the rows.
    axis: [usize; 3],
    /// Cells of a block along its axes; powers of two.
    pub block: [usize; 3],
    shift: [u32; 3],
    /// Blocks along the block axes.
    counts: [usize; 3],
    /// Block number at each place, or [`NONE`].
    table: Vec<u32>,
    /// Lattice velocities along the block axes.
    pub velocity: [[i32; 3]; Q],
    /// [`Self::upstream`] of every place in a block and every direction.
    upstream: Vec<[(u8, u16); Q]>,
}

impl Layout {
    /// Blocks for a box; `width` is the number of cells that are computed side by side (8 or 16).
    #[must_use]
    pub fn new(extents: [usize; 3], width: usize) -> Self {
        let mut axis = [0, 1, 2];
        // Rows along x unless they would be shorter than one register and another axis is longer.
        if extents[0] < width {
            let longest = if extents[2] > extents[1] { 2 } else { 1 };
            if extents[longest] > extents[0] {
                axis.swap(0, longest);
            }
        }
        let room = axis.map(|a| extents[a].next_power_of_two());
        let mut block = [width, 1, 1];
        while block.iter().product::<usize>() < BLOCK_CELLS {
            let grows = (0..3).filter(|&k| block[k] < room[k]).min_by_key(|&k| (block[k], k));
            match grows {
                Some(k) => block[k] *= 2,
                None => break,
            }
        }
        let counts = std::array::from_fn(|k| extents[axis[k]].div_ceil(block[k]));
        let velocity = C.map(|c| axis.map(|a| c[a]));
        let table = vec![NONE; counts.iter().product()];
        let shift = block.map(usize::trailing_zeros);
        let mut layout = Self { axis, block, shift, counts, table, velocity, upstream: Vec::new() };
        let all = 0..layout.block_cells();
        layout.upstream = all.map(|local| std::array::from_fn(|i| layout.find_upstream(local, i))).collect();
        layout
    }

    /// Cells per block.
    #[must_use]
    pub(crate) fn block_cells(&self) -> usize {
        1 << (self.shift[0] + self.shift[1] + self.shift[2])
    }

    /// Populations per block.
    #[must_use]
    pub(crate) fn block_len(&self) -> usize {
        Q * self.block_cells()
    }

    /// Number of places for blocks.
    #[must_use]
    pub(crate) fn places(&self) -> usize {
        self.table.len()
    }

    /// Block at a place.
    #[must_use]
    pub(crate) fn block_at(&self, place: usize) -> u32 {
        self.table[place]
    }

    /// Puts a block number, or [`NONE`], at a place.
    pub(crate) fn set_block(&mut self, place: usize, number: u32) {
        self.table[place] = number;
    }

    /// First cell (x, y, z) of the block at a place.
    #[must_use]
    pub(crate) fn origin(&self, place: usize) -> [usize; 3] {
        let [n0, n1, _] = self.counts;
        let at = [place % n0, (place / n0) % n1, place / (n0 * n1)];
        self.to_box(std::array::from_fn(|k| at[k] << self.shift[k]))
    }

    /// Block coordinates to box coordinates.
    fn to_box(&self, local: [usize; 3]) -> [usize; 3] {
        let mut at = [0; 3];
        for k in 0..3 {
            at[self.axis[k]] = local[k];
        }
        at
    }

    /// Cell (x, y, z) at a place in the block that starts at `origin`; it may lie outside the box in the last
    /// blocks of an axis.
    #[must_use]
    pub(crate) fn cell(&self, origin: [usize; 3], local: usize) -> [usize; 3] {
        let add = self.to_box(self.coordinates(local));
        std::array::from_fn(|a| origin[a] + add[a])
    }

    /// Coordinates inside the block, along the block axes.
    #[inline(always)]
    #[must_use]
    pub(crate) fn coordinates(&self, local: usize) -> [usize; 3] {
        let [s0, s1, _] = self.shift;
        [local & ((1 << s0) - 1), (local >> s0) & ((1 << s1) - 1), local >> (s0 + s1)]
    }

    /// Place in the block of coordinates along the block axes.
    #[inline(always)]
    #[must_use]
    pub(crate) fn local(&self, [a, b, c]: [usize; 3]) -> usize {
        a | (b << self.shift[0]) | (c << (self.shift[0] + self.shift[1]))
    }

    /// Place of the block that holds a cell, and the cell's place in it.
    #[inline]
    #[must_use]
    pub(crate) fn find(&self, at: [usize; 3]) -> (usize, usize) {
        let along = self.axis.map(|a| at[a]);
        let place: [usize; 3] = std::array::from_fn(|k| along[k] >> self.shift[k]);
        let local = std::array::from_fn(|k| along[k] & (self.block[k] - 1));
        (place[0] + self.counts[0] * (place[1] + self.counts[1] * place[2]), self.local(local))
    }

    /// Slot of a cell; `None` where there is no block.
    #[inline]
    #[must_use]
    pub(crate) fn slot(&self, at: [usize; 3]) -> Option<usize> {
        let (place, local) = self.find(at);
        let number = self.table[place];
        (number != NONE).then(|| (number as usize) * self.block_cells() + local)
    }

    /// The 27 blocks around a place, itself in the middle, periodic in every axis; entry
    /// (o0 + 1) + 3 (o1 + 1) + 9 (o2 + 1).
    #[must_use]
    pub(crate) fn around(&self, place: usize) -> [usize; 27] {
        let [n0, n1, n2] = self.counts;
        let at = [place % n0, (place / n0) % n1, place / (n0 * n1)];
        let along = |a: usize, n: usize| {
            let low = if at[a] == 0 { n - 1 } else { at[a] - 1 };
            let high = if at[a] + 1 == n { 0 } else { at[a] + 1 };
            [low, at[a], high]
        };
        let (x, y, z) = (along(0, n0), along(1, n1), along(2, n2));
        std::array::from_fn(|k| x[k % 3] + n0 * (y[k / 3 % 3] + n1 * z[k / 9]))
    }

    /// Where population `i` of a cell comes from on the grid of blocks: entry of [`Self::around`] and place in
    /// that block.
    #[inline(always)]
    #[must_use]
    pub(crate) fn upstream(&self, local: usize, i: usize) -> (usize, usize) {
        let (block, from) = self.upstream[local][i];
        (usize::from(block), usize::from(from))
    }

    fn find_upstream(&self, local: usize, i: usize) -> (u8, u16) {
        let at = self.coordinates(local);
        let mut block = 0;
        let mut from = [0; 3];
        let mut weight = 1;
        for k in 0..3 {
            let to = at[k] as i32 - self.velocity[i][k];
            let size = self.block[k] as i32;
            let offset = i32::from(to >= size) - i32::from(to < 0);
            from[k] = (to - offset * size) as usize;
            block += (offset + 1) as usize * weight;
            weight *= 3;
        }
        (block as u8, self.local(from) as u16)
    }

    /// Row that population `i` of a cell comes from, before the shift along the row: entry of
    /// [`Self::around`] and place of the row's first cell.
    #[inline]
    #[must_use]
    pub(crate) fn upstream_row(&self, local: usize, i: usize) -> (usize, usize) {
        let at = self.coordinates(local);
        let (mut block, mut weight) = (1, 3);
        let mut from = [0; 3];
        for k in 1..3 {
            let to = at[k] as i32 - self.velocity[i][k];
            let size = self.block[k] as i32;
            let offset = i32::from(to >= size) - i32::from(to < 0);
            from[k] = (to - offset * size) as usize;
            block += (offset + 1) as usize * weight;
            weight *= 3;
        }
        (block, self.local(from))
    }

    /// Whether rows run along x.
    #[inline(always)]
    #[must_use]
    pub(crate) fn is_straight(&self) -> bool {
        self.axis[0] == 0
    }

    /// Bytes held.
    #[must_use]
    pub(crate) fn bytes(&self) -> u64 {
        (self.table.len() * size_of::<u32>() + self.upstream.len() * size_of::<[(u8, u16); Q]>()) as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_inverse_of_cell_and_slot() {
        for extents in [[1, 1, 1], [1, 37, 1], [5, 3, 70], [64, 64, 64], [130, 1, 40], [3, 3, 3]] {
            let mut layout = Layout::new(extents, 8);
            for place in 0..layout.places() {
                layout.set_block(place, place as u32);
            }
            let size = layout.block_cells();
            let mut seen = std::collections::BTreeSet::new();
            for z in 0..extents[2] {
                for y in 0..extents[1] {
                    for x in 0..extents[0] {
                        let slot = layout.slot([x, y, z]).unwrap_or(usize::MAX);
                        assert!(seen.insert(slot));
                        assert_eq!(layout.cell(layout.origin(slot / size), slot % size), [x, y, z]);
                    }
                }
            }
        }
    }

    #[test]
    fn exact_upstream_in_a_periodic_box() {
        let extents = [16, 8, 8];
        let mut layout = Layout::new(extents, 8);
        for place in 0..layout.places() {
            layout.set_block(place, place as u32);
        }
        let size = layout.block_cells();
        for place in 0..layout.places() {
            let around = layout.around(place);
            for local in 0..size {
                let at = layout.cell(layout.origin(place), local);
                for i in 0..Q {
                    let from = std::array::from_fn(|a| {
                        (at[a] as i32 - C[i][a]).rem_euclid(extents[a] as i32) as usize
                    });
                    let (block, there) = layout.upstream(local, i);
                    assert_eq!(layout.slot(from), Some(around[block] * size + there));
                }
            }
        }
    }
}
