//! What a run in blocks tells about itself: the same sums in the same order as the plain backend.

use super::block::Block;
use super::element::{Aligned, Element};
use super::memory::sources_bytes;
use super::run::FastRun;
use super::surface::state::Surface;
use crate::coupling::Immersed;
use crate::fingerprint::{Fingerprint, Hasher};
use crate::lattice::Q;
use crate::lattice::moments::Moments;
use crate::setup::Setup;
use crate::solver::cell::{self, State};
use crate::solver::observe::{self, Observed};
use crate::solver::physics::Physics;
use crate::solver::run::{Fields, Ledger, Load, Run, Stopped, Totals};
use crate::state::{StateError, Tape};

impl<P: Physics, E: Element> FastRun<P, E> {
    /// Block and place of every fluid cell, with its number in the box, in the order of the box.
    pub(super) fn in_order(&self) -> impl Iterator<Item = (usize, usize, usize)> + '_ {
        let cells = self.layout.block_cells();
        (0..self.setup.cells()).filter_map(move |cell| {
            let slot = self.layout.slot(self.setup.coordinates(cell))?;
            let (number, local) = (slot / cells, slot % cells);
            self.holds_fluid(number, local).then_some((cell, number, local))
        })
    }

    pub(super) fn holds_fluid(&self, number: usize, local: usize) -> bool {
        match &self.surface {
            None => self.blocks[number].is_usable(local),
            Some(surface) => surface.kinds[number][local].is_fluid(),
        }
    }
}

impl<P: Physics, E: Element> Observed for FastRun<P, E> {
    /// Number in the box, block and place in it.
    type At = (usize, usize, usize);

    fn in_order(&self) -> impl Iterator<Item = Self::At> {
        FastRun::in_order(self)
    }
    fn number(&self, (cell, ..): Self::At) -> usize {
        cell
    }
    fn arrived(&self, (_, number, local): Self::At) -> [f64; Q] {
        FastRun::arrived(self, number, local)
    }
    fn body_force(&self) -> [f64; 3] {
        FastRun::body_force(self)
    }
    fn force_on(&self, (_, number, local): Self::At, force: &[f64; 3]) -> [f64; 3] {
        self.force_of(number, local, force).unwrap_or(*force)
    }
    fn state(&self, (_, number, local): Self::At, force: &[f64; 3]) -> State {
        let previous = self.lag[number].get(local).copied().unwrap_or(0.0);
        let fluid = self.blocks[number].fluid.get(local).copied().unwrap_or(0);
        cell::state(&self.physics, &FastRun::arrived(self, number, local), force, fluid, previous)
    }
    fn mass_of(&self, (_, number, local): Self::At, m: &Moments<f64>) -> (f64, f64) {
        self.surface.as_ref().map_or((m.d_rho, m.rho), |surface| surface.mass_of(number, local, m))
    }
    fn blank_fields(&self) -> Fields {
        let mut fields = Fields::empty(self.setup.cells());
        if let Some(surface) = &self.surface {
            surface.start_fields(self, &mut fields);
        }
        fields
    }
    fn fill_of(&self, (_, number, local): Self::At, rho: f64) -> f64 {
        self.surface.as_ref().map_or(1.0, |surface| surface.fill_of(number, local, rho))
    }
    fn hash_surface(&self, (cell, number, local): Self::At, hasher: &mut Hasher) {
        if let Some(surface) = &self.surface {
            surface.hash_cell(hasher, cell, number, local);
        }
    }
    fn hash_parked(&self, hasher: &mut Hasher) {
        for (cell, mass) in self.surface.iter().flat_map(|surface| &surface.parked) {
            hasher.number(f64::from(*cell));
            hasher.number(*mass);
        }
    }
    fn hash_memory(&self, (_, number, local): Self::At, hasher: &mut Hasher) {
        let inertia = self.surface.as_ref().and_then(|surface| surface.inertia.as_ref());
        let acceleration = inertia.map(|inertia| inertia.acceleration_of(number, local));
        let dry = self.surface.as_ref().map(|surface| surface.dry_at(number, local));
        for number in acceleration.iter().chain(&dry).flatten().chain(self.lag[number].get(local)) {
            hasher.number(*number);
        }
    }
}

impl<P: Physics, E: Element> Run for FastRun<P, E> {
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
        let cells = self.layout.block_cells();
        match self.layout.slot(self.setup.coordinates(cell)) {
            Some(slot) if self.holds_fluid(slot / cells, slot % cells) => {
                self.arrived(slot / cells, slot % cells)
            }
            _ => [0.0; Q],
        }
    }

    fn totals(&self) -> Totals {
        observe::totals(self)
    }

    fn fingerprint(&self) -> Fingerprint {
        observe::fingerprint(self)
    }

    fn fluid_cells(&self) -> u64 {
        self.surface.as_ref().map_or(self.fluid_cells, |surface| surface.fluid_cells())
    }

    fn ledger(&self) -> Option<Ledger> {
        self.make_ledger()
    }

    fn pass_seconds(&self) -> Vec<(&'static str, f64)> {
        let mut passes = vec![("stream and collide", self.seconds[0])];
        if self.corrected() {
            passes.push(("walls", self.seconds[1]));
        }
        if self.surface.is_some() {
            passes.push(("surface", self.seconds[2]));
        }
        if self.grains.is_some() {
            passes.push(("surfaces of grains", self.seconds[3]));
            passes.push(("motion of grains", self.seconds[4]));
        }
        passes
    }

    fn loads(&self) -> Vec<Load> {
        self.surface.as_ref().map_or_else(|| self.loads.clone(), |surface| surface.loads.clone())
    }

    fn grains(&self) -> Option<&Immersed> {
        self.grains.as_deref()
    }

    fn leave(&mut self, keep: &[bool]) {
        self.take_grains_out(keep);
    }

    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        self.pass_state(tape)
    }

    fn grains_mut(&mut self) -> Option<&mut Immersed> {
        self.grains.as_deref_mut()
    }

    fn allocated_bytes(&self) -> u64 {
        let populations: u64 = self.old.iter().chain(&self.new).map(Aligned::bytes).sum();
        let rim: usize = self.rim.iter().map(|rim| size_of_val(rim.as_slice())).sum();
        let cuts = size_of_val(&*self.setup.cuts);
        let numbers: usize = self
            .density
            .iter()
            .chain(&self.lag)
            .chain(&self.cut_returned)
            .map(|n| size_of_val(n.as_slice()))
            .sum();
        let blocks: u64 = self.blocks.iter().map(Block::bytes).sum();
        let marks = self.setup.solids.len() + self.setup.fluid_of_cell.len();
        let surface = self.surface.as_ref().map_or(0, Surface::bytes);
        let sources = sources_bytes(&self.layout, E::PER_LINE);
        let grains = self.grains.as_ref().map_or(0, |grains| grains.bytes());
        populations
            + (rim + numbers + cuts + marks) as u64
            + blocks
            + self.layout.bytes()
            + self.hand_over.bytes()
            + sources
            + surface
            + grains
    }
}
