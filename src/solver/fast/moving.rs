//! Walls and solids whose velocities change in time.

use super::block::Origin;
use super::element::Element;
use super::run::FastRun;
use crate::boundary::links::{Source, boundary_cell_at};
use crate::setup::course::Factors;
use crate::solver::physics::Physics;

impl<P: Physics, E: Element> FastRun<P, E> {
    /// Gives walls and solids the velocities of this step, where they change in time. The collision before it has
    /// streamed the links of the last step.
    pub(super) fn move_walls(&mut self) {
        if !self.setup.courses.vary() {
            return;
        }
        let factors = Factors::at(&self.setup, self.step);
        self.hand_over.move_solids(&factors);
        for block in &mut self.blocks {
            for at in 0..block.rim.len() {
                let local = usize::from(block.rim[at].local);
                let cell = self.setup.index(self.layout.cell(block.origin, local));
                let Some(now) = boundary_cell_at(&self.setup, &factors, cell) else { continue };
                block.rim[at].drag = now.drag;
                for link in block.links_of_cell(local, E::PER_LINE) {
                    if let Origin::Wall { velocity: number, .. } = link.from
                        && let Source::Wall { velocity, .. } = now.sources[usize::from(link.direction)]
                    {
                        self.velocities.list[number as usize] = velocity;
                    }
                }
            }
        }
    }
}
