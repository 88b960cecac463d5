//! Which cells a grain covers, and its links \[C1\]. Work follows the grains that have moved.

use super::L3;
use super::link::{Ball, Blocked, Box3, Link};
use crate::boundary::links::Source;
use crate::lattice::{Q, opposite};
use crate::setup::Setup;
use crate::vector::norm_squared;
use rayon::prelude::*;

/// No grain.
pub const NOBODY: u32 = u32::MAX;

/// What is known of one grain's cells.
#[derive(Clone, Debug, Default)]
pub struct Cover {
    /// Cells it covers, ascending. A cell inside two grains belongs to the one that came first.
    pub cells: Vec<u32>,
    /// Links from outside into them, ascending.
    pub links: Vec<Link>,
    /// Links into walls and fixed solids.
    pub blocked: Vec<Blocked>,
    /// No cell changes before a ball has moved this far, cells.
    clearance: f64,
    /// Centres of its balls at the last look, cells; empty before the first.
    seen: Vec<L3>,
}

/// Changes of one update.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Changes {
    /// (cell, grain) newly covered, ascending by cell.
    pub covered: Vec<(u32, u32)>,
    /// (cell, grain) given free, ascending by cell.
    pub freed: Vec<(u32, u32)>,
}

/// Coverage of the whole box.
#[derive(Clone, Debug)]
pub struct Coverage {
    /// By cell: the grain that covers it, or [`NOBODY`].
    owner: Vec<u32>,
    covers: Vec<Cover>,
    looks: u64,
}

impl Coverage {
    /// Nothing covered yet.
    #[must_use]
    pub fn new(cells: usize, grains: usize) -> Self {
        Self { owner: vec![NOBODY; cells], covers: vec![Cover::default(); grains], looks: 0 }
    }

    /// Grain that covers a cell, or [`NOBODY`].
    #[inline]
    #[must_use]
    pub fn owner(&self, cell: usize) -> u32 {
        self.owner[cell]
    }

    /// Cells and links of a grain.
    #[must_use]
    pub fn of(&self, grain: usize) -> &Cover {
        &self.covers[grain]
    }

    /// How often a grain's cells were looked at again.
    #[must_use]
    pub fn looks(&self) -> u64 {
        self.looks
    }

