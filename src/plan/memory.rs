//! Bytes a run will hold, worked out before any of them is taken, and what this machine has.

use serde::Serialize;

use super::coupled::added_bytes;
use crate::boundary::links::BoundaryCell;
use crate::scene::{Scene, SurfaceGravity, YieldChoice};
use crate::setup::{Face, FreeSurface, Setup, SurfaceForce, WallRule, YieldTreatment};
use crate::solver::choose;
use crate::solver::fast::layout::Layout as Blocks;
use crate::solver::fast::memory as fast;

/// How a backend lays cells out in memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Layout {
    /// Every cell of the box has all arrays: the plain backend.
    EveryCell,
    /// Only blocks that hold fluid have arrays: the fast backend.
    #[default]
    Blocks,
}

impl Layout {
    /// Of a backend, by its name. Backends from elsewhere are taken to hold every cell.
    #[must_use]
    pub fn of(backend: &str) -> Self {
        if backend == "fast" { Self::Blocks } else { Self::EveryCell }
    }
}

/// What an item is part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Part {
    /// Populations and what a collision remembers.
    Populations,
    /// What cells are for streaming, and what walls, mirror planes and solids need.
    Walls,
    /// The free surface.
    Surface,
    /// Grains in the fluid.
    Grains,
    /// Fields while they are written.
    Outputs,
}

/// Bytes of one feature.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Item {
    /// What it is.
    pub what: &'static str,
    /// What it is part of.
    pub part: Part,
    /// Bytes.
    pub bytes: u64,
    /// The same over the cells of the box.
    pub bytes_per_cell: f64,
}

/// Bytes of a run, by part.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Prediction {
    /// Populations and what a collision remembers.
    pub populations: u64,
    /// What cells are for streaming; walls, mirror planes and solids.
    pub walls: u64,
    /// The free surface.
    pub surface: u64,
    /// Grains in the fluid.
    pub grains: u64,
    /// Fields while they are written.
    pub outputs: u64,
    /// All of them: the most that is held at one time.
    pub total: u64,
}

impl Prediction {
    fn of(items: &[Item]) -> Self {
        let sum = |part| items.iter().filter(|item| item.part == part).map(|item| item.bytes).sum::<u64>();
        let [populations, walls, surface, grains, outputs] =
            [Part::Populations, Part::Walls, Part::Surface, Part::Grains, Part::Outputs].map(sum);
        let total = populations + walls + surface + grains + outputs;
        Self { populations, walls, surface, grains, outputs, total }
    }

    /// Bytes of the run itself, without outputs: what [`crate::solver::run::Run::allocated_bytes`] says.
    #[must_use]
    pub const fn run(&self) -> u64 {
        self.total - self.outputs
    }
}

/// Two copies of 19 populations in f64, which is all the plain backend has.
pub const POPULATIONS: u64 = 2 * 19 * 8;
/// What a cell is for streaming: one 32-bit number.
const NEIGHBOURS: u64 = 4;
/// Density, velocity, stress, shear rate and relaxation rate while fields are written.
pub const FIELDS: u64 = (1 + 3 + 6 + 1 + 1) * 8;
/// Upstream offsets of one coordinate of an axis.
const AXIS: u64 = 3 * 8;
/// ω⁺ of the previous step.
const LAG: u64 = 8;

/// Kind, touched kinds, mass, fill now and at time 0, and velocity.
const SURFACE: u64 = 1 + 1 + 8 + 8 + 8 + 24;
/// Smoothed acceleration and the velocity it is made from.
const INERTIA: u64 = 24 + 24;
/// Fill and kind while fields are written.
const SURFACE_FIELDS: u64 = 8 + 1;
/// Pressure, velocity, stress and shear rate in SI units, and four marks, while a picture of the box is
/// written.
const PICTURE: u64 = (1 + 3 + 6 + 1) * 8 + 4;
/// Scratch of the plan itself: shapes, distances between walls, columns of fluid.
const PLANNING: u64 = 16;

/// Bytes a run holds at most, on the plain backend.
///
/// # Arguments
/// `setup`: must have passed [`crate::solver::check::check`].
#[must_use]
pub fn predicted_bytes(setup: &Setup) -> Prediction {
    predict(setup, Layout::EveryCell)
}

/// Bytes a run holds at most, on a backend of this layout.
#[must_use]
pub fn predict(setup: &Setup, layout: Layout) -> Prediction {
    Prediction::of(&items(setup, layout))
}

