//! Grains and a free surface: books, floating, sinking, resting on the bed.

use std::sync::Arc;

use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::claims::free_surface::support::tank;
use crate::claims::immersed::{UNITS, grains, immersed, numerics, periodic, sphere, volume};
use lahar::coupling::{CouplingEquations, GrainWall, StandardCoupling, Suspension};
use lahar::dem::packing::Random;
use lahar::dem::{Grain, Surface, V3, Wall};
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, FreeSurface, Setup};
use lahar::solver::run::Backend;

/// A pool with walls below and above, periodic sides, filled to `depth` cells where no grain is, and grains in it.
fn pool(extents: [usize; 3], depth: f64, gravity: f64, suspension: Suspension) -> Setup {
    let mut setup = periodic(extents, suspension);
    if let Some(suspension) = setup.grains.as_mut().map(Arc::make_mut) {
        suspension.dem.period.0[2] = None;
        suspension.dem.gravity = V3::new(0.0, 0.0, -gravity);
        let floor = Surface::Plane { point: V3::zeros(), normal: V3::z() };
        suspension.dem.walls = vec![Wall::fixed("floor", floor, 0)];
    }
    setup.faces[2] = [Face::NoSlip; 2];
    setup.force = BodyForce::Constant([0.0, 0.0, -gravity]);
    let fill = (0..setup.cells()).map(|cell| (depth - setup.coordinates(cell)[2] as f64).clamp(0.0, 1.0));
    setup.free_surface = Some(FreeSurface::new(fill.collect()));
    setup
}

/// Grains that stir: moving and turning in all directions, of two densities.
fn stirring(count: usize, [nx, ny]: [f64; 2], depth: f64, radius: f64) -> Result<Vec<Grain>, VerifyError> {
    let mut random = Random::new(11);
    let mut placed: Vec<[f64; 3]> = Vec::new();
    for _ in 0..1_000_000 {
        let low = radius + 0.5;
        let x = [nx * random.unit(), ny * random.unit(), low + (depth - 2.0 * low) * random.unit()];
        let free = placed.iter().all(|y| {
            let wrap = |d: f64, n: f64| d - n * (d / n).round();
            let d = [wrap(x[0] - y[0], nx), wrap(x[1] - y[1], ny), x[2] - y[2]];
            d.iter().map(|d| d * d).sum::<f64>() > 4.0 * (radius + 0.1) * (radius + 0.1)
        });
        if free {
            placed.push(x);
        }
        if placed.len() == count {
            break;
        }
    }
    if placed.len() < count {
        return Err(numerics("pool", "no room for the grains"));
    }
    let mut vector = |size: f64| {
        let mut one = || size * (2.0 * random.unit() - 1.0);
        V3::new(one(), one(), one())
    };
    Ok(placed.into_iter().map(|x| sphere(radius, x).moving(vector(0.03)).spinning(vector(0.01))).collect())
}

/// What the books say after a while: residuals of mass and momentum, and the largest rise of the energy.
pub fn books(
    backend: &dyn Backend,
    count: f64,
    steps: u64,
    equations: impl CouplingEquations + Copy + 'static,
) -> Result<[f64; 4], VerifyError> {
    let many = count > 50.0;
    // 1e5 steps of 200 grains in ten minutes of one thread: grains of 1.6 cells, a fifth of the volume.
    let (extents, radius) = if many { ([32, 32, 24], 1.6) } else { ([20, 20, 20], 2.2) };
    let depth = extents[2] as f64 * 0.7 + 0.3;
    let gravity = 2e-5;
    let sides = [extents[0] as f64, extents[1] as f64];
    let mut dem = grains(1.5, stirring(count as usize, sides, depth, radius)?);
    dem.materials.list[0].young_pa = 0.1;
    let suspension = Suspension {
        wall: GrainWall::HalfWay,
        sub_steps: 10,
        equations: Arc::new(equations),
        ..Suspension::new(dem, UNITS)
    };
    let mut run = backend.start(&pool(extents, depth, gravity, suspension))?;
    let energy = |run: &dyn lahar::solver::run::Run| -> Result<f64, VerifyError> {
        let grains = immersed(run)?;
        let own = grains.totals().kinetic_energy;
        // Weight of the grains less that of the fluid they displace; the fluid's own level hardly moves.
        let potential: f64 = (0..grains.grains())
            .map(|i| (grains.mass(i) - grains.volume(i)) * gravity * grains.centre(i)[2])
            .sum();
        Ok(own + run.totals().kinetic_energy + potential)
    };
    let start = energy(run.as_ref())?;
    let mut last = start;
    let mut rise = 0.0_f64;
    let pause = (steps / 10).max(1);
    for _ in 0..10 {
        run.advance(pause)?;
        let now = energy(run.as_ref())?;
        rise = rise.max((now - last) / start.abs());
        last = now;
    }
    let ledger = run.ledger().ok_or_else(|| numerics("pool", "no ledger"))?;
    let impulse = run.fluid_cells() as f64 * gravity * steps as f64;
    Ok([ledger.mass_residual.abs(), ledger.momentum_residual / impulse, rise, (last - start) / start])
}