    /// Cells covered by all grains.
    #[must_use]
    pub fn covered_cells(&self) -> u64 {
        self.covers.iter().map(|cover| cover.cells.len() as u64).sum()
    }

    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        let each = |cover: &Cover| {
            cover.cells.capacity() * 4
                + cover.links.capacity() * size_of::<Link>()
                + cover.blocked.capacity() * size_of::<Blocked>()
                + cover.seen.capacity() * size_of::<L3>()
                + size_of::<Cover>()
        };
        (self.owner.len() * 4 + self.covers.iter().map(each).sum::<usize>()) as u64
    }

    /// Leaves out all grains that are not kept and numbers the others anew; their cells must have been given free.
    pub fn retain(&mut self, keep: &[bool]) {
        let mut number = 0;
        let numbers: Vec<u32> = keep
            .iter()
            .map(|&kept| {
                let own = if kept { number } else { NOBODY };
                number += u32::from(kept);
                own
            })
            .collect();
        for owner in self.owner.iter_mut().filter(|owner| **owner != NOBODY) {
            *owner = numbers[*owner as usize];
        }
        let mut kept = keep.iter();
        self.covers.retain(|_| kept.next().copied().unwrap_or(true));
    }

    /// Gives all cells of a grain free.
    pub fn clear(&mut self, grain: usize) -> Vec<u32> {
        let cells = std::mem::take(&mut self.covers[grain]).cells;
        for &cell in &cells {
            self.owner[cell as usize] = NOBODY;
        }
        cells
    }

    /// Looks at the grains that have moved far enough, on the threads of the pool it is called in. `balls(grain)`: its
    /// spheres; `moved(grain, seen)`: how far the farthest of them is from where it was at the last look.
    pub fn update(
        &mut self,
        setup: &Setup,
        shape: &Box3,
        balls: &(impl Fn(usize) -> Vec<Ball> + Sync),
        moved: &(impl Fn(usize, &[L3]) -> f64 + Sync),
    ) -> Changes {
        let found: Vec<Option<(Inside, Vec<Ball>)>> = self
            .covers
            .par_iter()
            .enumerate()
            .map(|(grain, cover)| {
                if !cover.seen.is_empty() && moved(grain, &cover.seen) < cover.clearance {
                    return None;
                }
                let balls = balls(grain);
                Some((inside(setup, shape, &balls), balls))
            })
            .collect();
        let mut looked = Vec::new();
        let mut freed: Vec<(u32, u32)> = Vec::new();
        for (grain, (found, balls)) in
            found.into_iter().enumerate().filter_map(|(grain, found)| Some((grain, found?)))
        {
            self.looks += 1;
            let cover = &mut self.covers[grain];
            cover.clearance = found.clearance;
            cover.seen = balls.iter().map(|ball| ball.centre).collect();
            for &cell in &cover.cells {
                if found.cells.binary_search(&cell).is_err() {
                    self.owner[cell as usize] = NOBODY;
                    freed.push((cell, grain as u32));
                }
            }
            looked.push((grain, found, balls));
        }
        // Given free first, so that a cell can pass from one grain to another.
        let mut covered = Vec::new();
        for (grain, found, _) in &mut looked {
            let own = *grain as u32;
            let owner = &mut self.owner;
            found.cells.retain(|&cell| {
                let owner = &mut owner[cell as usize];
                if *owner == NOBODY {
                    *owner = own;
                    covered.push((cell, own));
                }
                *owner == own
            });
        }
        freed.sort_unstable();
        let mut passed_on: Vec<usize> = Vec::new();
        for &(cell, from) in &freed {
            let owner = self.owner[cell as usize];
            if owner != NOBODY {
                continue;
            }
            // A grain at rest beside the one that left may have had a claim on the cell all along.
            if let Some(heir) = self.heir(setup, shape, balls, cell as usize, from) {
                self.owner[cell as usize] = heir;
                covered.push((cell, heir));
                match looked.iter_mut().find(|(grain, ..)| *grain == heir as usize) {
                    Some((_, found, _)) => insert(&mut found.cells, cell),
                    None => {
                        insert(&mut self.covers[heir as usize].cells, cell);
                        passed_on.push(heir as usize);
                    }
                }
            }
        }
        covered.sort_unstable();
        // What only changed hands stays covered.
        let stays = |list: &[(u32, u32)], cell: u32| list.binary_search_by_key(&cell, |c| c.0).is_ok();
        let truly_freed = freed.iter().copied().filter(|c| !stays(&covered, c.0)).collect();
        let truly_covered = covered.iter().copied().filter(|c| !stays(&freed, c.0)).collect();
        let mut renewed: Vec<(usize, Vec<Ball>)> = Vec::with_capacity(looked.len() + passed_on.len());
        for (grain, found, balls) in looked {
            // Links follow from the cells of the grain itself and from fixed solids.
            if self.covers[grain].cells != found.cells {
                self.covers[grain].cells = found.cells;
                renewed.push((grain, balls));
            }
        }
        renewed.extend(passed_on.into_iter().map(|grain| (grain, balls(grain))));
        let links: Vec<_> =
            renewed.par_iter().map(|(grain, balls)| self.links(setup, shape, *grain, balls)).collect();
        for ((grain, _), (links, blocked)) in renewed.iter().zip(links) {
            let cover = &mut self.covers[*grain];
            (cover.links, cover.blocked) = (links, blocked);
        }
        Changes { covered: truly_covered, freed: truly_freed }
    }

    /// The grain with the lowest number beside a cell that has it inside.
    fn heir(
        &self,
        setup: &Setup,
        shape: &Box3,
        balls: &impl Fn(usize) -> Vec<Ball>,
        cell: usize,
        from: u32,
    ) -> Option<u32> {
        let centre = shape.centre(cell);
        let mut found: Option<u32> = None;
        for i in 1..Q {
            let Some(n) = shape.target(setup, cell, i) else { continue };
            let owner = self.owner[n];
            if owner == NOBODY || owner == from || found.is_some_and(|f| f <= owner) {
                continue;
            }
            let holds =
                |ball: &Ball| norm_squared(shape.apart(&centre, &ball.centre)) < ball.radius * ball.radius;
            if balls(owner as usize).iter().any(holds) {
                found = Some(owner);
            }
        }
        found
    }

    /// Links of a grain, from its cells.
    fn links(&self, setup: &Setup, shape: &Box3, grain: usize, balls: &[Ball]) -> (Vec<Link>, Vec<Blocked>) {
        let own = grain as u32;
        let (mut links, mut blocked) = (Vec::new(), Vec::new());
        // All 18 neighbours of a cell deeper than √2 are inside too.
        let deep = |cell: usize| {
            let centre = shape.centre(cell);
            balls.iter().any(|ball| {
                let room = ball.radius - 1.5;
                room > 0.0 && norm_squared(shape.apart(&centre, &ball.centre)) < room * room
            })
        };
        for &cell in &self.covers[grain].cells {
            let at = cell as usize;
            if deep(at) {
                continue;
            }
            for i in 1..Q {
                match shape.source(setup, at, i) {
                    Source::Cell { cell: from, direction } => {
                        if self.owner[from as usize] != own {
                            let slot = opposite(i) as u8;
                            links.push(Link {
                                cell: from,
                                out: direction,
                                slot,
                                covered: cell,
                                behind: NOBODY,
                            });
                        }
                    }
                    Source::Wall { .. } => blocked.push(Blocked { covered: cell, inward: i as u8 }),
                    Source::Open => {}
                }
            }
        }
        // By (cell, out, slot), which no two share.
        links.sort_unstable_by_key(|link: &Link| {
            u64::from(link.cell) << 16 | u64::from(link.out) << 8 | u64::from(link.slot)
        });
        for link in &mut links {
            let behind = shape.straight_behind(setup, link.cell as usize, usize::from(link.out));
            link.behind = behind.unwrap_or(NOBODY);
        }
        (links, blocked)
    }
}

