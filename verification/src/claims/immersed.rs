//! What the claims about grains in a fluid share: set-ups in lattice units, limits of slow approaches.
//!
//! One cell is 1 m, one step 1 s, the reference density 1 kg/m³, so that SI numbers of the grains are lattice numbers.

use std::f64::consts::PI;
use std::sync::Arc;

use crate::claim::VerifyError;
use crate::exact::ExactError;
use lahar::collision::CollisionChoice;
use lahar::coupling::{GrainWall, Immersed, Suspension};
use lahar::dem::{self, Grain, Material, Materials, PairProperties, V3};
use lahar::rheology::Law;
use lahar::setup::Setup;
use lahar::solver::run::{Backend, Run};
use lahar::units::Units;

/// Lattice units as SI units.
pub const UNITS: Units = Units { dx_m: 1.0, dt_s: 1.0, rho0_kg_per_m3: 1.0 };

/// Viscosity at τ = 1: with Λ = 3/16 the wall does not depend on it, and this is the quickest way to a steady flow.
pub const MU: f64 = 1.0 / 6.0;

/// Both ways in which surfaces return populations, with their names.
pub const WALLS: [(&str, GrainWall); 2] =
    [("half-way", GrainWall::HalfWay), ("central linear", GrainWall::CentralLinear)];

/// A soft material of a density relative to the fluid.
#[must_use]
pub fn material(density: f64) -> Materials {
    let grain = Material { name: "grain".into(), density_kg_m3: density, young_pa: 1.0, poisson: 0.25 };
    Materials::single(grain, PairProperties::default())
}

/// Grains of one density, without gravity.
#[must_use]
pub fn grains(density: f64, grains: Vec<Grain>) -> dem::Setup {
    dem::Setup { grains, ..dem::Setup::new(material(density)) }
}

/// A sphere.
#[must_use]
pub fn sphere(radius: f64, centre: [f64; 3]) -> Grain {
    Grain::sphere(radius, V3::from(centre), 0)
}

/// The grain with a prescribed motion.
#[must_use]
pub fn driven(grain: Grain, velocity: [f64; 3], spin: [f64; 3]) -> Grain {
    Grain { driven: true, ..grain.moving(V3::from(velocity)).spinning(V3::from(spin)) }
}

/// Default rules, without lubrication.
#[must_use]
pub fn plain_suspension(grains: dem::Setup, wall: GrainWall) -> Suspension {
    Suspension { wall, lubrication: None, ..Suspension::new(grains, UNITS) }
}

/// A periodic box of Newtonian fluid of viscosity [`MU`] with grains; the grains' period is set.
#[must_use]
pub fn periodic(extents: [usize; 3], mut suspension: Suspension) -> Setup {
    suspension.dem.period = dem::Period(extents.map(|n| Some(n as f64)));
    let mut setup = Setup::periodic(extents, Law::Newtonian { mu: MU });
    setup.grains = Some(Arc::new(suspension));
    setup
}

/// (4/3)πR³.
#[must_use]
pub fn volume(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius * radius * radius
}

/// Radius of the sphere that fills the share `c` of a cube.
#[must_use]
pub fn radius_in_cube(c: f64, edge: f64) -> f64 {
    libm::cbrt(0.75 / PI * c) * edge
}

/// The grains of a run.
///
/// # Errors
/// It has none: the backend has forgotten them.
pub fn immersed(run: &dyn Run) -> Result<&Immersed, VerifyError> {
    run.grains().ok_or_else(|| numerics("grains", "the backend runs without them"))
}

/// Something that did not work out.
#[must_use]
pub fn numerics(what: &'static str, detail: impl std::fmt::Display) -> VerifyError {
    VerifyError::Numerics { what, detail: detail.to_string() }
}

/// A reference solution, or why there is none.
///
/// # Errors
/// Outside its range.
pub fn exact<T>(value: Result<T, ExactError>) -> Result<T, VerifyError> {
    value.map_err(|error| numerics("reference solution", error))
}

/// Limit of a quantity that decays towards it exponentially (Aitken's rule on the last three looks).
///
/// # Errors
/// A guard stopped the run; the extrapolation changes by more than `tolerance` of the limit after `max_steps`.
pub fn limit(
    run: &mut dyn Run,
    (interval, tolerance, max_steps): (u64, f64, u64),
    look: &dyn Fn(&dyn Run) -> Result<f64, VerifyError>,
) -> Result<f64, VerifyError> {
    let mut seen = [look(run)?; 3];
    let mut before = f64::NAN;
    let mut residual = f64::INFINITY;
    let mut quiet = 0;
    while run.step() < max_steps {
        run.advance(interval)?;
        seen = [seen[1], seen[2], look(run)?];
        let (first, second) = (seen[1] - seen[0], seen[2] - seen[1]);
        let ratio = second / first;
        // Beyond 0.9 the extrapolation is ten times the last change: wait.
        let now = if ratio.abs() < 0.9 { seen[2] + second * ratio / (1.0 - ratio) } else { seen[2] };
        residual = ((now - before) / now).abs();
        // What is left of a change that small is below the tolerance at any ratio up to 0.95.
        let still = second.abs() <= 0.05 * tolerance * now.abs();
        quiet = if residual <= tolerance && (ratio.abs() < 0.9 || still) { quiet + 1 } else { 0 };
        if quiet == 2 || second == 0.0 {
            return Ok(now);
        }
        before = now;
    }
    let found = format!("not steady: the limit changes by {residual:.2e} of itself between looks");
    Err(VerifyError::NotSteady { steps: run.step(), wanted: tolerance, found })
}

