//! What the numbers of a plan are worked out with: relaxation times, slip, rounding, thickness at rest.

use super::facts::Facts;
use super::scale::Scales;
use super::surface::Pool;
use super::wall_error::Layer;
use crate::rheology::Law;
use crate::scene::Boundary;
use crate::scene::Operator;
use crate::scene::force::norm;
use crate::setup::{Setup, WallRule, YieldTreatment};
use crate::units::Units;

/// Depth of a film, cells, below which it is not resolved.
pub(super) const SHALLOW: f64 = 4.0;

/// What they follow from.
pub(super) struct Basis<'a> {
    pub facts: &'a Facts<'a>,
    pub units: &'a Units,
    pub setup: &'a Setup,
    pub scales: &'a Scales,
    pub steps: u64,
    /// Widest gap between walls, cells; infinite without walls.
    pub gap: f64,
    pub pool: Option<Pool>,
}

/// σ0 over the force along the bed: a layer of this thickness on the slope is on the point of yielding.
pub(super) fn arrest_thickness(basis: &Basis) -> Option<f64> {
    let curve = basis.facts.curve();
    let force = along_bed(basis)?;
    (curve.has_plug() && force > 0.0).then(|| curve.plastic_stress() / force)
}

/// The force along the bed, N/m³; `None` without a free surface.
pub(super) fn along_bed(basis: &Basis) -> Option<f64> {
    let mut force = basis.facts.forces.extremes[0];
    force[basis.pool?.up.index()] = 0.0;
    Some(norm(force))
}

/// Least and largest τ over all fluids, between rest and the largest expected shear rate.
pub(super) fn tau_range(
    facts: &Facts,
    units: &Units,
    scales: &Scales,
    yielding: &YieldTreatment,
) -> (f64, f64) {
    let mut range = (f64::INFINITY, 0.5);
    for curve in facts.curves() {
        let at_rest = units.tau_of_viscosity(curve.viscosity_at_rest());
        let fastest = scales.shear_rate_max;
        let fast =
            if fastest > 0.0 { units.tau_of_viscosity(curve.apparent_viscosity(fastest)) } else { at_rest };
        let (low, high) = if fast < at_rest { (fast, at_rest) } else { (at_rest, fast) };
        range.0 = if low < range.0 { low } else { range.0 };
        range.1 = if high > range.1 { high } else { range.1 };
    }
    match *yielding {
        YieldTreatment::Exact => range,
        YieldTreatment::ImplicitClamped { tau_min, tau_max }
        | YieldTreatment::LaggedClamped { tau_min, tau_max } => {
            let clamp = |tau: f64| {
                if tau < tau_min {
                    tau_min
                } else if tau > tau_max {
                    tau_max
                } else {
                    tau
                }
            };
            (clamp(range.0), clamp(range.1))
        }
    }
}

/// What decides the error of plane walls along which a force drives the fluid; `None` in any other flow, and with walls or
/// clamps that the sweep does not have.
pub(super) fn sheared_layer(basis: &Basis) -> Option<Layer> {
    let n = match basis.facts.laws[..] {
        [Law::Newtonian { .. } | Law::Bingham { .. }] => 1.0,
        [Law::HerschelBulkley { n, .. } | Law::PowerLaw { n, .. } | Law::Papanastasiou { n, .. }] => n,
        _ => return None,
    };
    let plane = basis.setup.solids.is_empty() && walled_axes(basis.facts) == 1;
    let exact = basis.setup.yielding == YieldTreatment::Exact;
    if !plane || !exact || basis.setup.wall_rule != WallRule::ViscosityIndependent {
        return None;
    }
    let deep = match basis.pool {
        // The rows of walls have no shallower films; what is expected of these has rows of its own.
        Some(pool) if pool.level && basis.units.length_to_lattice(pool.depth) >= SHALLOW => {
            basis.units.length_to_lattice(pool.depth)
        }
        Some(_) => return None,
        None => 0.5 * basis.gap,
    };
    let force = along_bed(basis).unwrap_or_else(|| along_walls(basis));
    let rigid = basis.units.length_to_lattice(basis.facts.curve().plastic_stress() / force);
    let layer = Layer { sheared: deep - rigid, n, push: push(basis)? };
    (layer.sheared > 0.0 && layer.push > 0.0 && layer.push.is_finite()).then_some(layer)
}

/// Share of the expected speed that a step of the force along walls adds; `None` where there are none.
pub(super) fn push(basis: &Basis) -> Option<f64> {
    let force = match basis.pool {
        Some(_) => along_bed(basis)?,
        None if basis.gap.is_finite() => along_walls(basis),
        None => return None,
    };
    let speed = basis.units.velocity_to_lattice(basis.scales.velocity);
    (speed > 0.0).then(|| basis.units.force_to_lattice(force) / speed)
}

/// The driving force along axes that fluid can flow along, N/m³.
pub(super) fn along_walls(basis: &Basis) -> f64 {
    let force = basis.facts.forces.driving_extremes[0];
    norm(std::array::from_fn(|a| if basis.facts.closed[a] { 0.0 } else { force[a] }))
}

/// Axes that end at walls.
fn walled_axes(facts: &Facts) -> usize {
    let wall = |face: &Boundary| matches!(face, Boundary::NoSlip | Boundary::MovingWall { .. });
    facts.faces.iter().filter(|pair| pair.iter().any(wall)).count()
}

/// ε times roundings per step times the steps they can add up over: those of the run, or L²/(8ν) where walls or
/// a bed L or L/2 cells apart hold the flow, as they hold it against a force.
///
/// # Source
/// Derived in the claims `single-precision-channel` and `single-precision-flows`.
pub(super) fn rounding_floor(basis: &Basis, tau_min: f64) -> f64 {
    let precision = basis.setup.precision;
    let across = match basis.pool {
        Some(pool) => 2.0 * basis.units.length_to_lattice(pool.depth),
        None => basis.gap,
    };
    let held = 3.0 * across * across / (8.0 * (tau_min - 0.5));
    let steps = basis.steps as f64;
    precision.roundings() * precision.rounding() * if held < steps { held } else { steps }
}

/// 2θ f Δt / ρ in m/s: the slip of an unyielded solid along the walls that hold it \[K3\].
pub(super) fn plug_slip(basis: &Basis) -> f64 {
    let plug = basis.facts.any_plug();
    let walls = (basis.gap.is_finite() || basis.pool.is_some()) && basis.setup.wall_rule == WallRule::HalfWay;
    let exact = basis.setup.yielding == YieldTreatment::Exact;
    if !(plug && walls && exact) {
        return 0.0;
    }
    // Where the bed is part of the solids, its slope is not known: the whole weight is a bound.
    let force = along_bed(basis).filter(|along| *along > 0.0).unwrap_or(basis.scales.force);
    match Operator::odd_excess_of_plugs(&basis.setup.collision) {
        Some(excess) => 2.0 * excess * force * basis.units.dt_s / basis.units.rho0_kg_per_m3,
        None => f64::INFINITY,
    }
}
