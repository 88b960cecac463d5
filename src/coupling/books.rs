//! Books of what goes between fluid and grains \[C3\].

use super::L3;
use super::load::Returned;
use crate::free_surface::ledger::{Sum, VectorSum};
use crate::state::state;

/// Mass and momentum that went between fluid and grains, lattice units.
#[derive(Clone, Copy, Debug, Default)]
pub struct CouplingBooks {
    link_mass: Sum,
    covered_mass: Sum,
    freed_mass: Sum,
    link_momentum: VectorSum,
    covered_momentum: VectorSum,
    freed_momentum: VectorSum,
    /// Cells covered so far that held fluid.
    pub covered: u64,
    /// Cells freed so far that got fluid.
    pub freed: u64,
}

state!(CouplingBooks: link_mass covered_mass freed_mass link_momentum covered_momentum freed_momentum covered freed);

impl CouplingBooks {
    pub(super) fn enter_links(&mut self, returned: &Returned) {
        self.link_mass.add(returned.mass);
        self.link_momentum.add(&returned.momentum);
    }

    pub(super) fn cover(&mut self, mass: f64, momentum: &L3) {
        self.covered_mass.add(mass);
        self.covered_momentum.add(momentum);
        self.covered += u64::from(mass != 0.0);
    }

    pub(super) fn free(&mut self, mass: f64, momentum: &L3) {
        self.freed_mass.add(mass);
        self.freed_momentum.add(momentum);
        self.freed += u64::from(mass != 0.0);
    }

    /// Mass: into the fluid over links, out of it into grains, back from them.
    #[must_use]
    pub(crate) fn masses(&self) -> [f64; 3] {
        [self.link_mass.value(), self.covered_mass.value(), self.freed_mass.value()]
    }

    /// Momentum, in the same order.
    #[must_use]
    pub(crate) fn momenta(&self) -> [L3; 3] {
        [self.link_momentum.value(), self.covered_momentum.value(), self.freed_momentum.value()]
    }
}
