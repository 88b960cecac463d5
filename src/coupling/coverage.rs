//! Which cells a grain covers, and its links \[C1\]. Work follows the grains that have moved.

use super::L3;
use super::inside::{Inside, inside};
use super::link::{Ball, Blocked, Box3, Link};
use crate::boundary::links::Source;
use crate::lattice::{Q, opposite};
use crate::setup::Setup;
use crate::state::state;
use crate::vector::norm_squared;
use rayon::prelude::*;

/// No grain.
pub(crate) const NOBODY: u32 = u32::MAX;

/// What is known of one grain's cells.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cover {
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
pub(crate) struct Changes {
    /// (cell, grain) newly covered, ascending by cell.
    pub covered: Vec<(u32, u32)>,
    /// (cell, grain) given free, ascending by cell.
    pub freed: Vec<(u32, u32)>,
}

impl Changes {
    /// What is covered or free now and was not before: what only changed hands stays covered. Both ascending.
    fn between(covered: &[(u32, u32)], freed: &[(u32, u32)]) -> Self {
        let holds = |list: &[(u32, u32)], cell: u32| list.binary_search_by_key(&cell, |c| c.0).is_ok();
        let beyond = |list: &[(u32, u32)], other: &[(u32, u32)]| {
            list.iter().copied().filter(|c| !holds(other, c.0)).collect()
        };
        Self { covered: beyond(covered, freed), freed: beyond(freed, covered) }
    }
}

/// What a look at one grain has found.
struct Look {
    grain: usize,
    found: Inside,
    balls: Vec<Ball>,
}

/// Coverage of the whole box.
#[derive(Clone, Debug)]
pub(crate) struct Coverage {
    /// By cell: the grain that covers it, or [`NOBODY`].
    owner: Vec<u32>,
    covers: Vec<Cover>,
    looks: u64,
}

state!(Cover: cells links blocked clearance seen);
state!(Coverage: owner covers looks);

impl Coverage {
    /// Nothing covered yet.
    #[must_use]
    pub fn new(cells: usize, grains: usize) -> Self {
        Self { owner: vec![NOBODY; cells], covers: vec![Cover::default(); grains], looks: 0 }
    }

    /// Grain that covers a cell, or [`NOBODY`].
    #[inline]
    #[must_use]
    pub(crate) fn owner(&self, cell: usize) -> u32 {
        self.owner[cell]
    }

    /// Cells and links of a grain.
    #[must_use]
    pub fn of(&self, grain: usize) -> &Cover {
        &self.covers[grain]
    }

    /// Cells covered by all grains.
    #[must_use]
    pub(crate) fn covered_cells(&self) -> u64 {
        self.covers.iter().map(|cover| cover.cells.len() as u64).sum()
    }

