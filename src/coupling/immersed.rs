//! The grains of a run: where they are, what they cover, what acts on them.

use super::L3;
use super::books::CouplingBooks;
use super::coverage::Coverage;
use super::gaps::Gaps;
use super::host::Host;
use super::link::{Ball, Box3};
use super::load::{BodyLoad, Returned};
use crate::dem::{Dem, DemError, Shape, V3};
use crate::setup::Setup;
use crate::setup::suspension::Suspension;
use crate::state::{State, StateError, Tape, part};
use crate::vector::norm;
use std::sync::OnceLock;

/// Body force of a step, with the pressure gradient that balances the weight of grains, if there are any.
#[must_use]
pub fn body_force(setup: &Setup, step: u64, grains: Option<&Immersed>) -> L3 {
    let force = setup.force.at(step);
    let Some(grains) = grains else { return force };
    std::array::from_fn(|a| force[a] + grains.gradient[a])
}

/// Runs `work` on the backend's threads; without any on the caller's pool, or on one thread of its own.
pub(super) fn on_pool<R: Send>(
    alone: &OnceLock<Option<rayon::ThreadPool>>,
    backend: Option<&rayon::ThreadPool>,
    work: impl FnOnce() -> R + Send,
) -> R {
    let make = || rayon::ThreadPoolBuilder::new().num_threads(1).build().ok();
    let pool = match backend {
        Some(pool) => Some(pool),
        None if rayon::current_thread_index().is_some() => None,
        None => alone.get_or_init(make).as_ref(),
    };
    match pool {
        Some(pool) => pool.install(work),
        None => work(),
    }
}

/// Grains in a fluid.
pub struct Immersed {
    pub(super) config: Suspension,
    pub(super) shape: Box3,
    pub(super) dem: Dem,
    pub(super) coverage: Coverage,
    pub(super) loads: Vec<BodyLoad>,
    /// Mean force and torque of contacts and lubrication in the last step, lattice units.
    pub(super) contact: Vec<[f64; 6]>,
    /// Mass beyond the reference density that each grain has taken from the fluid and not given back.
    pub(super) owed: Vec<f64>,
    /// Mass of interface cells that each grain has taken and could not hand to their neighbours.
    pub(super) debt: Vec<f64>,
    /// Cells to be covered at the start.
    first: super::coverage::Changes,
    /// Uniform pressure gradient that balances the weight, lattice units.
    pub(super) gradient: L3,
    pub(super) gaps: Option<Gaps>,
    pub(super) books: CouplingBooks,
    /// Whether there is gas.
    pub(super) with_gas: bool,
    /// Cells that are neither fixed solids nor outside: what grains and fluid share.
    pub(super) room: u64,
    pub(super) failure: Option<DemError>,
    /// Room for what grains return, kept from step to step.
    pub(super) answers: Vec<Returned>,
    /// For runs on one thread: without a pool the grains would take all threads of the machine.
    pub(super) alone: OnceLock<Option<rayon::ThreadPool>>,
}

impl State for Immersed {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let Self {
            dem,
            coverage,
            loads,
            contact,
            owed,
            debt,
            gradient,
            gaps,
            books,
            config: _,
            shape: _,
            first: _,
            with_gas: _,
            room: _,
            failure: _,
            answers: _,
            alone: _,
        } = self;
        dem.state(tape)?;
        coverage.state(tape)?;
        loads.state(tape)?;
        contact.state(tape)?;
        owed.state(tape)?;
        debt.state(tape)?;
        gradient.state(tape)?;
        part(gaps, tape)?;
        books.state(tape)
    }
}

impl Immersed {
    /// Checks the grains; nothing is covered yet.
    ///
    /// # Errors
    /// Whatever [`Dem::new`] finds.
    pub fn new(setup: &Setup, suspension: &Suspension) -> Result<Self, DemError> {
        let config = suspension.clone();
        let mut dem_setup = config.dem.clone();
        dem_setup.time_step_s = Some(config.units.dt_s / f64::from(config.sub_steps.max(1)));
        let dem = Dem::new(&dem_setup)?;
        let grains = dem.bodies().len();
        let with_gas =
            setup.free_surface.as_ref().is_some_and(|surface| surface.fill.iter().any(|f| *f < 1.0));
        let solid = (0..setup.cells()).filter(|&cell| setup.is_solid(cell)).count();
        let mut immersed = Self {
            owed: vec![0.0; grains],
            debt: vec![0.0; grains],
            first: super::coverage::Changes::default(),
            shape: Box3::new(setup),
            coverage: Coverage::new(setup.cells(), grains),
            loads: vec![BodyLoad::default(); grains],
            contact: vec![[0.0; 6]; grains],
            gradient: [0.0; 3],
            gaps: config.lubrication.map(|rules| Gaps::new(rules, setup)),
            books: CouplingBooks::default(),
            with_gas,
            room: (setup.cells() - solid) as u64,
            failure: None,
            answers: Vec::new(),
            alone: OnceLock::new(),
            config,
            dem,
        };
        immersed.first = immersed.update_coverage(setup, None);
        let fluid = immersed.room - immersed.coverage.covered_cells();
        immersed.balance(fluid, &setup.force.at(0));
        Ok(immersed)
    }

