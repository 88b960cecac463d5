//! Wall slip, collision and streaming. Each pass reads one array and writes another.

use super::run::{CHUNK, PlainRun};
use super::surface::SurfacePhysics;
use crate::boundary::hand_over::Record;
use crate::boundary::links::{CellKind, Source};
use crate::boundary::wall_slip::largest_gain;
use crate::free_surface::Kind;
use crate::free_surface::ledger::VectorSum;
use crate::lattice::moments::density_excess;
use crate::lattice::{Q, W, opposite};
use crate::solver::cell::{self, Cell};
use crate::solver::physics::Physics;
use crate::solver::pool::each;
use crate::solver::run::Stopped;

/// Chunks of an array that may be empty; `count`: those of an array that is not.
pub(super) fn chunks<T>(all: &mut [T], count: usize) -> Vec<&mut [T]> {
    let mut list: Vec<&mut [T]> = all.chunks_mut(CHUNK).collect();
    list.resize_with(count, Default::default);
    list
}

/// What the collision writes of the cells from `start` on.
struct CollideChunk<'a> {
    start: usize,
    post: &'a mut [Cell],
    /// ω⁺ of the previous step, then of this one; empty unless lagged.
    omega: &'a mut [f64],
    /// Empty without a surface.
    velocity: &'a mut [[f64; 3]],
}

/// What a chunk of the collision found.
struct Collided {
    /// First cell that fails the guard.
    failed: Option<Stopped>,
    /// What the body force brought in; only below a surface.
    brought: VectorSum,
}

impl<P: Physics, S: SurfacePhysics> PlainRun<P, S> {
    /// Correction of every wall cell \[B3\], before ω⁺ of the previous step is overwritten.
    pub(super) fn wall_pass(&mut self, force: &[f64; 3]) {
        for slot in 0..self.corrections.len() {
            let record = &self.links.boundary()[slot];
            let at = record.cell as usize;
            if !record.touches_wall || !self.is_fluid(at) {
                continue;
            }
            if record.cut.is_some() && !self.is_interface(at) {
                // Cut links are not corrected [B4].
                self.corrections[slot] = [0.0; Q];
                continue;
            }
            let force = self.force_at(at, force);
            // Next to the surface the densities of interface cells are those of the gas, not of a hydrostatic pressure.
            let is_liquid = |n| self.is_fluid(n) && !self.is_interface(n);
            let situation = cell::Situation {
                residual: cell::residual_force(&self.f, &self.links, at, &force, is_liquid),
                drag: record.drag,
                fluid: self.fluid(at),
                sourced: self.setup.stress_source,
                gain: largest_gain(
                    self.setup.free_surface.as_ref().map(|_| &force),
                    &self.setup.law(at),
                    record.flat,
                ),
                walls: record.walls,
                flat: record.flat.filter(|_| !self.is_interface(at)),
            };
            let state = self.state(at, &force);
            self.corrections[slot] = cell::wall_correction(&self.physics, &self.f[at], &state, &situation);
        }
    }

    pub(super) fn is_interface(&self, cell: usize) -> bool {
        self.surface.as_ref().is_some_and(|surface| surface.kinds[cell] == Kind::Interface)
    }

    /// F − ∇p of a cell.
    fn residual_force(&self, cell: usize, force: &[f64; 3]) -> [f64; 3] {
        cell::residual_force(&self.f, &self.links, cell, force, |n| self.is_fluid(n))
    }

    /// Collides every fluid cell; the first cell in index order that fails the guard stops the run.
    pub(super) fn collide_pass(&mut self, force: &[f64; 3]) -> Result<(), Stopped> {
        let mut post = std::mem::take(&mut self.post);
        let mut omega = std::mem::take(&mut self.previous_omega);
        let mut velocity = self.surface.as_mut().map_or_else(Vec::new, |s| std::mem::take(&mut s.velocity));
        let count = post.len().div_ceil(CHUNK);
        let items = chunks(&mut post, count)
            .into_iter()
            .zip(chunks(&mut omega, count))
            .zip(chunks(&mut velocity, count))
            .enumerate()
            .map(|(k, ((post, omega), velocity))| CollideChunk { start: k * CHUNK, post, omega, velocity })
            .collect();
        let this = &*self;
        let results = each(this.pool.as_deref(), items, |chunk| this.collide_chunk(chunk, force));
        (self.post, self.previous_omega) = (post, omega);
        if let Some(surface) = &mut self.surface {
            surface.velocity = velocity;
        }
        if let Some(stopped) = results.iter().find_map(|chunk| chunk.failed) {
            // The step does not happen: nothing of it is booked.
            return Err(stopped);
        }
        if let Some(surface) = &mut self.surface {
            for chunk in &results {
                surface.books.from_force.merge(&chunk.brought);
            }
        }
        Ok(())
    }