/// What each feature of a set-up costs.
#[must_use]
pub fn items(setup: &Setup, layout: Layout) -> Vec<Item> {
    let cells = setup.cells() as u64;
    let item = |what, part, bytes: u64| Item {
        what,
        part,
        bytes,
        bytes_per_cell: bytes as f64 / cells.max(1) as f64,
    };
    let per_cell = |what, part, bytes: u64| item(what, part, bytes * cells);
    let surface = setup.free_surface.as_ref();
    // Grains are run by the plain backend for now.
    let layout = match choose::only_plain(setup) {
        None if setup.grains.is_none() => layout,
        _ => Layout::EveryCell,
    };
    let mut items = match layout {
        Layout::EveryCell => every_cell(setup, &item),
        Layout::Blocks => {
            vec![item("blocks that hold fluid", Part::Populations, fast_bytes(setup))]
        }
    };
    if !setup.solids.is_empty() {
        items.push(per_cell("solid numbers", Part::Walls, 1));
    }
    if !setup.fluid_of_cell.is_empty() {
        items.push(per_cell("fluid numbers", Part::Walls, 1));
    }
    if setup.grains.is_some() {
        items.push(item("grains: owners, links, neighbours", Part::Grains, added_bytes(setup)));
    }
    items.push(per_cell("fields while writing", Part::Outputs, FIELDS));
    items.push(per_cell("the same in SI units", Part::Outputs, PICTURE));
    if surface.is_some() || setup.grains.is_some() {
        items.push(per_cell("fill and kind while writing", Part::Outputs, SURFACE_FIELDS));
    }
    items
}

