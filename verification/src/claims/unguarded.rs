//! A run whose ledger need not close.

use lahar::coupling::Immersed;
use lahar::fingerprint::Fingerprint;
use lahar::lattice::Q;
use lahar::setup::Setup;
use lahar::solver::run::{Fields, Ledger, Load, Run, Runaway, Stopped, Totals};

/// Goes on where the guard of the ledger stops a run: the step it names is complete, and the claim on trial
/// measures how far the ledger is off.
pub struct Unguarded<R>(pub R);

impl<R: Run> Run for Unguarded<R> {
    fn advance(&mut self, steps: u64) -> Result<(), Stopped> {
        for _ in 0..steps {
            match self.0.advance(1) {
                Ok(()) | Err(Stopped { what: Runaway::Ledger { .. }, .. }) => {}
                Err(stopped) => return Err(stopped),
            }
        }
        Ok(())
    }

    fn step(&self) -> u64 {
        self.0.step()
    }

    fn setup(&self) -> &Setup {
        self.0.setup()
    }

    fn fields(&self) -> Fields {
        self.0.fields()
    }

    fn populations(&self, cell: usize) -> [f64; Q] {
        self.0.populations(cell)
    }

    fn totals(&self) -> Totals {
        self.0.totals()
    }

    fn fingerprint(&self) -> Fingerprint {
        self.0.fingerprint()
    }

    fn fluid_cells(&self) -> u64 {
        self.0.fluid_cells()
    }

    fn ledger(&self) -> Option<Ledger> {
        self.0.ledger()
    }

    fn loads(&self) -> Vec<Load> {
        self.0.loads()
    }

    fn allocated_bytes(&self) -> u64 {
        self.0.allocated_bytes()
    }

    fn grains(&self) -> Option<&Immersed> {
        self.0.grains()
    }

    fn grains_mut(&mut self) -> Option<&mut Immersed> {
        self.0.grains_mut()
    }

    fn leave(&mut self, keep: &[bool]) {
        self.0.leave(keep);
    }
}
