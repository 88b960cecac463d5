//! What a run in blocks tells about itself: the same sums in the same order as the plain backend.

use super::element::{Aligned, Element};
use super::run::FastRun;
use crate::coupling::Immersed;
use crate::fingerprint::{Fingerprint, Hasher};
use crate::lattice::Q;
use crate::lattice::moments::moments;
use crate::setup::Setup;
use crate::solver::physics::Physics;
use crate::solver::plain::cell;
use crate::solver::run::{Fields, Ledger, Load, Run, Stopped, Totals};

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

    fn force_here(&self, number: usize, local: usize, force: &[f64; 3]) -> [f64; 3] {
        self.force_of(number, local, force).unwrap_or(*force)
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
        let mut fields = Fields::empty(self.setup.cells());
        if let Some(surface) = &self.surface {
            surface.start_fields(self, &mut fields);
        }
        let force = self.body_force();
        for (cell, number, local) in self.in_order() {
            let f = self.arrived(number, local);
            let here = self.force_here(number, local, &force);
            let previous = self.lag[number].get(local).copied().unwrap_or(0.0);
            let fluid = self.blocks[number].fluid.get(local).copied().unwrap_or(0);
            let state = cell::state(&self.physics, &f, &here, fluid, previous);
            fields.record(cell, &state.m, state.omega);
            if let Some(surface) = &self.surface {
                fields.fill[cell] = surface.fill_of(number, local, state.m.rho);
            }
        }
        fields
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
        let force = self.body_force();
        let mut totals = Totals { mass_excess: 0.0, momentum: [0.0; 3], kinetic_energy: 0.0 };
        for (_, number, local) in self.in_order() {
            let m = moments(&self.arrived(number, local), &self.force_here(number, local, &force));
            let (excess, mass) = match &self.surface {
                None => (m.d_rho, m.rho),
                Some(surface) => surface.mass_of(number, local, &m),
            };
            totals.mass_excess += excess;
            let u2 = (m.u[0] * m.u[0] + m.u[1] * m.u[1]) + m.u[2] * m.u[2];
            totals.kinetic_energy += 0.5 * mass * u2;
            for a in 0..3 {
                totals.momentum[a] += mass * m.u[a];
            }
        }
        totals
    }

    fn fingerprint(&self) -> Fingerprint {
        let force = self.body_force();
        let mut hasher = Hasher::default();
        let mut max_speed2 = 0.0_f64;
        for (cell, number, local) in self.in_order() {
            let f = self.arrived(number, local);
            hasher.cell(&f);
            if let Some(surface) = &self.surface {
                surface.hash_cell(&mut hasher, cell, number, local);
            }
            let u = moments(&f, &self.force_here(number, local, &force)).u;
            max_speed2 = max_speed2.max((u[0] * u[0] + u[1] * u[1]) + u[2] * u[2]);
        }
        self.hash_rest(&mut hasher);
        if let Some(grains) = &self.grains {
            grains.add_to_hash(&mut hasher);
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
        self.surface.as_ref().map_or_else(Vec::new, |surface| surface.loads.clone())
    }

    fn grains(&self) -> Option<&Immersed> {
        self.grains.as_deref()
    }

    fn leave(&mut self, keep: &[bool]) {
        self.take_grains_out(keep);
    }

    fn grains_mut(&mut self) -> Option<&mut Immersed> {
        self.grains.as_deref_mut()
    }

    fn allocated_bytes(&self) -> u64 {
        let populations: u64 = self.old.iter().chain(&self.new).map(Aligned::bytes).sum();
        let rim: usize = self.rim.iter().map(|rim| size_of_val(rim.as_slice())).sum();
        let numbers: usize = self.density.iter().chain(&self.lag).map(|n| size_of_val(n.as_slice())).sum();
        let blocks: u64 = self.blocks.iter().map(super::block::Block::bytes).sum();
        let marks = self.setup.solids.len() + self.setup.fluid_of_cell.len();
        let surface = self.surface.as_ref().map_or(0, super::surface::Surface::bytes);
        let sources = super::memory::sources_bytes(&self.layout, E::PER_LINE);
        let grains = self.grains.as_ref().map_or(0, |grains| grains.bytes());
        populations
            + (rim + numbers + marks) as u64
            + blocks
            + self.layout.bytes()
            + sources
            + surface
            + grains
    }
}
