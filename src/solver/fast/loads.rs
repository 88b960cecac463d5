//! Loads on solids where there is no surface \[C7\]; with one they come out of the ledger.

use super::block::Origin;
use super::element::{Element, index};
use super::links::{density_at_wall, wall_link};
use super::run::FastRun;
use super::task::Task;
use crate::boundary::links::Source;
use crate::lattice::{C, opposite};
use crate::solver::loads::{LoadSums, Pull, book_pull};
use crate::solver::physics::Physics;
use crate::solver::pool::each;

impl<P, E: Element> Task<'_, P, E> {
    /// What the links of a block bring to each solid, after the collision whose populations lie in `old`.
    fn loads_of(&self, number: usize, rim: &[super::rim::Rim], solids: usize) -> Vec<LoadSums>
    where
        P: Physics,
    {
        let mut sums = vec![LoadSums::default(); solids];
        let own = self.old[number].get();
        for link in &self.blocks[number].links {
            let Origin::Wall { velocity, body, edge } = link.from else { continue };
            let (local, i) = (usize::from(link.local), usize::from(link.direction));
            let u = &self.velocities[velocity as usize];
            let at = self.layout.cell(self.blocks[number].origin, local);
            let source = Source::Wall { velocity: *u, body, edge };
            let Some(owners) = source.owners(self.setup, at, i) else { continue };
            let rho = density_at_wall(self, number, local, u);
            let back = wall_link(self, number, rim, link, rho, u, body)
                + own[index::<E>(local, opposite(i))].to_f64();
            let brought = C[i].map(|c| f64::from(c) * back);
            book_pull(&mut sums, self.setup, at, owners, &Pull { i, brought, share: 1.0 });
        }
        sums
    }
}

impl<P: Physics, E: Element> FastRun<P, E> {
    /// Brings the loads up to date with the collision just done; nothing happens with a surface.
    pub(super) fn book_loads(&mut self) {
        if self.loads.is_empty() {
            return;
        }
        let task = self.task([0.0; 3]);
        let numbers = (0..self.blocks.len()).filter(|&n| !self.blocks[n].links.is_empty()).collect();
        let solids = self.loads.len();
        let parts = each(self.pool.as_deref(), numbers, |number: usize| {
            task.loads_of(number, &self.rim[number], solids)
        });
        let mut sums = vec![LoadSums::default(); solids];
        for (sum, part) in parts.iter().flat_map(|part| (0..solids).zip(part)) {
            sums[sum].merge(part);
        }
        for (load, sums) in self.loads.iter_mut().zip(&sums) {
            sums.enter(load);
        }
    }
}
