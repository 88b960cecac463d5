//! Loads of a fluid at rest on solids: Archimedes and the wall of a tank.

use super::support::{ledger, level, speed, tank};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use lahar::rheology::Law;
use lahar::setup::{Setup, SolidMotion};
use lahar::solver::run::{Backend, Run};

const GRAVITY: f64 = 1e-5;

/// Puts solids into a box: `body` is 0 for fluid, else the number of the solid.
pub(super) fn with_solids(mut setup: Setup, body: impl Fn([usize; 3]) -> u8) -> Setup {
    setup.solids = (0..setup.cells()).map(|cell| body(setup.coordinates(cell))).collect();
    let bodies = setup.solids.iter().copied().max().unwrap_or(0);
    setup.solid_motion = vec![SolidMotion::default(); usize::from(bodies)];
    setup.loads = true;
    setup
}

/// Load on the first solid.
fn force(run: &dyn Run) -> [f64; 3] {
    run.loads().first().map_or([f64::NAN; 3], |load| load.force)
}

/// A block of 3 × 4 × 3 cells under a surface at 9.3 cells.
fn archimedes(backend: &dyn Backend, steps: f64) -> Result<Sample, VerifyError> {
    let block =
        |[i, j, k]: [usize; 3]| u8::from((3..6).contains(&i) && (2..6).contains(&j) && (3..6).contains(&k));
    let pool = tank([9, 8, 12], Law::Newtonian { mu: 0.3 }, GRAVITY, |[_, _, k]| level(9.3, k));
    let mut run = backend.start(&with_solids(pool, block))?;
    run.advance(steps as u64)?;
    let lift = force(run.as_ref());
    let weight = 36.0 * GRAVITY;
    Ok(Sample::relative(steps, lift[2], weight)
        .with("sideways/weight", lift[0].abs().max(lift[1].abs()) / weight)
        .with("largest speed", speed(run.as_ref()))
        .with("momentum residual", ledger(run.as_ref()).momentum_residual))
}

/// Buoyancy.
pub const BUOYANCY: Claim = Claim {
    id: "block-buoyancy",
    title: "A submerged block at rest is lifted by the weight of the fluid it displaces",
    tags: &["C7", "F3"],
    measures: "vertical load on a block of 3 × 4 × 3 cells by momentum exchange, τ = 1.4",
    reference: Reference { source: "Archimedes: rho g V", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "steps", short: &[4000.0], full: &[4000.0, 20_000.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-5,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "the pressure under the block has to settle first (columns start from the gas above them): 3e-6 is left \
                  after 4000 steps, with speeds of 1e-9",
    },
    kind: Kind::Verification,
    measure: archimedes,
};

/// The end wall of a tank, which reaches below the floor, as the floor is another solid: the links into the
/// corner belong to the wall.
fn end_wall(backend: &dyn Backend, depth: f64) -> Result<Sample, VerifyError> {
    let cells = libm::ceil(depth) as usize + 3;
    let tank = tank([7, 1, cells], Law::Newtonian { mu: 0.3 }, GRAVITY, |[_, _, k]| level(depth + 1.0, k));
    let body = |[i, _, k]: [usize; 3]| match (i, k) {
        (6, _) => 1,
        (_, 0) => 2,
        _ => 0,
    };
    let mut run = backend.start(&with_solids(tank, body))?;
    run.advance(2000)?;
    let push = force(run.as_ref());
    let exact = 0.5 * GRAVITY * depth * depth;
    let fill = depth - libm::floor(depth);
    let wetted = run.loads().first().map_or(f64::NAN, |load| load.wetted[0][0]);
    Ok(Sample::relative(depth, push[0], exact)
        .with("excess over φ(1 − φ)/2 [rho g Δx²]", (push[0] - exact) / GRAVITY - 0.5 * fill * (1.0 - fill))
        .with("wetted area/depth", wetted / depth)
        .with("largest speed", speed(run.as_ref())))
}

/// Hydrostatic load on a wall.
pub const WALL: Claim = Claim {
    id: "wall-hydrostatic-load",
    title: "Fluid at rest pushes a vertical wall with rho g H²/2 per width, to second order",
    tags: &["C7", "F3"],
    measures: "horizontal load on the end wall of a tank by momentum exchange",
    reference: Reference { source: "rho g H²/2", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "H (cells)", short: &[4.5, 8.5, 16.5], full: &[4.5, 8.5, 16.5, 32.5] },
    order: Some(OrderBand { expected: 2.0, band: 0.1, at_least: false }),
    tolerance: Tolerance {
        value: 0.02,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the surface cell pushes over its whole face with the pressure of its middle: φ(1 − φ)/2 too much, \
                  1/(4H²) of the load at half fill, 1.2 % at 4.5 cells",
    },
    kind: Kind::Verification,
    measure: end_wall,
};
