//! Wall corrections of a block \[B3\].

use super::block::{Block, Place, RimCell};
use super::element::MOST;
use super::instructions::{self, Chosen};
use super::layout::NONE;
use super::rim::{Alike, Columns, Given, Rim, WallTask};
use crate::boundary::wall_slip::pressure_slope;
use crate::lattice::Q;
use crate::lattice::moments::density_excess;
use crate::solver::physics::Physics;

/// Cells that are corrected together: as many as the widest register holds.
const GROUP: usize = 8;

/// Corrections of the rim cells of a block: neighbours along the rim with the same walls side by side.
/// `force(local)`: body force of a fluid cell, `None` if the cell holds no fluid; `is_full(local)`:
/// whether it is no interface cell; `is_liquid(place)`: whether a neighbour is full of
/// fluid: the densities of interface cells are those of the gas, not of a hydrostatic pressure.
pub(crate) fn correct<P: Physics>(
    chosen: Chosen,
    task: &WallTask<P>,
    block: &Block,
    rim: &mut [Rim],
    force: &impl Fn(usize) -> Option<[f64; 3]>,
    is_full: &impl Fn(usize) -> bool,
    is_liquid: &impl Fn(Place) -> bool,
) {
    let mut columns = Columns::new();
    let mut group = [0; MOST];
    let mut flat = None;
    let mut at = 0;
    while at < rim.len() {
        let mut count = 0;
        while count < GROUP && at < rim.len() {
            let cell = &block.rim[at];
            let local = usize::from(cell.local);
            let force = if cell.walls == 0 { None } else { force(local) };
            let full = force.is_some() && is_full(local);
            if full && cell.cut.is_some() {
                // Cut links are not corrected [B4].
                rim[at].correction = [0.0; Q];
            } else if let Some(force) = force {
                let wall = cell.flat.filter(|_| full);
                if count == 0 {
                    flat = wall;
                } else if wall != flat || !alike(block, &block.rim[group[0]], cell) {
                    break;
                }
                columns.put(count, &rim[at], &given(task, cell, &rim[at], force, is_liquid), &cell.drag);
                group[count] = at;
                count += 1;
            }
            at += 1;
        }
        if count > 0 {
            let cell = &block.rim[group[0]];
            let alike = Alike { count, walls: cell.walls, flat, fluid: fluid_of(block, cell) };
            instructions::walls(chosen, task, &mut columns, &alike);
            for (lane, &at) in group[..count].iter().enumerate() {
                columns.take(lane, &mut rim[at]);
            }
        }
    }
}

/// Whether two cells have the same walls and fluid.
fn alike(block: &Block, a: &RimCell, b: &RimCell) -> bool {
    a.walls == b.walls && fluid_of(block, a) == fluid_of(block, b)
}

fn fluid_of(block: &Block, cell: &RimCell) -> u8 {
    block.fluid.get(usize::from(cell.local)).copied().unwrap_or(0)
}

/// Force and residual force of a cell that holds fluid.
#[inline]
fn given<P>(
    task: &WallTask<P>,
    cell: &RimCell,
    kept: &Rim,
    force: [f64; 3],
    is_liquid: &impl Fn(Place) -> bool,
) -> Given {
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
    Given { force, residual }
}
