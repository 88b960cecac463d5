//! What probes say about the fluid, in SI units.

use super::columns::{Upright, front};
use super::fields::{fill, is_fluid, layer, max_speed, unyielded, window};
use super::moving_mean::Wrench;
use super::quantity::{Quantity, one, several, vector, vectors};
use crate::geometry::Axis;
use crate::scene::Scene;
use crate::setup::Setup;
use crate::solver::run::{Fields, Load, Run};
use crate::units::Units;
use crate::vector::{cross, sub};

/// What stays the same about the fluid of a run.
pub(in crate::run) struct Frame {
    /// The scales between SI and lattice.
    pub units: Units,
    /// Which way columns of fluid stand.
    pub upright: Upright,
    /// Names of the solids, in the order of the loads on them.
    solids: Vec<String>,
}

impl Frame {
    pub fn new(scene: &Scene, units: Units) -> Self {
        let (up, down_is_low) = crate::scene::force::up(scene);
        let solids = scene.solids.iter().map(|solid| solid.name.clone()).collect();
        Self { units, upright: Upright { up, down_is_low }, solids }
    }

    /// Rows of a section along an axis of the bed: position, bed, depth, surface, mean velocity.
    pub(crate) fn section(
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
pub(in crate::run) const SECTION_COLUMNS: [(&str, &str); 7] = [
    ("position", "m"),
    ("bed", "m"),
    ("depth", "m"),
    ("surface", "m"),
    ("mean_velocity_x", "m/s"),
    ("mean_velocity_y", "m/s"),
    ("mean_velocity_z", "m/s"),
];

/// The fluid at one time.
#[derive(Clone, Copy)]
pub(in crate::run) struct Fluid<'a> {
    pub run: &'a dyn Run,
    pub fields: &'a Fields,
    pub frame: &'a Frame,
}

impl Fluid<'_> {
    fn volume_unit(&self) -> f64 {
        let dx = self.frame.units.dx_m;
        dx * dx * dx
    }

    fn mass_unit(&self) -> f64 {
        self.frame.units.rho0_kg_per_m3 * self.volume_unit()
    }

    /// Velocity of the cell that holds a point.
    pub(crate) fn point_velocity(&self, at_m: [f64; 3]) -> Vec<Quantity> {
        let (setup, units) = (self.run.setup(), &self.frame.units);
        let cell: [usize; 3] = std::array::from_fn(|a| layer(at_m[a], a, setup, units));
        vector("", "m/s", units.velocities_to_si(self.fields.velocity[setup.index(cell)]))
    }

    pub(crate) fn max_speed(&self) -> Vec<Quantity> {
        one("m/s", self.frame.units.velocity_to_si(max_speed(self.fields)))
    }

    pub(super) fn kinetic_energy_j(&self) -> f64 {
        let velocity_unit = self.frame.units.velocity_unit();
        self.run.totals().kinetic_energy * self.mass_unit() * velocity_unit * velocity_unit
    }

    pub fn kinetic_energy(&self) -> Vec<Quantity> {
        one("J", self.kinetic_energy_j())
    }

    pub(super) fn mass_kg(&self) -> f64 {
        let mass = match self.run.ledger() {
            Some(ledger) => ledger.mass,
            None => self.run.fluid_cells() as f64 + self.run.totals().mass_excess,
        };
        mass * self.mass_unit()
    }

    pub(crate) fn mass(&self) -> Vec<Quantity> {
        one("kg", self.mass_kg())
    }

    /// Share of the fluid cells that are unyielded.
    fn plug(&self) -> f64 {
        let plug = unyielded(self.run.setup(), self.fields).iter().filter(|u| **u).count();
        plug as f64 / self.run.fluid_cells().max(1) as f64
    }

    pub(crate) fn plug_fraction(&self) -> Vec<Quantity> {
        one("-", self.plug())
    }

    pub(crate) fn yielded_fraction(&self) -> Vec<Quantity> {
        one("-", 1.0 - self.plug())
    }

    /// Volume per time through a layer of cells.
    pub(crate) fn flow_rate(&self, normal: Axis, at_m: f64) -> Vec<Quantity> {
        let (setup, units, fields) = (self.run.setup(), &self.frame.units, self.fields);
        let at = layer(at_m, normal.index(), setup, units);
        let cells = (0..setup.cells()).filter(|&c| setup.coordinates(c)[normal.index()] == at);
        let sum: f64 = cells.map(|c| fields.velocity[c][normal.index()] * fill(fields, c)).sum();
        one("m^3/s", units.velocity_to_si(sum) * units.dx_m * units.dx_m)
    }

    pub(crate) fn volume(&self) -> Vec<Quantity> {
        let setup = self.run.setup();
        let fluid = |c: &usize| is_fluid(setup, self.fields, *c);
        let filled: f64 = (0..setup.cells()).filter(fluid).map(|c| fill(self.fields, c)).sum();
        one("m^3", filled * self.volume_unit())
    }

