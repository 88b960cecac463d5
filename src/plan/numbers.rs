//! The numbers `lahar plan` shows.

use serde::Serialize;

use super::cost::Passed;
use super::coupled::CoupledNumbers;
use super::disk::Files;
use super::expected::{self, Expectation};
use super::figures::{Basis, arrest_thickness, plug_slip, push, rounding_floor, sheared_layer};
use super::judge::Judged;
use super::memory::{Item, at_most, items};
use super::needs::{Need, passes};
use super::oblique::{Residual, residual};
use super::surface::Pool;
use super::time_step::StepRule;
use super::wall_error::{Expected, Sweep};
use super::warning::Warning;
use crate::geometry::Axis;
use crate::scene::Operator;
use crate::setup::Setup;
use crate::solver::layout::Layout;

/// Everything `lahar plan` shows. Infinite numbers are `null` in JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Numbers {
    /// The scene's title, or its file name.
    pub title: String,
    /// Cells along x, y, z.
    pub extents: [usize; 3],
    /// Cells that hold fluid.
    pub fluid_cells: u64,
    /// Cells inside solids.
    pub solid_cells: u64,
    /// Cell size, m.
    pub spacing_m: f64,
    /// Widest gap between walls, cells; infinite without walls.
    pub gap_cells: f64,
    /// Cells of air at time 0; `null` without a free surface.
    pub gas_cells: Option<u64>,
    /// Greatest depth of the fluid at time 0, cells; `null` without a free surface.
    pub depth_cells: Option<f64>,
    /// Volume of the fluid in the cells at time 0, m³; `null` without a free surface.
    pub volume_m3: Option<f64>,
    /// Volume of what is drawn as fluid and not as a solid, m³; `null` without a free surface.
    pub drawn_m3: Option<f64>,
    /// Thickness at which the fluid stops on this slope, σ0/(f along the bed), m; `null` without a yield
    /// stress, a slope, or a free surface.
    pub arrest_thickness_m: Option<f64>,
    /// Time step, s.
    pub time_step_s: f64,
    /// What fixed the time step.
    pub time_step_rule: StepRule,
    /// End time, s.
    pub end_time_s: f64,
    /// Steps to the end time.
    pub steps: u64,
    /// Expected largest velocity, m/s.
    pub reference_velocity_m_per_s: f64,
    /// The reference velocity, cells per step.
    pub speed_lattice: f64,
    /// Length of the Reynolds number, m.
    pub reference_length_m: f64,
    /// ρ U^(2−n) Lⁿ / K.
    pub reynolds: f64,
    /// σ0 Lⁿ / (K Uⁿ); 0 without yield stress, infinite at rest.
    pub bingham: f64,
    /// U over the speed of sound.
    pub mach: f64,
    /// Collision operator.
    pub operator: Operator,
    /// τ of the plastic viscosity.
    pub tau_plastic: f64,
    /// Least τ expected.
    pub tau_min: f64,
    /// Largest τ; infinite when cells can be unyielded.
    pub tau_max: f64,
    /// Largest stable speed at the least τ, cells per step, where it is known.
    pub stable_speed: Option<f64>,
    /// It over the expected speed.
    pub stability_margin: Option<f64>,
    /// Precision of the populations.
    pub precision: &'static str,
    /// Bytes of a population.
    pub population_bytes: u64,
    /// Most by which rounding can change the velocity, relative: 2⁻²⁴ per rounding (2⁻⁵³ in double precision)
    /// as a body force that never changes sign.
    pub rounding_floor: f64,
    /// Speed at which an unyielded solid held by walls slips, m/s: 2θ f Δt/ρ \[K3\].
    pub plug_slip_m_per_s: f64,
    /// How far it slips over the whole run, m.
    pub plug_slip_m: f64,
    /// What keeps moving where the fluid has come to rest \[F2\] \[F4\]; `null` where it is at rest and level from the start, and
    /// where nothing holds it.
    pub residual: Option<Residual>,
    /// Error to expect of plane walls along which a force drives the fluid; `null` in any other flow.
    pub wall_error: Option<Expected>,
    /// Errors to expect of the whole flow, by the random scenes most like it.
    pub expected: Expectation,
    /// Share of the expected speed that a step of the force along walls adds; `null` without walls.
    pub push_per_step: Option<f64>,
    /// Bytes of each feature.
    pub memory: Vec<Item>,
    /// Bytes per cell of the box, all features.
    pub bytes_per_cell: f64,
    /// Bytes of the run.
    pub bytes: u64,
    /// Bytes once the fluid has reached every open cell; `null` where that is no more.
    pub bytes_at_most: Option<u64>,
    /// Files, by kind.
    pub files: Vec<Files>,
    /// Passes.
    pub passes: Vec<Need>,
    /// What a step passes over.
    pub passed: Passed,
    /// Cell updates in the whole run.
    pub cell_updates: f64,
    /// Rough duration on one thread, s: up to the end time, which a flow that is steady or at rest does not reach.
    pub estimated_seconds: f64,
    /// What to think about before running.
    pub warnings: Vec<Warning>,
    /// The grains; left out without any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grains: Option<CoupledNumbers>,
}

