//! Collision, streaming and mass exchange.

use rayon::prelude::*;

use super::SurfaceRun;
use crate::boundary::links::{CellKind, Source};
use crate::free_surface::Kind;
use crate::free_surface::conversion::{mirrored, touch};
use crate::free_surface::force::{interface_force, smooth};
use crate::free_surface::ledger::VectorSum;
use crate::lattice::moments::density_excess;
use crate::lattice::{Q, opposite};
use crate::setup::SurfaceForce;
use crate::solver::physics::Physics;
use crate::solver::plain::cell::{self, Cell};
use crate::solver::run::Stopped;

/// Cells per chunk of work.
pub const CHUNK: usize = 4096;

/// Chunks of an array that may be empty.
fn chunks<T>(all: &mut [T], count: usize) -> Vec<&mut [T]> {
    let mut list: Vec<&mut [T]> = all.chunks_mut(CHUNK).collect();
    list.resize_with(count, Default::default);
    list
}

/// Runs `work` on every item, on the pool if there is one; results in order.
fn each<I: Send, T: Send>(
    pool: Option<&rayon::ThreadPool>,
    items: Vec<I>,
    work: impl Fn(I) -> T + Sync + Send,
) -> Vec<T> {
    match pool {
        Some(pool) => pool.install(|| items.into_par_iter().map(work).collect()),
        None => items.into_iter().map(work).collect(),
    }
}

struct CollideChunk<'a> {
    start: usize,
    post: &'a mut [Cell],
    velocity: &'a mut [[f64; 3]],
    omega: &'a mut [f64],
}

struct StreamChunk<'a> {
    start: usize,
    f: &'a mut [Cell],
    mass: &'a mut [f64],
    touches: &'a mut [u8],
}

impl<P: Physics> SurfaceRun<P> {
    /// Force of a cell \[F3\].
    #[inline]
    pub(super) fn force_at(&self, cell: usize, force: &[f64; 3]) -> [f64; 3] {
        if self.kinds[cell] != Kind::Interface {
            return *force;
        }
        let rule = self.surface.force;
        let acceleration = match rule {
            SurfaceForce::ByFillAndInertia => self.acceleration_around(cell),
            SurfaceForce::Full | SurfaceForce::ByFill => [0.0; 3],
        };
        interface_force(rule, force, self.fill[cell], &acceleration)
    }

    /// Mean smoothed acceleration of the liquid neighbours; zero without any.
    fn acceleration_around(&self, cell: usize) -> [f64; 3] {
        let mut parts = [[0.0; Q]; 3];
        let mut count = 0;
        for i in 1..Q {
            let Source::Cell { cell: from, direction } = self.links.source(cell, i) else { continue };
            let from = from as usize;
            if self.kinds[from] == Kind::Liquid {
                count += 1;
                for (a, part) in parts.iter_mut().enumerate() {
                    part[i] = mirrored(i, usize::from(direction), a) * self.acceleration[from][a];
                }
            }
        }
        parts.map(|part| if count > 0 { density_excess(&part) / f64::from(count) } else { 0.0 })
    }

    pub(super) fn state(&self, cell: usize, force: &[f64; 3]) -> cell::State {
        let previous = self.previous_omega.get(cell).copied().unwrap_or(0.0);
        cell::state(&self.physics, &self.f[cell], force, 0, previous)
    }

