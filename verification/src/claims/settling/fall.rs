//! Falls that are compared with experiments: one sphere in a box, one behind another.

use std::sync::Arc;

use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::claims::immersed::{grains, immersed, numerics, sphere};
use crate::exact::suspension::ten_cate;
use lahar::coupling::{GrainWall, Suspension};
use lahar::dem::{self, V3};
use lahar::rheology::Law;
use lahar::setup::{Face, Setup};
use lahar::solver::run::Backend;
use lahar::units::Units;

/// A closed box of fluid with grains that fall along −z: the fluid is computed without its weight.
fn closed(extents: [usize; 3], mu: f64, mut suspension: Suspension) -> Setup {
    let gravity = suspension.dem.gravity.z;
    let units = suspension.units;
    // Buoyancy: −∇P of fluid at rest.
    suspension.pressure_gradient = [0.0, 0.0, -gravity * units.dt_s * units.dt_s / units.dx_m];
    let mut setup = Setup::periodic(extents, Law::Newtonian { mu });
    setup.faces = [[Face::NoSlip; 2]; 3];
    setup.grains = Some(Arc::new(suspension));
    // Down to tau = 0.51: the drag must not depend on the viscosity.
    setup.collision = super::TRT;
    setup
}

/// The run nearest to a Reynolds number, its sphere `across` cells wide.
fn oil(re: f64, across: f64) -> Result<(ten_cate::Run, Setup, f64), VerifyError> {
    let run = *ten_cate::RUNS
        .iter()
        .min_by(|a, b| (a.reynolds - re).abs().total_cmp(&(b.reynolds - re).abs()))
        .ok_or_else(|| numerics("ten Cate", "no runs"))?;
    let dx = ten_cate::DIAMETER_M / across;
    // 0.03 cells per step at the largest speed, but no more than tau = 1 (slow creeping runs).
    let nu = run.viscosity / run.fluid_density;
    let dt = (0.03 * dx / run.unbounded_speed).min(dx * dx / (6.0 * nu));
    let units = Units::new(dx, dt, run.fluid_density);
    let extents = ten_cate::BOX_M.map(|l| (l / dx).round() as usize);
    let [x, y, _] = extents.map(|n| 0.5 * n as f64 * dx);
    let centre = [x, y, ten_cate::START_GAP_M + 0.5 * ten_cate::DIAMETER_M];
    let mut balls = grains(ten_cate::SPHERE_DENSITY, vec![sphere(0.5 * ten_cate::DIAMETER_M, centre)]);
    balls.gravity = V3::new(0.0, 0.0, -9.81);
    balls.materials.list[0].young_pa = 1e4;
    balls.design_speed_m_s = run.unbounded_speed;
    let suspension = Suspension { wall: GrainWall::CentralLinear, ..Suspension::new(balls, units) };
    Ok((run, closed(extents, units.viscosity_to_lattice(run.viscosity), suspension), dx / dt))
}

fn largest_speed(backend: &dyn Backend, re: f64, across: f64) -> Result<Sample, VerifyError> {
    let (experiment, setup, unit) = oil(re, across)?;
    let mut run = backend.start(&setup)?;
    let (mut most, mut sum, mut count) = (0.0_f64, 0.0, 0.0);
    let mut means: Vec<f64> = Vec::new();
    let height = setup.extents[2] as f64;
    loop {
        // Mean over a tenth of a cell at full speed and more: the staircase does not count.
        run.advance(8)?;
        let grain = immersed(run.as_ref())?;
        let (u, z) = (-grain.motion(0)[2], grain.centre(0)[2]);
        sum += u;
        count += 1.0;
        if count == 5.0 {
            // Terminal: no growth by 0.1 % in two hundred steps.
            let before = means.len().checked_sub(5).map_or(0.0, |k| means[k]);
            means.push(sum / count);
            let slow = sum / count < 1.001 * before;
            most = most.max(sum / count);
            (sum, count) = (0.0, 0.0);
            if slow || z < 0.25 * height {
                break;
            }
        }
        if run.step() > 20_000 {
            return Err(numerics("fall", "the sphere does not reach the floor"));
        }
    }
    let reference = experiment.speed_ratio * experiment.unbounded_speed;
    Ok(Sample::relative(re, most * unit, reference)
        .with("simulated by ten Cate et al. [m/s]", experiment.simulated_ratio * experiment.unbounded_speed)
        .with("steps", run.step() as f64)
        .with("diameter [cells]", across))
}

