//! Arrays and passes of the plain backend.

use rayon::prelude::*;

use super::cell::{self, Cell};
use crate::boundary::links::{CellKind, Links};
use crate::fingerprint::{Fingerprint, Hasher};
use crate::lattice::Q;
use crate::lattice::moments::moments;
use crate::setup::{Setup, WallRule, YieldTreatment};
use crate::solver::initial::{self, REST};
use crate::solver::physics::Physics;
use crate::solver::run::{Fields, Run, StartError, Stopped, Totals};

/// Cells per chunk of work: enough to hide the hand-over, few enough to balance.
const CHUNK: usize = 4096;

/// A flow being stepped with one kind of physics.
pub struct PlainRun<P> {
    setup: Setup,
    physics: P,
    links: Links,
    /// Populations before collision, f − w.
    f: Vec<Cell>,
    /// Populations after collision.
    post: Vec<Cell>,
    /// ω⁺ of the previous step; only for the lagged treatment.
    previous_omega: Vec<f64>,
    /// Wall correction per boundary cell; only for the viscosity-independent wall.
    corrections: Vec<Cell>,
    step: u64,
    pool: Option<rayon::ThreadPool>,
}

impl<P: Physics> PlainRun<P> {
    /// Allocates and initialises.
    ///
    /// # Errors
    /// The setup is inconsistent ([`crate::solver::check::check`]).
    pub fn start(setup: &Setup, physics: P) -> Result<Self, StartError> {
        crate::solver::check::check(setup)?;
        let links = Links::new(setup);
        let cells = setup.cells();
        let force = setup.force.at(0);
        let f = (0..cells)
            .map(|cell| {
                if setup.is_solid(cell) {
                    return [0.0; Q];
                }
                let point = setup.initial.as_ref().map_or(REST, |flow| flow(setup.coordinates(cell)));
                initial::start(&point, &setup.law(cell), &force)
            })
            .collect();
        let lagged = matches!(setup.yielding, YieldTreatment::LaggedClamped { .. });
        let previous_omega =
            if lagged { (0..cells).map(|cell| starting_omega(setup, cell)).collect() } else { Vec::new() };
        let corrections = match setup.wall_rule {
            WallRule::HalfWay => Vec::new(),
            WallRule::ViscosityIndependent => vec![[0.0; Q]; links.boundary().len()],
        };
        let pool = (setup.threads > 1 && cells > CHUNK)
            .then(|| rayon::ThreadPoolBuilder::new().num_threads(setup.threads).build().ok())
            .flatten();
        Ok(Self {
            setup: setup.clone(),
            physics,
            links,
            f,
            post: vec![[0.0; Q]; cells],
            previous_omega,
            corrections,
            step: 0,
            pool,
        })
    }

    /// One time step: slip, collide, stream.
    fn advance_one(&mut self) -> Result<(), Stopped> {
        let force = self.setup.force.at(self.step);
        self.wall_pass(&force);
        self.collide_pass(&force)?;
        self.stream_pass();
        self.step += 1;
        Ok(())
    }

    #[inline(never)]
    fn state(&self, cell: usize, force: &[f64; 3]) -> cell::State {
        let fluid = self.setup.fluid_of_cell.get(cell).copied().unwrap_or(0);
        let previous = self.previous_omega.get(cell).copied().unwrap_or(0.0);
        cell::state(&self.physics, &self.f[cell], force, fluid, previous)
    }

    /// Correction of every wall cell \[B3\], before ω⁺ of the previous step is overwritten.
    fn wall_pass(&mut self, force: &[f64; 3]) {
        for slot in 0..self.corrections.len() {
            let record = &self.links.boundary()[slot];
            if record.touches_wall {
                let at = record.cell as usize;
                let residual = cell::residual_force(&self.f, &self.links, at, force, |_| true);
                let fluid = self.setup.fluid_of_cell.get(at).copied().unwrap_or(0);
                let state = self.state(at, force);
                let sourced = self.setup.stress_source;
                let situation = cell::Situation { residual, fluid, sourced, limited: false };
                self.corrections[slot] = cell::wall_correction(
                    &self.physics,
                    record.walls,
                    &record.normal,
                    &self.f[at],
                    &state,
                    &situation,
                );
            }
        }
    }

