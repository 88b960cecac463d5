//! Free spheres: any density, neutral, turning in shear.

use std::f64::consts::PI;
use std::sync::Arc;

use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::claims::immersed::{
    MU, WALLS, exact, grains, immersed, limit, numerics, periodic, plain_suspension, sphere,
};
use crate::claims::settling::{TRT, array, over_places};
use crate::exact::suspension::{cubic_array, rotation};
use lahar::coupling::{CouplingEquations, GrainWall, StandardCoupling, Suspension};
use lahar::dem::{Clump, Grain, Orientation, Sphere, V3};
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, FreeSurface, Setup};
use lahar::solver::run::Backend;

fn density_ratio(backend: &dyn Backend, ratio: f64) -> Result<Sample, VerifyError> {
    let array = array(0.1, 12, GrainWall::CentralLinear);
    let k = array.falling(backend, ratio)?;
    Ok(Sample::relative(ratio, k, exact(cubic_array::drag(array.c))?))
}

/// Σ|u(t+1) − 2u(t) + u(t−1)| of the last tenth of a start from rest in a closed box over the largest speed.
fn rattle(backend: &dyn Backend, ratio: f64) -> Result<Sample, VerifyError> {
    let mut worst = 0.0_f64;
    let mut fastest = 0.0_f64;
    for (_, wall) in WALLS {
        let mut run = backend.start(&closed(ratio, 1e-5, wall))?;
        let mut speed = vec![0.0];
        for _ in 0..300 {
            run.advance(1)?;
            speed.push(immersed(run.as_ref())?.motion(0)[2]);
        }
        let bend: f64 = speed[270..].windows(3).map(|u| (u[2] - 2.0 * u[1] + u[0]).abs()).sum();
        fastest = speed.iter().fold(0.0_f64, |m, u| if u.abs() > m.abs() { *u } else { m });
        let share = bend / fastest.abs();
        worst = if share <= worst { worst } else { share };
    }
    let sinks = fastest * (1.0 - ratio) > 0.0;
    Ok(Sample::absolute(ratio, if sinks { worst } else { f64::NAN }, 0.0)
        .with("largest speed [cells per step]", fastest))
}

/// H8, no oscillation.
pub const RATTLE: Claim = Claim {
    id: "coupled-start-without-rattle",
    title: "Released from rest, spheres lighter and heavier than the fluid start the right way and do not rattle",
    tags: &["C6"],
    measures: "sum of |second differences| of the speed in the last tenth of 300 steps over the largest speed, D = 5 cells, closed box, \
               g = 1e-5, both kinds of surface; not a number if a sphere moves the wrong way",
    reference: Reference { source: "a speed that grows ever more slowly", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "density of the sphere over that of the fluid",
        short: &[0.5, 1.0001, 10.0],
        full: &[0.5, 0.9, 0.9999, 1.0001, 1.01, 2.0, 10.0, 100.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 4e-3,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "a speed that grows ever more slowly from zero rises by less than u/270 per step after 270 steps, and the sum of its second \
                  differences is at most that; an oscillation of one part in 1e4 from step to step would give 1e-2",
    },
    kind: Kind::Verification,
    measure: rattle,
};

/// A sphere of five cells across in a closed box of 14; weight of the fluid balanced by its pressure.
fn closed(ratio: f64, gravity: f64, wall: GrainWall) -> Setup {
    let mut ball = grains(ratio, vec![sphere(2.5, [7.12, 6.87, 7.29])]);
    ball.gravity = V3::new(0.0, 0.0, -gravity);
    let mut suspension = plain_suspension(ball, wall);
    suspension.pressure_gradient = [0.0, 0.0, gravity];
    let mut setup = Setup::periodic([14; 3], Law::Newtonian { mu: MU });
    setup.faces = [[Face::NoSlip; 2]; 3];
    setup.grains = Some(Arc::new(suspension));
    setup
}

/// H8.
pub const DENSITY_RATIOS: Claim = Claim {
    id: "coupled-density-ratios",
    title: "Spheres of any density move with the same drag, light ones upwards",
    tags: &["C6"],
    measures: "drag K of a free sphere in a balanced periodic box, c = 0.1, R = 3.5 cells",
    reference: Reference {
        source: "Stokes flow in a simple cubic array, boundary integrals",
        uncertainty: 1e-9,
    },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "density of the sphere over that of the fluid",
        short: &[0.5, 0.9, 1.0001, 1.01, 2.0, 10.0],
        full: &[0.2, 0.5, 0.9, 0.99, 0.9999, 1.0001, 1.01, 1.1, 2.0, 10.0, 100.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 0.035,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "second order: 0.09 s/R^2 with s = 3.7 the sensitivity of K a to the radius, and the scatter of a single place",
    },
    kind: Kind::Verification,
    measure: density_ratio,
};

fn neutral(backend: &dyn Backend, gravity: f64) -> Result<Sample, VerifyError> {
    let mut worst = 0.0_f64;
    for (_, wall) in WALLS {
        let mut run = backend.start(&closed(1.0, gravity, wall))?;
        for _ in 0..10 {
            run.advance(50)?;
            let w = immersed(run.as_ref())?.motion(0);
            let speed = (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]).sqrt();
            worst = if speed <= worst { worst } else { speed };
        }
    }
    Ok(Sample::absolute(gravity, worst, 0.0))
}

