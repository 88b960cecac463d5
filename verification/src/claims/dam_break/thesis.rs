//! The slope flows of 004 Ch. 5: a reservoir of Herschel-Bulkley fluid released on an incline, with and
//! without an erodible bed, set up in lattice units.

use crate::claims::columns;
use crate::exact::ExactError;
use crate::exact::flow_curve::FlowCurve;
use crate::exact::thin_layer::{Geometry, Snapshot, ThinLayer, setting};
use lahar::free_surface::settle::settle;
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, FreeSurface, Setup, SolidMotion, SurfaceForce, YieldTreatment};
use lahar::solver::run::{Fields, Run};
use lahar::units::Units;

/// ρ, kg/m³.
pub const DENSITY: f64 = 997.45;
/// σ0, Pa.
pub const YIELD_STRESS: f64 = 58.0;
/// K, Pa sⁿ.
pub const CONSISTENCY: f64 = 35.0;
/// n.
pub const INDEX: f64 = 0.33;
/// g, m/s².
pub const GRAVITY: f64 = 9.81;
/// Volume per width, m².
pub const VOLUME: f64 = 0.03;
/// Reservoir length along the slope, m.
pub const LENGTH: f64 = 0.3;
/// Elevation above the top of the bed that counts as the front, m.
pub const THRESHOLD: f64 = 3e-3;

/// One run of 004 Table 5.1 in numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// θ in degrees.
    pub slope_deg: f64,
    /// Erodible bed: start, m, and depth, m; its length is 0.3 m.
    pub bed: Option<(f64, f64)>,
    /// μ_max in Pa s, μ_min a thousandth of it; `None`: exact yield.
    pub clamp: Option<f64>,
    /// Length of the box, m.
    pub box_length: f64,
}

/// Run A: 12°.
pub const A: Case = Case { slope_deg: 12.0, bed: None, clamp: None, box_length: 1.05 };
/// Runs C and G: 16°.
pub const C: Case = Case { slope_deg: 16.0, bed: None, clamp: None, box_length: 1.2 };
/// Run E: 16°, bed of 6 mm from 0.7 m.
pub const E: Case = Case { slope_deg: 16.0, bed: Some((0.7, 6e-3)), clamp: None, box_length: 1.26 };
/// Run H: 16°, bed of 6 mm from 0.9 m.
pub const H: Case = Case { slope_deg: 16.0, bed: Some((0.9, 6e-3)), clamp: None, box_length: 1.32 };
/// Run C with the papers' largest viscosity.
pub const C_CLAMPED: Case = Case { clamp: Some(150.0), box_length: 1.5, ..C };

/// Length of an erodible bed, m.
const BED_LENGTH: f64 = 0.3;

/// How a case is discretised.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Δx, m.
    pub dx: f64,
    /// 3 g H Δt²/Δx² \[F7\], H the depth at the gate.
    pub compression: f64,
    /// Force rule in interface cells.
    pub force: SurfaceForce,
    /// Whether the reservoir starts with the mass that was drawn ([`settle`]).
    pub settled: bool,
}

impl Grid {
    /// The design's time step at a spacing in mm.
    pub const fn millimetres(dx: f64) -> Self {
        Self { dx: dx * 1e-3, compression: 0.02, force: SurfaceForce::ByFill, settled: true }
    }
}

/// A case on its grid, ready to start.
pub struct Prepared {
    /// For the backend.
    pub setup: Setup,
    /// Its scales.
    pub units: Units,
    /// Cells below the top of the bed.
    bed_cells: usize,
}

impl Case {
    fn theta(&self) -> f64 {
        self.slope_deg.to_radians()
    }

    /// Depth at the gate, m.
    pub fn gate_depth(&self) -> f64 {
        VOLUME / LENGTH + 0.5 * LENGTH * libm::tan(self.theta())
    }

    /// Δt in s.
    pub fn time_step(&self, grid: Grid) -> f64 {
        grid.dx * (grid.compression / (3.0 * GRAVITY * self.gate_depth())).sqrt()
    }