/// One simple cubic array: a sphere in a periodic cube.
#[derive(Clone, Copy, Debug)]
pub struct Array {
    /// Solid fraction.
    pub c: f64,
    /// Cells along an edge.
    pub cells: usize,
    /// How surfaces return populations.
    pub wall: GrainWall,
    /// Collision operator.
    pub collision: CollisionChoice,
    /// Viscosity.
    pub mu: f64,
    /// Where the centre lies between cell centres, cells.
    pub offset: [f64; 3],
}

/// Places between cell centres: errors of a staircase depend on them.
pub const OFFSETS: [[f64; 3]; 3] = [[0.12, 0.37, 0.29], [0.47, 0.25, 0.41], [0.33, 0.18, 0.04]];

impl Array {
    /// With the default scheme and the first offset.
    #[must_use]
    pub fn new(c: f64, cells: usize, wall: GrainWall) -> Self {
        Self { c, cells, wall, collision: CollisionChoice::default(), mu: MU, offset: OFFSETS[0] }
    }

    /// Radius, cells.
    #[must_use]
    pub fn radius(&self) -> f64 {
        radius_in_cube(self.c, self.cells as f64)
    }

    fn centre(&self) -> [f64; 3] {
        let middle = (self.cells / 2) as f64 + 0.5;
        self.offset.map(|d| middle + d)
    }

    fn setup(&self, density: f64, hold: bool) -> Setup {
        let mut grain = sphere(self.radius(), self.centre());
        grain.driven = hold;
        let suspension = plain_suspension(grains(density, vec![grain]), self.wall);
        let mut setup = periodic([self.cells; 3], suspension);
        setup.fluids = vec![Law::Newtonian { mu: self.mu }];
        setup.collision = self.collision;
        setup
    }

    /// A third of the time in which the flow relaxes by e: friction of the spheres on the fluid of the box, and
    /// diffusion across it.
    fn interval(&self, hold: bool) -> u64 {
        let n = self.cells as f64;
        let diffusion = n * n / (4.0 * PI * PI * self.mu);
        // Leading order of 1/K; only the number of steps depends on it.
        let drag = 1.0 / (1.0 - 1.76 * libm::cbrt(self.c) + self.c).max(0.05);
        let friction = n * n * n / (6.0 * PI * self.radius() * drag * self.mu);
        ((if hold { diffusion + friction } else { diffusion }) / 3.0).ceil() as u64
    }

    /// K of the fixed array, driven by a force per volume of fluid: set-up (a) of
    /// [`crate::exact::suspension::cubic_array`].
    ///
    /// # Errors
    /// The run does not start, is stopped, or does not settle; see [`limit`].
    pub fn fixed(&self, backend: &dyn Backend) -> Result<f64, VerifyError> {
        let mut setup = self.setup(1.0, true);
        let force = self.force(1.0);
        setup.force = lahar::setup::BodyForce::Constant([force, 0.0, 0.0]);
        let mut run = backend.start(&setup)?;
        immersed(run.as_ref())?;
        let cube = (self.cells * self.cells * self.cells) as f64;
        let u = limit(run.as_mut(), self.rule(true), &|run| Ok(run.totals().momentum[0] / cube))?;
        Ok(force * cube / (6.0 * PI * self.mu * self.radius() * u))
    }

    /// u₀/u of the array that falls freely without net volume flux: set-up (c) there, with the balance of
    /// [`lahar::coupling::Suspension::balanced`].
    ///
    /// # Errors
    /// The run does not start, is stopped, or does not settle; see [`limit`].
    pub fn falling(&self, backend: &dyn Backend, density: f64) -> Result<f64, VerifyError> {
        let mut setup = self.setup(density, false);
        let cube = (self.cells * self.cells * self.cells) as f64;
        let gravity = self.force((density - 1.0).abs()) * cube / volume(self.radius());
        if let Some(suspension) = setup.grains.as_mut().map(Arc::make_mut) {
            suspension.balanced = [false, false, true];
            suspension.dem.gravity = V3::new(0.0, 0.0, -gravity);
        }
        setup.force = lahar::setup::BodyForce::Constant([0.0, 0.0, -gravity]);
        let mut run = backend.start(&setup)?;
        let ball = volume(self.radius());
        let u = limit(run.as_mut(), self.rule(false), &|run| {
            let u = immersed(run)?.motion(0)[2];
            Ok(u - (run.totals().momentum[2] + ball * u) / cube)
        })?;
        let weight = ball * (1.0 - density) * gravity;
        Ok(weight / (6.0 * PI * self.mu * self.radius() * u))
    }

    fn rule(&self, hold: bool) -> (u64, f64, u64) {
        // In boxes of a few cells sound and the steps from node to node take longer than diffusion.
        (self.interval(hold), 1e-4, (120 * self.interval(hold)).max(2000))
    }

    /// Force per volume of the box that moves the fluid at a Reynolds number 2Ru/ν of about 0.002, over the
    /// density that it acts on.
    fn force(&self, density: f64) -> f64 {
        let n = self.cells as f64;
        let speed = 1e-3 * self.mu / self.radius();
        6.0 * PI * self.mu * self.radius() * speed / (n * n * n * density)
    }
}