/// Neutral.
pub const NEUTRAL: Claim = Claim {
    id: "neutral-sphere-at-rest",
    title: "A sphere as heavy as the fluid stays at rest",
    tags: &["C2", "C6"],
    measures: "largest speed in 500 steps, cells per step, closed box, both kinds of surface",
    reference: Reference { source: "hydrostatics", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "gravity", short: &[1e-4], full: &[1e-6, 1e-5, 1e-4, 1e-3] },
    order: None,
    tolerance: Tolerance {
        value: 1e-8,
        at: Rung::Every,
        basis: Basis::Reference,
        because: "HARD_CASES H8; rounding of weight less buoyancy (1e-16 of 65 g) over 500 steps gives 1e-16",
    },
    kind: Kind::Verification,
    measure: neutral,
};

fn pool(backend: &dyn Backend, gravity: f64) -> Result<Sample, VerifyError> {
    let mut ball = grains(1.0, vec![sphere(3.0, [8.12, 7.87, 7.29])]);
    ball.gravity = V3::new(0.0, 0.0, -gravity);
    let mut setup = periodic([16, 16, 18], plain_suspension(ball, GrainWall::HalfWay));
    if let Some(suspension) = setup.grains.as_mut().map(Arc::make_mut) {
        suspension.dem.period.0[2] = None;
    }
    setup.faces[2] = [Face::NoSlip; 2];
    setup.force = BodyForce::Constant([0.0, 0.0, -gravity]);
    let fill = (0..setup.cells()).map(|cell| (15.5 - setup.coordinates(cell)[2] as f64).clamp(0.0, 1.0));
    setup.free_surface = Some(FreeSurface::new(fill.collect()));
    let mut run = backend.start(&setup)?;
    run.advance(1000)?;
    let stokes = 2.0 / 9.0 * 9.0 * gravity / MU;
    Ok(Sample::absolute(gravity, immersed(run.as_ref())?.motion(0)[2] / stokes, 0.0))
}

