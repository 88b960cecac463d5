//! Cells at walls and open faces: what is kept of their last collision, and the wall correction \[B3\].

use super::element::MOST;
use super::layout::Layout;
use super::registers::Registers;
use crate::boundary::flat_wall::FlatWall;
use crate::boundary::wall_slip::largest_gain;
use crate::lattice::Q;
use crate::lattice::unroll::{directions, three};
use crate::rheology::Law;
use crate::solver::cell::{Situation, State, wall_correction};
use crate::solver::physics::Physics;
use crate::state::state;

/// What is kept of a cell at a wall or open face.
#[derive(Clone, Debug)]
pub(crate) struct Rim {
    /// Populations before the last collision.
    pub f: [f64; Q],
    /// What the wall subtracts from the populations that leave \[B3\].
    pub correction: [f64; Q],
    /// u of the last collision.
    pub velocity: [f64; 3],
    /// ω⁺ of the last collision.
    pub omega: f64,
}

state!(Rim: f correction velocity omega);

impl Default for Rim {
    fn default() -> Self {
        Self { f: [0.0; Q], correction: [0.0; Q], velocity: [0.0; 3], omega: 0.0 }
    }
}

/// What the corrections of a block depend on.
pub(crate) struct WallTask<'a, P> {
    /// Equations.
    pub physics: &'a P,
    /// Which block is where.
    pub layout: &'a Layout,
    /// ρ − 1 before the last collision, by block and cell.
    pub density: &'a [Vec<f64>],
    /// \[K6\].
    pub sourced: bool,
    /// The body force where there is a surface.
    pub weight: Option<[f64; 3]>,
    /// The laws, by fluid number.
    pub laws: &'a [Law],
}

/// What a correction takes from around its cell.
pub(crate) struct Given {
    /// Body force.
    pub force: [f64; 3],
    /// F − ∇p.
    pub residual: [f64; 3],
}

/// What the cells of a group have in common.
pub(crate) struct Alike {
    /// Cells of the group.
    pub count: usize,
    /// Directions that lead into walls, one bit each.
    pub walls: u32,
    /// The wall, where the law by stress acts.
    pub flat: Option<FlatWall>,
    /// Number of the fluid.
    pub fluid: u8,
}

/// Cells side by side: one number per lane.
#[repr(align(64))]
pub(crate) struct Columns {
    f: [[f64; MOST]; Q],
    force: [[f64; MOST]; 3],
    residual: [[f64; MOST]; 3],
    drag: [[f64; MOST]; 3],
    omega: [f64; MOST],
}

impl Columns {
    /// Zeros.
    #[must_use]
    pub fn new() -> Self {
        let zeros = [0.0; MOST];
        Self { f: [zeros; Q], force: [zeros; 3], residual: [zeros; 3], drag: [zeros; 3], omega: zeros }
    }

    /// A cell into a lane.
    pub(crate) fn put(&mut self, lane: usize, kept: &Rim, given: &Given, drag: &[f64; 3]) {
        for (column, f) in self.f.iter_mut().zip(&kept.f) {
            column[lane] = *f;
        }
        for a in 0..3 {
            self.force[a][lane] = given.force[a];
            self.residual[a][lane] = given.residual[a];
            self.drag[a][lane] = drag[a];
        }
        self.omega[lane] = kept.omega;
    }

    /// The correction of a lane.
    pub(crate) fn take(&self, lane: usize, kept: &mut Rim) {
        for (value, column) in kept.correction.iter_mut().zip(&self.f) {
            *value = column[lane];
        }
    }

    /// Puts the corrections in the place of the populations.
    #[inline(always)]
    fn correct<R: Registers<Element = f64>, P: Physics>(&mut self, task: &WallTask<P>, alike: &Alike) {
        for part in (0..alike.count).step_by(R::WIDTH) {
            let h = directions(
                #[inline(always)]
                |i| R::load_wide(&self.f[i][part..]),
            );
            let load = |columns: &[[f64; MOST]; 3]| {
                three(
                    #[inline(always)]
                    |a| R::load_wide(&columns[a][part..]),
                )
            };
            let state = State {
                m: task.physics.moments(&h, &load(&self.force)),
                omega: R::load_wide(&self.omega[part..]),
            };
            let situation = Situation {
                residual: load(&self.residual),
                drag: load(&self.drag),
                fluid: alike.fluid,
                sourced: task.sourced,
                gain: largest_gain(task.weight.as_ref(), &task.laws[usize::from(alike.fluid)], alike.flat),
                walls: alike.walls,
                flat: alike.flat,
            };
            let correction = wall_correction(task.physics, &h, &state, &situation);
            for i in 0..Q {
                R::store_wide(correction[i], &mut self.f[i][part..]);
            }
        }
    }
}

impl Default for Columns {
    fn default() -> Self {
        Self::new()
    }
}

/// Corrections of cells side by side, for one instruction set; see [`super::instructions::walls`].
#[inline(always)]
pub(crate) fn correct_group<R: Registers<Element = f64>, P: Physics>(
    task: &WallTask<P>,
    columns: &mut Columns,
    alike: &Alike,
) {
    columns.correct::<R, P>(task, alike);
}
