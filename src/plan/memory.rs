//! Bytes a run will hold, worked out before any of them is taken, and what this machine has.

use serde::Serialize;

use super::coupled::added_bytes;
use super::disk::surface_bytes;
pub use super::limits::available;
pub(crate) use super::text::human;
use crate::boundary::cut::cut_count;
use crate::boundary::hand_over::HandOver;
use crate::scene::{Scene, SurfaceGravity, YieldChoice};
use crate::setup::{FreeSurface, Setup, SurfaceForce, WallRule, YieldTreatment};
pub use crate::solver::boundary_cells::boundary_cells;
pub use crate::solver::layout::Layout;
use crate::solver::{choose, fast, plain::memory as plain};

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
    /// Bytes over the cells of the box.
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

/// Density, velocity, stress, shear rate and relaxation rate while fields are written.
pub(crate) const FIELDS: u64 = (1 + 3 + 6 + 1 + 1) * 8;
/// Fill and kind while fields are written.
const SURFACE_FIELDS: u64 = 8 + 1;
/// Pressure, velocity, stress and shear rate in SI units, and four marks, while a picture of the box is
/// written.
const PICTURE: u64 = (1 + 3 + 6 + 1) * 8 + 4;
/// Halves of the bytes of a surface in its file that are held while it is written: the mesh, its corners by edge, arrays that
/// grow by doubling, the file.
const MESH: u64 = 7;
/// Scratch of the plan itself: shapes, distances between walls, columns of fluid.
const PLANNING: u64 = 16;

/// Bytes a run holds at most, on the plain backend.
///
/// # Arguments
/// `setup`: must have passed `crate::solver::check::check`.
#[must_use]
pub fn predicted_bytes(setup: &Setup) -> Prediction {
    predict(setup, Layout::EveryCell)
}

/// Bytes a run holds at most, on a backend of this layout.
#[must_use]
pub fn predict(setup: &Setup, layout: Layout) -> Prediction {
    Prediction::of(&items(setup, layout))
}

/// Bytes a run holds once the fluid has reached every cell that is not solid; `None` where that is no more than at time 0:
/// without a free surface, and on a backend that holds every cell.
///
/// # Arguments
/// `items`: those of time 0, with the surface that the fluid has then.
#[must_use]
pub(super) fn at_most(setup: &Setup, layout: Layout, items: &[Item]) -> Option<u64> {
    let surface = setup.free_surface.as_ref()?;
    if layout == Layout::EveryCell || setup.grains.is_some() || choose::only_plain(setup).is_some() {
        return None;
    }
    let now = items.iter().map(|item| item.bytes).sum::<u64>();
    let blocks = items.iter().find(|item| item.part == Part::Populations).map_or(0, |item| item.bytes);
    let fill = (0..setup.cells()).map(|cell| if setup.is_solid(cell) { 0.0 } else { 1.0 }).collect();
    let full = Setup { free_surface: Some(FreeSurface { fill, ..surface.clone() }), ..setup.clone() };
    Some(now + fast::predict::bytes(&full).saturating_sub(blocks)).filter(|&most| most > now)
}

/// What each feature of a set-up costs.
#[must_use]
pub(crate) fn items(setup: &Setup, layout: Layout) -> Vec<Item> {
    let cells = setup.cells() as u64;
    let item = |what, part, bytes: u64| Item {
        what,
        part,
        bytes,
        bytes_per_cell: bytes as f64 / cells.max(1) as f64,
    };
    let per_cell = |what, part, bytes: u64| item(what, part, bytes * cells);
    let surface = setup.free_surface.as_ref();
    // With grains the arrays of the plain backend are taken for those of either.
    let layout = match choose::only_plain(setup) {
        None if setup.grains.is_none() => layout,
        _ => Layout::EveryCell,
    };
    let mut items = match layout {
        Layout::EveryCell => every_cell(setup, &item),
        Layout::Blocks => {
            vec![item("blocks that hold fluid", Part::Populations, fast::predict::bytes(setup))]
        }
    };
    if !setup.solids.is_empty() {
        items.push(per_cell("solid numbers", Part::Walls, 1));
    }
    let handed = HandOver::bytes_of(setup);
    if handed > 0 {
        items.push(item("surfaces of moving solids", Part::Walls, handed));
    }
    if !setup.cuts.is_empty() {
        items.push(item("shares of cut links", Part::Walls, size_of_val(&*setup.cuts) as u64));
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
    if surface.is_some() {
        items.push(item("mesh of the surface while writing", Part::Outputs, MESH * surface_bytes(setup) / 2));
    }
    items
}

/// The arrays of the plain backend.
fn every_cell(setup: &Setup, item: &dyn Fn(&'static str, Part, u64) -> Item) -> Vec<Item> {
    let cells = setup.cells() as u64;
    let axes = plain::AXIS * setup.extents.iter().sum::<usize>() as u64;
    let mut items = vec![
        item("populations, two copies", Part::Populations, plain::POPULATIONS * cells),
        item("neighbour table", Part::Walls, plain::NEIGHBOURS * cells + axes),
    ];
    let boundary = boundary_cells(setup);
    if boundary > 0 {
        let bytes = boundary * plain::RECORD;
        items.push(item("records of boundary cells", Part::Walls, bytes));
        if setup.wall_rule == WallRule::ViscosityIndependent {
            items.push(item("wall corrections", Part::Walls, boundary * plain::CORRECTION));
        }
    }
    if !setup.cuts.is_empty() {
        let [cells, links] = cut_count(setup);
        let bytes = cells * plain::CUT_CELL + links * plain::CUT_LINK;
        items.push(item("links that surfaces cut", Part::Walls, bytes));
    }
    if matches!(setup.yielding, YieldTreatment::LaggedClamped { .. }) {
        items.push(item("relaxation time of the previous step", Part::Populations, plain::LAG * cells));
    }
    if setup.free_surface.is_some() || setup.grains.is_some() {
        items.push(item("surface kind, mass, fill, velocity", Part::Surface, plain::SURFACE * cells));
    }
    let smoothed = |surface: &FreeSurface| surface.force == SurfaceForce::ByFillAndInertia;
    if setup.free_surface.as_ref().is_some_and(smoothed) {
        items.push(item("acceleration in surface cells", Part::Surface, plain::INERTIA * cells));
    }
    items
}

/// Bytes per cell of the box that are certain before anything is allocated: the features the scene asks
/// for without walls, or with blocks what the plan itself needs.
#[must_use]
pub(crate) fn least_bytes_per_cell(scene: &Scene, layout: Layout) -> u64 {
    let numbers = u64::from(!scene.solids.is_empty()) + u64::from(!scene.layers.is_empty());
    let free = scene.fluid.initial.is_some();
    let inertia = scene
        .numerics
        .free_surface
        .is_some_and(|rules| matches!(rules.gravity, SurfaceGravity::ByFillAndInertia));
    let of_surface = match (free, inertia) {
        (false, _) => 0,
        (true, false) => plain::SURFACE + SURFACE_FIELDS,
        (true, true) => plain::SURFACE + SURFACE_FIELDS + plain::INERTIA,
    };
    let lag =
        if matches!(scene.numerics.yield_treatment, YieldChoice::LaggedClamped(_)) { plain::LAG } else { 0 };
    match layout {
        Layout::EveryCell => {
            plain::POPULATIONS + plain::NEIGHBOURS + FIELDS + PICTURE + numbers + lag + of_surface
        }
        Layout::Blocks => FIELDS + PICTURE + numbers + PLANNING + if free { SURFACE_FIELDS } else { 0 },
    }
}
