//! Puts the numbers of interface cells where their neighbours look for them, see [`super::flow`].

use super::flow::{CARRIED, Flow, NUMBERS};
use super::record::InterfaceCell;
use super::streaming::Streaming;
use crate::lattice::moments::density_excess;
use crate::solver::fast::block::numbers_around;
use crate::solver::fast::element::Element;
use crate::solver::fast::layout::NONE;
use crate::solver::fast::links::after;
use crate::solver::fast::run::FastRun;
use crate::solver::physics::Physics;
use crate::solver::pool::each;

impl<P: Physics, E: Element> FastRun<P, E> {
    /// Puts the numbers of all interface cells where their neighbours look for them.
    pub(super) fn spread_flow(&mut self) {
        let Some(surface) = &mut self.surface else { return };
        let mut flow = std::mem::take(&mut surface.flow);
        let Some(surface) = &self.surface else { return };
        let items: Vec<_> = flow.iter_mut().zip(&surface.interface).enumerate().collect();
        each(
            self.pool.as_deref(),
            items,
            |(number, (flow, list)): (usize, (&mut Flow, &Vec<InterfaceCell>))| {
                if list.is_empty() {
                    *flow = Vec::new();
                } else {
                    flow.resize(NUMBERS * self.layout.block_cells(), 0.0);
                    self.fill_flow(number, list, flow);
                }
            },
        );
        if let Some(surface) = &mut self.surface {
            surface.flow = flow;
        }
    }

    fn fill_flow(&self, number: usize, list: &[InterfaceCell], flow: &mut [f64]) {
        let Some(surface) = &self.surface else { return };
        let task = self.task([0.0; 3]);
        let block = &self.blocks[number];
        let cells = self.layout.block_cells();
        let around = numbers_around(&self.layout, block.place);
        let streaming = Streaming { task: &task, surface, rim: &self.rim[number], block, number, around };
        let pack_of = |cell: &InterfaceCell| usize::from(cell.local) / E::PER_LINE;
        let mut packs: Vec<usize> = list.iter().map(pack_of).collect();
        packs.dedup();
        let apart = self.sources.is_empty() || streaming.among_grains();
        if !apart {
            let fill = around.map(|n| match n {
                NONE => surface.nothing.as_slice(),
                n => surface.fill[n as usize].as_slice(),
            });
            (self.passes.carry)(self.chosen, &fill, &self.sources, &packs, &mut flow[CARRIED * cells..]);
        }
        for cell in list {
            let local = usize::from(cell.local);
            flow[local] = density_excess(&after(&task, number, local));
            for (a, u) in cell.velocity.iter().enumerate() {
                flow[(1 + a) * cells + local] = *u;
            }
            if apart || !block.links_of_cell(local, E::PER_LINE).is_empty() {
                flow[CARRIED * cells + local] = streaming.carried(local);
            }
        }
    }
}
