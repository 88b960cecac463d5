//! Conversions of one step \[F4\] \[F6\]: the arrays of this backend for [`crate::free_surface::conversion`].

use std::collections::BTreeMap;

use super::SurfaceRun;
use crate::boundary::links::Source;
use crate::free_surface::Kind;
use crate::free_surface::conversion::{Cells, convert, fill_of, verdict};
use crate::free_surface::marks::Mark;
use crate::lattice::Q;
use crate::lattice::moments::{density_excess, moments};
use crate::setup::{SurfaceForce, YieldTreatment};
use crate::solver::physics::Physics;
use crate::solver::plain::cell::Cell;

impl<P: Physics> SurfaceRun<P> {
    /// Marks, conversions, refill and excess of one step; then φ of every interface cell.
    pub(super) fn convert(&mut self, force: &[f64; 3]) {
        let marks = self.marks();
        if !marks.is_empty() || !self.parked.is_empty() {
            let rules = self.surface.clone();
            let mut parked = std::mem::take(&mut self.parked);
            let step = self.step;
            let turnover = convert(self, &rules, &marks, &mut parked, (step, force));
            self.parked = parked;
            self.books.from_conversions.merge(&turnover.momentum);
            self.books.conversions += turnover.conversions;
            self.books.outflow.add(turnover.outflow);
            if turnover.conversions > 0 {
                self.list_special();
            }
        }
        for &cell in &self.special {
            let cell = cell as usize;
            if self.kinds[cell] == Kind::Interface {
                self.fill[cell] = fill_of(self.mass[cell], 1.0 + density_excess(&self.f[cell]));
            }
        }
        if !self.acceleration.is_empty() {
            self.velocity_before.clone_from(&self.velocity);
        }
    }

    /// Interface cells that fill or empty, before reverting.
    fn marks(&self) -> BTreeMap<u32, Mark> {
        let mut marks = BTreeMap::new();
        for &at in &self.special {
            let cell = at as usize;
            if self.kinds[cell] == Kind::Interface {
                let rho = 1.0 + density_excess(&self.f[cell]);
                let verdict = verdict(self, &self.surface, cell, rho);
                if verdict != Mark::Stay {
                    marks.insert(at, verdict);
                }
            }
        }
        marks
    }
}

impl<P: Physics> Cells for SurfaceRun<P> {
    fn source(&self, cell: usize, i: usize) -> Source {
        self.links.source(cell, i)
    }
    fn kind(&self, cell: usize) -> Kind {
        self.kinds[cell]
    }
    fn fill(&self, cell: usize) -> f64 {
        self.fill[cell]
    }
    fn mass(&self, cell: usize) -> f64 {
        self.mass[cell]
    }
    fn touches(&self, cell: usize) -> u8 {
        self.touches[cell]
    }
    fn populations(&self, cell: usize) -> Cell {
        self.f[cell]
    }
    fn fill_up(&mut self, cell: usize) {
        self.kinds[cell] = Kind::Liquid;
        (self.mass[cell], self.fill[cell]) = (0.0, 1.0);
    }
    fn empty(&mut self, cell: usize) {
        self.kinds[cell] = Kind::Gas;
        self.f[cell] = [0.0; Q];
        (self.mass[cell], self.fill[cell]) = (0.0, 0.0);
        self.velocity[cell] = [0.0; 3];
    }
    fn expose(&mut self, cell: usize, mass: f64) {
        self.kinds[cell] = Kind::Interface;
        self.mass[cell] = mass;
    }
    fn wet(&mut self, cell: usize, populations: &Cell) {
        self.kinds[cell] = Kind::Interface;
        self.f[cell] = *populations;
        self.mass[cell] = 0.0;
        self.velocity[cell] = moments(populations, &[0.0; 3]).u;
        if let YieldTreatment::LaggedClamped { tau_max, .. } = self.setup.yielding {
            self.previous_omega[cell] = 1.0 / tau_max;
        }
        if self.surface.force == SurfaceForce::ByFillAndInertia {
            self.acceleration[cell] = [0.0; 3];
        }
    }
    fn add_mass(&mut self, cell: usize, mass: f64) {
        self.mass[cell] += mass;
    }
    fn excess(&self, mass: f64) -> f64 {
        self.physics.excess(mass)
    }
}
