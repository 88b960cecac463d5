//! Grains in a fluid: sub-steps, gravity, checks, and what `lahar plan` says about them.

mod bytes;
mod classes;
mod numbers;
mod print;
mod speed;
mod sub_steps;
mod warnings;

use std::sync::Arc;

pub(super) use bytes::{added_bytes, links};
pub use classes::ClassNumbers;
pub(super) use numbers::Given;
pub use numbers::{CoupledNumbers, LubricationNumbers, SubStepsFrom};
pub(super) use print::table;

use self::sub_steps::{Stepping, gap_viscosity, sub_steps};
use super::cells::Cells;
use super::error::{PlanError, PlanProblem};
use super::facts::Facts;
use super::grains::{GrainPlan, Placed, refusal, speed as impact};
use super::scale::Scales;
use super::warning::Warning;
use crate::coupling::{GrainRefill, GrainWall, Lubrication, Suspension};
use crate::dem::{Dem, Setup as Grains};
use crate::scene::dry::DryScene;
use crate::scene::{GrainRefillChoice, GrainWallChoice, LubricationChoice, Scene};
use crate::setup::Setup;
use crate::units::Units;

/// Where a scene gives the number of sub-steps.
const SUB_STEPS: &str = "grains.coupling.sub_steps";
/// Least density of a grain over that of the fluid.
const LEAST_DENSITY_RATIO: f64 = 0.3;
/// Least radius, cells.
const LEAST_RADIUS: f64 = 1.0;

/// Grains of a scene with fluid, planned.
#[derive(Clone, Debug)]
pub struct Coupled {
    /// The scene as its grains see it.
    pub scene: DryScene,
    /// Their plan; its time step is that of the sub-steps.
    pub grains: GrainPlan,
    /// What the solver is asked to do.
    pub suspension: Arc<Suspension>,
}

/// Grains placed and checked, before the time step of the fluid is known.
pub(super) struct Started {
    view: DryScene,
    placed: Placed,
    /// Fastest grain relative to the fluid, m/s.
    slip: f64,
    /// Fastest wall, driven grain, or grain at time 0, m/s.
    pub given: f64,
    /// Speed that contacts are planned for, m/s.
    design: f64,
}

/// Places the grains and raises the scales of the flow to what they will stir up; `None` without grains.
pub(super) fn start(
    facts: &Facts,
    cells: &Cells,
    scales: &mut Scales,
    available: Option<u64>,
) -> Result<Option<Started>, PlanError> {
    let scene = facts.scene;
    let Some(view) = scene.as_dry() else { return Ok(None) };
    let at = |path: &str, problem| PlanError::new(&scene.file, path, problem);
    let placed = GrainPlan::placed(&view, available)?;
    let faces = placed.walls.faces.len();
    for (i, (_, walls)) in placed.walls.solids.iter().enumerate() {
        debug_assert!(walls.iter().all(|&wall| wall >= faces));
        if walls.iter().any(|&wall| placed.setup.walls[wall].shifts()) {
            return Err(at(&format!("solids[{i}]"), PlanProblem::SolidLeavesCells));
        }
    }
    let setup = &placed.setup;
    resolution(scene, &placed)?;
    densities(scene, setup)?;
    let slips = setup.grains.iter().map(|grain| speed::relative(facts, setup, cells, grain));
    let slip = slips.fold(0.0, f64::max);
    let (pushed, free) = impact::given_speeds(&view, setup);
    let given = pushed.max(free);
    let mut design = slip + pushed + free + scales.velocity;
    if design == 0.0 {
        // Everything rests: contacts of grains that shift by a hundredth of what falling by their size would give.
        let size = setup.grains.iter().map(|grain| grain.radius).fold(0.0, f64::max);
        design = 0.01 * (4.0 * setup.gravity.norm() * size).sqrt();
    }
    if scene.numerics.reference_velocity_m_per_s.is_none() {
        scales.velocity = scales.velocity.max(given) + slip;
        scales.shear_rate = 2.0 * scales.velocity / scales.length;
        let smallest = setup.grains.iter().map(|grain| grain.radius).fold(f64::INFINITY, f64::min);
        // Stokes: the rate at the side of a sphere is 3U/(2R).
        let around = 1.5 * (slip + given) / smallest.max(scene.domain.spacing_m);
        scales.shear_rate_max = scales.shear_rate_max.max(scales.shear_rate).max(around);
    }
    Ok(Some(Started { view, placed, slip, given, design }))
}