/// The arrays of the plain backend.
fn every_cell(setup: &Setup, item: &dyn Fn(&'static str, Part, u64) -> Item) -> Vec<Item> {
    let cells = setup.cells() as u64;
    let axes = AXIS * setup.extents.iter().sum::<usize>() as u64;
    let mut items = vec![
        item("populations, two copies", Part::Populations, POPULATIONS * cells),
        item("neighbour table", Part::Walls, NEIGHBOURS * cells + axes),
    ];
    let boundary = boundary_cells(setup);
    if boundary > 0 {
        let bytes = boundary * size_of::<BoundaryCell>() as u64;
        items.push(item("records of boundary cells", Part::Walls, bytes));
        if setup.wall_rule == WallRule::ViscosityIndependent {
            items.push(item("wall corrections", Part::Walls, boundary * 19 * 8));
        }
    }
    if matches!(setup.yielding, YieldTreatment::LaggedClamped { .. }) {
        items.push(item("relaxation time of the previous step", Part::Populations, LAG * cells));
    }
    if setup.free_surface.is_some() || setup.grains.is_some() {
        items.push(item("surface kind, mass, fill, velocity", Part::Surface, SURFACE * cells));
    }
    let smoothed = |surface: &FreeSurface| surface.force == SurfaceForce::ByFillAndInertia;
    if setup.free_surface.as_ref().is_some_and(smoothed) {
        items.push(item("acceleration in surface cells", Part::Surface, INERTIA * cells));
    }
    items
}

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

fn touches_boundary(setup: &Setup, cell: usize) -> bool {
    let at = setup.coordinates(cell);
    crate::lattice::C[1..].iter().any(|c| match neighbour(setup, at, *c) {
        None => true,
        Some(cell) => setup.is_solid(setup.index(cell)),
    })
}

/// The cell at an offset of at most one cell along each axis, through periodic faces; `None` beyond others.
fn neighbour(setup: &Setup, at: [usize; 3], offset: [i32; 3]) -> Option<[usize; 3]> {
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

/// Bytes of the fast backend: two copies of the populations in blocks that hold fluid at time 0 or that it touches, records of
/// cells at walls and at the surface, and what a block says of itself.
#[must_use]
pub fn fast_bytes(setup: &Setup) -> u64 {
    let line = fast::line(setup.precision);
    let layout = Blocks::new(setup.extents, line);
    let held = held_blocks(setup, &layout);
    let count = held.iter().filter(|&&held| held).count() as u64;
    let cells = count * layout.block_cells() as u64;
    let (rim, interface) = special_cells(setup, &layout, &held);
    let mut per_cell = 2 * 19 * setup.precision.bytes();
    if setup.fluids.len() > 1 {
        per_cell += 1;
    }
    if matches!(setup.yielding, YieldTreatment::LaggedClamped { .. }) {
        per_cell += LAG;
    }
    let corrected = setup.wall_rule == WallRule::ViscosityIndependent;
    if corrected && fast::has_walls(setup) {
        per_cell += 8;
    }
    if setup.free_surface.is_some() {
        per_cell += 1 + 8;
    }
    if setup.free_surface.as_ref().is_some_and(|surface| surface.force == SurfaceForce::ByFillAndInertia) {
        // Velocities of two collisions and the acceleration.
        per_cell += 3 * 24;
    }
    let per_rim = fast::rim_bytes(corrected, setup.free_surface.is_some());
    let table = layout.bytes() + fast::sources_bytes(&layout, line);
    cells * per_cell
        + count * fast::block_bytes(&layout, line, setup.free_surface.is_some())
        + rim * per_rim
        + interface * fast::INTERFACE_BYTES
        + table
}

/// Which places hold a fluid cell at time 0, and, below a free surface, a neighbour of one: the fluid will move.
fn held_blocks(setup: &Setup, layout: &Blocks) -> Vec<bool> {
    let mut held = vec![setup.solids.is_empty() && setup.free_surface.is_none(); layout.places()];
    if held.first() == Some(&true) {
        return held;
    }
    for cell in (0..setup.cells()).filter(|&cell| holds_fluid(setup, cell)) {
        let at = setup.coordinates(cell);
        held[layout.find(at).0] = true;
        if setup.free_surface.is_some() {
            for c in &crate::lattice::C[1..7] {
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

/// Cells of held blocks with an irregular link, and interface cells: partly filled ones, and full ones with
/// an empty cell next to them along an axis.
fn special_cells(setup: &Setup, layout: &Blocks, held: &[bool]) -> (u64, u64) {
    let (mut rim, mut interface) = (0, 0);
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
        if let Some(surface) = &setup.free_surface {
            let axes = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
            let dry = |c: &[i32; 3]| {
                let near = neighbour(setup, at, *c).map(|near| setup.index(near));
                near.is_some_and(|near| !setup.is_solid(near) && surface.fill[near] <= 0.0)
            };
            let fill = surface.fill[cell];
            interface += u64::from(fill > 0.0 && (fill < 1.0 || axes.iter().any(dry)));
        }
    }
    (rim, interface)
}

/// Bytes per cell of the box that are certain before anything is allocated: the features the scene asks
/// for without walls, or with blocks what the plan itself needs.
#[must_use]
pub fn least_bytes_per_cell(scene: &Scene, layout: Layout) -> u64 {
    let numbers = u64::from(!scene.solids.is_empty()) + u64::from(!scene.layers.is_empty());
    let free = scene.fluid.initial.is_some();
    let inertia = scene
        .numerics
        .free_surface
        .is_some_and(|rules| matches!(rules.gravity, SurfaceGravity::ByFillAndInertia));
    let of_surface = match (free, inertia) {
        (false, _) => 0,
        (true, false) => SURFACE + SURFACE_FIELDS,
        (true, true) => SURFACE + SURFACE_FIELDS + INERTIA,
    };
    let lag = if matches!(scene.numerics.yield_treatment, YieldChoice::LaggedClamped(_)) { LAG } else { 0 };
    match layout {
        Layout::EveryCell => POPULATIONS + NEIGHBOURS + FIELDS + PICTURE + numbers + lag + of_surface,
        Layout::Blocks => FIELDS + PICTURE + numbers + PLANNING + if free { SURFACE_FIELDS } else { 0 },
    }
}

/// A number of bytes for people.
#[must_use]
pub fn human(bytes: u64) -> String {
    let units = [("GiB", 1_u64 << 30), ("MiB", 1 << 20), ("KiB", 1 << 10)];
    match units.into_iter().find(|&(_, unit)| bytes >= unit) {
        Some((name, unit)) => format!("{:.2} {name}", bytes as f64 / unit as f64),
        None => format!("{bytes} bytes"),
    }
}

/// Memory that can still be taken, bytes; `None` where the system does not say.
#[must_use]
pub fn available() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kib: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kib.checked_mul(1024)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rheology::Law;

    const LAW: Law = Law::Newtonian { mu: 0.1 };

    #[test]
    fn exact_number_of_blocks_below_a_surface() {
        let count = |setup: &Setup| {
            let layout = Blocks::new(setup.extents, fast::line(setup.precision));
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

    #[test]
    fn exact_units_of_bytes() {
        assert_eq!(human(1000), "1000 bytes");
        assert_eq!(human(3 << 19), "1.50 MiB");
        assert_eq!(human(5 << 30), "5.00 GiB");
    }
}