fn stir(backend: &dyn Backend, count: f64) -> Result<Sample, VerifyError> {
    ledgers(backend, count, StandardCoupling)
}

/// Residuals over their bounds. `equations`: of the coupling.
pub fn ledgers(
    backend: &dyn Backend,
    count: f64,
    equations: impl CouplingEquations + Copy + 'static,
) -> Result<Sample, VerifyError> {
    let steps = if count > 50.0 { 100_000 } else { 300 };
    let [mass, momentum, rise, change] = books(backend, count, steps, equations)?;
    let shares = [mass / 1e-12, momentum / 1e-9, rise / 1e-2];
    let worst = shares.iter().fold(0.0_f64, |m, s| if *s <= m { m } else { *s });
    Ok(Sample::absolute(count, worst, 0.0)
        .with("mass residual", mass)
        .with("momentum residual over the impulse of gravity", momentum)
        .with("largest rise of the energy in a tenth of the time", rise)
        .with("change of the energy", change))
}

/// Ledgers.
pub const BOOKS: Claim = Claim {
    id: "stirred-pool-books",
    title: "Grains stirring a pool with a free surface lose no mass and no momentum, and no energy appears",
    tags: &["C3", "F5"],
    measures: "largest of: mass residual/1e-12; momentum residual over the impulse of gravity/1e-9; rise of the energy (kinetic, and \
               potential of the grains in the fluid) in a tenth of the time over the whole/1e-2; 300 steps, with 200 grains 1e5",
    reference: Reference { source: "conservation of mass, momentum and energy", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "grains", short: &[10.0], full: &[10.0, 200.0] },
    order: None,
    tolerance: Tolerance {
        value: 1.0,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "sums of 1e4 numbers over 1e5 steps, kept compensated: 1e-12 at most; the momentum residual is absolute, a rounding of \
                  populations of 0.3 in 1e4 cells a step; the energy of waves that the surface makes is not counted, a hundredth",
    },
    kind: Kind::Verification,
    measure: stir,
};

/// H13: a dam break of 64 × 8 × 32 cells over and with 20 spheres, ten in the column and ten on the floor before it.
fn dam_break(backend: &dyn Backend, steps: f64) -> Result<Sample, VerifyError> {
    let (extents, gravity) = ([64, 8, 32], 2e-5);
    let column = |[i, _, k]: [usize; 3]| if i < 20 && k < 24 { 1.0 } else { 0.0 };
    let mut setup = tank(extents, Law::Newtonian { mu: 0.05 }, gravity, column);
    setup.faces[1] = [Face::Periodic; 2];
    // No two are placed alike relative to the grid.
    let spheres = (0..20).map(|k| {
        let (row, shift) = ((k / 2) % 5, 0.037 * k as f64);
        let y = if k % 2 == 0 { 2.0 } else { 6.0 } + shift;
        let inside = k < 10;
        let [x, z] = if inside {
            [2.5 + 3.7 * row as f64, 6.0 + 3.0 * row as f64]
        } else {
            [26.0 + 6.0 * row as f64, 1.8]
        };
        sphere(1.8, [x + shift, y, z])
    });
    let mut dem = grains(1.5, spheres.collect());
    dem.materials.list[0].young_pa = 0.1;
    dem.period.0[1] = Some(extents[1] as f64);
    dem.gravity = V3::new(0.0, 0.0, -gravity);
    let wall = |name: &str, axis: usize, side: f64| {
        let normal = V3::ith(axis, side);
        let point = if side > 0.0 { V3::zeros() } else { V3::ith(axis, extents[axis] as f64) };
        Wall::fixed(name, Surface::Plane { point, normal }, 0)
    };
    dem.walls =
        vec![wall("floor", 2, 1.0), wall("lid", 2, -1.0), wall("back", 0, 1.0), wall("front", 0, -1.0)];
    setup.grains = Some(Arc::new(Suspension { sub_steps: 10, ..Suspension::new(dem, UNITS) }));
    let mut run = backend.start(&setup)?;
    let mut fastest = 0.0_f64;
    for _ in 0..10 {
        run.advance((steps / 10.0) as u64)?;
        let grains = immersed(run.as_ref())?;
        let speed = |grain| grains.motion(grain)[..3].iter().map(|u| u * u).sum::<f64>().sqrt();
        fastest = (0..grains.grains()).map(speed).fold(fastest, f64::max);
    }
    let ledger = run.ledger().ok_or_else(|| numerics("dam break", "no ledger"))?;
    Ok(Sample::absolute(steps, ledger.mass_residual, 0.0)
        .with("conversions", ledger.conversions as f64)
        .with("fastest grain (cells per step)", fastest))
}