    /// Takes the grains' cells out of the fluid as it was drawn; before the ledger is opened.
    pub(crate) fn start(&mut self, host: &mut dyn Host) {
        for (cell, _) in std::mem::take(&mut self.first).covered {
            host.cover(cell as usize);
        }
    }

    /// Number of grains.
    #[must_use]
    pub fn grains(&self) -> usize {
        self.dem.bodies().len()
    }

    /// The grains by themselves, SI units.
    #[must_use]
    pub(crate) fn dem(&self) -> &Dem {
        &self.dem
    }

    /// What was asked for.
    #[must_use]
    pub(crate) fn config(&self) -> &Suspension {
        &self.config
    }

    /// Forces and torques of the last step, by grain.
    #[must_use]
    pub fn loads(&self) -> &[BodyLoad] {
        &self.loads
    }

    /// Mean contact and lubrication force and torque of the last step, by grain, free or driven, lattice units.
    #[must_use]
    pub fn contact_loads(&self) -> &[[f64; 6]] {
        &self.contact
    }

    /// Which cells are covered by whom.
    #[must_use]
    pub(crate) fn is_covered(&self, cell: usize) -> bool {
        self.coverage.owner(cell) != super::coverage::NOBODY
    }

    /// Cells covered by all grains, and by one.
    #[must_use]
    pub(crate) fn covered_cells(&self, grain: Option<usize>) -> u64 {
        match grain {
            None => self.coverage.covered_cells(),
            Some(grain) => self.coverage.of(grain).cells.len() as u64,
        }
    }

    /// Uniform pressure gradient that acts on fluid and grains besides the body force, −∇P, lattice units.
    #[must_use]
    pub(crate) fn gradient(&self) -> L3 {
        self.gradient
    }

    /// Why the grains could not go on.
    #[must_use]
    pub(crate) fn failure(&self) -> Option<&DemError> {
        self.failure.as_ref()
    }

    /// Mean force of lubrication on a wall of the grains in the last step, N.
    #[must_use]
    pub fn lubrication_on_wall(&self, wall: usize) -> V3 {
        self.lubrication_wrench(wall).0
    }

    /// Mean force of lubrication on a wall of the grains in the last step, N, and torque about the point about which the wall
    /// turns, N m.
    #[must_use]
    pub fn lubrication_wrench(&self, wall: usize) -> (V3, V3) {
        let sum = self.gaps.as_ref().map(|gaps| gaps.on_wall(wall)).unwrap_or_default();
        let steps = f64::from(self.config.sub_steps.max(1));
        (sum.0 / steps, sum.1 / steps)
    }

    /// Bytes held, without those of the grains themselves.
    #[must_use]
    pub(crate) fn bytes(&self) -> u64 {
        self.coverage.bytes() + (self.loads.len() * (size_of::<BodyLoad>() + size_of::<[f64; 6]>())) as u64
    }

    pub(super) fn update_coverage(
        &mut self,
        setup: &Setup,
        pool: Option<&rayon::ThreadPool>,
    ) -> super::coverage::Changes {
        let mut coverage = std::mem::replace(&mut self.coverage, Coverage::new(0, 0));
        let this = &*self;
        let balls = |grain: usize| this.balls(grain);
        let moved = |grain: usize, seen: &[L3]| {
            this.members(grain)
                .zip(seen)
                .fold(0.0, |far: f64, (ball, seen)| far.max(norm(this.shape.apart(&ball.centre, seen))))
        };
        let changes = on_pool(&self.alone, pool, || coverage.update(setup, &this.shape, &balls, &moved));
        self.coverage = coverage;
        changes
    }