    /// Bytes held.
    #[must_use]
    pub(crate) fn bytes(&self) -> u64 {
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
    pub(crate) fn retain(&mut self, keep: &[bool]) {
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
    pub(crate) fn clear(&mut self, grain: usize) -> Vec<u32> {
        let cells = std::mem::take(&mut self.covers[grain]).cells;
        for &cell in &cells {
            self.owner[cell as usize] = NOBODY;
        }
        cells
    }

    /// Looks at the grains that have moved far enough, on the threads of the pool it is called in. `balls(grain)`: its
    /// spheres; `moved(grain, seen)`: how far the farthest of them is from where it was at the last look.
    pub(crate) fn update(
        &mut self,
        setup: &Setup,
        shape: &Box3,
        balls: &(impl Fn(usize) -> Vec<Ball> + Sync),
        moved: &(impl Fn(usize, &[L3]) -> f64 + Sync),
    ) -> Changes {
        let mut looked = self.look(setup, shape, balls, moved);
        let freed = self.free(&looked);
        // Given free first, so that a cell can pass from one grain to another.
        let mut covered = self.take(&mut looked);
        let mut heirs: Vec<usize> = Vec::new();
        for &(cell, from) in &freed {
            if self.owner[cell as usize] != NOBODY {
                continue;
            }
            // A grain at rest beside the one that left may have had a claim on the cell all along.
            if let Some(heir) = self.heir(setup, shape, balls, cell as usize, from) {
                covered.push((cell, heir));
                heirs.extend(self.inherit(&mut looked, cell, heir));
            }
        }
        covered.sort_unstable();
        let changes = Changes::between(&covered, &freed);
        let mut renewed = self.settle(looked);
        renewed.extend(heirs.into_iter().map(|grain| (grain, balls(grain))));
        self.relink(setup, shape, &renewed);
        changes
    }

    /// Cells inside the grains that have moved far enough, ascending by grain.
    fn look(
        &mut self,
        setup: &Setup,
        shape: &Box3,
        balls: &(impl Fn(usize) -> Vec<Ball> + Sync),
        moved: &(impl Fn(usize, &[L3]) -> f64 + Sync),
    ) -> Vec<Look> {
        let looked: Vec<Look> = self
            .covers
            .par_iter()
            .enumerate()
            .filter_map(|(grain, cover)| {
                if !cover.seen.is_empty() && moved(grain, &cover.seen) < cover.clearance {
                    return None;
                }
                let balls = balls(grain);
                Some(Look { grain, found: inside(setup, shape, &balls), balls })
            })
            .collect();
        for Look { grain, found, balls } in &looked {
            let cover = &mut self.covers[*grain];
            cover.clearance = found.clearance;
            cover.seen = balls.iter().map(|ball| ball.centre).collect();
        }
        self.looks += looked.len() as u64;
        looked
    }

    /// Gives free what is no longer inside its grain: (cell, grain), ascending.
    fn free(&mut self, looked: &[Look]) -> Vec<(u32, u32)> {
        let mut freed = Vec::new();
        for Look { grain, found, .. } in looked {
            for &cell in &self.covers[*grain].cells {
                if found.cells.binary_search(&cell).is_err() {
                    self.owner[cell as usize] = NOBODY;
                    freed.push((cell, *grain as u32));
                }
            }
        }
        freed.sort_unstable();
        freed
    }

    /// Gives cells that are nobody's to the grains that have them inside, (cell, grain); `looked` keeps what each grain
    /// has got.
    fn take(&mut self, looked: &mut [Look]) -> Vec<(u32, u32)> {
        let mut covered = Vec::new();
        for Look { grain, found, .. } in looked {
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
        covered
    }

    /// Gives a cell to a grain beside the one that left it; the grain, if it has not been looked at.
    fn inherit(&mut self, looked: &mut [Look], cell: u32, heir: u32) -> Option<usize> {
        self.owner[cell as usize] = heir;
        let heir = heir as usize;
        if let Ok(at) = looked.binary_search_by_key(&heir, |look| look.grain) {
            insert(&mut looked[at].found.cells, cell);
            return None;
        }
        insert(&mut self.covers[heir].cells, cell);
        Some(heir)
    }

    /// Enters what was found; the grains whose cells have changed. Links follow from the cells of the grain itself and
    /// from fixed solids.
    fn settle(&mut self, looked: Vec<Look>) -> Vec<(usize, Vec<Ball>)> {
        let mut renewed = Vec::with_capacity(looked.len());
        for Look { grain, found, balls } in looked {
            if self.covers[grain].cells != found.cells {
                self.covers[grain].cells = found.cells;
                renewed.push((grain, balls));
            }
        }
        renewed
    }

    /// Finds the links of some grains anew.
    fn relink(&mut self, setup: &Setup, shape: &Box3, renewed: &[(usize, Vec<Ball>)]) {
        let links: Vec<_> =
            renewed.par_iter().map(|(grain, balls)| self.links(setup, shape, *grain, balls)).collect();
        for ((grain, _), (links, blocked)) in renewed.iter().zip(links) {
            let cover = &mut self.covers[*grain];
            (cover.links, cover.blocked) = (links, blocked);
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rheology::Law;

    #[test]
    fn bytes_grow_with_what_is_covered() {
        let setup = Setup::periodic([8; 3], Law::Newtonian { mu: 0.1 });
        let mut coverage = Coverage::new(setup.cells(), 2);
        let bare = 512 * 4 + 2 * size_of::<Cover>() as u64;
        assert_eq!(coverage.bytes(), bare);
        let balls = |grain: usize| vec![Ball { centre: [2.0 + 4.0 * grain as f64, 4.0, 4.0], radius: 1.7 }];
        coverage.update(&setup, &Box3::new(&setup), &balls, &|_, _| 0.0);
        let held: usize = (0..2)
            .map(|grain| {
                let cover = coverage.of(grain);
                assert!(cover.cells.len() > 10 && cover.links.len() > 50);
                4 * cover.cells.len() + size_of::<Link>() * cover.links.len() + size_of::<L3>()
            })
            .sum();
        // A list that grows holds at most twice what is in it, and four entries.
        let least = bare + held as u64;
        assert!((least..=2 * least).contains(&coverage.bytes()), "{} {least}", coverage.bytes());
    }
}