    #[inline(never)]
    fn collide_chunk(&self, chunk: CollideChunk, force: &[f64; 3]) -> Collided {
        let mut found = Collided { failed: None, brought: VectorSum::default() };
        for (k, out) in chunk.post.iter_mut().enumerate() {
            let at = chunk.start + k;
            if !self.is_fluid(at) {
                continue;
            }
            let here = self.force_at(at, force);
            let h = &self.f[at];
            let previous = chunk.omega.get(k).copied().unwrap_or(0.0);
            let state = cell::state(&self.physics, h, &here, self.fluid(at), previous);
            if found.failed.is_none()
                && let Some(what) = cell::runaway(&state.m, self.setup.speed_limit)
            {
                let cell = self.setup.coordinates(at);
                found.failed = Some(Stopped { step: self.step, cell, what, tau: 1.0 / state.omega });
            }
            if let Some(omega) = chunk.omega.get_mut(k) {
                *omega = state.omega;
            }
            if let Some(velocity) = chunk.velocity.get_mut(k) {
                *velocity = state.m.u;
                found.brought.add(&here);
            }
            *out = self.physics.collide(h, &state.m, state.omega);
            if self.setup.stress_source {
                cell::add_stress_source(&self.physics, out, &state, &self.residual_force(at, &here));
            }
        }
        found
    }

    /// Streams every fluid cell.
    pub(super) fn stream_pass(&mut self) {
        let mut f = std::mem::take(&mut self.f);
        let this = &*self;
        let items = f.chunks_mut(CHUNK).enumerate().collect();
        each(this.pool.as_deref(), items, |(k, f): (usize, &mut [Cell])| this.stream_chunk(k * CHUNK, f));
        self.f = f;
    }

    fn stream_chunk(&self, start: usize, f: &mut [Cell]) {
        let [nx, ny, _] = self.setup.extents;
        let mut at = self.setup.coordinates(start);
        for (k, out) in f.iter_mut().enumerate() {
            let cell = start + k;
            if self.is_fluid(cell) {
                *out = self.gather(cell, at);
            }
            at[0] += 1;
            if at[0] == nx {
                at = [0, at[1] + 1, at[2]];
                if at[1] == ny {
                    at = [0, 0, at[2] + 1];
                }
            }
        }
    }

    /// f_i(x, t+1) = f_i*(x − c_i, t), or what walls, open faces and gas send back.
    #[inline(always)]
    fn gather(&self, cell: usize, at: [usize; 3]) -> Cell {
        let interface = self.is_interface(cell);
        match self.links.kind(cell) {
            CellKind::Bulk if !interface => std::array::from_fn(|i| self.post[self.links.upstream(at, i)][i]),
            CellKind::Bulk => self.gather_links(cell, at, None, None),
            CellKind::Boundary(slot) => {
                self.gather_links(cell, at, self.corrections.get(slot), self.links.boundary()[slot].cut)
            }
            // Holds no fluid.
            CellKind::Solid => [0.0; Q],
        }
    }

    /// Mass that a boundary cell of a moving solid hands to its wet neighbours \[B1\].
    fn given(&self, record: &Record) -> f64 {
        match &self.surface {
            None => record.all(),
            Some(surface) => self.hand_over.given(record, |cell| surface.kinds[cell].is_fluid()),
        }
    }

    /// Streaming into a cell that touches a wall, a solid, a mirror plane or gas \[B1\]–\[B4\] \[F2\] \[F10\].
    #[inline(never)]
    fn gather_links(&self, cell: usize, at: [usize; 3], correction: Option<&Cell>, cut: Option<u32>) -> Cell {
        let own = &self.post[cell];
        let rho = 1.0 + density_excess(own);
        let partly = self.surface.as_ref().filter(|surface| surface.kinds[cell] == Kind::Interface);
        let mut contact = None;
        std::array::from_fn(|i| {
            if i == 0 {
                return own[0];
            }
            match self.links.source_at(cell, at, i) {
                Source::Wall { velocity, body, .. } => {
                    let back =
                        cut.and_then(|place| self.cuts.returned(place, opposite(i))).unwrap_or_else(|| {
                            let back = cell::wall_link(&self.physics, own, correction, i, rho, &velocity);
                            match self.hand_over.at(cell, body) {
                                None => back,
                                Some(record) => {
                                    back + W[i] * self.hand_over.raise(record, rho, self.given(record))
                                }
                            }
                        });
                    let Some(surface) = partly else { return back };
                    let contact = contact.get_or_insert_with(|| surface.contact_at(&self.links, cell));
                    surface.meet_wall(&self.post, contact, (cell, opposite(i)), back)
                }
                Source::Open => self.open_link(cell, i),
                Source::Cell { cell: from, direction } => {
                    let from = from as usize;
                    let gas = self.surface.as_ref().filter(|s| s.is_gas_link(cell, from));
                    match gas {
                        Some(surface) => surface.gas_link(&self.post, cell, opposite(i)),
                        // In a covered cell lies what the surface of its grain returns.
                        None => self.post[from][usize::from(direction)],
                    }
                }
            }
        })
    }
}
