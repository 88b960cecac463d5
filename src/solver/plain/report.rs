//! What a run tells about itself.

use super::run::PlainRun;
use super::surface::SurfacePhysics;
use crate::coupling::Immersed;
use crate::fingerprint::{Fingerprint, Hasher};
use crate::lattice::Q;
use crate::lattice::moments::Moments;
use crate::setup::Setup;
use crate::solver::cell::{Cell, State};
use crate::solver::observe::{self, Observed};
use crate::solver::physics::Physics;
use crate::solver::run::{Fields, Ledger, Load, Run, Stopped, Totals};
use crate::state::{StateError, Tape};

impl<P: Physics, S: SurfacePhysics> Observed for PlainRun<P, S> {
    type At = usize;

    fn in_order(&self) -> impl Iterator<Item = usize> {
        (0..self.f.len()).filter(|&cell| self.is_fluid(cell))
    }
    fn number(&self, at: usize) -> usize {
        at
    }
    fn arrived(&self, at: usize) -> Cell {
        self.f[at]
    }
    fn body_force(&self) -> [f64; 3] {
        PlainRun::body_force(self)
    }
    fn force_on(&self, at: usize, force: &[f64; 3]) -> [f64; 3] {
        self.force_at(at, force)
    }
    fn state(&self, at: usize, force: &[f64; 3]) -> State {
        PlainRun::state(self, at, force)
    }
    fn mass_of(&self, at: usize, m: &Moments<f64>) -> (f64, f64) {
        self.surface.as_ref().map_or((m.d_rho, m.rho), |surface| surface.mass_of(at, m.d_rho, m.rho))
    }
    fn blank_fields(&self) -> Fields {
        let mut fields = Fields::empty(self.f.len());
        if let Some(surface) = &self.surface {
            fields.fill = vec![0.0; self.f.len()];
            fields.kind = surface.kinds.iter().map(|&kind| kind as u8).collect();
        }
        fields
    }
    fn fill_of(&self, at: usize, rho: f64) -> f64 {
        self.surface.as_ref().map_or(1.0, |surface| surface.fill_of(at, rho))
    }
    fn hash_surface(&self, at: usize, hasher: &mut Hasher) {
        if let Some(surface) = &self.surface {
            hasher.number(at as f64);
            hasher.number(f64::from(surface.kinds[at] as u8));
            hasher.number(surface.mass[at]);
        }
    }
    fn hash_parked(&self, hasher: &mut Hasher) {
        for (cell, mass) in self.surface.iter().flat_map(|surface| &surface.parked) {
            hasher.number(f64::from(*cell));
            hasher.number(*mass);
        }
    }
    fn hash_memory(&self, at: usize, hasher: &mut Hasher) {
        let surface = self.surface.as_ref();
        let acceleration = surface.and_then(|surface| surface.acceleration.get(at));
        let dry = surface.map(|surface| surface.dry[at]);
        for number in acceleration.into_iter().chain(&dry).flatten().chain(self.previous_omega.get(at)) {
            hasher.number(*number);
        }
    }
}

impl<P: Physics, S: SurfacePhysics> Run for PlainRun<P, S> {
    fn advance(&mut self, steps: u64) -> Result<(), Stopped> {
        self.run(steps)
    }

    fn step(&self) -> u64 {
        self.step
    }

    fn setup(&self) -> &Setup {
        &self.setup
    }

    fn fields(&self) -> Fields {
        observe::fields(self)
    }

    fn populations(&self, cell: usize) -> [f64; Q] {
        self.f[cell]
    }

    fn totals(&self) -> Totals {
        observe::totals(self)
    }

    fn fingerprint(&self) -> Fingerprint {
        observe::fingerprint(self)
    }

    fn fluid_cells(&self) -> u64 {
        self.surface.as_ref().map_or(self.links.fluid_cells(), |surface| surface.fluid_count())
    }

    fn ledger(&self) -> Option<Ledger> {
        self.surface.as_ref().map(|surface| surface.ledger(&self.f))
    }

    fn loads(&self) -> Vec<Load> {
        self.surface.as_ref().map_or_else(|| self.loads.clone(), |surface| surface.loads.clone())
    }

    fn grains(&self) -> Option<&Immersed> {
        self.grains.as_deref()
    }

    fn grains_mut(&mut self) -> Option<&mut Immersed> {
        self.grains.as_deref_mut()
    }

    fn leave(&mut self, keep: &[bool]) {
        self.take_grains_out(keep);
    }

    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        self.pass_state(tape)
    }

    fn allocated_bytes(&self) -> u64 {
        let populations = (self.f.len() + self.post.len() + self.corrections.len()) * size_of::<Cell>();
        let lag = self.previous_omega.len() * size_of::<f64>();
        let marks = self.setup.solids.len() + self.setup.fluid_of_cell.len();
        let surface = self.surface.as_ref().map_or(0, |surface| surface.bytes());
        let grains = self.grains.as_ref().map_or(0, |grains| grains.bytes());
        let cuts = size_of_val(&*self.setup.cuts) as u64 + self.cuts.bytes();
        let walls = self.links.bytes() + self.hand_over.bytes() + cuts;
        (populations + lag + marks) as u64 + walls + surface + grains
    }
}