    /// Lattice set-up.
    pub fn prepare(&self, grid: Grid) -> Prepared {
        let dx = grid.dx;
        let units = Units::new(dx, self.time_step(grid), DENSITY);
        let (start, depth) = self.bed.unwrap_or((0.0, 0.0));
        let bed_cells = (depth / dx).round() as usize;
        let nx = (self.box_length / dx).round() as usize;
        let nz = bed_cells + (self.gate_depth() / dx).ceil() as usize + 2;
        let law = Law::HerschelBulkley {
            sigma0: units.stress_to_lattice(YIELD_STRESS),
            k: units.consistency_to_lattice(CONSISTENCY, INDEX),
            n: INDEX,
        };
        let mut setup = Setup::periodic([nx, 1, nz], law);
        setup.faces[0] = [Face::NoSlip; 2];
        setup.faces[2] = [Face::NoSlip; 2];
        let weight = units.force_to_lattice(DENSITY * GRAVITY);
        let (sin, cos) = (libm::sin(self.theta()), libm::cos(self.theta()));
        setup.force = BodyForce::Constant([weight * sin, 0.0, -(weight * cos)]);
        if let Some(largest) = self.clamp {
            let tau = |mu: f64| 0.5 + 3.0 * units.viscosity_to_lattice(mu);
            setup.yielding =
                YieldTreatment::ImplicitClamped { tau_min: tau(1e-3 * largest), tau_max: tau(largest) };
        }
        if bed_cells > 0 {
            let rigid = |cell: usize| {
                let [i, _, k] = setup.coordinates(cell);
                let x = (i as f64 + 0.5) * dx;
                k < bed_cells && !(x > start && x < start + BED_LENGTH)
            };
            setup.solids = (0..setup.cells()).map(|cell| u8::from(rigid(cell))).collect();
            setup.solid_motion = vec![SolidMotion::default()];
        }
        let fill = (0..setup.cells()).map(|cell| {
            let [i, _, k] = setup.coordinates(cell);
            if k < bed_cells { 1.0 } else { self.fill(i as f64 * dx, (k - bed_cells) as f64 * dx, dx) }
        });
        let mut fill: Vec<f64> = fill.collect();
        if grid.settled {
            let is_solid = |cell: usize| setup.is_solid(cell);
            fill = settle(setup.extents, setup.periodic_axes(), &fill, is_solid, &setup.force.at(0));
        }
        let mut surface = FreeSurface::new(fill);
        surface.force = grid.force;
        setup.free_surface = Some(surface);
        Prepared { setup, units, bed_cells }
    }

    /// Fill of the cell with its low corner at (x, z) above the bed: mean over 16 strips.
    fn fill(&self, x: f64, z: f64, dx: f64) -> f64 {
        const STRIPS: usize = 16;
        let tan = libm::tan(self.theta());
        let part = |s: usize| {
            let at = x + (s as f64 + 0.5) / STRIPS as f64 * dx;
            let depth = self.gate_depth() - (LENGTH - at) * tan;
            if at < LENGTH { ((depth - z) / dx).clamp(0.0, 1.0) } else { 0.0 }
        };
        (0..STRIPS).map(part).sum::<f64>() / STRIPS as f64
    }

    /// The depth-averaged twin with any law, at the given times in s, cells of 2.5 mm: fronts to ±0.5 mm.
    ///
    /// # Errors
    /// Those of [`ThinLayer::run`].
    pub fn twin<C: FlowCurve>(&self, law: C, times: &[f64]) -> Result<Vec<Snapshot>, ExactError> {
        self.twin_of_volume(law, times, VOLUME)
    }

    /// The twin with another volume, m².
    ///
    /// # Errors
    /// Those of [`ThinLayer::run`].
    pub fn twin_of_volume<C: FlowCurve>(
        &self,
        law: C,
        times: &[f64],
        volume: f64,
    ) -> Result<Vec<Snapshot>, ExactError> {
        let dx = 2.5e-3;
        let cells = (1.3 * self.box_length / dx).round() as usize;
        let bed = match self.bed {
            Some((start, depth)) => setting::recess(start, BED_LENGTH, depth, 0.01, dx, cells)?,
            None => vec![0.0; cells],
        };
        let reservoir = setting::reservoir(self.theta(), volume, LENGTH, dx, cells)?;
        let layer = ThinLayer {
            law,
            density: DENSITY,
            gravity: GRAVITY,
            slope: self.theta(),
            geometry: Geometry::Planar,
            dx,
            bed,
            tolerance: 1e-4,
        };
        Ok(layer.run(&setting::filled_to_zero(&reservoir), times)?.snapshots)
    }
}

impl Prepared {
    /// Depth of fluid above the top of the bed in every column, m.
    pub fn depths(&self, fields: &Fields) -> Vec<f64> {
        let cells = columns::depths(&self.setup, fields, self.bed_cells);
        cells.into_iter().map(|depth| self.units.length_to_si(depth)).collect()
    }

    /// x of the column centres, m.
    pub fn positions(&self) -> Vec<f64> {
        (0..self.setup.extents[0]).map(|i| (i as f64 + 0.5) * self.units.dx_m).collect()
    }

    /// Largest x at which the depth above the bed falls through [`THRESHOLD`], m; 0 without any.
    pub fn front(&self, depths: &[f64]) -> f64 {
        self.units.dx_m * columns::front(depths, THRESHOLD)
    }

    /// Mass-weighted mean velocity along the slope, m/s.
    pub fn mean_velocity(&self, run: &dyn Run) -> f64 {
        let mass = run.ledger().map_or(f64::NAN, |ledger| ledger.mass);
        self.units.velocity_to_si(run.totals().momentum[0] / mass)
    }

    /// Steps to a time in s.
    pub fn steps(&self, time: f64) -> u64 {
        self.units.time_to_lattice(time).round() as u64
    }
}
