//! The claim of the sweep.

use super::case::Case;
use super::judge::Judgement;
use super::row::Row;
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::plan::wall_error::Sweep;
use lahar::solver::run::Backend;

/// Cases of a rung.
const EACH: u64 = 10;
const RUNGS: &[f64] = &[0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0];

/// A hundred small random flows.
pub const WALLS: Claim = Claim {
    id: "walls-sweep",
    title: "A hundred random flows between walls have one steady state each, near the exact one",
    tags: &["B1", "B3", "Y3", "K2", "K3"],
    measures: "cases among ten with a fault that no plan warns of: a run from rest or from 3 × the exact flow that is stopped or does \
               not become steady, two states more than 1e-3 of the speed apart (5e-2 between curved walls), an error of the largest speed \
               above 1.5 % from 12 cells on between plane walls with n ≥ 0.25, or above that with half-way walls on stairs by more \
               than 1 % (5 % around turning cylinders, which are stairs, and where a run that half-way walls leave unsteady too is no \
               fault); a plan's warning comes from other cases than these",
    reference: Reference { source: "exact solutions of each flow (docs/references.md)", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "first case", short: RUNGS, full: RUNGS },
    order: None,
    tolerance: Tolerance { value: 0.5, at: Rung::Every, basis: Basis::Derived, because: "no fault at all" },
    kind: Kind::Verification,
    measure: |backend, first| faults(backend, first),
};

fn faults(backend: &dyn Backend, first: f64) -> Result<Sample, VerifyError> {
    let table = |e: serde_json::Error| VerifyError::Numerics {
        what: "the table of the sweep",
        detail: e.to_string(),
    };
    let sweep = Sweep::built_in().map_err(table)?;
    let from = first as u64;
    let (mut silent, mut announced, mut last) = (0, 0, -1.0);
    let (mut worst, mut apart) = (0.0_f64, 0.0_f64);
    for number in from..from + EACH {
        let row = Row::of(backend, Case::new(number))?;
        let judgement = Judgement::of(&row, &sweep);
        if judgement.is_silent() {
            (silent, last) = (silent + 1, number as f64);
        }
        if judgement.announced {
            announced += 1;
        } else if row.case.place.is_flat() {
            (worst, apart) = (worst.max(row.error().abs()), apart.max(row.apart()));
        }
    }
    Ok(Sample::absolute(first, f64::from(silent), 0.0)
        .with("plane, no warning: largest error", worst)
        .with("plane, no warning: starts apart", apart)
        .with("cases that a plan warns of", f64::from(announced))
        .with("last case with a fault", last))
}