/// Neutral in a pool.
pub const NEUTRAL_IN_POOL: Claim = Claim {
    id: "neutral-sphere-in-a-pool",
    title: "Under a free surface a sphere as heavy as the fluid hardly moves: buoyancy is that of its volume",
    tags: &["C2", "F3"],
    measures: "speed after 1000 steps over the Stokes speed by its full weight, R = 3 cells",
    reference: Reference { source: "hydrostatics", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "gravity", short: &[1e-5], full: &[1e-6, 1e-5, 1e-4] },
    order: None,
    tolerance: Tolerance {
        value: 2e-3,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the fluid at its depth is denser than 1 by 3 g h = 2.4e-4 at g = 1e-5 (2.4e-3 at 1e-4, the largest of the ladder, over \
                  which the confined drag is larger than Stokes')",
    },
    kind: Kind::Verification,
    measure: pool,
};

/// Moving walls normal to y around one grain: shear rate 2 `speed`/height.
pub fn sheared(
    grain: Grain,
    clumps: Vec<Clump>,
    cells: usize,
    speed: f64,
    equations: impl CouplingEquations + Copy + 'static,
) -> Setup {
    let mut suspension = Suspension {
        equations: Arc::new(equations),
        ..plain_suspension(grains(1.0, vec![grain]), GrainWall::CentralLinear)
    };
    suspension.dem.clumps = clumps;
    let mut setup = periodic([cells; 3], suspension);
    if let Some(suspension) = setup.grains.as_mut().map(Arc::make_mut) {
        suspension.dem.period.0[1] = None;
    }
    setup.fluids = vec![Law::Newtonian { mu: 0.5 }];
    setup.collision = TRT;
    setup.faces[1] = [Face::Moving([-speed, 0.0, 0.0]), Face::Moving([speed, 0.0, 0.0])];
    let h = cells as f64;
    setup.initial = Some(Arc::new(move |[_, j, _]| {
        let mut gradient = [[0.0; 3]; 3];
        gradient[0][1] = 2.0 * speed / h;
        let velocity = [speed * (2.0 * (j as f64 + 0.5) / h - 1.0), 0.0, 0.0];
        lahar::setup::FlowPoint { density: 1.0, velocity, gradient }
    }));
    setup
}

/// −ω_z over the shear rate.
fn spin(backend: &dyn Backend, setup: &Setup, rate: f64) -> Result<f64, VerifyError> {
    let mut run = backend.start(setup)?;
    run.advance(40)?;
    limit(run.as_mut(), (20, 2e-4, 1500), &|run| Ok(-immersed(run)?.motion(0)[5] / rate))
}

/// Cells across and a centre at a place, for a body of this radius: walls ten radii apart.
pub fn middle(radius: f64, place: [f64; 3]) -> (usize, [f64; 3]) {
    let cells = (10.0 * radius).round() as usize;
    (cells, place.map(|d| (cells / 2) as f64 + d))
}

const SHEAR_SPEED: f64 = 1e-4;

/// Spin of a sphere in shear. `equations`: of the coupling.
pub fn sphere_spin(
    backend: &dyn Backend,
    radius: f64,
    equations: impl CouplingEquations + Copy + 'static,
) -> Result<Sample, VerifyError> {
    let (mean, scatter) = over_places(|place| {
        let (cells, centre) = middle(radius, place);
        let setup = sheared(sphere(radius, centre), Vec::new(), cells, SHEAR_SPEED, equations);
        spin(backend, &setup, 2.0 * SHEAR_SPEED / cells as f64)
    })?;
    Ok(Sample::relative(radius, mean, rotation::SPHERE_SPIN).with("largest deviation of a place", scatter))
}

/// Spin.
pub const SPHERE_SPIN: Claim = Claim {
    id: "sphere-spin-in-shear",
    title: "A free sphere in shear turns with half the shear rate",
    tags: &["C1", "C2", "004 Eq 3.38"],
    measures: "spin over shear rate, walls 10 R apart, interpolated surface, TRT 3/16, Re = 1e-4; mean over \
               three places",
    reference: Reference { source: "Stokes flow: half the vorticity", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "R (cells)", short: &[2.0], full: &[2.0, 2.5, 3.0, 4.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.045,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "images of the sphere's stresslet in walls and periodic sides: (R/5R)^3 = 0.008; a surface that is off by 0.12/R cells \
                  here and there: 0.15/R^2 = 0.037 at R = 2",
    },
    kind: Kind::Verification,
    measure: |backend, radius| sphere_spin(backend, radius, StandardCoupling),
};

/// Ratio r of the effective aspect from the spins of a touching pair along the flow and along the gradient.
fn pair_aspect(backend: &dyn Backend, radius: f64) -> Result<Sample, VerifyError> {
    let ball = |x: f64| Sphere { centre: V3::new(x, 0.0, 0.0), radius };
    let clump = Clump::new("pair", &[ball(-radius), ball(radius)])?;
    let equivalent = clump.equivalent_radius();
    let at = |angle: f64| {
        over_places(|place| {
            let (cells, centre) = middle(radius, place);
            let turn = Orientation::from_axis_angle(&nalgebra::Vector3::z_axis(), angle) * clump.frame;
            let grain = Grain::clump(0, equivalent, V3::from(centre), turn, 0);
            let setup = sheared(grain, vec![clump.clone()], cells, SHEAR_SPEED, StandardCoupling);
            spin(backend, &setup, 2.0 * SHEAR_SPEED / cells as f64)
        })
    };
    let ((along, first), (across, second)) = (at(0.0)?, at(0.5 * PI)?);
    if !(along > 0.0 && across > along) {
        return Err(numerics("pair in shear", format!("spins {along:e} and {across:e}")));
    }
    // γ̇/(1 + r²) along the flow, γ̇ r²/(1 + r²) along the gradient.
    Ok(Sample::relative(radius, (across / along).sqrt(), exact(rotation::chain(2, 2.0))?)
        .with("sum of the two spins over the shear rate", along + across)
        .with("largest deviation of a place", first.max(second)))
}

/// Jeffery.
pub const PAIR: Claim = Claim {
    id: "pair-effective-aspect-ratio",
    title: "A rigid pair of touching spheres turns in shear like an ellipsoid of aspect ratio 1.98",
    tags: &["C1", "C2", "D4"],
    measures: "square root of the ratio of its spins along the gradient and along the flow (Jeffery's orbit), walls 10 R apart; mean over \
               three places",
    reference: Reference { source: "rings of fundamental solutions; Nir & Acrivos 1973", uncertainty: 5e-5 },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "R (cells)", short: &[2.0], full: &[2.0, 2.5, 3.0, 4.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.05,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "the slow spin is the difference of two nearly equal torques, four times as sensitive as the fast one: twice 0.09/R^2 = 0.045 \
                  for the ratio's root at R = 2, and the images of a body 4 R long in a box of 10 R: (2/5)^3/8 = 0.008",
    },
    kind: Kind::Verification,
    measure: pair_aspect,
};
