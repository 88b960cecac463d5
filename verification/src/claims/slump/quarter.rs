//! A quarter of a heap between mirror planes and the whole heap; the ledger over many steps.

use super::scene::Heap;
use super::shear::HEAP;
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::solver::run::{Backend, Run};

/// The heap of the shear regime, narrower so that the whole of it is small too.
const SMALL: Heap = Heap { top: 0.5, base: 1.5, reach: 2.5, ..HEAP };
/// Cells in its height.
const CELLS: f64 = 4.0;

/// Cells of the quarter whose populations, kind or fill differ in any bit from those of the same cell of the
/// whole.
fn differing(part: &dyn Run, whole: &dyn Run) -> usize {
    let (small, large) = (part.fields(), whole.fields());
    let half = whole.setup().extents[0] / 2;
    let differs = |&cell: &usize| {
        let [i, j, k] = part.setup().coordinates(cell);
        let other = whole.setup().index([i + half, j + half, k]);
        part.populations(cell) != whole.populations(other)
            || small.kind[cell] != large.kind[other]
            || small.fill[cell].to_bits() != large.fill[other].to_bits()
    };
    (0..part.setup().cells()).filter(differs).count()
}

fn quarter(backend: &dyn Backend, steps: f64) -> Result<Sample, VerifyError> {
    let whole = Heap { quarter: false, ..SMALL };
    let mut part = backend.start(&SMALL.setup(CELLS))?;
    let mut whole = backend.start(&whole.setup(CELLS))?;
    part.advance(steps as u64)?;
    whole.advance(steps as u64)?;
    let mut sample = Sample::absolute(steps, differing(part.as_ref(), whole.as_ref()) as f64, 0.0)
        .with("fluid cells of the quarter [-]", part.fluid_cells() as f64);
    if let (Some(a), Some(b)) = (part.ledger(), whole.ledger()) {
        sample = sample
            .with("four quarters less the whole, mass over mass [-]", (4.0 * a.mass - b.mass) / b.mass)
            .with("conversions of the quarter [-]", a.conversions as f64)
            .with("conversions of the whole [-]", b.conversions as f64);
    }
    Ok(sample)
}

/// Quarter and whole.
pub const QUARTER: Claim = Claim {
    id: "slump-quarter-geometry",
    title: "A quarter of a slump between two mirror planes is the whole slump, bit by bit.",
    tags: &["B2", "F1", "F2", "F4", "F6"],
    measures: "cells of the quarter whose populations, kind or fill differ from the whole's in any bit",
    reference: Reference { source: "symmetry", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "steps", short: &[100.0, 600.0], full: &[100.0, 600.0, 3000.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.0,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "a mirrored cell does the same sums in the same order",
    },
    kind: Kind::Verification,
    measure: quarter,
};

fn mass(backend: &dyn Backend, steps: f64) -> Result<Sample, VerifyError> {
    let heap = Heap { top: 1.0, base: 2.0, reach: 3.25, ..HEAP };
    let mut run = backend.start(&heap.setup(CELLS))?;
    run.advance(steps as u64)?;
    let ledger = run
        .ledger()
        .ok_or(VerifyError::Numerics { what: "the ledger", detail: "the backend keeps none".to_owned() })?;
    // Counted anew from the fields, so that the ledger's own sums are checked too.
    let fields = run.fields();
    let counted = fields.fill.iter().zip(&fields.density).fold(0.0, |sum, (fill, rho)| sum + fill * rho);
    let residual = (counted + ledger.parked + ledger.outflow - ledger.initial_mass) / ledger.initial_mass;
    Ok(Sample::absolute(steps, residual, 0.0)
        .with("ledger's own residual [-]", ledger.mass_residual)
        .with("mass parked over mass [-]", ledger.parked / ledger.initial_mass)
        .with("conversions [-]", ledger.conversions as f64)
        .with(
            "momentum residual over weight times steps [-]",
            ledger.momentum_residual / ledger.from_force[2].abs(),
        )
        .with("largest speed [lattice units]", run.fingerprint().max_speed))
}

/// Mass over a long run.
pub const MASS: Claim = Claim {
    id: "slump-mass",
    title: "A slump neither gains nor loses mass.",
    tags: &["F1", "F5", "F6"],
    measures: "mass counted from fill and density, with parked mass and outflow, less the initial one, over the initial one",
    reference: Reference { source: "conservation of mass", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "steps",
        short: &[1000.0, 5000.0],
        full: &[1000.0, 5000.0, 20_000.0, 100_000.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 1e-12,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "each step rounds the masses of some 400 cells: 1e5 steps of random rounding, \
                  1e-16 x (1e5)^1/2, leave 3e-14; a drift of one rounding a step would leave 1e-11",
    },
    kind: Kind::Verification,
    measure: mass,
};
