//! What a step does with the surface after the collision, and the closing of its books.

use crate::free_surface::Kind;
use crate::solver::fast::element::Element;
use crate::solver::fast::layout::NONE;
use crate::solver::fast::run::FastRun;
use crate::solver::fast::task::Outcome;
use crate::solver::physics::Physics;
use crate::solver::run::{Runaway, Stopped};

/// Steps between two searches for blocks that have run dry.
const STEPS_PER_SEARCH: u64 = 64;

impl<P: Physics, E: Element> FastRun<P, E> {
    /// Streaming, mass exchange and conversions of the step whose collision is done.
    pub(in crate::solver::fast) fn surface_pass(&mut self, force: &[f64; 3]) {
        if self.surface.is_none() {
            return;
        }
        self.drop_settled();
        self.spread_flow();
        self.exchange(force);
        self.accelerate();
        self.convert_cells(force);
        self.spread_acceleration();
        if self.step.is_multiple_of(STEPS_PER_SEARCH) {
            self.drop_dry_blocks();
        }
        if let Some(surface) = &mut self.surface {
            surface.open = true;
        }
    }

    /// Records of cells that are liquid by now have done their work.
    fn drop_settled(&mut self) {
        let Some(surface) = &mut self.surface else { return };
        for number in 0..surface.interface.len() {
            let (list, kinds) = (&mut surface.interface[number], &surface.kinds[number]);
            let before = list.len();
            list.retain(|cell| kinds[usize::from(cell.local)] == Kind::Interface);
            if list.len() != before {
                surface.list_lanes(number, E::PER_LINE);
            }
        }
    }

    /// Gives up blocks without fluid.
    fn drop_dry_blocks(&mut self) {
        for number in 0..self.blocks.len() {
            let Some(surface) = &self.surface else { return };
            let dry =
                surface.lanes[number].iter().all(|lane| lane.fluid == 0) && surface.covered[number] == 0;
            if dry && !self.old[number].is_empty() {
                self.give_up(number);
            }
        }
    }

    /// Gives up a block; its number is free for another.
    pub(in crate::solver::fast) fn give_up(&mut self, number: usize) {
        let Some(surface) = &mut self.surface else { return };
        self.layout.set_block(self.blocks[number].place, NONE);
        self.old[number] = Default::default();
        self.new[number] = Default::default();
        for list in [&mut self.density, &mut self.lag, &mut surface.fill, &mut surface.returned] {
            list[number] = Vec::new();
        }
        self.rim[number] = Vec::new();
        if let Some(inertia) = &mut surface.inertia {
            inertia.drop_block(number);
        }
        surface.kinds[number] = Vec::new();
        surface.lanes[number] = Vec::new();
        surface.flow[number] = Vec::new();
        self.blocks[number].clear();
        surface.free.push(number);
    }

    /// Closes the mass of the last step with the densities that this collision found.
    ///
    /// # Errors
    /// It does not close within rounding; the cell named is the interface cell with the largest |m| off
    /// its fill.
    pub(in crate::solver::fast) fn close_last_step(&mut self, outcomes: &[Outcome]) -> Result<(), Stopped> {
        let Some(surface) = &mut self.surface else { return Ok(()) };
        if !std::mem::take(&mut surface.open) {
            return Ok(());
        }
        let mut mass: f64 = outcomes.iter().map(|outcome| outcome.liquid_excess).sum();
        let mut worst = (0, 0, -1.0);
        for (number, list) in surface.interface.iter().enumerate() {
            let mut sum = 0.0;
            for cell in list {
                let local = usize::from(cell.local);
                if surface.kinds[number][local] == Kind::Interface {
                    sum += cell.mass;
                    let off = (cell.mass - surface.fill[number][local]).abs();
                    if off.is_nan() || off > worst.2 {
                        worst = (number, local, if off.is_nan() { f64::INFINITY } else { off });
                    }
                }
            }
            mass += sum;
        }
        mass += surface.counts[0] as f64;
        mass += surface.parked.values().sum::<f64>();
        let cells = surface.counts[0] + surface.counts[1];
        let rounding = self.setup.precision.rounding();
        let Some((residual, bound)) = surface.books.close(mass, cells, rounding) else { return Ok(()) };
        let cell = self.layout.cell(self.blocks[worst.0].origin, worst.1);
        Err(Stopped { step: self.step, cell, what: Runaway::Ledger { residual, bound }, tau: f64::NAN })
    }
}
