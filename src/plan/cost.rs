//! Time that a run takes, from what a step passes over and what each of it costs.

use serde::Serialize;

use crate::geometry::Axis;
use crate::setup::Setup;
use crate::solver::boundary_cells::{is_interface, touches_boundary};

/// Seconds on one thread, fast backend, double precision: geometric fits to the first seconds of the scenes in `scenes`
/// on an AMD EPYC with 512-bit registers (December 2026), 3 µs to 60 ms per step; all of them within 2.2 times. Of a step,
const STEP: f64 = 2.5e-6;
/// of a cell with one relaxation time,
const CELL: f64 = 4.0e-8;
/// of one whose viscosity follows the shear rate,
const VARYING_CELL: f64 = 4.5e-8;
/// and besides: of a cell at the free surface,
const INTERFACE: f64 = 5.0e-7;
/// of a cell at a wall,
const WALL: f64 = 7.0e-7;
/// of a cell with cut links,
const CUT: f64 = 4.5e-7;
/// of a link between fluid and grain.
const GRAIN_LINK: f64 = 2.4e-7;

/// Seconds on one thread of a step of grains without fluid,
const GRAIN_STEP: f64 = 4.5e-7;
/// and of each of its spheres: 40 ns alone, 370 ns in a stack with one and a half contacts each, 190 to 330 ns in a drum, a
/// hopper and a column that collapses.
const SPHERE: f64 = 3.0e-7;

/// What rough times are of.
pub(super) const ON_WHAT: &str = "on one thread, within 2 to 3 times where the machine is like that of the fit (an AMD EPYC); \
                                  less if it comes to an end before";

/// Seconds of steps of grains.
pub(super) fn of_grains(steps: f64, sphere_updates: f64) -> f64 {
    steps * GRAIN_STEP + sphere_updates * SPHERE
}

/// Seconds of links between fluid and grains.
pub(super) fn of_links(steps: f64, links: f64) -> f64 {
    steps * links * GRAIN_LINK
}

/// What a step passes over: cells in the mean over the run, and what is beside them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Passed {
    /// Cells with fluid.
    pub fluid_cells: f64,
    /// Of these, at the free surface.
    pub interface_cells: f64,
    /// Of the cells with fluid, those at walls, mirrors and stairs.
    pub wall_cells: f64,
    /// Of the cells with fluid, those with links that surfaces of solids cut.
    pub cut_cells: f64,
}

impl Passed {
    /// Counts at time 0, and as they are once the fluid lies one cell thick wherever it can: half-way between.
    ///
    /// # Arguments
    /// `setup`: as the solver gets it. `spreads`: the axis of the depth, where there is a surface and the fluid is not level.
    #[must_use]
    pub(super) fn of(setup: &Setup, spreads: Option<Axis>) -> Self {
        let wet = |cell: usize| {
            !setup.is_solid(cell)
                && setup.free_surface.as_ref().is_none_or(|surface| surface.fill[cell] > 0.0)
        };
        let cut = setup.cuts.iter().map(|cut| cut.cell as usize);
        let is_cut: std::collections::HashSet<usize> = cut.collect();
        let mut now = Self::default();
        for cell in (0..setup.cells()).filter(|&cell| wet(cell)) {
            now.fluid_cells += 1.0;
            now.interface_cells += f64::from(u8::from(is_interface(setup, cell)));
            if is_cut.contains(&cell) {
                now.cut_cells += 1.0;
            } else if touches_boundary(setup, cell) {
                now.wall_cells += 1.0;
            }
        }
        spreads.map_or(now, |up| now.half_way_to(now.spread(setup, up, is_cut.len() as f64)))
    }

    /// Seconds of steps on one thread.
    pub(super) fn seconds(&self, setup: &Setup, steps: f64) -> f64 {
        let varies = !setup.fluids.iter().all(|law| law.constant_tau().is_some());
        let cell = if varies { VARYING_CELL } else { CELL };
        let cells = self.fluid_cells * cell + self.interface_cells * INTERFACE;
        steps * (STEP + cells + self.wall_cells * WALL + self.cut_cells * CUT)
    }

    /// The same fluid in a layer of one cell.
    fn spread(self, setup: &Setup, up: Axis, cut_cells: f64) -> Self {
        let columns = columns(setup, up) as f64;
        let layer = self.fluid_cells.min(columns);
        Self {
            fluid_cells: self.fluid_cells,
            interface_cells: self.interface_cells.max(layer),
            wall_cells: if setup.cuts.is_empty() { self.wall_cells.max(layer) } else { self.wall_cells },
            cut_cells: self.cut_cells.max(layer.min(cut_cells)),
        }
    }

    fn half_way_to(self, other: Self) -> Self {
        Self {
            fluid_cells: 0.5 * (self.fluid_cells + other.fluid_cells),
            interface_cells: 0.5 * (self.interface_cells + other.interface_cells),
            wall_cells: 0.5 * (self.wall_cells + other.wall_cells),
            cut_cells: 0.5 * (self.cut_cells + other.cut_cells),
        }
    }
}

/// Columns along an axis that hold a cell which is no solid.
fn columns(setup: &Setup, up: Axis) -> usize {
    let n = setup.extents;
    let (a, b) = ((up.index() + 1) % 3, (up.index() + 2) % 3);
    let open = |i: usize, j: usize| {
        (0..n[up.index()]).any(|k| {
            let mut at = [k; 3];
            (at[a], at[b]) = (i, j);
            !setup.is_solid(setup.index(at))
        })
    };
    (0..n[a]).map(|i| (0..n[b]).filter(|&j| open(i, j)).count()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rheology::Law;
    use crate::setup::{Face, FreeSurface};

    fn block_on_a_floor() -> Setup {
        let mut setup = Setup::periodic([10, 6, 8], Law::Newtonian { mu: 0.1 });
        setup.faces[2] = [Face::NoSlip, Face::Open];
        // 3 × 6 × 4 cells, which reach through the periodic faces.
        let fill = (0..setup.cells()).map(|cell| setup.coordinates(cell)).map(|[x, _, z]| x < 3 && z < 4);
        setup.free_surface = Some(FreeSurface::new(fill.map(|wet| f64::from(u8::from(wet))).collect()));
        setup
    }

    #[test]
    fn exact_counts_of_a_block_and_of_its_layer() {
        let setup = block_on_a_floor();
        // Top 18 cells, sides 2 × 6 × 3; floor 18.
        let level = Passed { fluid_cells: 72.0, interface_cells: 54.0, wall_cells: 18.0, cut_cells: 0.0 };
        assert_eq!(Passed::of(&setup, None), level);
        // A layer covers all 60 columns.
        let spread = Passed { fluid_cells: 72.0, interface_cells: 57.0, wall_cells: 39.0, cut_cells: 0.0 };
        assert_eq!(Passed::of(&setup, Some(Axis::Z)), spread);
    }

    #[test]
    fn cells_of_a_full_box_are_the_time_of_its_steps() {
        let seconds = |n: usize, law: Law| {
            let setup = Setup::periodic([n, n, n], law);
            Passed::of(&setup, None).seconds(&setup, 1000.0)
        };
        let newtonian = Law::Newtonian { mu: 0.1 };
        // 1000 steps of 8⁶ cells at 25 million per second, and of none.
        assert!((seconds(64, newtonian) / (262.144e6 / 25e6) - 1.0).abs() < 1e-3);
        assert!(seconds(32, Law::Bingham { sigma0: 1e-5, mu: 0.1 }) > seconds(32, newtonian));
    }
}
