//! Mass and momentum over whole steps, and the four operators the claims compare.

use std::sync::Arc;

use super::equilibrium::Sequence;
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::collision::{CollisionChoice, OddRate};
use lahar::rheology::Law;
use lahar::setup::{BodyForce, FlowPoint, Setup};
use lahar::solver::run::Backend;

/// The four operators, in the order of the ladders that run over them.
pub const OPERATORS: [CollisionChoice; 4] = [
    CollisionChoice::Bgk,
    CollisionChoice::Trt(OddRate::fixed(3.0 / 16.0)),
    CollisionChoice::CentralMoment(OddRate::STANDARD),
    CollisionChoice::Regularised,
];

/// The operator of a rung: 1 is the first.
pub fn operator(parameter: f64) -> Result<CollisionChoice, VerifyError> {
    OPERATORS
        .get((parameter as usize).wrapping_sub(1))
        .copied()
        .ok_or_else(|| VerifyError::Numerics { what: "operator", detail: format!("no operator {parameter}") })
}

const EXTENTS: [usize; 3] = [6, 5, 4];
const STEPS: u64 = 50;
const FORCE: [f64; 3] = [1e-4, -2e-4, 5e-5];

/// An arbitrary flow in a periodic box: densities within 2 %, velocities up to 0.05.
fn arbitrary_flow(collision: CollisionChoice) -> Setup {
    let mut setup = Setup::periodic(EXTENTS, Law::Newtonian { mu: 0.05 });
    setup.collision = collision;
    setup.force = BodyForce::Constant(FORCE);
    setup.initial = Some(Arc::new(|[i, j, k]| {
        let mut numbers = Sequence::new((i + 7 * j + 49 * k + 1) as u64);
        numbers.vector();
        FlowPoint {
            density: 1.0 + 0.04 * numbers.next(),
            velocity: numbers.vector().map(|v| 0.1 * v),
            gradient: [numbers.vector(), numbers.vector(), numbers.vector()].map(|row| row.map(|g| 0.01 * g)),
        }
    }));
    setup
}

fn measure(backend: &dyn Backend, parameter: f64) -> Result<Sample, VerifyError> {
    let setup = arbitrary_flow(operator(parameter)?);
    let cells = setup.cells() as f64;
    let mut run = backend.start(&setup)?;
    let before = run.totals();
    run.advance(STEPS)?;
    let after = run.totals();
    let mass = (after.mass_excess - before.mass_excess).abs() / cells;
    let momentum = (0..3)
        .map(|a| (after.momentum[a] - before.momentum[a]) / cells - FORCE[a] * STEPS as f64)
        .fold(0.0, |m: f64, d| if d.abs() <= m { m } else { d.abs() });
    let error = if mass <= momentum { momentum } else { mass };
    Ok(Sample::absolute(parameter, error, 0.0)
        .with("mass [1/cell]", mass)
        .with("momentum [1/cell]", momentum))
}

/// Mass and momentum.
pub const CONSERVATION: Claim = Claim {
    id: "conservation-collision",
    title: "Every collision keeps mass, and adds exactly the body force to the momentum",
    tags: &["L4", "L5", "K1", "K2", "K3", "K4", "004 Eq 3.28"],
    measures: "change of Σ(ρ − 1), and of Σρu minus F t, per cell after 50 steps of an arbitrary periodic flow",
    reference: Reference { source: "conservation laws", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "operator (1 BGK, 2 TRT, 3 central moment, 4 regularised)",
        short: &[1.0, 2.0, 3.0, 4.0],
        full: &[1.0, 2.0, 3.0, 4.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 50.0 * 30.0 * 0.5 * f64::EPSILON * 0.05,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding: 50 steps, each about 30 operations on sums of populations below 0.05",
    },
    kind: Kind::Verification,
    measure,
};
