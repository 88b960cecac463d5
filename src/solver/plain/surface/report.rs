//! What a free-surface run tells about itself.

use super::SurfaceRun;
use crate::coupling::Immersed;
use crate::fingerprint::{Fingerprint, Hasher};
use crate::free_surface::Kind;
use crate::lattice::Q;
use crate::lattice::moments::moments;
use crate::setup::Setup;
use crate::solver::physics::Physics;
use crate::solver::plain::cell::Cell;
use crate::solver::run::{Fields, Ledger, Load, Run, Stopped, Totals};

impl<P: Physics> SurfaceRun<P> {
    fn fluid_in_order(&self) -> impl Iterator<Item = usize> {
        (0..self.kinds.len()).filter(|&cell| self.kinds[cell].is_fluid())
    }

    /// Mass of a fluid cell: ρ in liquid, m in interface.
    fn mass_of(&self, cell: usize, rho: f64) -> f64 {
        if self.kinds[cell] == Kind::Liquid { rho } else { self.mass[cell] }
    }
}

impl<P: Physics> Run for SurfaceRun<P> {
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
        let mut fields = Fields::empty(self.f.len());
        fields.fill = vec![0.0; self.f.len()];
        fields.kind = self.kinds.iter().map(|&kind| kind as u8).collect();
        let force = self.body_force();
        for cell in self.fluid_in_order() {
            let state = self.state(cell, &self.force_at(cell, &force));
            fields.record(cell, &state.m, state.omega);
            fields.fill[cell] =
                if self.kinds[cell] == Kind::Liquid { 1.0 } else { self.mass[cell] / state.m.rho };
        }
        fields
    }

    fn populations(&self, cell: usize) -> [f64; Q] {
        self.f[cell]
    }

    /// Mass-weighted: Σ(mass) less the number of liquid cells, Σ m u, Σ ½ m u².
    fn totals(&self) -> Totals {
        let force = self.body_force();
        let mut totals = Totals { mass_excess: 0.0, momentum: [0.0; 3], kinetic_energy: 0.0 };
        for cell in self.fluid_in_order() {
            let m = moments(&self.f[cell], &self.force_at(cell, &force));
            let mass = self.mass_of(cell, m.rho);
            totals.mass_excess += if self.kinds[cell] == Kind::Liquid { m.d_rho } else { mass };
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
        for cell in self.fluid_in_order() {
            hasher.cell(&self.f[cell]);
            hasher.number(cell as f64);
            hasher.number(f64::from(self.kinds[cell] as u8));
            hasher.number(self.mass[cell]);
            let u = moments(&self.f[cell], &self.force_at(cell, &force)).u;
            max_speed2 = max_speed2.max((u[0] * u[0] + u[1] * u[1]) + u[2] * u[2]);
        }
        for (cell, mass) in &self.parked {
            hasher.number(f64::from(*cell));
            hasher.number(*mass);
        }
        for cell in self.fluid_in_order() {
            let acceleration = self.acceleration.get(cell).into_iter().flatten();
            for a in acceleration.chain(self.previous_omega.get(cell)) {
                hasher.number(*a);
            }
        }
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
        self.fluid_count()
    }

    fn ledger(&self) -> Option<Ledger> {
        Some(self.make_ledger())
    }

    fn loads(&self) -> Vec<Load> {
        self.loads.clone()
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
        let populations =
            (self.f.len() + self.post.len() + self.before.len() + self.corrections.len()) * size_of::<Cell>();
        let vectors = (self.velocity.len() + self.acceleration.len() + self.velocity_before.len())
            * size_of::<[f64; 3]>();
        let numbers =
            (self.mass.len() + self.fill.len() + self.previous_omega.len() + self.surface.fill.len())
                * size_of::<f64>();
        let marks = self.kinds.len() + self.touches.len() + self.setup.solids.len();
        let grains = self.grains.as_ref().map_or(0, |grains| grains.bytes());
        (populations + vectors + numbers + marks) as u64 + self.links.bytes() + grains
    }
}
