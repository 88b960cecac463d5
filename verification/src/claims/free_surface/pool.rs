//! Pools with a level surface: rest, hydrostatic pressure, no flicker.

use super::support::{ledger, level, speed, tank};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::rheology::Law;
use lahar::setup::Setup;
use lahar::solver::run::{Backend, Run};

/// τ = 0.51, 0.8, 1.5 and a Bingham fluid, each with its gravity.
const FLUIDS: [(&str, Law, f64); 4] = [
    ("tau 0.51", Law::Newtonian { mu: 0.01 / 3.0 }, 1e-5),
    ("tau 0.8", Law::Newtonian { mu: 0.1 }, 1e-4),
    ("tau 1.5", Law::Newtonian { mu: 1.0 / 3.0 }, 3e-5),
    ("Bingham", Law::Bingham { sigma0: 1e-5, mu: 0.05 }, 1e-4),
];

const DEPTH: usize = 5;

fn pool(law: Law, gravity: f64, fill: f64) -> Setup {
    tank([4, 1, DEPTH + 3], law, gravity, |[_, _, k]| level(DEPTH as f64 + fill, k))
}

const STEPS: u64 = 10_000;

fn rest(backend: &dyn Backend, fill: f64) -> Result<Sample, VerifyError> {
    let mut worst = 0.0_f64;
    let mut conversions = 0;
    for (_, law, gravity) in FLUIDS {
        let mut run = backend.start(&pool(law, gravity, fill))?;
        for _ in 0..4 {
            run.advance(STEPS / 4)?;
            let speed = speed(run.as_ref());
            worst = if speed <= worst { worst } else { speed };
        }
        conversions += ledger(run.as_ref()).conversions;
    }
    Ok(Sample::absolute(fill, worst, 0.0).with("conversions", conversions as f64))
}

/// Rest.
pub const REST: Claim = Claim {
    id: "pool-at-rest",
    title: "A pool with a level surface between walls stays at rest at any fill level",
    tags: &["F2", "F3", "F4"],
    measures: "largest speed over 1e4 steps, tau 0.51, 0.8, 1.5 and Bingham, g = 1e-5 to 1e-4, cells per step",
    reference: Reference { source: "hydrostatics", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "fill of the surface cells",
        short: &[0.0, 1e-3, 0.25, 0.5, 0.75, 0.999, 1.0],
        full: &[0.0, 1e-3, 0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9, 0.999, 1.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 1e-12,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding of populations near 0.3 (5e-17) times 1e4 steps if it all added up",
    },
    kind: Kind::Verification,
    measure: rest,
};

/// Largest |slope/F − 1| of the pressure over pairs of liquid cells.
fn slope(run: &dyn Run, gravity: f64) -> f64 {
    let fields = run.fields();
    let layer = 4;
    let mut worst = 0.0_f64;
    for cell in 0..layer * (DEPTH - 1) {
        let slope = (fields.density[cell] - fields.density[cell + layer]) / 3.0;
        let error = (slope / gravity - 1.0).abs();
        worst = if error <= worst { worst } else { error };
    }
    worst
}

fn pressure(backend: &dyn Backend, fill: f64) -> Result<Sample, VerifyError> {
    let mut worst = 0.0_f64;
    for (_, law, gravity) in FLUIDS {
        let mut run = backend.start(&pool(law, gravity, fill))?;
        run.advance(2000)?;
        let error = slope(run.as_ref(), gravity);
        worst = if error <= worst { worst } else { error };
    }
    Ok(Sample::absolute(fill, worst, 0.0))
}

/// Hydrostatic pressure.
pub const PRESSURE: Claim = Claim {
    id: "pool-pressure",
    title: "The pressure of a pool at rest rises by rho g per cell",
    tags: &["F2", "F3"],
    measures: "largest |Δp/(rho g Δz) − 1| over pairs of liquid cells after 2000 steps",
    reference: Reference { source: "hydrostatics with the constant force F", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "fill of the surface cells",
        short: &[0.0, 0.25, 0.5, 0.999],
        full: &[0.0, 1e-3, 0.25, 0.5, 0.75, 0.999, 1.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 1e-6,
        at: Rung::Every,
        basis: Basis::Reference,
        because: "HARD_CASES H12; rounding of rho − 1 would give 1e-10",
    },
    kind: Kind::Verification,
    measure: pressure,
};

fn flicker(backend: &dyn Backend, fill: f64) -> Result<Sample, VerifyError> {
    let height = 8.0 + fill;
    let setup = tank([16, 1, 16], Law::Newtonian { mu: 0.1 }, 0.0, |[_, _, k]| level(height, k));
    let mut run = backend.start(&setup)?;
    run.advance(2)?;
    let before = ledger(run.as_ref()).conversions;
    let mut fastest = 0.0_f64;
    for _ in 0..10 {
        run.advance(1000)?;
        let speed = speed(run.as_ref());
        fastest = if speed <= fastest { fastest } else { speed };
    }
    let end = ledger(run.as_ref());
    let conversions = (end.conversions - before) as f64;
    let shares = [conversions, fastest / 1e-12, end.mass_residual.abs() / 1e-13];
    let worst = shares.iter().fold(0.0_f64, |m, s| if *s <= m { m } else { *s });
    Ok(Sample::absolute(fill, worst, 0.0)
        .with("conversions after step 2", conversions)
        .with("largest speed", fastest)
        .with("mass drift", end.mass_residual.abs()))
}

/// H6.
pub const FLICKER: Claim = Claim {
    id: "flat-layer-without-flicker",
    title: "A level layer at any fill, without force, converts no cell, moves nothing and keeps its mass",
    tags: &["F1", "F4", "F6"],
    measures: "largest of: conversions after step 2; |u|/1e-12; mass drift/1e-13; 1e4 steps, 16 × 16 cells",
    reference: Reference { source: "rest", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "fill above 8 cells",
        short: &[-1e-3, 0.0, 1e-3, 0.5, 1.0],
        full: &[-1e-3, 0.0, 1e-3, 0.25, 0.5, 0.75, 0.999, 1.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 1.0,
        at: Rung::Every,
        basis: Basis::Reference,
        because: "HARD_CASES H6: less than one conversion, rounding for the rest (128 cells of mass 1 hold 3e-14)",
    },
    kind: Kind::Verification,
    measure: flicker,
};