/// H13 with grains.
pub const DAM_BREAK: Claim = Claim {
    id: "dam-break-mass-with-grains",
    title: "A dam break that carries twenty spheres away keeps its mass to rounding",
    tags: &["C3", "F5"],
    measures: "mass + what grains have taken − initial mass, over the initial mass; 64 × 8 × 32 cells, Newtonian, τ = 0.65, spheres of 1.8 \
               cells and 1.5 times the density",
    reference: Reference { source: "conservation of mass", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "steps", short: &[500.0], full: &[500.0, 5000.0, 50_000.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-12,
        at: Rung::Every,
        basis: Basis::Reference,
        because: "HARD_CASES H13",
    },
    kind: Kind::Verification,
    measure: dam_break,
};

fn float(backend: &dyn Backend, radius: f64) -> Result<Sample, VerifyError> {
    let n = (5.0 * radius).round() as usize;
    let side = n as f64;
    let depth = 0.6 * side + 0.5;
    let gravity = 2e-4;
    let ball = sphere(radius, [0.5 * side + 0.12, 0.5 * side + 0.37, depth + 0.3 * radius]);
    let suspension = Suspension { lubrication: None, ..Suspension::new(grains(0.5, vec![ball]), UNITS) };
    let mut setup = pool([n, n, n], depth, gravity, suspension);
    setup.fluids = vec![lahar::rheology::Law::Newtonian { mu: 0.1 }];
    let mut run = backend.start(&setup)?;
    // Bobbing at √(1.5 g/R) is damped in a few periods.
    let period = 2.0 * std::f64::consts::PI / (1.5 * gravity / radius).sqrt();
    run.advance((4.0 * period) as u64)?;
    let mut share = 0.0;
    for _ in 0..16 {
        run.advance((period / 16.0) as u64)?;
        share += submerged(run.as_ref(), radius)? / 16.0;
    }
    let mass = run.ledger().map_or(f64::NAN, |l| l.mass_residual.abs());
    Ok(Sample::absolute(radius, share, 0.5).with("mass residual", mass))
}

/// Share of the sphere below the level of the pool: mean height of the fluid columns two radii and more from its axis.
fn submerged(run: &dyn lahar::solver::run::Run, radius: f64) -> Result<f64, VerifyError> {
    let centre = immersed(run)?.centre(0);
    let fields = run.fields();
    let [nx, ny, nz] = run.setup().extents;
    let wrap = |d: f64, n: usize| d - n as f64 * (d / n as f64).round();
    let (mut level, mut columns) = (0.0, 0.0);
    for i in 0..nx {
        for j in 0..ny {
            let d = [wrap(i as f64 + 0.5 - centre[0], nx), wrap(j as f64 + 0.5 - centre[1], ny)];
            if d[0] * d[0] + d[1] * d[1] > 4.0 * radius * radius {
                level += (0..nz).map(|k| fields.fill[run.setup().index([i, j, k])]).sum::<f64>();
                columns += 1.0;
            }
        }
    }
    let eta = ((level / columns - (centre[2] - radius)) / radius).clamp(0.0, 2.0);
    Ok(0.25 * eta * eta * (3.0 - eta))
}

/// Floating.
pub const FLOATING: Claim = Claim {
    id: "floating-sphere",
    title: "A sphere half as heavy as the fluid floats with half its volume under the surface",
    tags: &["C2", "C3", "F3"],
    measures: "share of the volume below the level of the pool, mean over one period of bobbing after four",
    reference: Reference { source: "Archimedes", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "R (cells)", short: &[3.2], full: &[3.2, 4.4, 6.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.12,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "half a cell of height, the grid's resolution of the water line: 0.75 (0.5/R) of the volume at R = 3.2",
    },
    kind: Kind::Verification,
    measure: float,
};

fn sink(backend: &dyn Backend, ratio: f64) -> Result<Sample, VerifyError> {
    let (radius, gravity, depth) = (3.0, 2e-4, 16.4);
    let ball = sphere(radius, [8.12, 8.37, depth + radius + 1.0]);
    let mut dem = grains(ratio, vec![ball]);
    dem.materials.list[0].young_pa = 0.1;
    let suspension = Suspension { sub_steps: 10, ..Suspension::new(dem, UNITS) };
    let mut setup = pool([16, 16, 28], depth, gravity, suspension);
    setup.fluids = vec![lahar::rheology::Law::Newtonian { mu: 0.02 }];
    let mut run = backend.start(&setup)?;
    let before = run.ledger().map_or(f64::NAN, |l| l.mass);
    let mut steps = 0;
    while immersed(run.as_ref())?.centre(0)[2] > depth - 1.5 * radius && steps < 4000 {
        run.advance(50)?;
        steps += 50;
    }
    run.advance(200)?;
    let covered = immersed(run.as_ref())?.centre(0)[2] < depth - 1.5 * radius;
    let ledger = run.ledger().ok_or_else(|| numerics("pool", "no ledger"))?;
    let change = (ledger.mass - before) / before;
    let shares =
        [ledger.mass_residual.abs() / 1e-12, change.abs() / 5e-3, if covered { 0.0 } else { f64::NAN }];
    let worst = shares.iter().fold(0.0_f64, |m, s| if *s <= m { m } else { *s });
    Ok(Sample::absolute(ratio, worst, 0.0)
        .with("mass residual", ledger.mass_residual.abs())
        .with("change of the mass of the fluid", change)
        .with("steps", f64::from(steps)))
}

/// Sinking.
pub const SINKING: Claim = Claim {
    id: "sinking-through-the-surface",
    title: "A heavy sphere falls through the surface into the pool and takes no fluid with it",
    tags: &["C3", "F5"],
    measures: "largest of: mass residual/1e-12; change of the mass of the fluid/5e-3; not a number if it does not sink",
    reference: Reference { source: "conservation of mass", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "relative density", short: &[2.0], full: &[1.5, 2.0, 4.0] },
    order: None,
    tolerance: Tolerance {
        value: 1.0,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "the ledger closes to rounding; what the grain owes the fluid is of the order of a layer of cells of its wet surface with \
                  the difference of density there, 3 g h = 1e-2, and the layer that a half-covered cell hides: 113 cells of 4198 times \
                  a fifth",
    },
    kind: Kind::Verification,
    measure: sink,
};

fn bed(backend: &dyn Backend, ratio: f64) -> Result<Sample, VerifyError> {
    let (radius, gravity, depth) = (3.0, 1e-4, 10.4);
    let mut dem = grains(ratio, vec![sphere(radius, [7.12, 7.37, radius])]);
    // Stiff: the overlap is a hundredth of a cell, and the sphere need not sink for it.
    dem.materials.list[0].young_pa = 10.0;
    let suspension = Suspension { sub_steps: 50, lubrication: None, ..Suspension::new(dem, UNITS) };
    let mut run = backend.start(&pool([14, 14, 14], depth, gravity, suspension))?;
    run.advance(1500)?;
    let (mut contact, mut held) = (0.0, 0.0);
    for _ in 0..200 {
        run.advance(1)?;
        let grains = immersed(run.as_ref())?;
        contact += grains.contact_loads()[0][2] / 200.0;
        held += grains.loads()[0].held[2] / 200.0;
    }
    let weight = volume(radius) * gravity;
    Ok(Sample::absolute(ratio, contact / weight, ratio - 1.0)
        .with("pressure in the gap over the weight of the fluid displaced", held / weight))
}

/// On the bed.
pub const BED: Claim = Claim {
    id: "grain-on-the-bed-weighs-less",
    title: "A sphere lying on the bed of a pool presses on it with its weight less its buoyancy",
    tags: &["C2", "C5"],
    measures: "force of the contact over the weight of the fluid displaced, R = 3 cells, mean over 200 steps",
    reference: Reference { source: "Archimedes", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "relative density", short: &[2.0], full: &[1.5, 2.0, 4.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.02,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "the pressure is continued into the gap as a linear function, exact at rest; the density of the fluid rises by 3 g h = 4e-3, \
                  and slow motion is left after 1500 steps",
    },
    kind: Kind::Verification,
    measure: bed,
};
