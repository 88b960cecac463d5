//! Measurements on fields, in SI units.

use crate::geometry::Axis;
use crate::scene::{Measure, Probe};
use crate::solver::run::{Fields, Run};
use crate::solver::setup::{Setup, YieldTreatment};
use crate::units::Units;

/// Largest speed, lattice units.
pub(super) fn max_speed(fields: &Fields) -> f64 {
    let squares = fields.velocity.iter().map(|u| u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    squares.fold(0.0_f64, |most, s| if s > most { s } else { most }).sqrt()
}

/// Whether a relaxation rate is that of an unyielded cell: exactly 0, or at the clamp.
pub(super) fn is_unyielded(omega: f64, treatment: YieldTreatment) -> bool {
    match treatment {
        YieldTreatment::Exact => omega == 0.0,
        // A quotient and a product away from 1/τ_max: three roundings.
        YieldTreatment::ImplicitClamped { tau_max, .. } | YieldTreatment::LaggedClamped { tau_max, .. } => {
            omega * tau_max <= 1.0 + 4.0 * f64::EPSILON
        }
    }
}

/// Unyielded fluid cells, one entry per cell.
pub(super) fn unyielded(setup: &Setup, fields: &Fields) -> Vec<bool> {
    let cells = fields.omega.iter().enumerate();
    cells.map(|(c, &omega)| !setup.is_solid(c) && is_unyielded(omega, setup.yielding)).collect()
}

/// Name and unit of the series columns of a probe; none for profiles.
pub(super) fn columns(probe: &Probe) -> Vec<(String, &'static str)> {
    let one = |unit| vec![(probe.name.clone(), unit)];
    match probe.measure {
        Measure::PointVelocity { .. } => {
            ["x", "y", "z"].iter().map(|axis| (format!("{}_{axis}", probe.name), "m/s")).collect()
        }
        Measure::Profile { .. } => Vec::new(),
        Measure::MaxSpeed => one("m/s"),
        Measure::KineticEnergy => one("J"),
        Measure::Mass => one("kg"),
        Measure::PlugFraction => one("-"),
        Measure::FlowRate { .. } => one("m^3/s"),
        _ => Vec::new(),
    }
}

/// Values of the series columns of a probe.
pub(super) fn values(measure: &Measure, run: &dyn Run, fields: &Fields, units: &Units) -> Vec<f64> {
    let setup = run.setup();
    let mass_unit = units.rho0_kg_per_m3 * units.dx_m * units.dx_m * units.dx_m;
    let velocity_unit = units.velocity_unit();
    match *measure {
        Measure::PointVelocity { at_m } => {
            let cell: [usize; 3] = std::array::from_fn(|a| layer(at_m[a], a, setup, units));
            units.velocities_to_si(fields.velocity[setup.index(cell)]).to_vec()
        }
        Measure::Profile { .. } => Vec::new(),
        Measure::MaxSpeed => vec![units.velocity_to_si(max_speed(fields))],
        Measure::KineticEnergy => {
            vec![run.totals().kinetic_energy * mass_unit * velocity_unit * velocity_unit]
        }
        Measure::Mass => vec![(run.fluid_cells() as f64 + run.totals().mass_excess) * mass_unit],
        Measure::PlugFraction => {
            let plug = unyielded(setup, fields).iter().filter(|u| **u).count();
            vec![plug as f64 / run.fluid_cells().max(1) as f64]
        }
        Measure::FlowRate { normal, at_m } => {
            let at = layer(at_m, normal.index(), setup, units);
            let cells = (0..setup.cells()).filter(|&c| setup.coordinates(c)[normal.index()] == at);
            let sum: f64 = cells.map(|c| fields.velocity[c][normal.index()]).sum();
            vec![units.velocity_to_si(sum) * units.dx_m * units.dx_m]
        }
        _ => Vec::new(),
    }
}

/// The layer of cells that holds a coordinate.
fn layer(at_m: f64, axis: usize, setup: &Setup, units: &Units) -> usize {
    let layer = libm::floor(units.length_to_lattice(at_m)) as usize;
    layer.min(setup.extents[axis] - 1)
}

/// Column names and units of a profile.
pub(super) const PROFILE_COLUMNS: [(&str, &str); 7] = [
    ("position", "m"),
    ("velocity_x", "m/s"),
    ("velocity_y", "m/s"),
    ("velocity_z", "m/s"),
    ("shear_rate", "1/s"),
    ("pressure", "Pa"),
    ("unyielded_fraction", "-"),
];

/// Averages over planes normal to an axis, fluid cells only; planes without fluid are left out.
pub(super) fn profile(along: Axis, setup: &Setup, fields: &Fields, units: &Units) -> Vec<[f64; 7]> {
    let a = along.index();
    let mut sums = vec![[0.0; 7]; setup.extents[a]];
    let unyielded = unyielded(setup, fields);
    for cell in (0..setup.cells()).filter(|&c| !setup.is_solid(c)) {
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
