//! Spheres that move as told: a Galilean twin, the books of covered cells, the noise of the staircase.

use std::f64::consts::PI;
use std::sync::Arc;

use crate::claim::{Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::claims::immersed::{WALLS, driven, grains, immersed, periodic, plain_suspension, sphere};
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::coupling::GrainWall;
use lahar::output::plot::{Axis, Plot, Series};
use lahar::rheology::Law;
use lahar::setup::{FlowPoint, Setup};
use lahar::solver::run::{Backend, Run};

const DIAMETER: f64 = 9.6;
const VELOCITY: [f64; 3] = [0.02, 0.011, 0.007];

/// Length of a vector.
pub fn norm(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn moving(cells: usize, wall: GrainWall, tau: f64, with_fluid: bool) -> Setup {
    let middle = 0.5 * cells as f64;
    let grain =
        driven(sphere(0.5 * DIAMETER, [middle - 0.7, middle + 0.2, middle - 0.1]), VELOCITY, [0.0; 3]);
    let mut setup = periodic([cells; 3], plain_suspension(grains(1.0, vec![grain]), wall));
    setup.fluids = vec![Law::Newtonian { mu: (tau - 0.5) / 3.0 }];
    if with_fluid {
        setup.initial =
            Some(Arc::new(|_| FlowPoint { density: 1.0, velocity: VELOCITY, gradient: [[0.0; 3]; 3] }));
    }
    setup
}

fn links(run: &dyn Run) -> Result<[f64; 3], VerifyError> {
    let l = immersed(run)?.loads()[0].links;
    Ok([l[0], l[1], l[2]])
}

fn twin(backend: &dyn Backend, tau: f64) -> Result<Sample, VerifyError> {
    let scale = norm(&VELOCITY) * norm(&VELOCITY) * PI * DIAMETER * DIAMETER / 8.0;
    let (mut worst, mut drift) = (0.0_f64, 0.0_f64);
    for (_, wall) in WALLS {
        let mut run = backend.start(&moving(16, wall, tau, true))?;
        for _ in 0..200 {
            run.advance(1)?;
            let force = norm(&links(run.as_ref())?) / scale;
            worst = if force <= worst { worst } else { force };
        }
        let density = mean_density(run.as_ref());
        drift = if density.abs() <= drift { drift } else { density.abs() };
    }
    Ok(Sample::absolute(tau, worst, 0.0).with("change of the mean density", drift))
}

/// Mean of ρ − 1.
fn mean_density(run: &dyn Run) -> f64 {
    run.totals().mass_excess / run.fluid_cells() as f64
}

/// H7, force.
pub const TWIN: Claim = Claim {
    id: "galilean-twin",
    title: "A sphere that moves with the fluid feels no force, whatever it covers and uncovers",
    tags: &["C1", "C2", "C3"],
    measures: "largest |F|/(rho u^2 pi D^2/8) in 200 steps (5 cells of way), D = 9.6, u = (0.02, 0.011, 0.007), both kinds of surface",
    reference: Reference { source: "uniform flow", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "tau", short: &[0.8], full: &[0.51, 0.55, 0.8, 1.0, 2.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-10,
        at: Rung::Every,
        because: "rounding: 1000 links of populations of 0.05 (1e-17 each) over a scale of 0.02 would be 5e-13 if they all added up; 200 \
                  times that for sums over steps (HARD_CASES H7 asks for 1e-2)",
    },
    kind: Kind::Verification,
    measure: twin,
};

fn mass(backend: &dyn Backend, steps: f64) -> Result<Sample, VerifyError> {
    let mut worst = 0.0_f64;
    for (_, wall) in WALLS {
        let mut run = backend.start(&moving(20, wall, 0.8, false))?;
        run.advance(steps as u64)?;
        let residual = run.ledger().map_or(f64::NAN, |ledger| ledger.mass_residual.abs());
        let owed = mean_density(run.as_ref()).abs();
        // The ledger closes to rounding; the density may differ by what a grain owes at the moment.
        let share = (residual / 1e-12).max(owed / 1e-6);
        worst = if share <= worst { worst } else { share };
        worst = if residual.is_nan() { f64::NAN } else { worst };
    }
    Ok(Sample::absolute(steps, worst, 0.0))
}

/// H7, mass.
pub const MASS: Claim = Claim {
    id: "moving-sphere-mass",
    title: "A sphere that moves through fluid at rest takes no mass from it",
    tags: &["C3"],
    measures: "largest of: |residual of the mass ledger|/1e-12, |mean density - 1|/1e-6; D = 9.6 in a periodic box of 20 cells",
    reference: Reference { source: "conservation of mass", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "steps", short: &[400.0], full: &[400.0, 1600.0, 6400.0] },
    order: None,
    tolerance: Tolerance {
        value: 1.0,
        at: Rung::Every,
        because: "rounding of sums over 8000 cells and 400 links, kept compensated; what is taken is given back as soon as the grain gives a \
                  cell free, so that a debt of a few cells at rho u^2 = 6e-4 remains: 6e-4 (5/7500) = 4e-7",
    },
    kind: Kind::Verification,
    measure: mass,
};

/// Noise.
pub const NOISE: Exhibit = Exhibit {
    id: "moving-sphere-noise",
    caption: "Force along the way of a sphere moving steadily through a periodic box, D = 9.6, u = 0.024, tau = 0.8: mean, noise about a \
              running mean of 51 steps, and the share of the noise at the frequency u_x/dx at which nodes are crossed.",
    timed: false,
    run: noise,
};

/// Amplitude of a force at a multiple of the crossing frequency over its mean, Hann window.
fn amplitude(force: &[f64], mean: f64, multiple: f64) -> f64 {
    let (mut a, mut b) = (0.0, 0.0);
    for (t, x) in force.iter().enumerate() {
        let window = 1.0 - libm::cos(2.0 * PI * t as f64 / force.len() as f64);
        let phase = 2.0 * PI * multiple * VELOCITY[0] * t as f64;
        a += window * (x - mean) * libm::cos(phase);
        b += window * (x - mean) * libm::sin(phase);
    }
    2.0 * (a * a + b * b).sqrt() / force.len() as f64 / mean.abs()
}

fn noise(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let (cells, steps) = if full { (32, 4000) } else { (20, 1000) };
    let mut table = Table::new(
        "Noise of the force",
        &[
            "surface",
            "mean force",
            "noise/mean",
            "amplitude at u_x/dx",
            "at 2 u_x/dx",
            "at u_y/dx",
            "largest elsewhere",
        ],
    );
    let mut plot = Plot::new(
        "Spectrum of the force",
        Axis::linear("frequency", "u_x/dx"),
        Axis::log("amplitude over mean force", ""),
    );
    for (name, wall) in WALLS {
        let mut run = backend.start(&moving(cells, wall, 0.8, false))?;
        run.advance(600)?;
        let mut force = Vec::new();
        for _ in 0..steps {
            run.advance(1)?;
            let f = links(run.as_ref())?;
            force.push((0..3).map(|a| f[a] * VELOCITY[a]).sum::<f64>() / norm(&VELOCITY));
        }
        let mean = force.iter().sum::<f64>() / force.len() as f64;
        let smooth = |i: usize| force[i - 25..=i + 25].iter().sum::<f64>() / 51.0;
        let rest: Vec<f64> = (25..force.len() - 25).map(|i| force[i] - smooth(i)).collect();
        let rms = (rest.iter().map(|x| x * x).sum::<f64>() / rest.len() as f64).sqrt();
        let amplitude = |multiple: f64| amplitude(&force, mean, multiple);
        let spectrum: Vec<[f64; 2]> =
            (4..=240).map(|i| 0.0125 * f64::from(i)).map(|m| [m, amplitude(m)]).collect();
        let away =
            |m: f64| [1.0, 2.0, 3.0, 0.55, 1.1, 1.65, 0.35, 0.7, 1.05].iter().all(|k| (m - k).abs() > 0.1);
        let elsewhere =
            spectrum.iter().filter(|p| p[0] > 0.5 && away(p[0])).fold(0.0_f64, |m, p| m.max(p[1]));
        table.push(vec![
            name.into(),
            mean.into(),
            (rms / mean.abs()).into(),
            amplitude(1.0).into(),
            amplitude(2.0).into(),
            amplitude(VELOCITY[1] / VELOCITY[0]).into(),
            elsewhere.into(),
        ]);
        plot = plot.with(Series::line(name, spectrum));
    }
    Ok(ExhibitData { tables: vec![table], plots: vec![plot], notes: vec![] })
}
