//! Streaming and mass exchange of all interface cells \[F1\] \[F2\] \[F8\].

use super::packed::Near;
use super::record::InterfaceCell;
use super::state::Surface;
use super::streaming::Streaming;
use crate::free_surface::conversion::touch;
use crate::free_surface::ledger::VectorSum;
use crate::free_surface::voids;
use crate::lattice::moments::density_excess;
use crate::solver::books::Entries;
use crate::solver::fast::block::numbers_around;
use crate::solver::fast::element::Element;
use crate::solver::fast::layout::NONE;
use crate::solver::fast::run::FastRun;
use crate::solver::physics::Physics;
use crate::solver::pool::each;

/// What a block brought in.
struct Brought {
    entries: Entries,
    force: VectorSum,
}

impl<P: Physics, E: Element> FastRun<P, E> {
    /// Streams interface cells and books all links that bring something in.
    pub(super) fn exchange(&mut self, force: &[f64; 3]) {
        let Some(surface) = &mut self.surface else { return };
        let mut interface = std::mem::take(&mut surface.interface);
        let mut returned = std::mem::take(&mut surface.returned);
        let solids = surface.loads.len();
        let task = self.task(*force);
        let Some(surface) = &self.surface else { return };
        let items: Vec<_> = interface.iter_mut().zip(&mut returned).enumerate().collect();
        let brought = each(self.pool.as_deref(), items, |(number, (list, returned))| {
            let mut brought = Brought { entries: Entries::new(solids), force: VectorSum::default() };
            let block = &self.blocks[number];
            if self.old[number].is_empty() || (list.is_empty() && block.links.is_empty()) {
                return brought;
            }
            let around = numbers_around(&self.layout, block.place);
            let rim = &self.rim[number];
            let streaming = Streaming { task: &task, surface, rim, block, number, around };
            for cell in list.iter() {
                brought.force.add(&surface.view().force_of(number, cell, force));
            }
            if !list.is_empty() {
                let fill = around.map(|n| match n {
                    NONE => surface.nothing.as_slice(),
                    n => surface.fill[n as usize].as_slice(),
                });
                let flow = std::array::from_fn(|k| around.map(|n| surface.flow_of(n, k)));
                let near = Near { populations: task.around(number), fill, flow };
                (self.passes.exchange)(self.chosen, &streaming, &near, list, &mut brought.entries);
                list.iter_mut().for_each(|cell| close_void(cell, near.fill[13]));
            }
            streaming.book_liquid(returned, &mut brought.entries);
            brought
        });
        let Some(surface) = &mut self.surface else { return };
        surface.interface = interface;
        surface.returned = returned;
        let mut entries = Entries::new(solids);
        for part in &brought {
            entries.merge(&part.entries);
            surface.books.from_force.merge(&part.force);
        }
        surface.books.from_force.add_times(force, surface.counts[0]);
        surface.books.enter(&entries, &mut surface.loads);
    }
}

/// A partly filled cell without gas neighbour gives up density \[F8\]; `fill`: φ of the block.
fn close_void(cell: &mut InterfaceCell, fill: &[f64]) {
    if cell.touches & touch::GAS == 0 {
        let density = voids::sink(fill[usize::from(cell.local)], density_excess(&cell.f));
        voids::give_up(&mut cell.f, density);
        cell.rho = 1.0 + density_excess(&cell.f);
    }
}

impl Surface {
    /// One of the numbers ([`super::flow`]) of every cell of a block; any numbers where it has no interface cells.
    fn flow_of(&self, number: u32, k: usize) -> &[f64] {
        let cells = self.nothing.len();
        match number {
            NONE => &self.nothing,
            n => self.flow[n as usize].get(k * cells..(k + 1) * cells).unwrap_or(&self.nothing),
        }
    }
}
