//! Grains in the fluid: the blocks of this backend for [`crate::coupling`].

use super::element::{Element, index};
use super::layout::NONE;
use super::run::FastRun;
use super::surface::record::InterfaceCell;
use crate::coupling::{Host, Immersed, Place, Uncovered, body_force};
use crate::free_surface::Kind;
use crate::free_surface::conversion::touch;
use crate::free_surface::exchange::{GAS, LIQUID};
use crate::lattice::Q;
use crate::lattice::moments::moments;
use crate::setup::{Setup, YieldTreatment};
use crate::solver::physics::Physics;
use crate::solver::run::Stopped;

impl<P: Physics, E: Element> FastRun<P, E> {
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
    }

    pub(super) fn move_grains(&mut self) -> Result<(), Stopped> {
        self.with_grains(|grains, run| grains.advance(run)).unwrap_or(Ok(()))
    }

    /// Block and place of a cell, which gets a block if it has none.
    fn find_or_make(&mut self, cell: usize) -> Option<(usize, usize)> {
        let (place, _) = self.layout.find(self.setup.coordinates(cell));
        if self.layout.block_at(place) == NONE {
            self.add_surface_block(place)?;
        }
        self.find(cell)
    }
}

impl<P: Physics, E: Element> Host for FastRun<P, E> {
    fn setup(&self) -> &Setup {
        &self.setup
    }
    fn moving_wall(&self, i: usize, rho: f64, u: &[f64; 3]) -> f64 {
        self.physics.wall(0.0, i, rho, u) + self.physics.wall_cubic(i, rho, u)
    }
    fn step_number(&self) -> u64 {
        self.step
    }
    fn after(&self, cell: usize) -> [f64; Q] {
        let Some((number, local)) = self.find(cell) else { return [0.0; Q] };
        let start = index::<E>(local, 0);
        let own = &self.old[number].get()[start..=start + (Q - 1) * E::PER_LINE];
        let mut f = [0.0; Q];
        for (f, own) in f.iter_mut().zip(own.iter().step_by(E::PER_LINE)) {
            *f = own.to_f64();
        }
        f
    }
    fn stored(&self, value: f64) -> f64 {
        E::from_f64(value).to_f64()
    }
    fn fluid_one(&self, cell: usize, i: usize) -> Option<f64> {
        let (number, local) = self.find(cell)?;
        let fluid = self.surface.as_ref().is_some_and(|surface| surface.kinds[number][local].is_fluid());
        fluid.then(|| self.old[number].get()[index::<E>(local, i)].to_f64())
    }
    fn place(&self, cell: usize, i: usize) -> Place {
        // Covered cells have a block.
        let (number, local) = self.find(cell).unwrap_or((usize::MAX, 0));
        Place { block: number as u32, index: index::<E>(local, i) as u32 }
    }
    fn put(&mut self, place: Place, value: f64) {
        if let Some(block) = self.old.get_mut(place.block as usize) {
            block.get_mut()[place.index as usize] = E::from_f64(value);
        }
    }
    fn cover(&mut self, cell: usize) {
        let Some((number, _)) = self.find_or_make(cell) else { return };
        self.change(cell, Kind::Solid, Some(GAS), None);
        if let Some(surface) = &mut self.surface {
            surface.covered[number] += 1;
        }
    }
    fn uncover(&mut self, cell: usize, to: &Uncovered) {
        let Some((number, local)) = self.find(cell) else { return };
        let m = moments(&to.populations, &[0.0; 3]);
        let fill = match to.kind {
            Kind::Liquid => LIQUID,
            Kind::Interface => to.mass / m.rho,
            Kind::Gas | Kind::Solid => GAS,
        };
        let record = to.kind.is_fluid().then_some(InterfaceCell {
            local: local as u16,
            touches: touch::GAS,
            f: to.populations,
            rho: m.rho,
            velocity: m.u,
            mass: to.mass,
            dry: [0.0; 3],
            acceleration: [0.0; 3],
        });
        self.change(cell, to.kind, Some(fill), record);
        let Some(surface) = &mut self.surface else { return };
        surface.covered[number] -= 1;
        if !to.kind.is_fluid() {
            return;
        }
        if let Some(inertia) = &mut surface.inertia {
            inertia.uncover(number, local, &m.u);
        }
        if let YieldTreatment::LaggedClamped { tau_max, .. } = self.setup.yielding {
            self.lag[number][local] = 1.0 / tau_max;
        }
    }
    fn take_parked(&mut self, cell: usize) -> f64 {
        self.surface.as_mut().and_then(|surface| surface.parked.remove(&(cell as u32))).unwrap_or(0.0)
    }
    fn book(&mut self, mass: f64, momentum: &[f64; 3]) {
        if let Some(surface) = &mut self.surface {
            surface.books.mass_from_grains.add(mass);
            surface.books.from_grains.add(momentum);
        }
    }
    fn fluid_count(&self) -> u64 {
        self.surface.as_ref().map_or(0, |surface| surface.counts[0] + surface.counts[1])
    }
    fn pool(&self) -> Option<&rayon::ThreadPool> {
        self.pool.as_deref()
    }
}
