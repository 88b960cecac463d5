//! All cells of a run with a surface at once, for conversions ([`Cells`]) and grains
//! ([`crate::coupling::Host`]).

use super::{Surface, SurfacePhysics};
use crate::boundary::hand_over::HandOver;
use crate::boundary::links::{Links, Source};
use crate::free_surface::Kind;
use crate::free_surface::conversion::{Cells, touch};
use crate::lattice::Q;
use crate::lattice::moments::moments;
use crate::setup::{Setup, SurfaceForce, YieldTreatment};
use crate::solver::cell::Cell;
use crate::solver::physics::Physics;

/// A run without its grains, so that these can look at the cells and change them.
pub(in crate::solver::plain) struct Wet<'a, P, S> {
    pub(in crate::solver::plain) setup: &'a Setup,
    pub(in crate::solver::plain) physics: &'a P,
    pub(in crate::solver::plain) links: &'a Links,
    pub(in crate::solver::plain) hand_over: &'a HandOver,
    pub(in crate::solver::plain) f: &'a mut [Cell],
    pub(in crate::solver::plain) post: &'a mut [Cell],
    pub(in crate::solver::plain) previous_omega: &'a mut [f64],
    pub(in crate::solver::plain) surface: &'a mut Surface<S>,
    pub(in crate::solver::plain) step: u64,
    pub(in crate::solver::plain) pool: Option<&'a rayon::ThreadPool>,
}

impl<P: Physics, S: SurfacePhysics> Wet<'_, P, S> {
    /// ω⁺ of a cell that becomes fluid, where the lagged treatment keeps one.
    pub(in crate::solver::plain) fn forget_omega(&mut self, cell: usize) {
        if let YieldTreatment::LaggedClamped { tau_max, .. } = self.setup.yielding {
            self.previous_omega[cell] = 1.0 / tau_max;
        }
    }

    /// Fluid becomes gas or solid.
    pub(in crate::solver::plain) fn drain(&mut self, cell: usize, kind: Kind) {
        let surface = &mut *self.surface;
        surface.kinds[cell] = kind;
        self.f[cell] = [0.0; Q];
        (surface.mass[cell], surface.fill[cell]) = (0.0, 0.0);
        (surface.velocity[cell], surface.dry[cell]) = ([0.0; 3], [0.0; 3]);
    }

    /// A covered cell becomes fluid or gas of this mass, with these populations.
    pub(in crate::solver::plain) fn flood(&mut self, cell: usize, kind: Kind, mass: f64, populations: &Cell) {
        let m = moments(populations, &[0.0; 3]);
        let surface = &mut *self.surface;
        surface.kinds[cell] = kind;
        self.f[cell] = *populations;
        surface.touches[cell] = touch::GAS;
        surface.mass[cell] = mass;
        surface.fill[cell] = match kind {
            Kind::Liquid => 1.0,
            Kind::Interface => mass / m.rho,
            Kind::Gas | Kind::Solid => 0.0,
        };
        surface.velocity[cell] = m.u;
        if let Some(acceleration) = surface.acceleration.get_mut(cell) {
            *acceleration = [0.0; 3];
        }
        // Nothing is known of its past.
        if let Some(before) = surface.velocity_before.get_mut(cell) {
            *before = m.u;
        }
        if kind.is_fluid() {
            self.forget_omega(cell);
        }
    }
}

impl<P: Physics, S: SurfacePhysics> Cells for Wet<'_, P, S> {
    fn source(&self, cell: usize, i: usize) -> Source {
        self.links.source(cell, i)
    }
    fn kind(&self, cell: usize) -> Kind {
        self.surface.kinds[cell]
    }
    fn fill(&self, cell: usize) -> f64 {
        self.surface.fill[cell]
    }
    fn mass(&self, cell: usize) -> f64 {
        self.surface.mass[cell]
    }
    fn touches(&self, cell: usize) -> u8 {
        self.surface.touches[cell]
    }
    fn populations(&self, cell: usize) -> Cell {
        self.f[cell]
    }
    fn fill_up(&mut self, cell: usize) {
        self.surface.kinds[cell] = Kind::Liquid;
        (self.surface.mass[cell], self.surface.fill[cell]) = (0.0, 1.0);
        self.surface.dry[cell] = [0.0; 3];
    }
    fn empty(&mut self, cell: usize) {
        self.drain(cell, Kind::Gas);
    }
    fn expose(&mut self, cell: usize, mass: f64) {
        self.surface.kinds[cell] = Kind::Interface;
        self.surface.touches[cell] = touch::GAS;
        self.surface.mass[cell] = mass;
    }
    fn wet(&mut self, cell: usize, populations: &Cell) {
        self.surface.kinds[cell] = Kind::Interface;
        self.f[cell] = *populations;
        self.surface.touches[cell] = touch::GAS;
        self.surface.mass[cell] = 0.0;
        self.surface.velocity[cell] = moments(populations, &[0.0; 3]).u;
        self.forget_omega(cell);
        if self.surface.rules.force == SurfaceForce::ByFillAndInertia {
            self.surface.acceleration[cell] = [0.0; 3];
        }
    }
    fn add_mass(&mut self, cell: usize, mass: f64) {
        self.surface.mass[cell] += mass;
    }
    fn excess(&self, mass: f64, full: f64) -> f64 {
        self.surface.equations.excess(mass, full)
    }
}
