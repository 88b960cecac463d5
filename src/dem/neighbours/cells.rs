//! Cells in levels: level l holds radii in (R/2^{l+1}, R/2^l], R the largest radius.
//!
//! A member looks at its own level and the coarser ones only, so a small grain never makes a large one look at
//! many cells: cost is linear for any mixture of sizes. Cells live in a hash table, so memory follows the
//! number of members and not the extent they occupy.

use crate::dem::V3;
use crate::dem::bodies::Member;

/// Finest level; radii below R/2^20 share it.
const LEVELS: usize = 21;

/// A member in a cell.
#[derive(Debug, Clone, Copy)]
struct Entry {
    cell: [i32; 3],
    level: u32,
    member: u32,
}

/// All members sorted into cells.
#[derive(Debug)]
pub struct Cells {
    entries: Vec<Entry>,
    start: Vec<u32>,
    mask: u64,
    /// Largest radius of each level.
    largest: Vec<f64>,
    occupied: Vec<bool>,
    level: Vec<u8>,
    /// Edge of the cells per level and axis, m.
    edge: Vec<V3>,
    /// Cells per period, 0 without period.
    count: Vec<[i32; 3]>,
    period: [Option<f64>; 3],
    grow: f64,
}

/// Position folded into the base cell, and the whole periods taken away.
#[inline]
pub(crate) fn fold(x: &V3, period: &[Option<f64>; 3]) -> (V3, [i32; 3]) {
    let mut folded = *x;
    let mut image = [0; 3];
    for k in 0..3 {
        if let Some(l) = period[k] {
            let n = (x[k] / l).floor();
            folded[k] = x[k] - n * l;
            image[k] = n as i32;
        }
    }
    (folded, image)
}

#[inline]
fn hash(cell: &[i32; 3], level: u32) -> u64 {
    let [x, y, z] = cell.map(|c| c as u64);
    let h = x
        .wrapping_add(y.wrapping_mul(0x9E37_79B9_7F4A_7C15))
        .wrapping_add(z.wrapping_mul(0xC2B2_AE3D_27D4_EB4F))
        .wrapping_add(u64::from(level).wrapping_mul(0x1656_67B1_9E37_79F9));
    h ^ (h >> 32)
}

impl Cells {
    /// Sorts the members; pairs nearer than (1 + `skin`) × the sum of radii will be found.
    pub fn new(members: &[Member], period: [Option<f64>; 3], skin: f64) -> Self {
        let top = members.iter().map(|m| m.radius).fold(0.0, f64::max);
        let grow = 1.0 + skin;
        let largest: Vec<f64> = (0..LEVELS).map(|l| top / (1u64 << l) as f64).collect();
        let mut edge = Vec::with_capacity(LEVELS);
        let mut count = Vec::with_capacity(LEVELS);
        for &r in &largest {
            let wish = 2.0 * r * grow;
            let mut e = V3::repeat(wish);
            let mut n = [0; 3];
            for k in 0..3 {
                if let Some(l) = period[k] {
                    n[k] = ((l / wish).floor() as i32).max(1);
                    e[k] = l / f64::from(n[k]);
                }
            }
            edge.push(e);
            count.push(n);
        }
        let mut occupied = vec![false; LEVELS];
        let level: Vec<u8> = members
            .iter()
            .map(|m| {
                let l = (1..LEVELS).take_while(|&l| m.radius <= largest[l]).count();
                occupied[l] = true;
                l as u8
            })
            .collect();
        let mask = (2 * members.len().max(8)).next_power_of_two() as u64 - 1;
        let mut cells = Self {
            entries: Vec::new(),
            start: Vec::new(),
            mask,
            largest,
            occupied,
            level,
            edge,
            count,
            period,
            grow,
        };
        cells.fill(members);
        cells
    }

    fn fill(&mut self, members: &[Member]) {
        let entry = |i: usize| {
            let level = self.level[i] as usize;
            let (x, _) = fold(&members[i].position, &self.period);
            let mut cell = [0; 3];
            for k in 0..3 {
                let c = (x[k] / self.edge[level][k]).floor() as i32;
                // Round-off may put a folded position on the far face.
                cell[k] = if self.count[level][k] > 0 { c.clamp(0, self.count[level][k] - 1) } else { c };
            }
            Entry { cell, level: level as u32, member: i as u32 }
        };
        let buckets = self.mask as usize + 1;
        let mut start = vec![0u32; buckets + 1];
        let all: Vec<Entry> = (0..members.len()).map(entry).collect();
        for e in &all {
            start[(hash(&e.cell, e.level) & self.mask) as usize + 1] += 1;
        }
        for b in 0..buckets {
            start[b + 1] += start[b];
        }
        let mut cursor = start.clone();
        let mut entries = all.clone();
        for e in all {
            let c = &mut cursor[(hash(&e.cell, e.level) & self.mask) as usize];
            entries[*c as usize] = e;
            *c += 1;
        }
        self.entries = entries;
        self.start = start;
    }

    /// Calls `found(other, periods)` for every member on this or a coarser level that may be near member `i`
    /// (same level: higher numbers only); `periods` is what to add to the other's place.
    #[inline]
    pub(crate) fn around(&self, members: &[Member], i: usize, mut found: impl FnMut(u32, [i32; 3])) {
        let own = self.level[i] as usize;
        let m = &members[i];
        let (x, image) = fold(&m.position, &self.period);
        for level in 0..=own {
            if !self.occupied[level] {
                continue;
            }
            let cut = (m.radius + self.largest[level]) * self.grow;
            let e = &self.edge[level];
            let low = [0, 1, 2].map(|k| ((x[k] - cut) / e[k]).floor() as i32);
            let high = [0, 1, 2].map(|k| ((x[k] + cut) / e[k]).floor() as i32);
            for cz in low[2]..=high[2] {
                for cy in low[1]..=high[1] {
                    for cx in low[0]..=high[0] {
                        let (cell, wrap) = self.wrapped([cx, cy, cz], level);
                        let b = (hash(&cell, level as u32) & self.mask) as usize;
                        for o in &self.entries[self.start[b] as usize..self.start[b + 1] as usize] {
                            if o.cell == cell
                                && o.level == level as u32
                                && (level < own || o.member > i as u32)
                            {
                                found(o.member, [0, 1, 2].map(|k| wrap[k] + image[k]));
                            }
                        }
                    }
                }
            }
        }
    }

    #[inline]
    fn wrapped(&self, mut cell: [i32; 3], level: usize) -> ([i32; 3], [i32; 3]) {
        let mut wrap = [0; 3];
        for k in 0..3 {
            let n = self.count[level][k];
            if n > 0 {
                wrap[k] = cell[k].div_euclid(n);
                cell[k] = cell[k].rem_euclid(n);
            }
        }
        (cell, wrap)
    }
}
