//! Cells at walls and open faces: what is kept of their last collision, and the wall correction \[B3\].

use super::element::MOST;
use super::layout::Layout;
use super::registers::Registers;
use crate::boundary::flat_wall::FlatWall;
use crate::lane::Lane;
use crate::lattice::Q;
use crate::lattice::unroll::{directions, six, three};
use crate::solver::cell::{Situation, State, wall_correction};
use crate::solver::cut_law::{CutShape, Memory, cut_correction};
use crate::solver::physics::Physics;

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
    /// Whether cut links are corrected, and whether by the law by stress.
    pub cut: [bool; 2],
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
    /// Whether surfaces cut their links \[B4\].
    pub cut: bool,
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
    cut: CutColumns,
}

/// What cut cells side by side have besides.
#[repr(align(64))]
struct CutColumns {
    shares: [[f64; MOST]; Q],
    normal: [[f64; MOST]; 3],
    curvature: [[f64; MOST]; 6],
    wall: [[f64; MOST]; 3],
    memory: [[f64; MOST]; 4],
}

impl Columns {
    /// Zeros.
    #[must_use]
    pub fn new() -> Self {
        let zeros = [0.0; MOST];
        Self {
            f: [zeros; Q],
            force: [zeros; 3],
            residual: [zeros; 3],
            drag: [zeros; 3],
            omega: zeros,
            cut: CutColumns::new(),
        }
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

    /// A cut cell into a lane.
    pub(crate) fn put_cut(&mut self, lane: usize, shape: &CutShape, memory: &Memory) {
        let put = |columns: &mut [[f64; MOST]], values: &[f64]| {
            for (column, value) in columns.iter_mut().zip(values) {
                column[lane] = *value;
            }
        };
        put(&mut self.cut.shares, &shape.shares);
        put(&mut self.cut.normal, &shape.normal);
        put(&mut self.cut.curvature, &shape.curvature);
        put(&mut self.cut.wall, &shape.wall);
        put(&mut self.cut.memory, memory);
    }

    /// What the cut cell in a lane remembers.
    pub(crate) fn memory_of(&self, lane: usize) -> Memory {
        self.cut.memory.map(|column| column[lane])
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
            if alike.cut && !task.cut[0] {
                for column in &mut self.f {
                    R::store_wide(R::Pack::zero(), &mut column[part..]);
                }
                continue;
            }
            if alike.cut {
                let residual = load(&self.residual);
                let (shape, memory) = self.cut.load::<R>(part);
                let by_stress = task.cut[1].then_some(alike.fluid);
                let (correction, memory) =
                    cut_correction(task.physics, &h, &state, &shape, &residual, by_stress, memory);
                for i in 0..Q {
                    R::store_wide(correction[i], &mut self.f[i][part..]);
                }
                for k in 0..4 {
                    R::store_wide(memory[k], &mut self.cut.memory[k][part..]);
                }
                continue;
            }
            let situation = Situation {
                residual: load(&self.residual),
                drag: load(&self.drag),
                fluid: alike.fluid,
                sourced: task.sourced,
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

impl CutColumns {
    fn new() -> Self {
        let zeros = [0.0; MOST];
        Self {
            shares: [zeros; Q],
            normal: [zeros; 3],
            curvature: [zeros; 6],
            wall: [zeros; 3],
            memory: [zeros; 4],
        }
    }

    #[inline(always)]
    fn load<R: Registers<Element = f64>>(&self, part: usize) -> (CutShape<R::Pack>, Memory<R::Pack>) {
        let load = |column: &[f64; MOST]| R::load_wide(&column[part..]);
        let shape = CutShape {
            shares: directions(
                #[inline(always)]
                |i| load(&self.shares[i]),
            ),
            normal: three(
                #[inline(always)]
                |a| load(&self.normal[a]),
            ),
            curvature: six(
                #[inline(always)]
                |k| load(&self.curvature[k]),
            ),
            wall: three(
                #[inline(always)]
                |a| load(&self.wall[a]),
            ),
        };
        (shape, [0, 1, 2, 3].map(|k| load(&self.memory[k])))
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