/// What the numbers follow from.
pub(super) struct Given<'a> {
    pub basis: Basis<'a>,
    pub judged: Judged,
    pub rule: StepRule,
    pub fluid_cells: u64,
    pub layout: Layout,
}

/// What a run holds, and the sum of its bytes.
fn counted(setup: &Setup, layout: Layout) -> (Vec<Item>, u64) {
    let memory = items(setup, layout);
    let bytes = memory.iter().map(|item| item.bytes).sum();
    (memory, bytes)
}

/// The axis of the depth, where the fluid is not level from the start.
fn spreads(pool: Option<Pool>) -> Option<Axis> {
    pool.filter(|pool| !pool.level).map(|pool| pool.up)
}

/// The error that the rows of the sweep make likely.
fn wall_error(basis: &Basis) -> Option<Expected> {
    Sweep::built_in().ok()?.expected(&sheared_layer(basis)?)
}

/// All but warnings and grains.
pub(super) fn numbers(given: &Given) -> Numbers {
    let basis @ Basis { facts, units, setup, scales, pool, steps, gap } = &given.basis;
    let (scene, curve) = (facts.scene, facts.curve());
    let cells = setup.cells() as u64;
    let solid_cells = setup.solids.iter().filter(|&&s| s != 0).count() as u64;
    let (u, length) = (scales.velocity, scales.length);
    let Judged { speed: speed_lattice, mach, tau_plastic, tau_min, tau_max, .. } = given.judged;
    let (stable_speed, slip) = (given.judged.stable_speed(), plug_slip(basis));
    let ((memory, bytes), passed) = (counted(setup, given.layout), Passed::of(setup, spreads(*pool)));
    let (viscous_stress, plastic_stress) = (curve.viscous_stress(u / length), curve.plastic_stress());
    Numbers {
        title: scene.title.clone().unwrap_or_else(|| scene.file.clone()),
        extents: setup.extents,
        fluid_cells: given.fluid_cells,
        solid_cells,
        spacing_m: units.dx_m,
        gap_cells: *gap,
        gas_cells: pool.map(|_| cells - solid_cells - given.fluid_cells),
        depth_cells: pool.map(|pool| units.length_to_lattice(pool.depth)),
        volume_m3: pool.map(|pool| pool.volume),
        drawn_m3: pool.map(|pool| pool.drawn),
        arrest_thickness_m: arrest_thickness(basis),
        time_step_s: units.dt_s,
        time_step_rule: given.rule,
        end_time_s: scene.stop.end_time_s,
        steps: *steps,
        reference_velocity_m_per_s: u,
        speed_lattice,
        reference_length_m: length,
        reynolds: if u > 0.0 { units.rho0_kg_per_m3 * u * u / viscous_stress } else { 0.0 },
        bingham: if plastic_stress > 0.0 { plastic_stress / viscous_stress } else { 0.0 },
        mach,
        operator: Operator::of(&setup.collision),
        tau_plastic,
        tau_min,
        tau_max,
        stable_speed,
        stability_margin: stable_speed.filter(|_| speed_lattice > 0.0).map(|limit| limit / speed_lattice),
        precision: setup.precision.name(),
        population_bytes: setup.precision.bytes(),
        rounding_floor: rounding_floor(basis, tau_min),
        plug_slip_m_per_s: slip,
        plug_slip_m: slip * scene.stop.end_time_s,
        residual: residual(basis),
        wall_error: wall_error(basis),
        expected: Expectation::of(expected::of_flow(basis, tau_plastic)),
        push_per_step: push(basis),
        bytes_at_most: at_most(setup, given.layout, &memory),
        memory,
        bytes_per_cell: bytes as f64 / cells as f64,
        bytes,
        files: Vec::new(),
        passes: passes(scene, setup),
        passed,
        cell_updates: given.fluid_cells as f64 * *steps as f64,
        estimated_seconds: passed.seconds(setup, *steps as f64),
        warnings: Vec::new(),
        grains: None,
    }
}
