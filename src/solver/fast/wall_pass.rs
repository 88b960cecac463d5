//! Wall corrections of a step \[B3\] \[B4\], block by block.

use super::element::Element;
use super::layout::NONE;
use super::place::Place;
use super::rim::{Rim, WallTask};
use super::run::FastRun;
use super::walls::correct;
use crate::solver::physics::Physics;
use crate::solver::pool::each;

impl<P: Physics, E: Element> FastRun<P, E> {
    /// What walls take off the populations that leave boundary cells.
    pub(super) fn wall_pass(&mut self, force: &[f64; 3]) {
        if !self.corrected() {
            return;
        }
        let mut rim = std::mem::take(&mut self.rim);
        let task = WallTask {
            physics: &self.physics,
            layout: &self.layout,
            density: &self.density,
            sourced: self.setup.stress_source,
            laws: &self.setup.fluids,
            weight: self.setup.free_surface.as_ref().map(|_| *force),
        };
        let items = rim.iter_mut().enumerate().filter(|(_, rim)| !rim.is_empty()).collect();
        each(self.pool.as_deref(), items, |(number, rim): (usize, &mut Vec<Rim>)| {
            let force_of = |local| self.force_of(number, local, force);
            let is_full = |local| self.is_full(number, local);
            let is_liquid = |place: Place| self.is_fluid(place) && self.is_full_at(place);
            correct(self.chosen, &task, &self.blocks[number], rim, &force_of, &is_full, &is_liquid);
        });
        self.rim = rim;
    }

    fn is_full_at(&self, place: Place) -> bool {
        match self.layout.block_at(place.block as usize) {
            NONE => true,
            number => self.is_full(number as usize, place.local as usize),
        }
    }
}
