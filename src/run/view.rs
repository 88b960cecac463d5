//! Grains at one time, to be measured and written, whoever moves them.

use crate::dem::{Dem, Setup};
use crate::state::state;

/// Grains that have left through open faces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Left {
    /// How many.
    pub number: u64,
    /// Their mass, kg.
    pub mass_kg: f64,
    /// What the books held of their energy, J.
    pub energy_j: f64,
}

state!(Left: number mass_kg energy_j);

/// Grains at one time.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    /// The state of the method.
    pub dem: &'a Dem,
    /// The set-up of the grains still there.
    pub setup: &'a Setup,
    /// Number at time 0 of each grain still there.
    pub ids: &'a [u32],
    /// Those that are not.
    pub left: Left,
    /// Energy balance at time 0, J.
    pub start: f64,
    /// Time since the start, s.
    pub time: f64,
}

impl<'a> View<'a> {
    /// Grains that are not driven.
    pub(crate) fn free(&self) -> impl Iterator<Item = usize> + use<'a> {
        let b = self.dem.bodies();
        (0..b.len()).filter(|&i| b.inverse_mass[i] > 0.0)
    }

    /// Largest speed of a free grain, m/s.
    pub(crate) fn max_speed(&self) -> f64 {
        let b = self.dem.bodies();
        // NaN must not hide behind a comparison; the method's own guard stops on it.
        self.free().map(|i| b.velocity[i].norm()).fold(0.0, f64::max)
    }

    /// What the energy balance has changed by since time 0, with what left, J.
    pub(crate) fn unexplained(&self) -> f64 {
        self.dem.energies().balance() + self.left.energy_j - self.start
    }
}
