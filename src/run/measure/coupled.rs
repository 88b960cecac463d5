//! What probes say about one grain in a fluid, in SI units.

use super::columns::Upright;
use super::fluid::Fluid;
use super::quantity::{Quantity, one, vectors};
use crate::coupling::{BodyLoad, Immersed};
use crate::setup::{Face, Setup};
use crate::solver::run::Fields;
use crate::units::Units;

/// Force and torque of the fluid on a grain, and force of contacts and lubrication; NaN without the grain.
pub(super) fn fluid_force(fluid: &Fluid<'_>, grain: Option<usize>) -> Vec<Quantity> {
    let units = &fluid.frame.units;
    let newton = units.force_unit() * units.dx_m * units.dx_m * units.dx_m;
    let (mut force, mut contact, mut torque) = ([f64::NAN; 3], [f64::NAN; 3], [f64::NAN; 3]);
    if let (Some(grain), Some(grains)) = (grain, fluid.run.grains()) {
        let load = grains.loads().get(grain).map(BodyLoad::total).unwrap_or_default();
        let contacts = grains.contact_loads().get(grain).copied().unwrap_or_default();
        force = std::array::from_fn(|k| load[k] * newton);
        contact = std::array::from_fn(|k| contacts[k] * newton);
        torque = std::array::from_fn(|k| load[3 + k] * newton * units.dx_m);
    }
    vectors([("force", "N", force), ("contact", "N", contact), ("torque", "N m", torque)])
}

/// Depth of a grain's centre below the surface around it; NaN without the grain or without fluid around it.
pub(super) fn submergence(fluid: &Fluid<'_>, grain: Option<usize>) -> Vec<Quantity> {
    let (units, upright) = (&fluid.frame.units, fluid.frame.upright);
    let below = |grains, grain| depth(fluid.run.setup(), fluid.fields, units, upright, grains, grain);
    one("m", grain.zip(fluid.run.grains()).map_or(f64::NAN, |(grain, grains)| below(grains, grain)))
}

/// Depth of a grain's centre below the mean surface of the columns around it, m.
fn depth(
    setup: &Setup,
    fields: &Fields,
    units: &Units,
    upright: Upright,
    grains: &Immersed,
    grain: usize,
) -> f64 {
    let centre = grains.centre(grain);
    let bodies = grains.dem().bodies();
    let radius = bodies.radius.get(grain).map_or(0.0, |r| units.length_to_lattice(*r));
    let [a, b] = upright.across();
    let n = setup.extents;
    let off = |k: usize, axis: usize| {
        let d = k as f64 + 0.5 - centre[axis];
        let length = n[axis] as f64;
        if setup.faces[axis][0] == Face::Periodic { d - length * (d / length).round() } else { d }
    };
    let (mut sum, mut count) = (0.0, 0.0);
    for ib in 0..n[b] {
        for ia in 0..n[a] {
            let (da, db) = (off(ia, a), off(ib, b));
            let distance = (da * da + db * db).sqrt();
            // A ring beyond the grain, two cells wide.
            if distance < radius + 1.0 || distance > radius + 3.0 {
                continue;
            }
            let mut cell = [0; 3];
            (cell[a], cell[b]) = (ia, ib);
            let column = upright.column(setup, fields, units, None, cell);
            if column.depth > 0.0 {
                sum += upright.surface(&column, None);
                count += 1.0;
            }
        }
    }
    if count == 0.0 {
        return f64::NAN;
    }
    let height = units.length_to_si(centre[upright.up.index()]);
    if upright.down_is_low { sum / count - height } else { height - sum / count }
}
