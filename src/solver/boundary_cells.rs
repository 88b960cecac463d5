//! Which cells touch a wall, a solid, a mirror plane or an open face, counted before any is stored.

use crate::lattice::C;
use crate::setup::{Face, Setup};

/// Cells that have a link through a wall, a mirror plane or an open face, or into a solid.
#[must_use]
pub fn boundary_cells(setup: &Setup) -> u64 {
    let inner: usize = (0..3)
        .map(|a| {
            let faces = setup.faces[a].iter().filter(|face| **face != Face::Periodic).count();
            setup.extents[a].saturating_sub(faces)
        })
        .product();
    if setup.solids.is_empty() {
        return (setup.cells() - inner) as u64;
    }
    let fluid = (0..setup.cells()).filter(|&cell| !setup.is_solid(cell));
    fluid.filter(|&cell| touches_boundary(setup, cell)).count() as u64
}

pub(crate) fn touches_boundary(setup: &Setup, cell: usize) -> bool {
    let at = setup.coordinates(cell);
    C[1..].iter().any(|c| match neighbour(setup, at, *c) {
        None => true,
        Some(cell) => setup.is_solid(setup.index(cell)),
    })
}

/// Whether a cell is at the free surface at time 0: partly filled, or full with an empty cell next to it along an axis.
pub(crate) fn is_interface(setup: &Setup, cell: usize) -> bool {
    let Some(surface) = &setup.free_surface else { return false };
    let at = setup.coordinates(cell);
    let dry = |c: &[i32; 3]| {
        let near = neighbour(setup, at, *c).map(|near| setup.index(near));
        near.is_some_and(|near| !setup.is_solid(near) && surface.fill[near] <= 0.0)
    };
    let fill = surface.fill[cell];
    fill > 0.0 && (fill < 1.0 || C[1..7].iter().any(dry))
}

/// The cell at an offset of at most one cell along each axis, through periodic faces; `None` beyond others.
pub(crate) fn neighbour(setup: &Setup, at: [usize; 3], offset: [i32; 3]) -> Option<[usize; 3]> {
    let mut cell = at;
    for axis in 0..3 {
        let n = setup.extents[axis];
        let side = usize::from(offset[axis] > 0);
        cell[axis] = match offset[axis] {
            0 => continue,
            1 if at[axis] + 1 < n => at[axis] + 1,
            -1 if at[axis] > 0 => at[axis] - 1,
            _ if setup.faces[axis][side] != Face::Periodic => return None,
            1 => 0,
            _ => n - 1,
        };
    }
    Some(cell)
}
