//! Random suspensions, and what their mean speed must be compared with.

use std::f64::consts::PI;

use super::arrays::TRT;
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::claims::immersed::{UNITS, exact, grains, immersed, numerics, periodic, sphere, volume};
use crate::exact::suspension::settling::{
    BROWNIAN_EXPONENT, hayakawa_ichiki, periodic_box_deficit, richardson_zaki, richardson_zaki_exponent,
};
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::coupling::{GrainWall, Suspension};
use lahar::dem::V3;
use lahar::dem::packing::Random;
use lahar::output::plot::{Axis, Plot, Series};
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Setup};
use lahar::solver::run::{Backend, Run};

/// Cells.
pub const RADIUS: f64 = 2.5;
const MU: f64 = 0.5;

/// Centres of `count` spheres at random in a periodic cube, one after the other, none overlapping.
///
/// # Errors
/// `Numerics` if there is no room.
pub fn scatter(count: usize, edge: f64, seed: u64) -> Result<Vec<[f64; 3]>, VerifyError> {
    let mut random = Random::new(seed);
    let mut placed: Vec<[f64; 3]> = Vec::new();
    let apart = |a: &[f64; 3], b: &[f64; 3]| -> f64 {
        (0..3).map(|i| a[i] - b[i]).map(|d| d - edge * (d / edge).round()).map(|d| d * d).sum()
    };
    for _ in 0..2_000_000 {
        let x = std::array::from_fn(|_| edge * random.unit());
        if placed.iter().all(|y| apart(&x, y) > 4.0 * RADIUS * RADIUS) {
            placed.push(x);
            if placed.len() == count {
                return Ok(placed);
            }
        }
    }
    Err(numerics("random box", "no room"))
}

/// A periodic cube of fluid with spheres at random that are about to fall without net volume flux.
#[derive(Clone, Copy, Debug)]
pub struct RandomBox {
    /// Solid fraction asked for: the edge is a whole number of cells.
    pub c: f64,
    /// Spheres.
    pub count: usize,
    /// Of the places.
    pub seed: u64,
    /// Density of the spheres over that of the fluid.
    pub density: f64,
    /// Viscosity, lattice units.
    pub mu: f64,
    /// Weight per mass, lattice units.
    pub gravity: f64,
    /// Steps of the grains in one of the fluid.
    pub sub_steps: u32,
}

impl RandomBox {
    /// Edge, cells.
    pub fn edge(&self) -> f64 {
        edge(self.c, self.count)
    }

    /// What a backend is given.
    ///
    /// # Errors
    /// The spheres do not fit, as for [`scatter`].
    pub fn setup(&self) -> Result<Setup, VerifyError> {
        let n = self.edge();
        let balls = scatter(self.count, n, self.seed)?.into_iter().map(|x| sphere(RADIUS, x)).collect();
        let mut spheres = grains(self.density, balls);
        spheres.gravity = V3::new(0.0, 0.0, -self.gravity);
        let suspension = Suspension {
            wall: GrainWall::CentralLinear,
            balanced: [false, false, true],
            sub_steps: self.sub_steps,
            ..Suspension::new(spheres, UNITS)
        };
        let mut setup = periodic([n as usize; 3], suspension);
        setup.fluids = vec![Law::Newtonian { mu: self.mu }];
        setup.collision = TRT;
        setup.force = BodyForce::Constant([0.0, 0.0, -self.gravity]);
        Ok(setup)
    }

    /// Mean speed of fall relative to the volume flux, cells per step.
    ///
    /// # Errors
    /// The backend has forgotten the spheres.
    pub fn speed(&self, run: &dyn Run) -> Result<f64, VerifyError> {
        let (grains, n) = (immersed(run)?, self.edge());
        let fall: f64 = (0..self.count).map(|i| grains.motion(i)[2]).sum();
        let flux = (run.totals().momentum[2] + volume(RADIUS) * fall) / (n * n * n);
        Ok(flux - fall / self.count as f64)
    }
}

/// Edge of the cube, a whole number of cells, that `count` spheres fill to the share `c`.
fn edge(c: f64, count: usize) -> f64 {
    libm::cbrt(count as f64 * volume(RADIUS) / c).round()
}

/// Mean settling speed over that of one sphere, of one realisation, without net volume flux.
fn realisation(backend: &dyn Backend, (c, count): (f64, usize), seed: u64) -> Result<f64, VerifyError> {
    // One sphere at Re = 0.005: it moves a thousandth of its radius.
    let single = 0.005 * MU / (2.0 * RADIUS);
    let gravity = 6.0 * PI * MU * RADIUS * single / volume(RADIUS);
    let random = RandomBox { c, count, seed, density: 2.0, mu: MU, gravity, sub_steps: 1 };
    let mut run = backend.start(&random.setup()?)?;
    // Six times the diffusion across the box, or the relaxation of a sphere.
    let n = random.edge();
    let across = n * n / (4.0 * PI * PI * MU);
    let own = 3.0 * volume(RADIUS) / (6.0 * PI * MU * RADIUS);
    run.advance((6.0 * across.max(own)).ceil() as u64)?;
    Ok(random.speed(run.as_ref())? / single)
}