    /// Collides every fluid cell; the first cell in index order that fails the guard stops the run.
    fn collide_pass(&mut self, force: &[f64; 3]) -> Result<(), Stopped> {
        let mut post = std::mem::take(&mut self.post);
        let mut omegas = std::mem::take(&mut self.previous_omega);
        let this = &*self;
        let work = |start: usize, post: &mut [Cell], omegas: &mut [f64]| {
            this.collide_chunk(start, post, omegas, force)
        };
        let lagged = !omegas.is_empty();
        let chunks = post.len().div_ceil(CHUNK);
        let failed = match &this.pool {
            Some(pool) if lagged => pool.install(|| {
                post.par_chunks_mut(CHUNK)
                    .zip(omegas.par_chunks_mut(CHUNK))
                    .enumerate()
                    .filter_map(|(k, (post, omegas))| work(k * CHUNK, post, omegas))
                    .min_by_key(|&(cell, _)| cell)
            }),
            Some(pool) => pool.install(|| {
                post.par_chunks_mut(CHUNK)
                    .enumerate()
                    .filter_map(|(k, post)| work(k * CHUNK, post, &mut []))
                    .min_by_key(|&(cell, _)| cell)
            }),
            None => (0..chunks)
                .filter_map(|k| {
                    let range = k * CHUNK..((k + 1) * CHUNK).min(post.len());
                    let lag = if lagged { range.clone() } else { 0..0 };
                    work(k * CHUNK, &mut post[range], &mut omegas[lag])
                })
                .min_by_key(|&(cell, _)| cell),
        };
        self.post = post;
        self.previous_omega = omegas;
        match failed {
            None => Ok(()),
            Some((_, stopped)) => Err(stopped),
        }
    }

    /// Collides the cells from `start` on; returns the first one that fails the guard. `omegas` holds
    /// ω⁺ of the previous step on entry and of this step on return (empty unless lagged).
    #[inline(never)]
    fn collide_chunk(
        &self,
        start: usize,
        post: &mut [Cell],
        omegas: &mut [f64],
        force: &[f64; 3],
    ) -> Option<(usize, Stopped)> {
        let mut failed = None;
        for (k, out) in post.iter_mut().enumerate() {
            let at = start + k;
            if self.links.kind(at) == CellKind::Solid {
                continue;
            }
            let h = &self.f[at];
            let fluid = self.setup.fluid_of_cell.get(at).copied().unwrap_or(0);
            let previous = omegas.get(k).copied().unwrap_or(0.0);
            let state = cell::state(&self.physics, h, force, fluid, previous);
            if failed.is_none()
                && let Some(what) = cell::runaway(&state.m, self.setup.speed_limit)
            {
                let cell = self.setup.coordinates(at);
                failed = Some((at, Stopped { step: self.step, cell, what, tau: 1.0 / state.omega }));
            }
            if let Some(omega) = omegas.get_mut(k) {
                *omega = state.omega;
            }
            *out = self.physics.collide(h, &state.m, state.omega);
            if self.setup.stress_source {
                let residual = cell::residual_force(&self.f, &self.links, at, force, |_| true);
                cell::add_stress_source(&self.physics, out, &state, &residual);
            }
        }
        failed
    }

    /// Streams every cell.
    fn stream_pass(&mut self) {
        let mut f = std::mem::take(&mut self.f);
        let this = &*self;
        let work = |(k, chunk): (usize, &mut [Cell])| {
            let [nx, ny, _] = this.setup.extents;
            let mut at = this.setup.coordinates(k * CHUNK);
            for (offset, out) in chunk.iter_mut().enumerate() {
                let cell = k * CHUNK + offset;
                *out = cell::gather(&this.physics, &this.post, &this.links, &this.corrections, cell, at);
                at[0] += 1;
                if at[0] == nx {
                    at = [0, at[1] + 1, at[2]];
                    if at[1] == ny {
                        at = [0, 0, at[2] + 1];
                    }
                }
            }
        };
        match &this.pool {
            Some(pool) => pool.install(|| f.par_chunks_mut(CHUNK).enumerate().for_each(work)),
            None => f.chunks_mut(CHUNK).enumerate().for_each(work),
        }
        self.f = f;
    }

