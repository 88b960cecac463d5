//! Grains in the fluid: the arrays of this backend for [`crate::coupling`].

use super::run::PlainRun;
use super::surface::SurfacePhysics;
use super::surface::cells::Wet;
use crate::coupling::{Host, Place, Uncovered, body_force};
use crate::free_surface::Kind;
use crate::setup::Setup;
use crate::solver::cell::Cell;
use crate::solver::physics::Physics;
use crate::solver::run::Stopped;

impl<P: Physics, S: SurfacePhysics> PlainRun<P, S> {
    /// Body force of this step, with the pressure gradient that balances the weight of grains.
    pub(super) fn body_force(&self) -> [f64; 3] {
        body_force(&self.setup, self.step, self.grains.as_deref())
    }

    pub(super) fn start_grains(&mut self) {
        if let Some((mut cells, Some(grains))) = self.wet() {
            grains.start(&mut cells);
        }
    }

    pub(super) fn exchange_with_grains(&mut self) {
        if let Some((mut cells, Some(grains))) = self.wet() {
            grains.exchange(&mut cells);
        }
    }

    pub(super) fn take_grains_out(&mut self, keep: &[bool]) {
        if let Some((mut cells, Some(grains))) = self.wet() {
            grains.leave(&mut cells, keep);
            cells.surface.list_special(cells.links);
        }
    }

    pub(super) fn move_grains(&mut self) -> Result<(), Stopped> {
        let Some((mut cells, Some(grains))) = self.wet() else { return Ok(()) };
        let before = *grains.books();
        let moved = grains.advance(&mut cells);
        if before.covered != grains.books().covered || before.freed != grains.books().freed {
            cells.surface.list_special(cells.links);
        }
        moved
    }
}

impl<P: Physics, S: SurfacePhysics> Host for Wet<'_, P, S> {
    fn setup(&self) -> &Setup {
        self.setup
    }
    fn moving_wall(&self, i: usize, rho: f64, u: &[f64; 3]) -> f64 {
        self.physics.wall(0.0, i, rho, u) + self.physics.wall_cubic(i, rho, u)
    }
    fn step_number(&self) -> u64 {
        self.step
    }
    fn after(&self, cell: usize) -> Cell {
        self.post[cell]
    }
    fn stored(&self, value: f64) -> f64 {
        value
    }
    fn fluid_one(&self, cell: usize, i: usize) -> Option<f64> {
        self.surface.kinds[cell].is_fluid().then(|| self.post[cell][i])
    }
    fn place(&self, cell: usize, i: usize) -> Place {
        Place { block: cell as u32, index: i as u32 }
    }
    fn put(&mut self, place: Place, value: f64) {
        self.post[place.block as usize][place.index as usize] = value;
    }
    fn cover(&mut self, cell: usize) {
        self.drain(cell, Kind::Solid);
    }
    fn uncover(&mut self, cell: usize, to: &Uncovered) {
        self.flood(cell, to.kind, to.mass, &to.populations);
    }
    fn take_parked(&mut self, cell: usize) -> f64 {
        self.surface.parked.remove(&(cell as u32)).unwrap_or(0.0)
    }
    fn book(&mut self, mass: f64, momentum: &[f64; 3]) {
        self.surface.books.mass_from_grains.add(mass);
        self.surface.books.from_grains.add(momentum);
    }
    fn fluid_count(&self) -> u64 {
        self.surface.fluid_count()
    }
    fn pool(&self) -> Option<&rayon::ThreadPool> {
        self.pool
    }
}
