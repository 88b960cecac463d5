//! Looks at the mass of a box without a free surface; where there is one, the ledger of the solver does in every step.

use crate::solver::books::ROUNDINGS;
use crate::solver::run::{Run, Runaway, Stopped};

/// Steps between looks: the sum over all cells costs as much as a few dozen steps.
const STEPS_PER_LOOK: u64 = 1024;

/// The mass of a box at the start, and when to look at it.
pub(super) struct MassWatch {
    /// Mass excess at time 0, lattice units.
    pub start: f64,
    /// Step at which the run ends.
    pub end: u64,
}

impl MassWatch {
    /// Steps that may be taken at once from `step` on, so as not to miss a look.
    pub fn stride(&self, step: u64) -> u64 {
        STEPS_PER_LOOK - step % STEPS_PER_LOOK
    }

    /// Looks if that is due.
    ///
    /// # Errors
    /// The mass has changed by more than the roundings of a cell in all steps so far.
    pub fn look(&self, run: &dyn Run) -> Result<(), Stopped> {
        let step = run.step();
        if !step.is_multiple_of(STEPS_PER_LOOK) && step < self.end || run.ledger().is_some() {
            return Ok(());
        }
        let cells = run.fluid_cells().max(1) as f64;
        let residual = (run.totals().mass_excess - self.start).abs() / cells;
        // The sum itself adds up excesses of a tenth at most, one cell after the other.
        let sums = 0.1 * f64::EPSILON * cells;
        let bound = 2.0 * ROUNDINGS * run.setup().precision.rounding() * step as f64 + sums;
        if residual <= bound {
            return Ok(());
        }
        Err(Stopped { step, cell: [0; 3], what: Runaway::Mass { residual, bound }, tau: f64::NAN })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rheology::Law;
    use crate::setup::{BodyForce, Face, Setup};
    use crate::solver::plain::Plain;
    use crate::solver::run::Backend;

    /// A channel keeps its mass; one that has lost a billionth does not, in the steps that are looked at.
    #[test]
    fn lost_mass_is_seen() {
        let mut setup = Setup::periodic([4, 6, 4], Law::Newtonian { mu: 0.1 });
        setup.faces[1] = [Face::NoSlip; 2];
        setup.force = BodyForce::Constant([1e-5, 0.0, 0.0]);
        let mut run = Plain.start(&setup).unwrap();
        let start = run.totals().mass_excess;
        run.advance(300).unwrap();
        let cells = run.fluid_cells() as f64;
        for (lost, end, seen) in [(0.0, 300, false), (1e-9, 300, true), (1e-9, 301, false)] {
            let watch = MassWatch { start: start + lost * cells, end };
            assert_eq!(watch.look(run.as_ref()).is_err(), seen, "{lost} {end}");
        }
    }
}
