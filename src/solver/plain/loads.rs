//! Loads on solids where there is no surface \[C7\]; with one they come out of the ledger.

use super::run::PlainRun;
use super::surface::SurfacePhysics;
use crate::lattice::{C, Q, opposite};
use crate::solver::loads::{LoadSums, Pull, book_pull};
use crate::solver::physics::Physics;

impl<P: Physics, S: SurfacePhysics> PlainRun<P, S> {
    /// Brings the loads up to date; reads populations after collision and after streaming.
    pub(super) fn book_loads(&mut self) {
        if self.loads.is_empty() {
            return;
        }
        let mut sums = vec![LoadSums::default(); self.loads.len()];
        for record in self.links.boundary() {
            let cell = record.cell as usize;
            let at = self.setup.coordinates(cell);
            for i in 1..Q {
                let Some(owners) = record.sources[i].owners(&self.setup, at, i) else { continue };
                let back = self.f[cell][i] + self.post[cell][opposite(i)];
                let brought = C[i].map(|c| f64::from(c) * back);
                book_pull(&mut sums, &self.setup, at, owners, &Pull { i, brought, share: 1.0 });
            }
        }
        for (load, sums) in self.loads.iter_mut().zip(&sums) {
            sums.enter(load);
        }
    }
}