    /// Uniform pressure gradient for the next step: the sum of all forces on fluid and free grains is zero.
    pub(super) fn balance(&mut self, fluid: u64, force: &L3) {
        let bodies = self.dem.bodies();
        let free = |grain: &usize| bodies.inverse_mass[*grain] > 0.0;
        for a in 0..3 {
            if !self.config.balanced[a] {
                continue;
            }
            let (mut pull, mut volume) = (fluid as f64 * force[a], fluid as f64);
            for grain in (0..bodies.len()).filter(free) {
                pull += self.weight(grain)[a] + self.volume(grain) * self.config.pressure_gradient[a];
                volume += self.volume(grain);
            }
            self.gradient[a] = -pull / volume;
        }
    }

    pub(super) fn members(&self, grain: usize) -> impl Iterator<Item = Ball> + '_ {
        let first = &self.dem.bodies().first_member;
        let scale = 1.0 / self.config.units.dx_m;
        self.dem.members()[first[grain] as usize..first[grain + 1] as usize].iter().map(move |member| Ball {
            centre: [member.position.x * scale, member.position.y * scale, member.position.z * scale],
            radius: member.radius * scale,
        })
    }

    /// Spheres of a grain, cells.
    pub(super) fn balls(&self, grain: usize) -> Vec<Ball> {
        self.members(grain).collect()
    }

    fn vector(v: &V3, scale: f64) -> L3 {
        [v.x * scale, v.y * scale, v.z * scale]
    }

    /// Centre of mass, cells.
    #[must_use]
    pub fn centre(&self, grain: usize) -> L3 {
        Self::vector(&self.dem.bodies().position[grain], 1.0 / self.config.units.dx_m)
    }

    /// (U, ω), lattice units.
    #[must_use]
    pub fn motion(&self, grain: usize) -> [f64; 6] {
        let (bodies, units) = (self.dem.bodies(), &self.config.units);
        let u = Self::vector(&bodies.velocity[grain], 1.0 / units.velocity_unit());
        let w = Self::vector(&bodies.spin[grain], units.dt_s);
        [u[0], u[1], u[2], w[0], w[1], w[2]]
    }

    /// Whether a grain moves as told.
    #[must_use]
    pub(crate) fn is_driven(&self, grain: usize) -> bool {
        self.dem.bodies().inverse_mass[grain] == 0.0
    }

    /// kg to lattice mass.
    fn mass_scale(&self) -> f64 {
        let units = &self.config.units;
        1.0 / (units.rho0_kg_per_m3 * units.dx_m * units.dx_m * units.dx_m)
    }

    /// Mass, lattice units.
    #[must_use]
    pub fn mass(&self, grain: usize) -> f64 {
        self.dem.bodies().mass[grain] * self.mass_scale()
    }

    /// Volume of the union of its spheres, cells³.
    #[must_use]
    pub fn volume(&self, grain: usize) -> f64 {
        let r = self.dem.bodies().radius[grain] / self.config.units.dx_m;
        4.0 / 3.0 * std::f64::consts::PI * r * r * r
    }

    /// m g, lattice units.
    #[must_use]
    pub(crate) fn weight(&self, grain: usize) -> L3 {
        let units = &self.config.units;
        let g = Self::vector(&self.config.dem.gravity, units.dt_s * units.dt_s / units.dx_m);
        let mass = self.mass(grain);
        g.map(|g| mass * g)
    }

    /// Moments of inertia about the centre, frame of the box, lattice units.
    #[must_use]
    pub(crate) fn inertia(&self, grain: usize) -> [L3; 3] {
        let (bodies, units) = (self.dem.bodies(), &self.config.units);
        let scale = self.mass_scale() / (units.dx_m * units.dx_m);
        let principal = bodies.inertia[grain] * scale;
        if bodies.shape[grain] == Shape::Sphere {
            return std::array::from_fn(|a| std::array::from_fn(|b| if a == b { principal.x } else { 0.0 }));
        }
        let turn = bodies.orientation[grain].to_rotation_matrix();
        let full = turn.matrix() * nalgebra::Matrix3::from_diagonal(&principal) * turn.matrix().transpose();
        std::array::from_fn(|a| std::array::from_fn(|b| full[(a, b)]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_a_pool_grains_take_one_thread() {
        let alone = OnceLock::new();
        assert_eq!(on_pool(&alone, None, rayon::current_num_threads), 1);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build();
        let pool = pool.unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(on_pool(&alone, Some(&pool), rayon::current_num_threads), 3);
        assert_eq!(pool.install(|| on_pool(&alone, None, rayon::current_num_threads)), 3);
    }
}
