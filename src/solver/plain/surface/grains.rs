//! Grains in the fluid: the arrays of this backend for [`crate::coupling`].

use super::SurfaceRun;
use crate::coupling::{Host, Immersed, Place, Uncovered, body_force};
use crate::free_surface::Kind;
use crate::lattice::Q;
use crate::lattice::moments::moments;
use crate::setup::{Setup, YieldTreatment};
use crate::solver::physics::Physics;
use crate::solver::plain::cell::Cell;
use crate::solver::run::Stopped;

impl<P: Physics> SurfaceRun<P> {
    /// Body force of this step, with the pressure gradient that balances the weight of grains.
    pub(super) fn body_force(&self) -> [f64; 3] {
        body_force(&self.setup, self.step, self.grains.as_deref())
    }

    /// Runs `work` on the grains and the cells.
    fn with_grains<R>(&mut self, work: impl FnOnce(&mut Immersed, &mut Self) -> R) -> Option<R> {
        let mut grains = self.grains.take()?;
        let result = work(&mut grains, self);
        self.grains = Some(grains);
        Some(result)
    }

    pub(super) fn start_grains(&mut self) {
        self.with_grains(|grains, run| grains.start(run));
    }

    pub(super) fn exchange_with_grains(&mut self) {
        self.with_grains(|grains, run| grains.exchange(run));
    }

    pub(super) fn take_grains_out(&mut self, keep: &[bool]) {
        self.with_grains(|grains, run| grains.leave(run, keep));
        self.list_special();
    }

    pub(super) fn move_grains(&mut self) -> Result<(), Stopped> {
        let moved = self.with_grains(|grains, run| {
            let before = *grains.books();
            let moved = grains.advance(run);
            (moved, before.covered != grains.books().covered || before.freed != grains.books().freed)
        });
        match moved {
            Some((result, changed)) => {
                if changed {
                    self.list_special();
                }
                result
            }
            None => Ok(()),
        }
    }
}

impl<P: Physics> Host for SurfaceRun<P> {
    fn setup(&self) -> &Setup {
        &self.setup
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
        self.kinds[cell].is_fluid().then(|| self.post[cell][i])
    }
    fn place(&self, cell: usize, i: usize) -> Place {
        Place { block: cell as u32, index: i as u32 }
    }
    fn put(&mut self, place: Place, value: f64) {
        self.post[place.block as usize][place.index as usize] = value;
    }
    fn cover(&mut self, cell: usize) {
        self.kinds[cell] = Kind::Solid;
        self.f[cell] = [0.0; Q];
        (self.mass[cell], self.fill[cell]) = (0.0, 0.0);
        self.velocity[cell] = [0.0; 3];
    }
    fn uncover(&mut self, cell: usize, to: &Uncovered) {
        self.kinds[cell] = to.kind;
        self.f[cell] = to.populations;
        let m = moments(&to.populations, &[0.0; 3]);
        self.mass[cell] = to.mass;
        self.fill[cell] = match to.kind {
            Kind::Liquid => 1.0,
            Kind::Interface => to.mass / m.rho,
            Kind::Gas | Kind::Solid => 0.0,
        };
        self.velocity[cell] = m.u;
        if let (YieldTreatment::LaggedClamped { tau_max, .. }, true) =
            (self.setup.yielding, to.kind.is_fluid())
        {
            self.previous_omega[cell] = 1.0 / tau_max;
        }
        if let Some(acceleration) = self.acceleration.get_mut(cell) {
            *acceleration = [0.0; 3];
        }
        if let Some(before) = self.velocity_before.get_mut(cell) {
            *before = m.u;
        }
    }
    fn take_parked(&mut self, cell: usize) -> f64 {
        self.parked.remove(&(cell as u32)).unwrap_or(0.0)
    }
    fn book(&mut self, mass: f64, momentum: &[f64; 3]) {
        self.books.mass_from_grains.add(mass);
        self.books.from_grains.add(momentum);
    }
    fn fluid_count(&self) -> u64 {
        SurfaceRun::fluid_count(self)
    }
    fn pool(&self) -> Option<&rayon::ThreadPool> {
        self.pool.as_ref()
    }
}
