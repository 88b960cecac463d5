//! What can be said about fields of a fluid without a scene. Gas and solid cells never count.

use crate::geometry::Axis;
use crate::setup::{Setup, YieldTreatment};
use crate::solver::run::Fields;
use crate::units::Units;

/// Largest speed, lattice units.
pub(in crate::run) fn max_speed(fields: &Fields) -> f64 {
    fields.velocity.iter().map(square).fold(0.0_f64, |most, s| if s > most { s } else { most }).sqrt()
}

/// Largest speed times fill, lattice units: splashes of little mass count little.
pub(in crate::run) fn weighted_speed(fields: &Fields) -> f64 {
    let speeds = fields.velocity.iter().enumerate();
    speeds
        .map(|(c, u)| fill(fields, c) * square(u).sqrt())
        .fold(0.0, |most, s| if s > most { s } else { most })
}

fn square(u: &[f64; 3]) -> f64 {
    u[0] * u[0] + u[1] * u[1] + u[2] * u[2]
}

/// Fill of a cell that may be gas, 0 to 1; 1 everywhere without a free surface.
pub(super) fn fill(fields: &Fields, cell: usize) -> f64 {
    fields.fill.get(cell).map_or(1.0, |fill| fill.clamp(0.0, 1.0))
}

/// Whether a relaxation rate is that of an unyielded cell: exactly 0, or at the clamp.
fn is_unyielded(omega: f64, treatment: YieldTreatment) -> bool {
    match treatment {
        YieldTreatment::Exact => omega == 0.0,
        // A quotient and a product away from 1/τ_max: three roundings.
        YieldTreatment::ImplicitClamped { tau_max, .. } | YieldTreatment::LaggedClamped { tau_max, .. } => {
            omega * tau_max <= 1.0 + 4.0 * f64::EPSILON
        }
    }
}

/// Whether a cell holds fluid.
pub(in crate::run) fn is_fluid(setup: &Setup, fields: &Fields, cell: usize) -> bool {
    fields.is_fluid(cell, setup.is_solid(cell))
}

/// Unyielded fluid cells, one entry per cell.
pub(in crate::run) fn unyielded(setup: &Setup, fields: &Fields) -> Vec<bool> {
    let cells = fields.omega.iter().enumerate();
    cells.map(|(c, &omega)| is_fluid(setup, fields, c) && is_unyielded(omega, setup.yielding)).collect()
}

/// The layer of cells that holds a coordinate.
pub(super) fn layer(at_m: f64, axis: usize, setup: &Setup, units: &Units) -> usize {
    let layer = libm::floor(units.length_to_lattice(at_m)) as usize;
    layer.min(setup.extents[axis] - 1)
}

/// Mean velocity of the fluid whose cell centres lie in a box, m/s, and its volume, m³.
pub(super) fn window(
    setup: &Setup,
    fields: &Fields,
    units: &Units,
    min: [f64; 3],
    max: [f64; 3],
) -> ([f64; 3], f64) {
    let (mut filled, mut sum) = (0.0, [0.0; 3]);
    for cell in (0..setup.cells()).filter(|&c| is_fluid(setup, fields, c)) {
        let centre = units.cell_centre_m(setup.coordinates(cell));
        if (0..3).all(|a| min[a] <= centre[a] && centre[a] < max[a]) {
            let fill = fill(fields, cell);
            filled += fill;
            for a in 0..3 {
                sum[a] += fill * fields.velocity[cell][a];
            }
        }
    }
    let mean = if filled > 0.0 { units.velocities_to_si(sum.map(|s| s / filled)) } else { [0.0; 3] };
    (mean, filled * units.dx_m * units.dx_m * units.dx_m)
}

/// Column names and units of a profile.
pub(in crate::run) const PROFILE_COLUMNS: [(&str, &str); 7] = [
    ("position", "m"),
    ("velocity_x", "m/s"),
    ("velocity_y", "m/s"),
    ("velocity_z", "m/s"),
    ("shear_rate", "1/s"),
    ("pressure", "Pa"),
    ("unyielded_fraction", "-"),
];

/// Averages over planes normal to an axis, fluid cells only; planes without fluid are left out.
pub(in crate::run) fn profile(along: Axis, setup: &Setup, fields: &Fields, units: &Units) -> Vec<[f64; 7]> {
    let a = along.index();
    let mut sums = vec![[0.0; 7]; setup.extents[a]];
    let unyielded = unyielded(setup, fields);
    for cell in (0..setup.cells()).filter(|&c| is_fluid(setup, fields, c)) {
        let sum = &mut sums[setup.coordinates(cell)[a]];
        let u = units.velocities_to_si(fields.velocity[cell]);
        // The first entry counts cells until it becomes the position.
        let entries = [
            1.0,
            u[0],
            u[1],
            u[2],
            units.rate_to_si(fields.shear_rate[cell]),
            units.pressure_of_density(fields.density[cell]),
            f64::from(u8::from(unyielded[cell])),
        ];
        for (total, entry) in sum.iter_mut().zip(entries) {
            *total += entry;
        }
    }
    let rows = sums.into_iter().enumerate().filter(|(_, sum)| sum[0] > 0.0);
    rows.map(|(i, sum)| {
        let mut row = sum.map(|total| total / sum[0]);
        row[0] = units.length_to_si(i as f64 + 0.5);
        row
    })
    .collect()
}
