//! Mirror images and mirror planes, to the last bit.

use super::support::tank;
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::rheology::Law;
use lahar::setup::{Face, Setup};
use lahar::solver::run::{Backend, Run};

const SLURRY: Law = Law::Bingham { sigma0: 2e-5, mu: 0.05 };

/// A block in the middle of a box that collapses to both sides; `half`: its right half.
fn collapse(half: bool) -> Setup {
    let (nx, from) = if half { (16, 16) } else { (32, 0) };
    let block = |[i, j, k]: [usize; 3]| {
        let x = i + from;
        if (11..21).contains(&x) && j < 5 && k < 9 { 1.0 } else { 0.0 }
    };
    let mut setup = tank([nx, 9, 14], SLURRY, 4e-5, block);
    if half {
        setup.faces[0][0] = Face::FreeSlip;
    }
    setup
}

/// Largest difference of fill and velocity between cell and partner; `partner` maps coordinates, x reversed if
/// `reversed`.
fn difference(a: &dyn Run, b: &dyn Run, reversed: bool, partner: impl Fn([usize; 3]) -> [usize; 3]) -> f64 {
    let (fa, fb) = (a.fields(), b.fields());
    let mut worst = 0.0_f64;
    for cell in 0..a.setup().cells() {
        let other = b.setup().index(partner(a.setup().coordinates(cell)));
        let sign = if reversed { -1.0 } else { 1.0 };
        let (u, v) = (fa.velocity[cell], fb.velocity[other]);
        let parts = [
            fa.fill[cell] - fb.fill[other],
            f64::from(fa.kind[cell]) - f64::from(fb.kind[other]),
            fa.density[cell] - fb.density[other],
            u[0] - sign * v[0],
            u[1] - v[1],
            u[2] - v[2],
        ];
        for part in parts {
            worst = if part.abs() <= worst { worst } else { part.abs() };
        }
    }
    worst
}

fn mirror(backend: &dyn Backend, steps: f64) -> Result<Sample, VerifyError> {
    let mut run = backend.start(&collapse(false))?;
    run.advance(steps as u64)?;
    let apart = difference(run.as_ref(), run.as_ref(), true, |[i, j, k]| [31 - i, j, k]);
    Ok(Sample::absolute(steps, apart, 0.0)
        .with("conversions", run.ledger().map_or(f64::NAN, |l| l.conversions as f64)))
}

fn halves(backend: &dyn Backend, steps: f64) -> Result<Sample, VerifyError> {
    let (mut whole, mut part) = (backend.start(&collapse(false))?, backend.start(&collapse(true))?);
    whole.advance(steps as u64)?;
    part.advance(steps as u64)?;
    let apart = difference(part.as_ref(), whole.as_ref(), false, |[i, j, k]| [i + 16, j, k]);
    Ok(Sample::absolute(steps, apart, 0.0)
        .with("conversions of the half", part.ledger().map_or(f64::NAN, |l| l.conversions as f64)))
}

const BITS: Tolerance = Tolerance {
    value: 0.0,
    at: Rung::Every,
    basis: Basis::Derived,
    because: "the mirrored cell does the same sums in the same order: equal to the last bit",
};

/// Mirror image.
pub const MIRROR: Claim = Claim {
    id: "collapse-mirror-symmetric",
    title: "A symmetric Bingham collapse stays symmetric to the last bit",
    tags: &["F1", "F4", "F6"],
    measures: "largest difference of fill, kind, density and velocity between a cell and its mirror image",
    reference: Reference { source: "symmetry", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "steps", short: &[1500.0], full: &[1500.0, 15_000.0] },
    order: None,
    tolerance: BITS,
    kind: Kind::Verification,
    measure: mirror,
};

/// Mirror plane.
pub const HALF: Claim = Claim {
    id: "collapse-half-geometry",
    title: "Half of a symmetric collapse with a mirror plane equals the whole to the last bit",
    tags: &["F1", "F4", "B2"],
    measures: "largest difference of fill, kind, density and velocity between the half and the whole",
    reference: Reference { source: "symmetry", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "steps", short: &[1500.0], full: &[1500.0, 15_000.0] },
    order: None,
    tolerance: BITS,
    kind: Kind::Verification,
    measure: halves,
};