/// ten Cate.
pub const TEN_CATE: Claim = Claim {
    id: "ten-cate-largest-speed",
    title: "A sphere of 4.2 cells across that falls in a box of silicone oil reaches the measured speed within 7 %",
    tags: &["C2", "C4", "C6"],
    measures: "largest speed, m/s, sphere 4.2 cells across in a box of 28 x 28 x 45 cells, interpolated surface, TRT 3/16",
    reference: Reference {
        source: "ten Cate et al. 2002, Tables I and II",
        uncertainty: ten_cate::UNCERTAINTY,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "Re", short: &[1.5], full: &[1.5, 4.1, 11.6, 31.9] },
    order: None,
    tolerance: Tolerance {
        value: 0.07,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "0.25/R^2 = 0.06 of the drag at R = 2.1 cells, and 1 % of the experiment",
    },
    kind: Kind::Validation,
    measure: |backend, re| largest_speed(backend, re, 4.2),
};

/// Time until a sphere touches the one that falls before it, t √(g'/D), and the speeds.
pub fn drafting(backend: &dyn Backend, across: f64) -> Result<Sample, VerifyError> {
    // Re about 20 at 0.08 cells per step.
    let (mu, density) = (0.08 * across / 20.0, 1.5);
    let drag = 2.7; // C_D near Re = 20.
    let gravity = 0.75 * drag * 0.08 * 0.08 / ((density - 1.0) * across);
    let extents = [(4.0 * across) as usize, (4.0 * across) as usize, (17.0 * across) as usize];
    let [x, y, z] = extents.map(|n| n as f64);
    let at = |height: f64, aside: f64| [0.5 * x + aside, 0.5 * y + 0.05 * across, height];
    let front = at(z - 4.0 * across, 0.0);
    let rear = at(z - 2.0 * across, 0.02 * across);
    let mut balls = grains(density, vec![sphere(0.5 * across, rear), sphere(0.5 * across, front)]);
    balls.gravity = V3::new(0.0, 0.0, -gravity);
    balls.period = dem::Period::default();
    let units = crate::claims::immersed::UNITS;
    let suspension = Suspension { sub_steps: 10, ..Suspension::new(balls, units) };
    let setup = closed(extents, mu, suspension);
    let mut run = backend.start(&setup)?;
    let start = 1.0_f64;
    let mut least = start;
    let mut faster = 0.0_f64;
    while run.step() < 4000 {
        run.advance(20)?;
        let grains = immersed(run.as_ref())?;
        let (a, b) = (grains.centre(0), grains.centre(1));
        let d: f64 = (0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum::<f64>().sqrt();
        faster = faster.max(grains.motion(0)[2] / grains.motion(1)[2]);
        least = least.min(d / across - 1.0);
        if least < 0.05 || b[2] < 2.0 * across {
            break;
        }
    }
    let time = run.step() as f64 * ((density - 1.0) * gravity / across).sqrt();
    Ok(Sample::absolute(across, least.max(0.0), 0.0)
        .with("gap at the start [D]", start)
        .with("time t sqrt(g'/D)", time)
        .with("largest speed of the rear over the front", faster))
}

/// Drafting.
pub const DRAFTING: Claim = Claim {
    id: "drafting-pair",
    title: "The rear one of two falling spheres catches up with the front one",
    tags: &["C2", "C5"],
    measures: "gap over diameter when the run stops, which it does below 0.05 or when the front one nears the floor; 1 at the start; Re about 20",
    reference: Reference {
        source: "Fortes, Joseph & Lundgren 1987, J. Fluid Mech. 177, 467: they kiss",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "D (cells)", short: &[4.0], full: &[4.0, 6.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.05,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "a twentieth of a diameter counts as met: below a third of a cell",
    },
    kind: Kind::Validation,
    measure: drafting,
};
