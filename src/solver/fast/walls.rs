//! Wall corrections of a block \[B3\].

use super::block::{Block, Place, RimCell};
use super::element::MOST;
use super::instructions::{self, Chosen};
use super::layout::NONE;
use super::rim::{Alike, Columns, Given, Rim, WallTask};
use crate::boundary::wall_slip::pressure_slope;
use crate::lattice::moments::density_excess;
use crate::solver::cut_law::Memory;
use crate::solver::physics::Physics;

/// Cells that are corrected together: as many as the widest register holds.
const GROUP: usize = 8;

/// What is kept of the rim cells of a block.
pub(crate) struct Kept<'a> {
    /// All of them.
    pub rim: &'a mut [Rim],
    /// Of those that surfaces cut.
    pub memory: &'a mut [Memory],
}

/// Corrections of the rim cells of a block: neighbours along the rim with the same walls side by side.
/// `force(local)`: body force of a fluid cell, `None` if the cell holds no fluid; `is_full(local)`:
/// whether it is no interface cell; `is_liquid(place)`: whether a neighbour is full of
/// fluid: the densities of interface cells are those of the gas, not of a hydrostatic pressure.
pub(crate) fn correct<P: Physics>(
    chosen: Chosen,
    task: &WallTask<P>,
    block: &Block,
    kept: &mut Kept,
    force: &impl Fn(usize) -> Option<[f64; 3]>,
    is_full: &impl Fn(usize) -> bool,
    is_liquid: &impl Fn(Place) -> bool,
) {
    let Kept { rim, memory } = kept;
    let mut columns = Columns::new();
    let mut group = [0; MOST];
    let (mut flat, mut cut) = (None, false);
    let mut at = 0;
    while at < rim.len() {
        let mut count = 0;
        while count < GROUP && at < rim.len() {
            let cell = &block.rim[at];
            let place = cell.cut.map(usize::from);
            let given = if cell.walls == 0 { None } else { given(task, cell, &rim[at], force, is_liquid) };
            let full = given.is_some() && is_full(usize::from(cell.local));
            if let Some(memory) = place.filter(|_| !full).and_then(|place| memory.get_mut(place)) {
                *memory = [0.0; 4];
            }
            if let Some(given) = given {
                let (wall, shape) = (cell.flat.filter(|_| full), place.filter(|_| full));
                if count == 0 {
                    (flat, cut) = (wall, shape.is_some());
                } else if wall != flat
                    || shape.is_some() != cut
                    || !alike(block, &block.rim[group[0]], cell, cut)
                {
                    break;
                }
                columns.put(count, &rim[at], &given, &cell.drag);
                if let Some(place) = shape {
                    columns.put_cut(count, &block.cuts.cells[place].shape, &memory[place]);
                }
                group[count] = at;
                count += 1;
            }
            at += 1;
        }
        if count > 0 {
            let cell = &block.rim[group[0]];
            let alike = Alike { count, walls: cell.walls, flat, cut, fluid: fluid_of(block, cell) };
            instructions::walls(chosen, task, &mut columns, &alike);
            for (lane, &at) in group[..count].iter().enumerate() {
                columns.take(lane, &mut rim[at]);
                if let Some(place) = block.rim[at].cut.filter(|_| cut) {
                    memory[usize::from(place)] = columns.memory_of(lane);
                }
            }
        }
    }
}

/// Whether two cells have the same walls and fluid; `cut`: cut cells bring their walls with their shares.
fn alike(block: &Block, a: &RimCell, b: &RimCell, cut: bool) -> bool {
    (cut || a.walls == b.walls) && fluid_of(block, a) == fluid_of(block, b)
}

fn fluid_of(block: &Block, cell: &RimCell) -> u8 {
    block.fluid.get(usize::from(cell.local)).copied().unwrap_or(0)
}

/// Force and residual force of a cell; `None` where it holds no fluid.
#[inline]
fn given<P>(
    task: &WallTask<P>,
    cell: &RimCell,
    kept: &Rim,
    force: &impl Fn(usize) -> Option<[f64; 3]>,
    is_liquid: &impl Fn(Place) -> bool,
) -> Option<Given> {
    let force = force(usize::from(cell.local))?;
    let density = |place: Option<Place>| {
        let place = place.filter(|&place| is_liquid(place))?;
        match task.layout.block_at(place.block as usize) {
            NONE => None,
            number => task.density[number as usize].get(place.local as usize).copied(),
        }
    };
    let own = density_excess(&kept.f);
    let mut residual = force;
    for (f, sides) in residual.iter_mut().zip(&cell.neighbours) {
        *f -= pressure_slope(density(sides[0]), own, density(sides[1]));
    }
    Some(Given { force, residual })
}