/// Mean and standard error over `boxes` realisations, and the exact fraction of the box.
fn ensemble(
    backend: &dyn Backend,
    (c, count): (f64, usize),
    boxes: u64,
) -> Result<(f64, f64, f64), VerifyError> {
    let n = edge(c, count);
    let fraction = count as f64 * volume(RADIUS) / (n * n * n);
    let all = (1..=boxes)
        .map(|seed| realisation(backend, (c, count), seed))
        .collect::<Result<Vec<f64>, VerifyError>>()?;
    let mean = all.iter().sum::<f64>() / boxes as f64;
    let variance = all.iter().map(|u| (u - mean) * (u - mean)).sum::<f64>() / (boxes as f64 - 1.0);
    Ok((mean, (variance / boxes as f64).sqrt(), fraction))
}

fn few(backend: &dyn Backend, c: f64) -> Result<Sample, VerifyError> {
    let (mean, error, fraction) = ensemble(backend, (c, 8), 16)?;
    let deficit = exact(periodic_box_deficit(fraction, 8))?;
    Ok(Sample::absolute(c, mean + deficit, exact(hayakawa_ichiki(fraction))?)
        .with("u/u0 in the box", mean)
        .with("correction for the size of the box", deficit)
        .with("standard error", error))
}

/// A few boxes.
pub const SETTLING: Claim = Claim {
    id: "random-boxes-settling",
    title: "Random boxes settle with the mean speed of random suspensions to 8 % of the speed of one sphere",
    tags: &["C2", "C5", "C6"],
    measures: "u/u0, mean of 16 boxes of 8 spheres, corrected for the size of the box; R = 2.5 cells",
    reference: Reference { source: "Hayakawa & Ichiki 1995, low Reynolds number", uncertainty: 0.03 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "c", short: &[0.1], full: &[0.05, 0.1, 0.15] },
    order: None,
    tolerance: Tolerance {
        value: 0.08,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "of u0: three standard errors of 16 boxes (0.02 each), and c/N = 0.02 that the correction for the box leaves",
    },
    kind: Kind::Validation,
    measure: few,
};

/// Ensembles.
pub const ENSEMBLES: Exhibit = Exhibit {
    id: "random-ensembles",
    caption: "Settling of random boxes of 27 spheres against solid fraction, with standard errors, beside the law of Richardson and Zaki, \
              its form for suspensions in equilibrium, and a low-Re correlation.",
    timed: false,
    run: ensembles,
};

fn ensembles(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let (boxes, count) = if full { (20, 27) } else { (3, 8) };
    let fractions: &[f64] = if full { &[0.05, 0.1, 0.15, 0.2, 0.25, 0.3] } else { &[0.05, 0.15] };
    let mut table = Table::new(
        format!("u/u0, {boxes} boxes of {count} spheres, R = 2.5 cells, Re = 0.005"),
        &[
            "c",
            "in the box",
            "standard error",
            "correction",
            "corrected",
            "Richardson-Zaki",
            "(1 - c)^5.6",
            "Hayakawa-Ichiki",
        ],
    );
    let mut points = Vec::new();
    for &c in fractions {
        let (mean, error, fraction) = ensemble(backend, (c, count), boxes)?;
        let deficit = exact(periodic_box_deficit(fraction, count as u32))?;
        let exponent = exact(richardson_zaki_exponent(0.005))?;
        points.push([fraction, mean + deficit]);
        table.push(vec![
            fraction.into(),
            mean.into(),
            error.into(),
            deficit.into(),
            (mean + deficit).into(),
            exact(richardson_zaki(fraction, exponent))?.into(),
            exact(richardson_zaki(fraction, BROWNIAN_EXPONENT.0))?.into(),
            exact(hayakawa_ichiki(fraction))?.into(),
        ]);
    }
    let curve = |f: &dyn Fn(f64) -> f64| (0..=35).map(|i| 0.01 * f64::from(i)).map(|c| [c, f(c)]).collect();
    let plot = Plot::new("Settling of random boxes", Axis::linear("c", ""), Axis::linear("u/u0", ""))
        .with(Series::markers("random boxes, corrected for their size", points))
        .with(Series::reference("(1 - c)^4.65", curve(&|c| libm::pow(1.0 - c, 4.65))))
        .with(Series::reference("(1 - c)^5.6", curve(&|c| libm::pow(1.0 - c, BROWNIAN_EXPONENT.0))));
    let notes = vec![
        "Spheres placed at random one after the other differ from an equilibrium suspension above c = 0.2; the exponent 4.65 belongs to \
         suspensions whose structure the flow has made."
            .to_owned(),
    ];
    Ok(ExhibitData { tables: vec![table], plots: vec![plot], notes })
}
