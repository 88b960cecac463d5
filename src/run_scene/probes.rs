//! Measurements on fields, in SI units. Gas and solid cells never count.

use super::columns::{Upright, front};
use super::grains::CONTACT_COLUMNS;
use crate::geometry::Axis;
use crate::scene::{Measure, Probe, Scene};
use crate::setup::{Setup, YieldTreatment};
use crate::solver::run::{Fields, Load, Run};
use crate::units::Units;

/// Largest speed, lattice units.
pub(super) fn max_speed(fields: &Fields) -> f64 {
    fields.velocity.iter().map(square).fold(0.0_f64, |most, s| if s > most { s } else { most }).sqrt()
}

/// Largest speed times fill, lattice units: splashes of little mass count little.
pub(super) fn weighted_speed(fields: &Fields) -> f64 {
    let speeds = fields.velocity.iter().enumerate();
    speeds
        .map(|(c, u)| fill(fields, c) * square(u).sqrt())
        .fold(0.0, |most, s| if s > most { s } else { most })
}

fn square(u: &[f64; 3]) -> f64 {
    u[0] * u[0] + u[1] * u[1] + u[2] * u[2]
}

/// Fill of a cell that may be gas, 0 to 1; 1 everywhere without a free surface.
fn fill(fields: &Fields, cell: usize) -> f64 {
    fields.fill.get(cell).map_or(1.0, |fill| fill.clamp(0.0, 1.0))
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

/// Whether a cell holds fluid.
pub(super) fn is_fluid(setup: &Setup, fields: &Fields, cell: usize) -> bool {
    fields.is_fluid(cell, setup.is_solid(cell))
}

/// Unyielded fluid cells, one entry per cell.
pub(super) fn unyielded(setup: &Setup, fields: &Fields) -> Vec<bool> {
    let cells = fields.omega.iter().enumerate();
    cells.map(|(c, &omega)| is_fluid(setup, fields, c) && is_unyielded(omega, setup.yielding)).collect()
}

/// Name and unit of the series columns of a probe; none for profiles and maps. With grains a force has a part of
/// contacts.
pub(super) fn columns(probe: &Probe, with_grains: bool) -> Vec<(String, &'static str)> {
    let one = |unit| vec![(probe.name.clone(), unit)];
    let several = |parts: &[(&str, &'static str)]| {
        parts.iter().map(|(part, unit)| (format!("{}_{part}", probe.name), *unit)).collect()
    };
    match probe.measure {
        Measure::PointVelocity { .. } => several(&[("x", "m/s"), ("y", "m/s"), ("z", "m/s")]),
        Measure::Profile { .. } | Measure::SurfaceProfile { .. } | Measure::DepthMap { .. } => Vec::new(),
        Measure::MaxSpeed => one("m/s"),
        Measure::KineticEnergy => one("J"),
        Measure::Mass => one("kg"),
        Measure::PlugFraction | Measure::YieldedFraction => one("-"),
        Measure::FlowRate { .. } => one("m^3/s"),
        Measure::Volume => one("m^3"),
        Measure::Front { .. } => one("m"),
        Measure::WindowVelocity { .. } => {
            several(&[("x", "m/s"), ("y", "m/s"), ("z", "m/s"), ("volume", "m^3")])
        }
        Measure::Force { .. } if with_grains => several(&[&FORCE_COLUMNS[..], &CONTACT_COLUMNS[..]].concat()),
        Measure::Force { .. } => several(&FORCE_COLUMNS),
        Measure::Ledger => several(&[
            ("mass", "kg"),
            ("mass_residual", "-"),
            ("outflow", "kg"),
            ("parked", "kg"),
            ("momentum_residual", "N s"),
            ("conversions", "-"),
        ]),
    }
}

/// Force, impulse, and wetted area by axis and side: `area_x_low` has its fluid at smaller x.
const FORCE_COLUMNS: [(&str, &str); 12] = [
    ("x", "N"),
    ("y", "N"),
    ("z", "N"),
    ("impulse_x", "N s"),
    ("impulse_y", "N s"),
    ("impulse_z", "N s"),
    ("area_x_low", "m^2"),
    ("area_x_high", "m^2"),
    ("area_y_low", "m^2"),
    ("area_y_high", "m^2"),
    ("area_z_low", "m^2"),
    ("area_z_high", "m^2"),
];

/// What measurements need to know besides the fields.
pub(super) struct Sampler {
    pub units: Units,
    pub upright: Upright,
    solids: Vec<String>,
}

impl Sampler {
    pub fn new(scene: &Scene, units: Units) -> Self {
        let (up, down_is_low) = crate::scene::force::up(scene);
        let solids = scene.solids.iter().map(|solid| solid.name.clone()).collect();
        Self { units, upright: Upright { up, down_is_low }, solids }
    }

    /// Values of the series columns of a probe.
    pub fn values(&self, measure: &Measure, run: &dyn Run, fields: &Fields) -> Vec<f64> {
        let (setup, units) = (run.setup(), &self.units);
        let volume_unit = units.dx_m * units.dx_m * units.dx_m;
        let mass_unit = units.rho0_kg_per_m3 * volume_unit;
        let velocity_unit = units.velocity_unit();
        let fluid = |c: &usize| is_fluid(setup, fields, *c);
        let plug = || {
            let plug = unyielded(setup, fields).iter().filter(|u| **u).count();
            plug as f64 / run.fluid_cells().max(1) as f64
        };
        match measure {
            Measure::PointVelocity { at_m } => {
                let cell: [usize; 3] = std::array::from_fn(|a| layer(at_m[a], a, setup, units));
                units.velocities_to_si(fields.velocity[setup.index(cell)]).to_vec()
            }
            Measure::Profile { .. } | Measure::SurfaceProfile { .. } | Measure::DepthMap { .. } => Vec::new(),
            Measure::MaxSpeed => vec![units.velocity_to_si(max_speed(fields))],
            Measure::KineticEnergy => {
                vec![run.totals().kinetic_energy * mass_unit * velocity_unit * velocity_unit]
            }
            Measure::Mass => vec![mass(run) * mass_unit],
            Measure::PlugFraction => vec![plug()],
            Measure::YieldedFraction => vec![1.0 - plug()],
            Measure::FlowRate { normal, at_m } => {
                let at = layer(*at_m, normal.index(), setup, units);
                let cells = (0..setup.cells()).filter(|&c| setup.coordinates(c)[normal.index()] == at);
                let sum: f64 = cells.map(|c| fields.velocity[c][normal.index()] * fill(fields, c)).sum();
                vec![units.velocity_to_si(sum) * units.dx_m * units.dx_m]
            }
            Measure::Volume => {
                let filled: f64 = (0..setup.cells()).filter(fluid).map(|c| fill(fields, c)).sum();
                vec![filled * volume_unit]
            }
            Measure::Front { along, threshold_m, from_m, above_m } => {
                let depths = self.deepest(*along, setup, fields, *above_m);
                vec![front(&depths, units.dx_m, *threshold_m, from_m.unwrap_or(0.0))]
            }
            Measure::WindowVelocity { min_m, max_m } => window(setup, fields, units, *min_m, *max_m).to_vec(),
            Measure::Force { solid } => {
                let number = self.solids.iter().position(|name| name == solid);
                let load = number.and_then(|n| run.loads().get(n).copied()).unwrap_or_default();
                self.load(&load)
            }
            Measure::Ledger => {
                let ledger = run.ledger().unwrap_or_default();
                vec![
                    ledger.mass * mass_unit,
                    ledger.mass_residual,
                    ledger.outflow * mass_unit,
                    ledger.parked * mass_unit,
                    ledger.momentum_residual * mass_unit * velocity_unit,
                    ledger.conversions as f64,
                ]
            }
        }
    }

    fn load(&self, load: &Load) -> Vec<f64> {
        let units = &self.units;
        let area = units.dx_m * units.dx_m;
        let force = units.force_unit() * area * units.dx_m;
        let mut values: Vec<f64> = load.force.iter().map(|f| f * force).collect();
        values.extend(load.impulse.iter().map(|i| i * force * units.dt_s));
        values.extend(load.wetted.iter().flatten().map(|wetted| wetted * area));
        values
    }

    /// Greatest depth of every layer of columns along an axis of the bed, m.
    fn deepest(&self, along: Axis, setup: &Setup, fields: &Fields, above_m: Option<f64>) -> Vec<f64> {
        let [a, b] = self.upright.across();
        let columns = self.upright.columns(setup, fields, &self.units, above_m);
        let mut depths = vec![0.0; setup.extents[along.index()]];
        for (i, column) in columns.iter().enumerate() {
            let at = [i % setup.extents[a], i / setup.extents[a]];
            let layer = if along.index() == a { at[0] } else { at[1] };
            debug_assert!(along.index() == a || along.index() == b);
            depths[layer] = if column.depth > depths[layer] { column.depth } else { depths[layer] };
        }
        depths
    }

    /// Rows of a section along an axis of the bed: position, bed, depth, surface, mean velocity.
    pub fn section(
        &self,
        along: Axis,
        at_m: Option<f64>,
        above_m: Option<f64>,
        setup: &Setup,
        fields: &Fields,
    ) -> Vec<[f64; 7]> {
        let [a, b] = self.upright.across();
        let third = if along.index() == a { b } else { a };
        let n = setup.extents;
        let line = at_m.map_or(n[third] / 2, |at| layer(at, third, setup, &self.units));
        let columns = self.upright.columns(setup, fields, &self.units, above_m);
        let row = |i: usize| {
            let column = if along.index() == a { columns[i + n[a] * line] } else { columns[line + n[a] * i] };
            let [u, v, w] = column.velocity;
            let surface = self.upright.surface(&column, above_m);
            [self.units.length_to_si(i as f64 + 0.5), column.bed, column.depth, surface, u, v, w]
        };
        (0..n[along.index()]).map(row).collect()
    }
}

/// Column names and units of a section.
pub(super) const SECTION_COLUMNS: [(&str, &str); 7] = [
    ("position", "m"),
    ("bed", "m"),
    ("depth", "m"),
    ("surface", "m"),
    ("mean_velocity_x", "m/s"),
    ("mean_velocity_y", "m/s"),
    ("mean_velocity_z", "m/s"),
];

/// Mass of the fluid, lattice units.
fn mass(run: &dyn Run) -> f64 {
    match run.ledger() {
        Some(ledger) => ledger.mass,
        None => run.fluid_cells() as f64 + run.totals().mass_excess,
    }
}

/// Mean velocity of the fluid whose cell centres lie in a box, m/s, and its volume, m³.
fn window(setup: &Setup, fields: &Fields, units: &Units, min: [f64; 3], max: [f64; 3]) -> [f64; 4] {
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
    [mean[0], mean[1], mean[2], filled * units.dx_m * units.dx_m * units.dx_m]
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