/// Grains of at least a cell's radius.
fn resolution(scene: &Scene, placed: &Placed) -> Result<(), PlanError> {
    let dx = scene.domain.spacing_m;
    for (i, (name, range)) in placed.sets.iter().enumerate() {
        let Some(grains) = placed.setup.grains.get(range.clone()) else { continue };
        let least = grains.iter().map(|grain| grain.radius).fold(f64::INFINITY, f64::min);
        // Half a unit in the last printed digit of slack.
        if least < LEAST_RADIUS * dx * (1.0 - 1e-9) {
            let problem = PlanProblem::GrainTooSmall {
                set: name.clone(),
                radius: least,
                cells: least / dx,
                least: LEAST_RADIUS,
                spacing: least / LEAST_RADIUS,
                good: least / 4.0,
            };
            return Err(PlanError::new(&scene.file, format!("grains.sets[{i}]"), problem));
        }
    }
    Ok(())
}

/// Density of every free grain over that of the fluid.
fn ratios<'a>(scene: &'a Scene, setup: &'a Grains) -> impl Iterator<Item = (usize, f64)> + 'a {
    let density = scene.fluid.density_kg_per_m3;
    let free = setup.grains.iter().filter(|grain| !grain.driven);
    free.map(move |grain| (grain.material, setup.materials.list[grain.material].density_kg_m3 / density))
}

fn densities(scene: &Scene, setup: &Grains) -> Result<(), PlanError> {
    match ratios(scene, setup).find(|(_, ratio)| *ratio < LEAST_DENSITY_RATIO) {
        None => Ok(()),
        Some((material, ratio)) => Err(PlanError::new(
            &scene.file,
            format!("grains.materials[{material}].density_kg_per_m3"),
            PlanProblem::GrainTooLight {
                density: setup.materials.list[material].density_kg_m3,
                ratio,
                least: LEAST_DENSITY_RATIO,
                least_density: LEAST_DENSITY_RATIO * scene.fluid.density_kg_per_m3,
            },
        )),
    }
}

impl Started {
    /// Speed of the fastest grain, m/s.
    pub(super) fn fastest(&self) -> f64 {
        self.slip + self.given
    }

    /// Sub-steps, gravity and rules; puts the grains into the set-up.
    pub(super) fn finish(
        self,
        facts: &Facts,
        units: &Units,
        scales: &Scales,
        setup: &mut Setup,
        rule_path: &str,
    ) -> Result<(Coupled, Findings), PlanError> {
        let scene = facts.scene;
        let at = |path: &str, problem| PlanError::new(&scene.file, path, problem);
        let Self { view, placed, slip, given, design } = self;
        let fastest = units.velocity_to_lattice(slip + given);
        if fastest > setup.speed_limit {
            let problem = PlanProblem::GrainsTooFast {
                speed: slip + given,
                lattice: fastest,
                limit: setup.speed_limit,
                dt: units.dt_s,
                dt_max: units.dt_s * setup.speed_limit / fastest,
            };
            return Err(at(rule_path, problem));
        }
        // Grains that are all driven take whole steps of the fluid.
        let mut grains = GrainPlan::finish(&view, placed, design, Some(view.stop.end_time_s))?;
        let lubrication = lubrication(scene.coupling().lubrication);
        let stepping = sub_steps(scene, units, &grains, lubrication, gap_viscosity(facts, scales))
            .map_err(|problem| at(SUB_STEPS, problem))?;
        take_sub_steps(&mut grains, &view, units, &stepping)?;
        let suspension = Arc::new(suspension(facts, &grains, units, &stepping, lubrication));
        setup.grains = Some(Arc::clone(&suspension));
        let findings = Findings { slip, fastest, stepping };
        Ok((Coupled { scene: view, grains, suspension }, findings))
    }
}