fn insert(list: &mut Vec<u32>, cell: u32) {
    if let Err(at) = list.binary_search(&cell) {
        list.insert(at, cell);
    }
}

/// Cells with their centre inside some balls.
struct Inside {
    /// Ascending.
    cells: Vec<u32>,
    /// Least distance of any cell centre from the surface of a ball, cells, at most 1.
    clearance: f64,
}

fn inside(setup: &Setup, shape: &Box3, balls: &[Ball]) -> Inside {
    let mut cells = Vec::new();
    let mut clearance = 1.0_f64;
    for ball in balls {
        let (r2, reach) = (ball.radius * ball.radius, ball.radius + 1.0);
        // | |d| − r | ≥ |d² − r²| / (2r + 1) for all cells looked at.
        let scale = 1.0 / (ball.radius + reach);
        let range = |a: usize| {
            let low = (ball.centre[a] - reach - 0.5).ceil() as i64;
            let high = (ball.centre[a] + reach - 0.5).floor() as i64;
            let n = shape.extents[a] as i64;
            if shape.periodic[a] { (low, high) } else { (low.max(0), high.min(n - 1)) }
        };
        let [x, y, z] = [range(0), range(1), range(2)];
        let fold = |k: i64, a: usize| {
            if shape.periodic[a] { k.rem_euclid(shape.extents[a] as i64) as usize } else { k as usize }
        };
        for k in z.0..=z.1 {
            let dz = k as f64 + 0.5 - ball.centre[2];
            for j in y.0..=y.1 {
                let dy = j as f64 + 0.5 - ball.centre[1];
                let rest = dy * dy + dz * dz;
                // Beyond this no cell is inside, or nearer to the surface than 1.
                let span2 = reach * reach - rest;
                if span2 < 0.0 {
                    continue;
                }
                let span = span2.sqrt();
                let low = ((ball.centre[0] - span - 0.5).ceil() as i64).max(x.0);
                let high = ((ball.centre[0] + span - 0.5).floor() as i64).min(x.1);
                let row = setup.index([0, fold(j, 1), fold(k, 2)]);
                for i in low..=high {
                    let dx = i as f64 + 0.5 - ball.centre[0];
                    let beyond = (dx * dx + rest) - r2;
                    let gap = beyond.abs() * scale;
                    if gap < clearance {
                        clearance = gap;
                    }
                    if beyond < 0.0 {
                        let cell = row + fold(i, 0);
                        if !setup.is_solid(cell) {
                            cells.push(cell as u32);
                        }
                    }
                }
            }
        }
    }
    cells.sort_unstable();
    cells.dedup();
    Inside { cells, clearance }
}
