//! Bytes that grains add to a run with fluid.

use crate::dem::{Grain, Integrator, Shape};
use crate::plan::grains::speed::bytes_per_grain;
use crate::setup::Setup;

/// Bytes per cell of the box for the owner of a covered cell.
const OWNER: u64 = 4;
/// Bytes per link between fluid and a covered cell.
const LINK: u64 = 12;
/// Links of a sphere over its radius in cells squared: lines of the 18 directions that cross it, 6π + 12√2π.
const LINKS: f64 = 72.0;

/// Links between fluid and grains.
pub(in crate::plan) fn links(grains: &[Grain], dx_m: f64) -> f64 {
    grains.iter().map(|grain| LINKS * (grain.radius / dx_m) * (grain.radius / dx_m)).sum()
}

/// Bytes that grains add to a run: owners of cells, links, lists of covered cells.
pub(in crate::plan) fn added_bytes(setup: &Setup) -> u64 {
    let Some(grains) = &setup.grains else { return 0 };
    let dx = grains.units.dx_m;
    let one = |radius: f64| {
        let r = radius / dx;
        (LINKS * r * r) as u64 * LINK + (4.19 * r * r * r) as u64 * 4
    };
    let spheres: u64 = grains.dem.grains.iter().map(|grain| one(grain.radius)).sum();
    let gear = grains.dem.integrator != Integrator::Verlet;
    let members = |grain: &Grain| match grain.shape {
        Shape::Sphere => 1.0,
        Shape::Clump(k) => grains.dem.clumps.get(k).map_or(1.0, |c| c.members.len() as f64),
    };
    let bodies = |grain| bytes_per_grain(members(grain), gear);
    let bodies = grains.dem.grains.iter().map(bodies).sum::<f64>() as u64;
    setup.cells() as u64 * OWNER + spheres + bodies
}
