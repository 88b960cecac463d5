//! The ledger of mass and momentum \[F5\] and the loads on solids \[C7\].

use super::SurfaceRun;
use crate::free_surface::Kind;
use crate::free_surface::ledger::{Sum, VectorSum};
use crate::lattice::moments::{density_excess, momentum};
use crate::lattice::{Q, opposite};
use crate::solver::books::{CellEntries, Crossing, Entries};
use crate::solver::physics::Physics;
use crate::solver::run::{Ledger, Runaway, Stopped};

impl<P: Physics> SurfaceRun<P> {
    pub(super) fn open_books(&mut self) {
        self.books.initial_mass = self.total_mass();
        self.books.mass = self.books.initial_mass;
        self.books.initial_momentum = self.total_momentum();
    }

    /// Liquid ρ + interface m + parked.
    pub(super) fn total_mass(&self) -> f64 {
        let mut sum = Sum::default();
        for cell in 0..self.kinds.len() {
            match self.kinds[cell] {
                Kind::Liquid => {
                    sum.add(1.0);
                    sum.add(density_excess(&self.f[cell]));
                }
                Kind::Interface => sum.add(self.mass[cell]),
                Kind::Gas | Kind::Solid => {}
            }
        }
        for mass in self.parked.values() {
            sum.add(*mass);
        }
        sum.value()
    }

    /// Σ c f over fluid cells.
    pub(super) fn total_momentum(&self) -> [f64; 3] {
        let mut sum = VectorSum::default();
        for cell in (0..self.kinds.len()).filter(|&cell| self.kinds[cell].is_fluid()) {
            sum.add(&momentum(&self.f[cell]));
        }
        sum.value()
    }

    /// What came in over the links of this step; reads populations after collision and after streaming.
    pub(super) fn book_links(&mut self) {
        let mut entries = Entries::new(self.loads.len());
        for &cell in &self.special {
            let cell = cell as usize;
            let mut own = CellEntries::default();
            for i in 1..Q {
                let source = self.links.source(cell, i);
                // Links to grains are booked where they are returned.
                if matches!(source, crate::boundary::links::Source::Cell { cell, .. }
                    if self.kinds[cell as usize] == Kind::Solid)
                {
                    continue;
                }
                let gas = matches!(source, crate::boundary::links::Source::Cell { cell, .. }
                    if !self.kinds[cell as usize].is_fluid());
                let crossing = Crossing {
                    i,
                    leaving: self.post[cell][opposite(i)],
                    arrived: self.f[cell][i],
                    share: self.share(cell),
                    liquid: self.kinds[cell] == Kind::Liquid,
                };
                own.link(&crossing, &source, gas, &mut entries);
            }
            own.close(&mut entries);
        }
        self.books.enter(&entries, &mut self.loads);
    }

    fn share(&self, cell: usize) -> f64 {
        if self.kinds[cell] == Kind::Liquid { 1.0 } else { self.fill[cell] }
    }

    /// Closes the mass of this step.
    ///
    /// # Errors
    /// It does not close within rounding; the cell named is the interface cell with the largest |m| off
    /// its fill.
    pub(super) fn close_books(&mut self) -> Result<(), Stopped> {
        let (mass, cells) = (self.total_mass(), self.fluid_count());
        let Some((residual, bound)) = self.books.close(mass, cells, self.setup.precision.rounding()) else {
            return Ok(());
        };
        if self.physics.is_mutant() {
            return Ok(());
        }
        let off = |cell: usize| {
            let off = (self.mass[cell] - self.fill[cell]).abs();
            if off.is_nan() { f64::INFINITY } else { off }
        };
        let worst = self.special.iter().map(|&cell| cell as usize).max_by(|&a, &b| off(a).total_cmp(&off(b)));
        let what = Runaway::Ledger { residual, bound };
        let cell = self.setup.coordinates(worst.unwrap_or(0));
        Err(Stopped { step: self.step, cell, what, tau: f64::NAN })
    }

    pub(super) fn fluid_count(&self) -> u64 {
        self.kinds.iter().filter(|kind| kind.is_fluid()).count() as u64
    }

    pub(super) fn make_ledger(&self) -> Ledger {
        let count = |kind: Kind| self.kinds.iter().filter(|&&k| k == kind).count() as u64;
        let cells = [count(Kind::Liquid), count(Kind::Interface)];
        self.books.ledger(self.total_mass(), self.total_momentum(), self.parked.values().sum(), cells)
    }
}
