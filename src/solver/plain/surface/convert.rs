//! Conversions of one step \[F4\] \[F6\].

use std::collections::BTreeMap;

use super::SurfacePhysics;
use super::cells::Wet;
use crate::free_surface::Kind;
use crate::free_surface::conversion::{convert, fill_of, verdict};
use crate::free_surface::marks::Mark;
use crate::lattice::moments::density_excess;
use crate::solver::physics::Physics;
use crate::solver::plain::run::PlainRun;

impl<P: Physics, S: SurfacePhysics> PlainRun<P, S> {
    /// Marks, conversions, refill and excess of one step; then φ of every interface cell.
    pub(in crate::solver::plain) fn convert(&mut self, force: &[f64; 3]) {
        if let Some((mut cells, _)) = self.wet() {
            cells.surface.accelerate();
            cells.convert_marked(force);
            cells.update_fill();
            cells.surface.remember_velocity();
        }
    }
}

impl<P: Physics, S: SurfacePhysics> Wet<'_, P, S> {
    fn convert_marked(&mut self, force: &[f64; 3]) {
        let marks = self.marks();
        if marks.is_empty() && self.surface.parked.is_empty() {
            return;
        }
        let rules = self.surface.rules.clone();
        let mut parked = std::mem::take(&mut self.surface.parked);
        let step = self.step;
        let turnover = convert(self, &rules, &marks, &mut parked, (step, force));
        self.surface.parked = parked;
        self.surface.books.from_conversions.merge(&turnover.momentum);
        self.surface.books.conversions += turnover.conversions;
        self.surface.books.outflow.add(turnover.outflow);
        if turnover.conversions > 0 {
            self.surface.list_special(self.links);
        }
    }

    /// Interface cells that fill or empty, before reverting.
    fn marks(&self) -> BTreeMap<u32, Mark> {
        let mut marks = BTreeMap::new();
        for &at in &self.surface.special {
            let cell = at as usize;
            if self.surface.kinds[cell] == Kind::Interface {
                let rho = 1.0 + density_excess(&self.f[cell]);
                let verdict = verdict(self, &self.surface.rules, cell, rho);
                if verdict != Mark::Stay {
                    marks.insert(at, verdict);
                }
            }
        }
        marks
    }

    fn update_fill(&mut self) {
        let surface = &mut *self.surface;
        for &cell in &surface.special {
            let cell = cell as usize;
            if surface.kinds[cell] == Kind::Interface {
                surface.fill[cell] = fill_of(surface.mass[cell], 1.0 + density_excess(&self.f[cell]));
            }
        }
    }
}
