//! Ledgers of violent flows: dam break, outflow, random fluid.

use super::support::{Dice, ledger, tank};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::rheology::Law;
use lahar::setup::{Face, Setup};
use lahar::solver::run::{Backend, Ledger};

const WATERY: Law = Law::Newtonian { mu: 0.05 };

/// H13: 64 × 8 × 32 cells, a column of 20 × 24 at one end.
fn dam() -> Setup {
    let column = |[i, _, k]: [usize; 3]| if i < 20 && k < 24 { 1.0 } else { 0.0 };
    let mut setup = tank([64, 8, 32], WATERY, 2e-5, column);
    setup.faces[1] = [Face::Periodic; 2];
    setup
}

fn books(sample: Sample, ledger: &Ledger) -> Sample {
    sample
        .with("conversions", ledger.conversions as f64)
        .with("interface cells", ledger.interface_cells as f64)
        .with("parked/mass", ledger.parked / ledger.initial_mass)
}

fn mass(backend: &dyn Backend, steps: f64) -> Result<Sample, VerifyError> {
    let mut run = backend.start(&dam())?;
    run.advance(steps as u64)?;
    let end = ledger(run.as_ref());
    Ok(books(Sample::absolute(steps, end.mass_residual, 0.0), &end))
}

/// Mass.
pub const MASS: Claim = Claim {
    id: "dam-break-mass",
    title: "A dam break keeps its mass to rounding, without any correction",
    tags: &["F1", "F4", "F5", "000 Eq 11", "004 Eq 3.30", "004 Eq 3.31"],
    measures: "mass + outflow − initial mass, over the initial mass; 64 × 8 × 32 cells, Newtonian, τ = 0.65",
    reference: Reference { source: "conservation of mass", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "steps", short: &[500.0, 5000.0], full: &[500.0, 5000.0, 50_000.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-12,
        at: Rung::Every,
        basis: Basis::Reference,
        because: "HARD_CASES H13",
    },
    kind: Kind::Verification,
    measure: mass,
};

/// Residual of momentum over the sum of what came in, in absolute value.
fn momentum_share(end: &Ledger) -> f64 {
    let parts = [end.from_force, end.from_faces, end.from_solids, end.from_gas, end.from_conversions];
    end.momentum_residual / parts.iter().flatten().map(|p| p.abs()).sum::<f64>()
}

fn momentum(backend: &dyn Backend, steps: f64) -> Result<Sample, VerifyError> {
    let mut run = backend.start(&dam())?;
    run.advance(steps as u64)?;
    let end = ledger(run.as_ref());
    let part = |p: [f64; 3]| p.iter().map(|x| x.abs()).fold(0.0, f64::max);
    Ok(books(Sample::absolute(steps, momentum_share(&end), 0.0), &end)
        .with("from force", part(end.from_force))
        .with("from walls", part(end.from_faces))
        .with("from gas", part(end.from_gas))
        .with("from conversions", part(end.from_conversions)))
}

/// Momentum.
pub const MOMENTUM: Claim = Claim {
    id: "dam-break-momentum",
    title: "The momentum of a dam break is what force, walls, gas and conversions brought in",
    tags: &["F5", "C7"],
    measures: "largest component of momentum − Σ impulses, over the sum of the |impulses|",
    reference: Reference { source: "conservation of momentum", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "steps", short: &[500.0], full: &[500.0, 5000.0, 50_000.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-12,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding: 1e-16 of each of the populations, whose impulses of a step add up to some 1e3 times \
                  what they leave",
    },
    kind: Kind::Verification,
    measure: momentum,
};

/// A column that runs out through an open face.
fn outflow(backend: &dyn Backend, steps: f64) -> Result<Sample, VerifyError> {
    let column = |[i, _, k]: [usize; 3]| if i < 10 && k < 12 { 1.0 } else { 0.0 };
    let mut setup = tank([24, 1, 16], WATERY, 5e-5, column);
    setup.faces[0][1] = Face::Open;
    let mut run = backend.start(&setup)?;
    let (mut before, mut back) = (0.0, 0.0);
    while run.step() < steps as u64 {
        run.advance(20)?;
        let now = ledger(run.as_ref()).outflow;
        back = f64::max(back, before - now);
        before = now;
    }
    let end = ledger(run.as_ref());
    let error = end.mass_residual.abs() + back / end.initial_mass;
    Ok(books(Sample::absolute(steps, error, 0.0), &end)
        .with("left through the face/initial mass", end.outflow / end.initial_mass)
        .with("momentum residual/impulses", momentum_share(&end)))
}

/// Open face.
pub const OUTFLOW: Claim = Claim {
    id: "outflow-ledger",
    title: "What leaves through an open face is debited, and nothing comes back in",
    tags: &["F5"],
    measures: "(mass + outflow − initial mass)/initial mass, plus any decrease of the outflow over 20 steps",
    reference: Reference { source: "conservation of mass", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "steps", short: &[4000.0], full: &[4000.0, 40_000.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-12,
        at: Rung::Every,
        basis: Basis::Reference,
        because: "rounding, as HARD_CASES H13",
    },
    kind: Kind::Verification,
    measure: outflow,
};

/// A closed box in which every cell is liquid, gas or partly filled at random.
fn random(law: Law) -> Setup {
    let mut dice = Dice(20_240_917);
    let n = 8;
    let mut fills = vec![0.0; n * n * n];
    for fill in &mut fills {
        let (sort, part) = (dice.roll(), dice.roll());
        *fill = if sort < 0.35 {
            1.0
        } else if sort < 0.6 {
            part
        } else {
            0.0
        };
    }
    tank([n, n, n], law, 2e-5, |[i, j, k]| fills[i + n * (j + n * k)])
}

fn foam(backend: &dyn Backend, steps: f64) -> Result<Sample, VerifyError> {
    let mut run = backend.start(&random(WATERY))?;
    run.advance(steps as u64)?;
    let end = ledger(run.as_ref());
    let finite = run.fields().velocity.iter().flatten().all(|u| u.is_finite());
    let error = if finite { end.mass_residual.abs() } else { f64::NAN };
    Ok(books(Sample::absolute(steps, error, 0.0), &end))
}

/// Random fluid.
pub const FOAM: Claim = Claim {
    id: "random-bubbles-and-drops",
    title: "Bubbles, drops, threads and films at random collapse without a bad number and without loss of mass",
    tags: &["F4", "F5", "F6"],
    measures: "mass residual; 8³ cells, 35 % liquid, 25 % partly filled, the rest gas, each cell on its own",
    reference: Reference { source: "conservation of mass", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "steps", short: &[10_000.0], full: &[10_000.0, 100_000.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-12,
        at: Rung::Every,
        basis: Basis::Reference,
        because: "rounding, as HARD_CASES H13",
    },
    kind: Kind::Verification,
    measure: foam,
};
