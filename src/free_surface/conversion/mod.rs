//! Conversions between gas, interface and liquid, and where their excess mass goes \[F4\] \[F6\], for any
//! backend.

mod cells;
pub mod excess;
mod hand_on;
mod refill;
mod verdict;

use std::collections::{BTreeMap, BTreeSet};

use crate::free_surface::Kind;
use crate::free_surface::ledger::VectorSum;
use crate::free_surface::marks::Mark;
use crate::lattice::Q;
use crate::lattice::moments::{density_excess, momentum};
use crate::setup::FreeSurface;
pub use cells::{Cells, touch};
use hand_on::{hand_on, move_parked, take_excess};
use refill::refill;
pub use refill::{Neighbourhood, mirrored, neighbourhood};
pub(crate) use verdict::verdict;

/// Populations of one cell, f − w.
type Cell = [f64; Q];

/// What conversions did to the ledger.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Turnover {
    /// Momentum of cells that became fluid less that of cells that became gas.
    pub momentum: VectorSum,
    /// Cells that changed kind.
    pub conversions: u64,
    /// Parked mass that left through an open face.
    pub outflow: f64,
}

/// φ of an interface cell from its mass: m/ρ limited to 0..1.
#[must_use]
pub(crate) fn fill_of(mass: f64, rho: f64) -> f64 {
    let fill = mass / rho;
    if fill > 1.0 {
        1.0
    } else if fill > 0.0 {
        fill
    } else {
        0.0
    }
}

/// Conversions, refill and excess of one step. `marks`: interface cells that fill or empty, before
/// reverting. `parked`: excess without receiver, by cell.
pub(crate) fn convert(
    cells: &mut impl Cells,
    rules: &FreeSurface,
    marks: &BTreeMap<u32, Mark>,
    parked: &mut BTreeMap<u32, f64>,
    (step, force): (u64, &[f64; 3]),
) -> Turnover {
    let mut turnover = Turnover::default();
    let (filled, emptied) = surviving(cells, marks);
    // Gas next to a filling cell, liquid next to an emptying one: both become interface.
    let wetted = around(cells, &filled, Kind::Gas);
    let exposed = around(cells, &emptied, Kind::Liquid);
    let refilled: Vec<Cell> = wetted.iter().map(|&cell| refill(cells, rules, cell as usize)).collect();
    let excess = take_excess(cells, rules, parked, &filled, &emptied);
    for &cell in &filled {
        cells.fill_up(cell as usize);
    }
    for &cell in &emptied {
        turnover.momentum.add(&momentum(&cells.populations(cell as usize)).map(|p| -p));
        cells.empty(cell as usize);
    }
    for &cell in &exposed {
        let mass = 1.0 + density_excess(&cells.populations(cell as usize));
        cells.expose(cell as usize, mass);
    }
    turnover.conversions = (filled.len() + emptied.len() + wetted.len() + exposed.len()) as u64;
    for (&cell, populations) in wetted.iter().zip(&refilled) {
        cells.wet(cell as usize, populations);
        turnover.momentum.add(&momentum(populations));
    }
    turnover.outflow = move_parked(cells, parked, step, force);
    hand_on(cells, parked, &excess);
    turnover
}

fn around(cells: &impl Cells, centres: &BTreeSet<u32>, kind: Kind) -> BTreeSet<u32> {
    let neighbours = |&cell: &u32| (1..Q).filter_map(move |i| cells.neighbour_along(cell as usize, i));
    centres.iter().flat_map(neighbours).filter(|&n| cells.kind(n) == kind).map(|n| n as u32).collect()
}

/// Cells that fill, and those that empty without a filling neighbour.
fn surviving(cells: &impl Cells, marks: &BTreeMap<u32, Mark>) -> (BTreeSet<u32>, BTreeSet<u32>) {
    let fills = |cell: u32| marks.get(&cell) == Some(&Mark::Fill);
    let filled = marks.keys().copied().filter(|&cell| fills(cell)).collect();
    let reverts =
        |cell: u32| (1..Q).any(|i| cells.neighbour_along(cell as usize, i).is_some_and(|n| fills(n as u32)));
    let emptied = marks.keys().copied().filter(|&cell| !fills(cell) && !reverts(cell)).collect();
    (filled, emptied)
}

#[cfg(test)]
mod tests;
