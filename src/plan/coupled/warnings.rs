//! The warnings of a plan about grains in a fluid.

use super::gap_viscosity;
use super::numbers::{CoupledNumbers, Given};
use crate::coupling::GrainWall;
use crate::plan::holding::holding;
use crate::plan::warning::{LOW_DENSITY_RATIO, LUBRICATED_GAP, Warning};
use crate::scene::Operator;

/// All of them, in the order in which they are printed.
pub(super) fn warnings(given: &Given, n: &CoupledNumbers) -> Vec<Warning> {
    let fast = n.speed_lattice;
    let light = n.density_ratio.map_or(f64::INFINITY, |[low, _]| low);
    let limited = |gap: f64| gap > LUBRICATED_GAP * (1.0 + 1e-9);
    let mut all = holding([
        (n.radius_cells[0] < 2.0, Warning::SmallGrain { cells: n.radius_cells[0], drag_error: n.drag_error }),
        (light < LOW_DENSITY_RATIO, Warning::LightGrain { ratio: light }),
        (n.lubrication.is_some_and(|rules| limited(rules.limited_gap_cells)), Warning::LubricationLimited),
        (fast > 0.1, Warning::FastGrains { cells_per_step: fast }),
    ]);
    all.extend(unstable(given, fast));
    let alone = given.coupled.grains.numbers.warnings.iter();
    all.extend(alone.filter(|warning| warning.holds_in_a_fluid()).cloned());
    all
}

/// Fast grains at a relaxation time at which their operator fails.
fn unstable(given: &Given, cells_per_step: f64) -> Option<Warning> {
    let half_way = given.coupled.suspension.wall == GrainWall::HalfWay;
    let (below, way_out) = Operator::fails_around_fast_grains(&given.setup.collision, half_way)?;
    let tau = given.units.tau_of_viscosity(gap_viscosity(given.facts, given.scales));
    let fails = tau < below && cells_per_step > 0.05;
    fails.then_some(Warning::GrainsUnstable { cells_per_step, tau, below, way_out })
}
