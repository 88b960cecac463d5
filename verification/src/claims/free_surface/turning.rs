//! Turning solids made of stairs below a free surface: mass, and the paraboloid of a bucket.

use super::support::{level, speed, tank};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::rheology::Law;
use lahar::setup::{Setup, SolidMotion};
use lahar::solver::run::{Backend, Run};

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

fn ledger_of(run: &dyn Run) -> lahar::solver::run::Ledger {
    super::support::ledger(run)
}

fn roller_mass(backend: &dyn Backend, turns: f64) -> Result<Sample, VerifyError> {
    let mut run = backend.start(&roller())?;
    run.advance((turns * std::f64::consts::TAU / 0.005) as u64)?;
    let end = ledger_of(run.as_ref());
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

/// Rate of the bucket, radians per step; gravity lifts the fluid by a quarter of the radius.
fn bucket(radius: f64) -> (Setup, f64, f64) {
    let cells = 2 * radius as usize + 2;
    let height = radius as usize;
    let spin = 0.04 / radius;
    let gravity = 2.0 * spin * spin * radius;
    let depth = 0.5 * radius + 0.37;
    let centre = [0.5 * cells as f64, 0.5 * cells as f64, 0.0];
    let mud = tank([cells, cells, height], Law::Newtonian { mu: 0.15 }, gravity, |[_, _, k]| level(depth, k));
    // A floor of one cell turns with the wall.
    let inside = |at: [f64; 3]| at[2] < 1.0 || libm::hypot(at[0] - centre[0], at[1] - centre[1]) > radius;
    let motion = SolidMotion { spin: [0.0, 0.0, spin], centre, ..SolidMotion::default() };
    (with_turning(mud, inside, motion), spin, gravity)
}

fn paraboloid(backend: &dyn Backend, radius: f64) -> Result<Sample, VerifyError> {
    let (setup, spin, gravity) = bucket(radius);
    let mut run = backend.start(&setup)?;
    // The slowest mode of the spin-up decays as exp(−(j₁₁/R)² ν t), or faster through the floor.
    let steps = 12.0 * radius * radius / (14.68 * 0.15);
    run.advance(steps as u64)?;
    let fill = run.fields().fill;
    let [nx, ny, nz] = setup.extents;
    let depth = |i: usize, j: usize| (0..nz).map(|k| fill[setup.index([i, j, k])]).sum::<f64>();
    let (mut square, mut sum, mut cross, mut mean, mut count) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (i, j) in (0..ny).flat_map(|j| (0..nx).map(move |i| (i, j))) {
        let [x, y] = [i, j].map(|at| at as f64 + 0.5 - 0.5 * nx as f64);
        let r2 = x * x + y * y;
        if r2 < (radius - 1.0) * (radius - 1.0) {
            let h = depth(i, j);
            (square, sum, cross, mean, count) = (square + r2 * r2, sum + r2, cross + r2 * h, mean + h, count + 1.0);
        }
    }
    // Least squares of depth against r².
    let slope = (count * cross - sum * mean) / (count * square - sum * sum);
    let end = ledger_of(run.as_ref());
    Ok(Sample::relative(radius, slope, spin * spin / (2.0 * gravity))
        .with("mass residual", end.mass_residual)
        .with("conversions", end.conversions as f64)
        .with("largest speed/rim", speed(run.as_ref()) / (spin * radius)))
}

/// The surface of a turning bucket.
pub const BUCKET: Claim = Claim {
    id: "bucket-paraboloid",
    title: "The surface of a fluid in a turning bucket is Newton's paraboloid",
    tags: &["B1", "F1", "F3"],
    measures: "relative error of the slope of the depth against r², by least squares over all columns but the outermost; \
               bucket with a turning floor, rim 0.04, rise R/4",
    reference: Reference { source: "h = h₀ + Ω²r²/(2g)", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "R (cells)", short: &[8.0, 12.0], full: &[8.0, 12.0, 16.0, 24.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.02,
        at: Rung::At(12.0),
        basis: Basis::Reference,
        because: "2 % at 12 cells was asked for before anything was measured",
    },
    kind: Kind::Verification,
    measure: paraboloid,
};