    /// Farthest position at which the flow is deeper than a threshold.
    pub(crate) fn front(
        &self,
        along: Axis,
        threshold_m: f64,
        from_m: Option<f64>,
        above_m: Option<f64>,
    ) -> Vec<Quantity> {
        let depths = self.deepest(along, above_m);
        one("m", front(&depths, self.frame.units.dx_m, threshold_m, from_m.unwrap_or(0.0)))
    }

    /// Greatest depth of every layer of columns along an axis of the bed, m.
    fn deepest(&self, along: Axis, above_m: Option<f64>) -> Vec<f64> {
        let (setup, upright) = (self.run.setup(), self.frame.upright);
        let [a, b] = upright.across();
        let columns = upright.columns(setup, self.fields, &self.frame.units, above_m);
        let mut depths = vec![0.0; setup.extents[along.index()]];
        for (i, column) in columns.iter().enumerate() {
            let at = [i % setup.extents[a], i / setup.extents[a]];
            let layer = if along.index() == a { at[0] } else { at[1] };
            debug_assert!(along.index() == a || along.index() == b);
            depths[layer] = if column.depth > depths[layer] { column.depth } else { depths[layer] };
        }
        depths
    }

    /// Mean velocity of the fluid inside a box, and its volume.
    pub(crate) fn window_velocity(&self, min_m: [f64; 3], max_m: [f64; 3]) -> Vec<Quantity> {
        let (mean, volume) = window(self.run.setup(), self.fields, &self.frame.units, min_m, max_m);
        let mut row = vector("", "m/s", mean);
        row.extend(several([("volume", "m^3", volume)]));
        row
    }

    /// Centre of a solid, cells, and the load on it.
    fn load_on(&self, solid: &str) -> ([f64; 3], Load) {
        let number = self.frame.solids.iter().position(|name| name == solid);
        let load = number.and_then(|n| self.run.loads().get(n).copied()).unwrap_or_default();
        let centre = number.and_then(|n| self.run.setup().solid_motion.get(n)).map_or([0.0; 3], |m| m.centre);
        (centre, load)
    }

    /// Force on a solid, N, and its torque about a point, N m, M_p = M_c + (c − p) × F; about its centre of rotation c
    /// without one.
    pub(super) fn wrench(&self, solid: &str, about_m: Option<[f64; 3]>) -> Wrench {
        let (centre, load) = self.load_on(solid);
        let units = &self.frame.units;
        let about = about_m.map_or(centre, |p| p.map(|x| units.length_to_lattice(x)));
        let moved = cross(sub(centre, about), load.force);
        let area = units.dx_m * units.dx_m;
        let [newton, metre] = [units.force_unit() * area * units.dx_m, units.force_unit() * area * area];
        let moment = std::array::from_fn(|a| (load.torque[a] + moved[a]) * metre);
        Wrench { force: load.force.map(|f| f * newton), moment }
    }

    /// Torque on a solid about a point; about its centre of rotation without one.
    pub fn torque(&self, solid: &str, about_m: Option<[f64; 3]>) -> Vec<Quantity> {
        vector("", "N m", self.wrench(solid, about_m).moment)
    }

    /// Force, impulse, and wetted area by axis and side of a solid: `area_x_low` has its fluid at smaller x.
    pub fn load(&self, solid: &str) -> Vec<Quantity> {
        let Load { force, impulse, wetted, .. } = self.load_on(solid).1;
        let units = &self.frame.units;
        let area = units.dx_m * units.dx_m;
        let newton = units.force_unit() * area * units.dx_m;
        let mut row = vectors([
            ("", "N", force.map(|f| f * newton)),
            ("impulse", "N s", impulse.map(|i| i * newton * units.dt_s)),
        ]);
        row.extend(several([
            ("area_x_low", "m^2", wetted[0][0] * area),
            ("area_x_high", "m^2", wetted[0][1] * area),
            ("area_y_low", "m^2", wetted[1][0] * area),
            ("area_y_high", "m^2", wetted[1][1] * area),
            ("area_z_low", "m^2", wetted[2][0] * area),
            ("area_z_high", "m^2", wetted[2][1] * area),
        ]));
        row
    }

    pub fn ledger(&self) -> Vec<Quantity> {
        let (ledger, mass_unit) = (self.run.ledger().unwrap_or_default(), self.mass_unit());
        let momentum_unit = self.frame.units.velocity_unit();
        let dx = self.frame.units.dx_m;
        let volume_unit = dx * dx * dx;
        several([
            ("mass", "kg", ledger.mass * mass_unit),
            ("mass_residual", "-", ledger.mass_residual),
            ("outflow", "kg", ledger.outflow * mass_unit),
            ("parked", "kg", ledger.parked * mass_unit),
            ("voids", "m^3", ledger.voids * volume_unit),
            ("momentum_residual", "N s", ledger.momentum_residual * mass_unit * momentum_unit),
            ("conversions", "-", ledger.conversions as f64),
        ])
    }
}