    fn fluid_cells_in_order(&self) -> impl Iterator<Item = usize> {
        (0..self.f.len()).filter(|&cell| self.links.kind(cell) != CellKind::Solid)
    }
}

/// ω⁺ that the lagged treatment starts from: the law at the initial shear rate, clamped.
pub fn starting_omega(setup: &Setup, cell: usize) -> f64 {
    let YieldTreatment::LaggedClamped { tau_min, tau_max } = setup.yielding else { return 0.0 };
    let point = setup.initial.as_ref().map_or(REST, |flow| flow(setup.coordinates(cell)));
    let gamma_dot = initial::shear_rate(&initial::strain_rate(&point.gradient));
    let tau =
        if gamma_dot > 0.0 { initial::tau_at(&setup.law(cell), point.density, gamma_dot) } else { tau_max };
    1.0 / tau.clamp(tau_min, tau_max)
}

impl<P: Physics> Run for PlainRun<P> {
    fn advance(&mut self, steps: u64) -> Result<(), Stopped> {
        for _ in 0..steps {
            self.advance_one()?;
        }
        Ok(())
    }

    fn step(&self) -> u64 {
        self.step
    }

    fn setup(&self) -> &Setup {
        &self.setup
    }

    fn fields(&self) -> Fields {
        let mut fields = Fields::empty(self.f.len());
        let force = self.setup.force.at(self.step);
        for cell in self.fluid_cells_in_order() {
            let state = self.state(cell, &force);
            fields.record(cell, &state.m, state.omega);
        }
        fields
    }

    fn populations(&self, cell: usize) -> [f64; Q] {
        self.f[cell]
    }

    fn totals(&self) -> Totals {
        let force = self.setup.force.at(self.step);
        let mut totals = Totals { mass_excess: 0.0, momentum: [0.0; 3], kinetic_energy: 0.0 };
        for cell in self.fluid_cells_in_order() {
            let m = moments(&self.f[cell], &force);
            totals.mass_excess += m.d_rho;
            let u2 = (m.u[0] * m.u[0] + m.u[1] * m.u[1]) + m.u[2] * m.u[2];
            totals.kinetic_energy += 0.5 * m.rho * u2;
            for a in 0..3 {
                totals.momentum[a] += m.rho * m.u[a];
            }
        }
        totals
    }

    fn fingerprint(&self) -> Fingerprint {
        let force = self.setup.force.at(self.step);
        let mut hasher = Hasher::default();
        let mut max_speed2 = 0.0_f64;
        for cell in self.fluid_cells_in_order() {
            hasher.cell(&self.f[cell]);
            let u = moments(&self.f[cell], &force).u;
            max_speed2 = max_speed2.max((u[0] * u[0] + u[1] * u[1]) + u[2] * u[2]);
        }
        for cell in self.fluid_cells_in_order() {
            if let Some(omega) = self.previous_omega.get(cell) {
                hasher.number(*omega);
            }
        }
        let totals = self.totals();
        Fingerprint {
            step: self.step,
            hash: hasher.finish(),
            mass_excess: totals.mass_excess,
            momentum: totals.momentum,
            max_speed: max_speed2.sqrt(),
        }
    }

    fn fluid_cells(&self) -> u64 {
        self.links.fluid_cells()
    }

    fn allocated_bytes(&self) -> u64 {
        let cells = (self.f.len() + self.post.len()) * size_of::<Cell>();
        let lag = self.previous_omega.len() * size_of::<f64>();
        let walls = self.corrections.len() * size_of::<Cell>();
        let marks = self.setup.solids.len() + self.setup.fluid_of_cell.len();
        (cells + lag + walls + marks) as u64 + self.links.bytes()
    }
}
