//! Bytes per cell, and what this machine has.

use serde::Serialize;

use crate::scene::Scene;
use crate::solver::setup::{Setup, SurfaceForce, YieldTreatment};

/// Bytes per cell of one feature.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Item {
    /// What it is.
    pub what: &'static str,
    /// Bytes per cell of the box.
    pub bytes_per_cell: u64,
}

/// Two copies of 19 populations in f64.
pub const POPULATIONS: u64 = 2 * 19 * 8;
/// What a cell is for streaming: one 32-bit number.
const NEIGHBOURS: u64 = 4;
/// Density, velocity, stress, shear rate and relaxation rate while fields are written.
pub const FIELDS: u64 = (1 + 3 + 6 + 1 + 1) * 8;

/// Kind, touched kinds, mass, fill now and at time 0, and velocity.
const SURFACE: u64 = 1 + 1 + 8 + 8 + 8 + 24;
/// Smoothed acceleration and the velocity it is made from.
const INERTIA: u64 = 24 + 24;

/// What each feature of a set-up costs.
#[must_use]
pub fn items(setup: &Setup) -> Vec<Item> {
    let item = |what, bytes_per_cell| Item { what, bytes_per_cell };
    let mut items = vec![
        item("populations, two copies", POPULATIONS),
        item("neighbour table", NEIGHBOURS),
        item("fields while writing", FIELDS),
    ];
    if !setup.solids.is_empty() {
        items.push(item("solid numbers", 1));
    }
    if !setup.fluid_of_cell.is_empty() {
        items.push(item("fluid numbers", 1));
    }
    if matches!(setup.yielding, YieldTreatment::LaggedClamped { .. }) {
        items.push(item("relaxation time of the previous step", 8));
    }
    if let Some(surface) = &setup.free_surface {
        items.push(item("surface kind, mass, fill, velocity", SURFACE));
        items.push(item("fill and kind while writing", 9));
        if surface.force == SurfaceForce::ByFillAndInertia {
            items.push(item("acceleration in surface cells", INERTIA));
        }
    }
    items
}

/// Upper bound of the bytes per cell, known before anything is allocated: all features and the
/// scratch arrays of `plan`.
#[must_use]
pub fn most_bytes_per_cell(scene: &Scene) -> u64 {
    let surface = if scene.fluid.initial.is_some() { SURFACE + INERTIA + 9 } else { 0 };
    POPULATIONS + NEIGHBOURS + FIELDS + 1 + 1 + 8 + 4 + surface
}

/// Memory that can still be taken, bytes; `None` where the system does not say.
#[must_use]
pub fn available() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kib: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kib.checked_mul(1024)
}