    /// Correction of every wall cell \[B3\].
    pub(super) fn wall_pass(&mut self, force: &[f64; 3]) {
        for slot in 0..self.corrections.len() {
            let record = &self.links.boundary()[slot];
            let at = record.cell as usize;
            if !record.touches_wall || !self.kinds[at].is_fluid() {
                continue;
            }
            let force = self.force_at(at, force);
            let fluid = |n: usize| self.kinds[n].is_fluid();
            let residual = cell::residual_force(&self.f, &self.links, at, &force, fluid);
            let state = self.state(at, &force);
            let sourced = self.setup.stress_source;
            let situation = cell::Situation { residual, fluid: 0, sourced, limited: true };
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

    /// Collides every fluid cell; the first one in index order that fails the guard stops the run.
    pub(super) fn collide_pass(&mut self, force: &[f64; 3]) -> Result<(), Stopped> {
        let mut post = std::mem::take(&mut self.post);
        let mut velocity = std::mem::take(&mut self.velocity);
        let mut omega = std::mem::take(&mut self.previous_omega);
        let count = post.len().div_ceil(CHUNK);
        let items = chunks(&mut post, count)
            .into_iter()
            .zip(chunks(&mut velocity, count))
            .zip(chunks(&mut omega, count))
            .enumerate()
            .map(|(k, ((post, velocity), omega))| CollideChunk { start: k * CHUNK, post, velocity, omega })
            .collect();
        let this = &*self;
        let results = each(this.pool.as_ref(), items, |chunk| this.collide_chunk(chunk, force));
        let acceleration = this.accelerations(&velocity);
        (self.post, self.previous_omega) = (post, omega);
        self.velocity = velocity;
        if let Some(acceleration) = acceleration {
            self.acceleration = acceleration;
        }
        let mut failed = None;
        for (brought, found) in results {
            self.books.from_force.merge(&brought);
            failed = failed.or(found);
        }
        failed.map_or(Ok(()), Err)
    }

    /// Smoothed acceleration of every fluid cell, from the velocities of this and the last collision.
    fn accelerations(&self, velocity: &[[f64; 3]]) -> Option<Vec<[f64; 3]>> {
        if self.acceleration.is_empty() || self.velocity_before.is_empty() {
            return None;
        }
        let before = &self.velocity_before;
        let each = |cell: usize| {
            if !self.kinds[cell].is_fluid() {
                return [0.0; 3];
            }
            let change = std::array::from_fn(|a| velocity[cell][a] - before[cell][a]);
            smooth(&self.acceleration[cell], &change)
        };
        Some((0..velocity.len()).map(each).collect())
    }

    /// Returns what the force brought in and the first cell that fails the guard.
    #[inline(never)]
    fn collide_chunk(&self, chunk: CollideChunk, force: &[f64; 3]) -> (VectorSum, Option<Stopped>) {
        let mut failed = None;
        let mut brought = VectorSum::default();
        for (k, out) in chunk.post.iter_mut().enumerate() {
            let at = chunk.start + k;
            if !self.kinds[at].is_fluid() {
                continue;
            }
            let here = self.force_at(at, force);
            let h = &self.f[at];
            let previous = chunk.omega.get(k).copied().unwrap_or(0.0);
            let state = cell::state(&self.physics, h, &here, 0, previous);
            if failed.is_none()
                && let Some(what) = cell::runaway(&state.m, self.setup.speed_limit)
            {
                let cell = self.setup.coordinates(at);
                failed = Some(Stopped { step: self.step, cell, what, tau: 1.0 / state.omega });
            }
            if let Some(omega) = chunk.omega.get_mut(k) {
                *omega = state.omega;
            }
            chunk.velocity[k] = state.m.u;
            brought.add(&here);
            *out = self.physics.collide(h, &state.m, state.omega);
            if self.setup.stress_source {
                let fluid = |n: usize| self.kinds[n].is_fluid();
                let residual = cell::residual_force(&self.f, &self.links, at, &here, fluid);
                cell::add_stress_source(&self.physics, out, &state, &residual);
            }
        }
        (brought, failed)
    }

    /// Streams every fluid cell and moves mass between interface cells \[F1\] \[F2\].
    pub(super) fn stream_pass(&mut self) {
        let mut f = std::mem::take(&mut self.f);
        let mut mass = std::mem::take(&mut self.mass);
        let mut touches = std::mem::take(&mut self.touches);
        let count = f.len().div_ceil(CHUNK);
        let items = chunks(&mut f, count)
            .into_iter()
            .zip(chunks(&mut mass, count))
            .zip(chunks(&mut touches, count))
            .enumerate()
            .map(|(k, ((f, mass), touches))| StreamChunk { start: k * CHUNK, f, mass, touches })
            .collect();
        let this = &*self;
        each(this.pool.as_ref(), items, |chunk| this.stream_chunk(chunk));
        (self.f, self.mass, self.touches) = (f, mass, touches);
    }

    fn stream_chunk(&self, chunk: StreamChunk) {
        for (k, out) in chunk.f.iter_mut().enumerate() {
            let cell = chunk.start + k;
            match self.kinds[cell] {
                Kind::Gas | Kind::Solid => {}
                Kind::Liquid => *out = self.gather_liquid(cell),
                Kind::Interface => {
                    let (populations, gained, touches) = self.gather_interface(cell);
                    *out = populations;
                    chunk.mass[k] += gained;
                    chunk.touches[k] = touches;
                }
            }
        }
    }

    fn gather_liquid(&self, cell: usize) -> Cell {
        let own = &self.post[cell];
        match self.links.kind(cell) {
            CellKind::Solid => [0.0; Q],
            CellKind::Bulk => {
                let at = self.setup.coordinates(cell);
                std::array::from_fn(|i| self.post[self.links.upstream(at, i)][i])
            }
            CellKind::Boundary(slot) => {
                let sources = &self.links.boundary()[slot].sources;
                let rho = 1.0 + density_excess(own);
                std::array::from_fn(|i| match sources[i] {
                    Source::Cell { cell, direction } if i > 0 => {
                        self.post[cell as usize][usize::from(direction)]
                    }
                    Source::Cell { .. } => own[0],
                    Source::Wall { velocity, .. } => {
                        let correction = self.corrections.get(slot);
                        cell::wall_link(&self.physics, own, correction, i, rho, &velocity)
                    }
                    Source::Open => self.open_link(cell, i),
                })
            }
        }
    }

    /// Populations, Δm and neighbours of an interface cell.
    #[inline(never)]
    fn gather_interface(&self, cell: usize) -> (Cell, f64, u8) {
        let own = &self.post[cell];
        let rho = 1.0 + density_excess(own);
        let u = &self.velocity[cell];
        let correction = match self.links.kind(cell) {
            CellKind::Boundary(slot) => self.corrections.get(slot),
            CellKind::Solid | CellKind::Bulk => None,
        };
        let mut arrived = *own;
        let mut gained = [0.0; Q];
        let mut touches = 0;
        for i in 1..Q {
            let out = opposite(i);
            match self.links.source(cell, i) {
                Source::Wall { velocity, .. } => {
                    touches |= touch::WALL;
                    arrived[i] = cell::wall_link(&self.physics, own, correction, i, rho, &velocity);
                }
                Source::Open => {
                    arrived[i] = self.open_link(cell, i);
                    gained[i] = self.fill[cell] * (arrived[i] - own[out]);
                }
                Source::Cell { cell: from, direction } => {
                    let (from, direction) = (from as usize, usize::from(direction));
                    let kind = self.kinds[from];
                    match kind {
                        // Covered by a grain: what its surface returns has been put there.
                        Kind::Solid => {
                            touches |= touch::WALL;
                            arrived[i] = self.post[from][direction];
                            continue;
                        }
                        Kind::Gas => {
                            touches |= touch::GAS;
                            let behind = || {
                                let behind = self.links.neighbour_along(cell, out);
                                behind.map_or(own[out], |b| self.post[b][out])
                            };
                            arrived[i] = self.physics.gas_link(own[out], out, u, behind);
                            continue;
                        }
                        Kind::Liquid => touches |= touch::LIQUID,
                        Kind::Interface => {}
                    }
                    arrived[i] = self.post[from][direction];
                    let masses = || [self.mass_before(cell), self.mass_before(from)];
                    let share = self.physics.wetted_share(kind, self.fill[cell], self.fill[from], masses);
                    let before = || [self.before[from][direction], self.before[cell][out]];
                    gained[i] = self.physics.link_mass(share, arrived[i], own[out], before);
                }
            }
        }
        (arrived, density_excess(&gained), touches)
    }

    /// m of a cell before this step's exchange, from its fill (masses are being written).
    #[inline(always)]
    fn mass_before(&self, cell: usize) -> f64 {
        self.fill[cell] * (1.0 + density_excess(&self.post[cell]))
    }

    /// What an open face sends back in direction `i`: as gas where fluid leaves, as a wall at rest where
    /// it would come in.
    #[inline]
    fn open_link(&self, cell: usize, i: usize) -> f64 {
        let out = opposite(i);
        let leaving = self.post[cell][out];
        let u = &self.velocity[cell];
        if crate::lattice::equilibrium::dot(out, u) > 0.0 {
            self.physics.gas_link(leaving, out, u, || leaving)
        } else {
            leaving
        }
    }
}
