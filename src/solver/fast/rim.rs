//! Cells at walls and open faces: what is kept of their last collision, and the wall correction \[B3\].

use super::block::{Block, Place, RimCell};
use super::instructions::{self, Chosen};
use super::layout::{Layout, NONE};
use super::registers::Registers;
use super::stage::MOST;
use crate::boundary::wall_slip::pressure_slope;
use crate::lattice::Q;
use crate::lattice::moments::density_excess;
use crate::lattice::unroll::{directions, three};
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

/// What a correction takes from around its cell.
struct Given {
    /// Body force.
    force: [f64; 3],
    /// F − ∇p.
    residual: [f64; 3],
}

/// Cells that are corrected together: as many as the widest register holds.
const GROUP: usize = 8;

/// What the cells of a group have in common.
pub struct Alike<'a> {
    count: usize,
    walls: u32,
    normal: &'a [f64; 3],
    fluid: u8,
}

/// Cells side by side: one number per lane.
#[repr(align(64))]
pub struct Columns {
    f: [[f64; MOST]; Q],
    force: [[f64; MOST]; 3],
    residual: [[f64; MOST]; 3],
    omega: [f64; MOST],
}

/// Corrections of the rim cells of a block: neighbours along the rim with the same walls side by side.
/// `force(local)`: body force of a fluid cell, `None` if the cell holds no fluid; `is_fluid(place)`: whether a
/// neighbour does.
pub fn correct<P: Physics>(
    chosen: Chosen,
    task: &WallTask<P>,
    block: &Block,
    rim: &mut [Rim],
    force: &impl Fn(usize) -> Option<[f64; 3]>,
    is_fluid: &impl Fn(Place) -> bool,
) {
    let zeros = [0.0; MOST];
    let mut columns = Columns { f: [zeros; Q], force: [zeros; 3], residual: [zeros; 3], omega: zeros };
    let mut group = [0; MOST];
    let mut at = 0;
    while at < rim.len() {
        let mut count = 0;
        while count < GROUP && at < rim.len() {
            let cell = &block.rim[at];
            if count > 0 && !alike(block, &block.rim[group[0]], cell) {
                break;
            }
            if cell.walls != 0
                && let Some(given) = given(task, cell, &rim[at], force, is_fluid)
            {
                columns.put(count, &rim[at], &given);
                group[count] = at;
                count += 1;
            }
            at += 1;
        }
        if count > 0 {
            let cell = &block.rim[group[0]];
            let alike =
                Alike { count, walls: cell.walls, normal: &cell.normal, fluid: fluid_of(block, cell) };
            instructions::walls(chosen, task, &mut columns, &alike);
            for (lane, &at) in group[..count].iter().enumerate() {
                for (value, column) in rim[at].correction.iter_mut().zip(&columns.f) {
                    *value = column[lane];
                }
            }
        }
    }
}

/// Whether two cells have the same walls and fluid.
fn alike(block: &Block, a: &RimCell, b: &RimCell) -> bool {
    a.walls == b.walls && a.normal == b.normal && fluid_of(block, a) == fluid_of(block, b)
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
    is_fluid: &impl Fn(Place) -> bool,
) -> Option<Given> {
    let force = force(usize::from(cell.local))?;
    let density = |place: Option<Place>| {
        let place = place.filter(|&place| is_fluid(place))?;
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

impl Columns {
    fn put(&mut self, lane: usize, kept: &Rim, given: &Given) {
        for (column, f) in self.f.iter_mut().zip(&kept.f) {
            column[lane] = *f;
        }
        for a in 0..3 {
            self.force[a][lane] = given.force[a];
            self.residual[a][lane] = given.residual[a];
        }
        self.omega[lane] = kept.omega;
    }

    /// Puts the corrections in the place of the populations.
    #[inline(always)]
    fn correct<R: Registers<Element = f64>, P: Physics>(&mut self, task: &WallTask<P>, alike: &Alike) {
        for part in (0..alike.count).step_by(R::WIDTH) {
            let h = directions(
                #[inline(always)]
                |i| R::load_wide(&self.f[i][part..]),
            );
            let force = three(
                #[inline(always)]
                |a| R::load_wide(&self.force[a][part..]),
            );
            let residual = three(
                #[inline(always)]
                |a| R::load_wide(&self.residual[a][part..]),
            );
            let omega = R::load_wide(&self.omega[part..]);
            let state = State { m: task.physics.moments(&h, &force), omega };
            let (sourced, limited) = (task.sourced, task.limited);
            let situation = Situation { residual, fluid: alike.fluid, sourced, limited };
            let correction = wall_correction(task.physics, alike.walls, alike.normal, &h, &state, &situation);
            for i in 0..Q {
                R::store_wide(correction[i], &mut self.f[i][part..]);
            }
        }
    }
}

/// Corrections of cells side by side, for one instruction set; see [`instructions::walls`].
#[inline(always)]
pub fn correct_group<R: Registers<Element = f64>, P: Physics>(
    task: &WallTask<P>,
    columns: &mut Columns,
    alike: &Alike,
) {
    columns.correct::<R, P>(task, alike);
}
