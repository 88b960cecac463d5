//! Turning solids made of stairs below a free surface: what they keep of the mass.

use super::support::{ledger, level, speed, tank};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::rheology::Law;
use lahar::setup::{Setup, SolidMotion};
use lahar::solver::run::Backend;

/// Puts one turning solid into a tank.
fn with_turning(mut setup: Setup, inside: impl Fn([f64; 3]) -> bool, motion: SolidMotion) -> Setup {
    let solid = |cell| inside(setup.coordinates(cell).map(|x| x as f64 + 0.5));
    setup.solids = (0..setup.cells()).map(|cell| u8::from(solid(cell))).collect();
    setup.solid_motion = vec![motion];
    setup.loads = true;
    setup
}

/// A roller of six cells' radius, half in mud, whose rim moves by 0.03 cells per step.
fn roller() -> Setup {
    let mud = tank([40, 1, 20], Law::Newtonian { mu: 0.4 }, 1e-4, |[_, _, k]| level(10.3, k));
    let centre = [20.0, 0.5, 10.0];
    let inside = |at: [f64; 3]| libm::hypot(at[0] - centre[0], at[2] - centre[2]) < 6.0;
    with_turning(mud, inside, SolidMotion { spin: [0.0, 0.005, 0.0], centre, ..SolidMotion::default() })
}

fn roller_mass(backend: &dyn Backend, turns: f64) -> Result<Sample, VerifyError> {
    let mut run = backend.start(&roller())?;
    run.advance((turns * std::f64::consts::TAU / 0.005) as u64)?;
    let end = ledger(run.as_ref());
    Ok(Sample::absolute(turns, end.mass_residual, 0.0)
        .with("conversions", end.conversions as f64)
        .with("from walls/mass", end.from_walls / end.initial_mass)
        .with("momentum residual", end.momentum_residual)
        .with("largest speed", speed(run.as_ref())))
}

/// Mass of a roller's pool.
pub const ROLLER: Claim = Claim {
    id: "roller-mass",
    title: "A turning roller half in mud neither swallows nor makes any",
    tags: &["B1", "F5"],
    measures: "mass − initial mass, over the initial mass; roller of 6 cells' radius, its stairs wet on one half, τ = 1.7",
    reference: Reference { source: "conservation of mass", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "turns", short: &[1.0], full: &[1.0, 10.0, 80.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-12,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding: 1e-17 per link and step in either sense, of 40 links in 1e5 steps; links that take mass into \
                  the stairs and hand it to nobody lost 2 % in one and a half turns",
    },
    kind: Kind::Verification,
    measure: roller_mass,
};

/// A bucket, its rate in radians per step and gravity, which lifts the fluid by a quarter of the radius.
fn bucket(radius: f64) -> (Setup, f64, f64) {
    let cells = 2 * radius as usize + 2;
    let height = radius as usize;
    let spin = 0.04 / radius;
    let gravity = 2.0 * spin * spin * radius;
    let depth = 0.5 * radius + 0.37;
    let centre = [0.5 * cells as f64, 0.5 * cells as f64, 0.0];
    let mud = tank([cells, cells, height], Law::Newtonian { mu: 0.3 }, gravity, |[_, _, k]| level(depth, k));
    // A floor of one cell turns with the wall.
    let inside = |at: [f64; 3]| at[2] < 1.0 || libm::hypot(at[0] - centre[0], at[1] - centre[1]) > radius;
    let motion = SolidMotion { spin: [0.0, 0.0, spin], centre, ..SolidMotion::default() };
    (with_turning(mud, inside, motion), spin, gravity)
}

/// Slope of the depth against r² by least squares, over columns nearer than `reach` to the axis.
fn slope(setup: &Setup, fill: &[f64], reach: f64) -> f64 {
    let [nx, ny, nz] = setup.extents;
    let depth = |i: usize, j: usize| (0..nz).map(|k| fill[setup.index([i, j, k])]).sum::<f64>();
    let (mut square, mut sum, mut cross, mut mean, mut count) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (i, j) in (0..ny).flat_map(|j| (0..nx).map(move |i| (i, j))) {
        let [x, y] = [i, j].map(|at| at as f64 + 0.5 - 0.5 * nx as f64);
        let r2 = x * x + y * y;
        if r2 < reach * reach {
            let h = depth(i, j);
            (square, sum, cross, mean, count) =
                (square + r2 * r2, sum + r2, cross + r2 * h, mean + h, count + 1.0);
        }
    }
    (count * cross - sum * mean) / (count * square - sum * sum)
}

fn bucket_mass(backend: &dyn Backend, steps: f64) -> Result<Sample, VerifyError> {
    let radius = 8.0;
    let (setup, spin, gravity) = bucket(radius);
    let mut run = backend.start(&setup)?;
    run.advance(steps as u64)?;
    let end = ledger(run.as_ref());
    let exact = spin * spin / (2.0 * gravity);
    Ok(Sample::absolute(steps, end.mass_residual, 0.0)
        .with("slope of the paraboloid/exact", slope(&setup, &run.fields().fill, 0.75 * radius) / exact)
        .with("conversions", end.conversions as f64)
        .with("from walls/mass", end.from_walls / end.initial_mass)
        .with("largest speed/rim", speed(run.as_ref()) / (spin * radius)))
}

/// Mass in a turning bucket.
pub const BUCKET: Claim = Claim {
    id: "bucket-mass",
    title: "A turning bucket keeps its fluid",
    tags: &["B1", "F5"],
    measures: "mass − initial mass, over the initial mass; bucket of 8 cells' radius with a turning floor, rim 0.04, \
               τ = 1.4, whose fluid rises by R/4",
    reference: Reference { source: "conservation of mass", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "steps", short: &[4000.0], full: &[4000.0, 100_000.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-12,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding, as for `roller-mass`; links that take mass into the stairs and hand it to nobody lost 13 %",
    },
    kind: Kind::Verification,
    measure: bucket_mass,
};
