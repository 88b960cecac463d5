//! Which interface cells fill or empty \[F4\].

use super::cells::{Cells, touch};
use super::hand_on::STEPS_PER_MOVE;
use crate::boundary::links::Source;
use crate::free_surface::Kind;
use crate::free_surface::hold::Span;
use crate::free_surface::marks::{Mark, Touches, mark};
use crate::lattice::moments::momentum;
use crate::lattice::{C, Q};
use crate::setup::FreeSurface;

/// Verdict on an interface cell \[F4\].
pub(crate) fn verdict(cells: &impl Cells, rules: &FreeSurface, cell: usize, rho: f64) -> Mark {
    let bits = cells.touches(cell);
    let touches = Touches {
        gas: bits & touch::GAS != 0,
        liquid: bits & touch::LIQUID != 0,
        held: is_held(cells, cell, bits, rho),
    };
    mark(cells.mass(cell), rho, touches, rules.margin, rules.lonely_margin)
}

/// Whether an interface cell touches a wall, or an interface cell other than itself that touches liquid or a wall;
/// and its links hold it: beside them it is no faster than parked mass falls. Where it touches liquid the answer is
/// not needed and `true`.
fn is_held(cells: &impl Cells, cell: usize, bits: u8, rho: f64) -> bool {
    if bits & touch::LIQUID != 0 {
        return true;
    }
    let firm = touch::LIQUID | touch::WALL;
    let through = |i| {
        cells
            .neighbour_along(cell, i)
            .is_some_and(|n| n != cell && cells.kind(n) == Kind::Interface && cells.touches(n) & firm != 0)
    };
    if bits & touch::WALL == 0 && !(1..Q).any(through) {
        return false;
    }
    let u = momentum(&cells.populations(cell)).map(|p| p / rho);
    // Slow cells, nearly all, need no look at their links.
    let speed2 = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    let limit = 1.0 / STEPS_PER_MOVE as f64;
    // What is not a number is left to the guard.
    let escapes = speed2 > limit * limit && span(cells, cell).beside(&u) > limit;
    !escapes
}

/// What the links of a cell to walls, solids and fluid span; a mirror plane holds along its normal.
fn span(cells: &impl Cells, cell: usize) -> Span {
    let mut span = Span::default();
    for i in 1..Q {
        match cells.source(cell, i) {
            Source::Wall { .. } => span.add(C[i]),
            Source::Cell { cell: n, direction } => {
                let n = n as usize;
                let turned: [i32; 3] = std::array::from_fn(|a| C[i][a] - C[usize::from(direction)][a]);
                if n == cell {
                    span.add(turned);
                } else if cells.kind(n) != Kind::Gas {
                    span.add(C[i]);
                    span.add(turned);
                }
            }
            Source::Open => {}
        }
        if span.is_full() {
            break;
        }
    }
    span
}
