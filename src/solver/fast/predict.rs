//! Bytes of a run, worked out before any of them is taken.

use super::cut_cells::cut_bytes;
use super::layout::Layout;
use super::memory as own;
use super::surface::flow::NUMBERS;
use crate::boundary::cut::cut_count;
use crate::lattice::{C, Q};
use crate::setup::{Face, Setup, SurfaceForce, WallRule, YieldTreatment};
use crate::solver::boundary_cells::{is_interface, neighbour, touches_boundary};

/// ω⁺ of the previous step.
const LAG: u64 = size_of::<f64>() as u64;
/// Kind and fill of a cell below a free surface.
const SURFACE: u64 = 1 + size_of::<f64>() as u64;
/// Density and velocity of a cell in blocks that hold interface cells.
const FLOW: u64 = (NUMBERS * size_of::<f64>()) as u64;
/// Velocities of two collisions and the acceleration.
const INERTIA: u64 = 3 * size_of::<[f64; 3]>() as u64;

/// Two copies of the populations in blocks that hold fluid at time 0 or that it touches, records of cells at walls and
/// at the surface, and what a block says of itself.
#[must_use]
pub(crate) fn bytes(setup: &Setup) -> u64 {
    let line = own::line(setup.precision);
    let layout = Layout::new(setup.extents, line);
    let held = held_blocks(setup, &layout);
    let count = held.iter().filter(|&&held| held).count() as u64;
    let cells = count * layout.block_cells() as u64;
    let Special { rim, interface, blocks } = special_cells(setup, &layout, &held);
    let mut per_cell = 2 * Q as u64 * setup.precision.bytes();
    if setup.fluids.len() > 1 {
        per_cell += 1;
    }
    if matches!(setup.yielding, YieldTreatment::LaggedClamped { .. }) {
        per_cell += LAG;
    }
    let corrected = setup.wall_rule == WallRule::ViscosityIndependent;
    if corrected && own::has_walls(setup) {
        per_cell += 8;
    }
    if setup.free_surface.is_some() {
        per_cell += SURFACE;
    }
    if setup.free_surface.as_ref().is_some_and(|surface| surface.force == SurfaceForce::ByFillAndInertia) {
        per_cell += INERTIA;
    }
    let per_rim = own::rim_bytes(corrected, setup.free_surface.is_some());
    let table = layout.bytes() + own::sources_bytes(&layout, line);
    cells * per_cell
        + count * own::block_bytes(&layout, line, setup.free_surface.is_some())
        + rim * per_rim
        + interface * own::INTERFACE_BYTES
        + blocks * layout.block_cells() as u64 * FLOW
        + table
        + cut_bytes(cut_count(setup))
}

/// Which places hold a fluid cell at time 0, and, below a free surface, a neighbour of one: the fluid will move.
fn held_blocks(setup: &Setup, layout: &Layout) -> Vec<bool> {
    let mut held = vec![setup.solids.is_empty() && setup.free_surface.is_none(); layout.places()];
    if held.first() == Some(&true) {
        return held;
    }
    for cell in (0..setup.cells()).filter(|&cell| holds_fluid(setup, cell)) {
        let at = setup.coordinates(cell);
        held[layout.find(at).0] = true;
        if setup.free_surface.is_some() {
            for c in &C[1..7] {
                if let Some(near) = neighbour(setup, at, *c) {
                    held[layout.find(near).0] = true;
                }
            }
        }
    }
    held
}

fn holds_fluid(setup: &Setup, cell: usize) -> bool {
    let surface = setup.free_surface.as_ref();
    !setup.is_solid(cell)
        && surface.is_none_or(|surface| surface.fill.get(cell).is_some_and(|&fill| fill > 0.0))
}

/// Cells of held blocks that need more than populations.
struct Special {
    /// Cells with an irregular link.
    rim: u64,
    /// Interface cells: partly filled ones, and full ones with an empty cell next to them along an axis.
    interface: u64,
    /// Blocks with interface cells.
    blocks: u64,
}

fn special_cells(setup: &Setup, layout: &Layout, held: &[bool]) -> Special {
    let (mut rim, mut interface) = (0, 0);
    let mut with_surface = vec![false; layout.places()];
    for cell in 0..setup.cells() {
        let at = setup.coordinates(cell);
        if setup.is_solid(cell) || !held[layout.find(at).0] {
            continue;
        }
        let at_face = (0..3).any(|a| {
            let n = setup.extents[a];
            (at[a] == 0 && setup.faces[a][0] != Face::Periodic)
                || (at[a] + 1 == n && setup.faces[a][1] != Face::Periodic)
        });
        rim += u64::from(at_face || (!setup.solids.is_empty() && touches_boundary(setup, cell)));
        let at_surface = is_interface(setup, cell);
        interface += u64::from(at_surface);
        with_surface[layout.find(at).0] |= at_surface;
    }
    let blocks = with_surface.into_iter().filter(|&any| any).count() as u64;
    Special { rim, interface, blocks }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rheology::Law;
    use crate::setup::FreeSurface;

    const LAW: Law = Law::Newtonian { mu: 0.1 };

    #[test]
    fn exact_number_of_blocks_below_a_surface() {
        let count = |setup: &Setup| {
            let layout = Layout::new(setup.extents, own::line(setup.precision));
            held_blocks(setup, &layout).into_iter().filter(|&held| held).count()
        };
        let mut setup = Setup::periodic([64, 64, 64], LAW);
        assert_eq!(count(&setup), 512);
        setup.faces[2] = [Face::NoSlip, Face::Open];
        for (depth, layers) in [(7, 1), (8, 2), (9, 2), (64, 8)] {
            let fill = (0..setup.cells())
                .map(|cell| if setup.coordinates(cell)[2] < depth { 1.0 } else { 0.0 })
                .collect();
            setup.free_surface = Some(FreeSurface::new(fill));
            assert_eq!(count(&setup), 64 * layers, "{depth}");
        }
    }
}
