//! What moving solids made of stairs hand along their surfaces \[B1\], cell by cell of a block.

use super::element::Element;
use super::layout::NONE;
use super::task::{Task, after};
use crate::boundary::hand_over::Record;
use crate::lattice::moments::density_excess;
use crate::solver::books::mass_handed;

/// (ρM − G)/Σw of a cell at a solid, see [`HandOver::raise`](crate::boundary::hand_over::HandOver::raise); `None` at faces of the box and solids at rest.
#[inline]
pub(crate) fn raise<P, E: Element>(task: &Task<P, E>, number: usize, local: usize, body: u8) -> Option<f64> {
    if body == 0 || task.hand_over.is_empty() {
        return None;
    }
    let record = task.hand_over.at(task.cell(number, local), body)?;
    let rho = 1.0 + density_excess(&after(task, number, local));
    Some(task.hand_over.raise(record, rho, given(task, record)))
}

/// Mass that goes to the neighbours that hold fluid.
fn given<P, E: Element>(task: &Task<P, E>, record: &Record) -> f64 {
    let Some(surface) = &task.surface else { return record.all() };
    task.hand_over.given(record, |cell| match task.find(cell) {
        Some((number, local)) => surface.kinds[number][local].is_fluid(),
        None => false,
    })
}

/// Mass that an interface cell hands to its neighbours; `share(number, local)`: A of the link to a cell \[F1\].
pub(crate) fn handed<P, E: Element>(
    task: &Task<P, E>,
    number: usize,
    local: usize,
    share: impl Fn(usize, usize) -> f64,
) -> f64 {
    if task.hand_over.is_empty() {
        return 0.0;
    }
    mass_handed(task.hand_over, task.cell(number, local), |cell| {
        task.find(cell).map_or(0.0, |(number, local)| share(number, local))
    })
}

impl<P, E: Element> Task<'_, P, E> {
    /// Number in the box of a cell of a block.
    fn cell(&self, number: usize, local: usize) -> usize {
        self.setup.index(self.layout.cell(self.blocks[number].origin, local))
    }

    /// Block and place of a cell of the box; `None` where there is no block.
    fn find(&self, cell: usize) -> Option<(usize, usize)> {
        let (place, local) = self.layout.find(self.setup.coordinates(cell));
        match self.layout.block_at(place) {
            NONE => None,
            number => Some((number as usize, local)),
        }
    }
}