/// Gives the grains the time step of the sub-steps, and all that follows from it.
fn take_sub_steps(
    grains: &mut GrainPlan,
    view: &DryScene,
    units: &Units,
    stepping: &Stepping,
) -> Result<(), PlanError> {
    let dt = units.dt_s / f64::from(stepping.sub_steps);
    grains.setup.time_step_s = Some(dt);
    if stepping.given {
        // The check that needs the step: a contact must be resolved.
        Dem::new(&grains.setup).map_err(|error| {
            let mut refused = refusal(view, &grains.sets, error);
            // Here the step comes from their number.
            if matches!(
                *refused.problem,
                PlanProblem::GrainTimeStep { .. } | PlanProblem::GrainStepUnstable { .. }
            ) {
                SUB_STEPS.clone_into(&mut refused.path);
            }
            refused
        })?;
    }
    grains.steps = (view.stop.end_time_s / units.dt_s).round() as u64 * u64::from(stepping.sub_steps);
    let n = &mut grains.numbers;
    n.steps_per_contact *= n.time_step_s / dt;
    n.time_step_s = dt;
    n.steps = grains.steps;
    n.sphere_updates = n.spheres as f64 * grains.steps as f64;
    Ok(())
}

/// What the solver is asked to do with the grains.
fn suspension(
    facts: &Facts,
    grains: &GrainPlan,
    units: &Units,
    stepping: &Stepping,
    lubrication: Option<Lubrication>,
) -> Suspension {
    let (rules, forces) = (facts.scene.coupling(), &facts.forces);
    let mut suspension = Suspension::new(grains.setup.clone(), *units);
    suspension.sub_steps = stepping.sub_steps;
    suspension.wall = match rules.wall {
        GrainWallChoice::HalfWay => GrainWall::HalfWay,
        GrainWallChoice::CentralLinear => GrainWall::CentralLinear,
    };
    suspension.refill = match rules.refill {
        GrainRefillChoice::WithStress => GrainRefill::WithStress,
        GrainRefillChoice::Equilibrium => GrainRefill::Equilibrium,
        GrainRefillChoice::Neighbours => GrainRefill::Neighbours,
    };
    suspension.lubrication = lubrication;
    suspension.balanced = forces.balanced;
    suspension.pressure_gradient = std::array::from_fn(|a| {
        let weight = units.rho0_kg_per_m3 * forces.gravity[a];
        // Not −0: it would show in hashes of the set-up.
        if forces.weightless[a] && weight != 0.0 { -units.force_to_lattice(weight) } else { 0.0 }
    });
    suspension
}

/// What the table of `lahar plan` needs besides the plan.
#[derive(Clone, Copy, Debug)]
pub(super) struct Findings {
    /// m/s.
    pub slip: f64,
    /// Cells per step.
    pub fastest: f64,
    pub stepping: Stepping,
}

fn lubrication(choice: LubricationChoice) -> Option<Lubrication> {
    let LubricationChoice::On(rules) = choice else { return None };
    let default = Lubrication::default();
    Some(Lubrication {
        cutoff: rules.cutoff_cells.unwrap_or(default.cutoff),
        smallest_gap: rules.smallest_gap_cells.unwrap_or(default.smallest_gap),
        tangential: rules.tangential.unwrap_or(default.tangential),
    })
}

/// What `lahar plan` shows about the grains, and its warnings.
pub(super) fn numbers(given: &Given) -> (CoupledNumbers, Vec<Warning>) {
    let numbers = numbers::numbers(given);
    let warnings = warnings::warnings(given, &numbers);
    (numbers, warnings)
}
