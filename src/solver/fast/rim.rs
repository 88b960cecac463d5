//! Cells at walls and open faces: what is kept of their last collision, and the wall correction \[B3\].

use super::block::{Block, Place};
use super::layout::{Layout, NONE};
use crate::boundary::wall_slip::pressure_slope;
use crate::lattice::Q;
use crate::lattice::moments::density_excess;
use crate::solver::physics::Physics;
use crate::solver::plain::cell::{Situation, State, wall_correction};

/// What is kept of a cell at a wall or open face.
#[derive(Clone, Debug)]
pub struct Rim {
    /// Populations before the last collision.
    pub f: [f64; Q],
    /// What the wall subtracts from the populations that leave \[B3\].
    pub correction: [f64; Q],
    /// u of the last collision.
    pub velocity: [f64; 3],
    /// ω⁺ of the last collision.
    pub omega: f64,
}

impl Default for Rim {
    fn default() -> Self {
        Self { f: [0.0; Q], correction: [0.0; Q], velocity: [0.0; 3], omega: 0.0 }
    }
}

/// What the corrections of a block depend on.
pub struct WallTask<'a, P> {
    pub physics: &'a P,
    pub layout: &'a Layout,
    /// ρ − 1 before the last collision, by block and cell.
    pub density: &'a [Vec<f64>],
    /// \[K6\].
    pub sourced: bool,
    /// Below a free surface.
    pub limited: bool,
}

/// Corrections of the rim cells of a block. `force(local)`: body force of a fluid cell, `None` if the cell
/// holds no fluid; `is_fluid(place)`: whether a neighbour does.
pub fn correct<P: Physics>(
    task: &WallTask<P>,
    block: &Block,
    rim: &mut [Rim],
    force: impl Fn(usize) -> Option<[f64; 3]>,
    is_fluid: impl Fn(Place) -> bool,
) {
    for (cell, kept) in block.rim.iter().zip(rim) {
        let local = usize::from(cell.local);
        if cell.walls == 0 {
            continue;
        }
        let Some(force) = force(local) else { continue };
        let density = |place: Option<Place>| {
            let place = place.filter(|&place| is_fluid(place))?;
            match task.layout.block_at(place.block as usize) {
                NONE => None,
                number => task.density[number as usize].get(place.local as usize).copied(),
            }
        };
        let own = density_excess(&kept.f);
        let residual = std::array::from_fn(|axis| {
            let [low, high] = cell.neighbours[axis].map(density);
            force[axis] - pressure_slope(low, own, high)
        });
        let fluid = block.fluid.get(local).copied().unwrap_or(0);
        let state = State { m: task.physics.moments(&kept.f, &force), omega: kept.omega };
        let situation = Situation { residual, fluid, sourced: task.sourced, limited: task.limited };
        kept.correction =
            wall_correction(task.physics, cell.walls, &cell.normal, &kept.f, &state, &situation);
    }
}
