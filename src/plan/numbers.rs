//! The numbers `lahar plan` shows.

use serde::Serialize;

use super::coupled::{self, Coupled, CoupledNumbers, Findings};
use super::law::{self, apparent_viscosity, has_plug, plastic_viscosity};
use super::memory::{Item, Layout, items};
use super::needs::{Need, passes};
use super::scale::Scales;
use super::surface::Pool;
use super::time_step::{StepRule, reference_viscosity};
use crate::collision::CollisionChoice;
use crate::scene::force::{extreme_forces, norm, total_force};
use crate::scene::{InitialPressure, Rheology, Scene};
use crate::setup::{Precision, Setup, WallRule, YieldTreatment};
use crate::stability::max_stable_speed;
use crate::units::Units;

/// Cell updates per second assumed for the cost estimate: fast backend, one thread, a flow with a free surface
/// on a processor with 256-bit registers or better. `lahar bench` measures it.
const UPDATES_PER_SECOND: f64 = 1e7;

/// Sphere updates per second assumed for the same: the order of what `lahar bench` gives.
const SPHERE_UPDATES_PER_SECOND: f64 = 2e6;

/// Excess mass worth a warning: 0.4 % of the volume moves the front of a long thin flow by as much.
const LEAST_EXCESS: f64 = 4e-3;

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
    /// Volume of the fluid at time 0, m³; `null` without a free surface.
    pub volume_m3: Option<f64>,
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
    /// The same, cells per step.
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
    pub operator: &'static str,
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
    /// The same over the whole run, m.
    pub plug_slip_m: f64,
    /// Bytes of each feature.
    pub memory: Vec<Item>,
    /// Bytes per cell of the box, all features.
    pub bytes_per_cell: f64,
    /// Bytes of the run.
    pub bytes: u64,
    /// Passes.
    pub passes: Vec<Need>,
    /// Cell updates in the whole run.
    pub cell_updates: f64,
    /// Rough duration on one thread, s.
    pub estimated_seconds: f64,
    /// What to think about before running.
    pub warnings: Vec<String>,
    /// The grains; left out without any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grains: Option<CoupledNumbers>,
}

/// What the numbers follow from.
pub(super) struct Given<'a> {
    pub scene: &'a Scene,
    pub units: &'a Units,
    pub setup: &'a Setup,
    pub scales: &'a Scales,
    pub rule: StepRule,
    pub steps: u64,
    pub gap: f64,
    pub fluid_cells: u64,
    pub pool: Option<Pool>,
    pub layout: Layout,
    pub coupled: Option<&'a (Coupled, Findings)>,
}

pub(super) fn numbers(given: &Given) -> Numbers {
    let Given { scene, units, setup, scales, .. } = *given;
    let cells = setup.extents.iter().map(|&n| n as u64).product::<u64>();
    let solid_cells = setup.solids.iter().filter(|&&s| s != 0).count() as u64;
    let p = law::parameters(&scene.fluid.rheology);
    let (u, length) = (scales.velocity, scales.length);
    let speed_lattice = units.velocity_to_lattice(u);
    let plastic = reference_viscosity(scene, scales).unwrap_or(f64::NAN);
    let (tau_min, tau_max) = tau_range(given);
    let tau_min = if tau_min.is_finite() { tau_min } else { units.tau_of_viscosity(plastic) };
    let stable_speed = max_stable_speed(&setup.collision, tau_min).ok().map(|limit| limit.speed);
    let slip = plug_slip(given);
    let memory = items(setup, given.layout);
    let bytes = memory.iter().map(|item| item.bytes).sum::<u64>();
    let cell_updates = given.fluid_cells as f64 * given.steps as f64;
    // K Uⁿ/Lⁿ, the viscous stress scale.
    let viscous = p.k * libm::pow(u / length, p.n);
    let mut numbers = Numbers {
        title: scene.title.clone().unwrap_or_else(|| scene.file.clone()),
        extents: setup.extents,
        fluid_cells: given.fluid_cells,
        solid_cells,
        spacing_m: units.dx_m,
        gap_cells: given.gap,
        gas_cells: given.pool.map(|_| cells - solid_cells - given.fluid_cells),
        depth_cells: given.pool.map(|pool| units.length_to_lattice(pool.depth)),
        volume_m3: given.pool.map(|pool| pool.volume),
        arrest_thickness_m: arrest_thickness(given),
        time_step_s: units.dt_s,
        time_step_rule: given.rule,
        end_time_s: scene.stop.end_time_s,
        steps: given.steps,
        reference_velocity_m_per_s: u,
        speed_lattice,
        reference_length_m: length,
        reynolds: if u > 0.0 { units.rho0_kg_per_m3 * u * u / viscous } else { 0.0 },
        bingham: if p.sigma0 > 0.0 { p.sigma0 / viscous } else { 0.0 },
        mach: speed_lattice * 3.0_f64.sqrt(),
        operator: operator(&setup.collision),
        tau_plastic: if plastic.is_nan() { tau_min } else { units.tau_of_viscosity(plastic) },
        tau_min,
        tau_max,
        stable_speed,
        stability_margin: stable_speed.filter(|_| speed_lattice > 0.0).map(|limit| limit / speed_lattice),
        precision: setup.precision.name(),
        population_bytes: setup.precision.bytes(),
        rounding_floor: rounding_floor(given, tau_min),
        plug_slip_m_per_s: slip,
        plug_slip_m: slip * scene.stop.end_time_s,
        memory,
        bytes_per_cell: bytes as f64 / cells as f64,
        bytes,
        passes: passes(scene, setup),
        cell_updates,
        estimated_seconds: cell_updates / UPDATES_PER_SECOND,
        warnings: Vec::new(),
        grains: None,
    };
    numbers.warnings = warnings(&numbers, scene, setup);
    numbers.warnings.extend(surface_warnings(&numbers));
    numbers.warnings.extend(weight_warning(given));
    if let Some((coupled, findings)) = given.coupled {
        let open = (cells - solid_cells) as f64 * units.dx_m * units.dx_m * units.dx_m;
        let mixture = given.pool.map_or(open, |pool| pool.volume);
        let (grains, warnings) = coupled::numbers(scene, units, setup, coupled, findings, scales, mixture);
        numbers.estimated_seconds += grains.sphere_updates / SPHERE_UPDATES_PER_SECOND;
        numbers.warnings.extend(warnings);
        numbers.grains = Some(grains);
    }
    numbers
}

/// σ0 over the force along the bed: a layer of this thickness on the slope is on the point of yielding.
fn arrest_thickness(given: &Given) -> Option<f64> {
    let law = &given.scene.fluid.rheology;
    let force = along_bed(given)?;
    (has_plug(law) && force > 0.0).then(|| law::parameters(law).sigma0 / force)
}

/// The force along the bed, N/m³; `None` without a free surface.
fn along_bed(given: &Given) -> Option<f64> {
    let mut force = extreme_forces(&total_force(given.scene))[0];
    force[given.pool?.up.index()] = 0.0;
    Some(norm(force))
}

/// By how much the fluid is heavier than drawn, where it will flow away.
fn weight_warning(given: &Given) -> Option<String> {
    let pool = given.pool.filter(|pool| !pool.level)?;
    let hydrostatic =
        given.scene.fluid.initial.as_ref().is_some_and(|i| i.pressure == InitialPressure::Hydrostatic);
    let weight = extreme_forces(&total_force(given.scene))[0][pool.up.index()].abs();
    let share = 1.5 * given.units.force_to_lattice(weight) * given.units.length_to_lattice(pool.depth);
    (hydrostatic && share > LEAST_EXCESS).then(|| {
        format!(
            "the deepest column starts {:.2} % heavier than drawn, compressed by its weight, and the flow gains that \
             much volume; `\"pressure\": \"settled\"` in `fluid.initial` starts with the mass that was drawn",
            100.0 * share
        )
    })
}

fn surface_warnings(n: &Numbers) -> Vec<String> {
    let Some(depth) = n.depth_cells else { return Vec::new() };
    let mut warnings = Vec::new();
    if depth < 4.0 {
        warnings.push(format!(
            "the fluid is at most {depth:.1} cells deep at time 0: a film of less than 4 cells is off by several per cent"
        ));
    }
    match n.arrest_thickness_m.map(|thickness| thickness / n.spacing_m) {
        Some(cells) if cells < 4.0 => warnings.push(format!(
            "the fluid comes to rest {cells:.1} cells thick on this slope; below 4 cells the deposit is not resolved"
        )),
        _ => {}
    }
    warnings
}

fn operator(collision: &CollisionChoice) -> &'static str {
    match collision {
        CollisionChoice::Bgk => "bgk",
        CollisionChoice::Trt(_) => "trt",
        CollisionChoice::CentralMoment(_) => "central_moment",
        CollisionChoice::Regularised => "regularised",
    }
}

/// Least and largest τ over all fluids, between rest and the largest expected shear rate.
fn tau_range(given: &Given) -> (f64, f64) {
    let laws = std::iter::once(&given.scene.fluid.rheology);
    let laws = laws.chain(given.scene.layers.iter().map(|layer| &layer.rheology));
    let mut range = (f64::INFINITY, 0.5);
    for law in laws {
        let at_rest = at_rest(law, given.units);
        let fastest = given.scales.shear_rate_max;
        let fast = if fastest > 0.0 {
            given.units.tau_of_viscosity(apparent_viscosity(law, fastest))
        } else {
            at_rest
        };
        let (low, high) = if fast < at_rest { (fast, at_rest) } else { (at_rest, fast) };
        range.0 = if low < range.0 { low } else { range.0 };
        range.1 = if high > range.1 { high } else { range.1 };
    }
    match given.setup.yielding {
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

/// τ in the limit of vanishing shear rate.
fn at_rest(law: &Rheology, units: &Units) -> f64 {
    let p = law::parameters(law);
    let viscosity = match *law {
        _ if has_plug(law) => f64::INFINITY,
        Rheology::Papanastasiou { yield_stress_pa, growth_s, .. } if p.n >= 1.0 => {
            yield_stress_pa * growth_s + plastic_viscosity(law, 0.0)
        }
        _ if p.n < 1.0 => f64::INFINITY,
        _ if p.n == 1.0 => p.k,
        _ => 0.0,
    };
    units.tau_of_viscosity(viscosity)
}

/// ε times roundings per step times the steps they can add up over: those of the run, or L²/(8ν) where walls or
/// a bed L or L/2 cells apart hold the flow, as they hold it against a force.
///
/// # Source
/// Derived in the claims `single-precision-channel` and `single-precision-flows`.
fn rounding_floor(given: &Given, tau_min: f64) -> f64 {
    let precision = given.setup.precision;
    let across = match given.pool {
        Some(pool) => 2.0 * given.units.length_to_lattice(pool.depth),
        None => given.gap,
    };
    let held = 3.0 * across * across / (8.0 * (tau_min - 0.5));
    let steps = given.steps as f64;
    precision.roundings() * precision.rounding() * if held < steps { held } else { steps }
}

/// 2θ f Δt / ρ in m/s: the slip of an unyielded solid along the walls that hold it \[K3\].
fn plug_slip(given: &Given) -> f64 {
    let laws = std::iter::once(&given.scene.fluid.rheology);
    let plug = laws.chain(given.scene.layers.iter().map(|layer| &layer.rheology)).any(has_plug);
    let walls = (given.gap.is_finite() || given.pool.is_some()) && given.setup.wall_rule == WallRule::HalfWay;
    let exact = given.setup.yielding == YieldTreatment::Exact;
    if !(plug && walls && exact) {
        return 0.0;
    }
    // Where the bed is part of the solids, its slope is not known: the whole weight is a bound.
    let force = along_bed(given).filter(|along| *along > 0.0).unwrap_or(given.scales.force);
    match given.setup.collision {
        CollisionChoice::Trt(odd) | CollisionChoice::CentralMoment(odd) => {
            2.0 * odd.floor * force * given.units.dt_s / given.units.rho0_kg_per_m3
        }
        // Third moments without memory: ω⁻ = 1, τ⁻ − ½ = ½.
        CollisionChoice::Regularised => force * given.units.dt_s / given.units.rho0_kg_per_m3,
        // One rate: τ⁻ = τ⁺ has no bound in a plug.
        CollisionChoice::Bgk => f64::INFINITY,
    }
}

fn warnings(n: &Numbers, scene: &Scene, setup: &Setup) -> Vec<String> {
    let mut warnings = Vec::new();
    let mut warn = |yes: bool, text: String| {
        if yes {
            warnings.push(text);
        }
    };
    warn(
        n.mach > 0.174,
        format!("Mach number {:.3}: errors of order Ma² = {:.1} %", n.mach, 100.0 * n.mach * n.mach),
    );
    warn(
        n.tau_plastic < 0.55,
        format!(
            "plastic relaxation time {:.4} is below 0.55: a finer spacing than {} m would be more accurate",
            n.tau_plastic, n.spacing_m
        ),
    );
    warn(
        n.tau_plastic > 2.0,
        format!("plastic relaxation time {:.2} is above 2: transients are smeared over steps", n.tau_plastic),
    );
    warn(
        n.gap_cells < 8.0 && n.depth_cells.is_none(),
        format!("only {} cells between walls: errors of several per cent", n.gap_cells),
    );
    warn(
        n.stability_margin.is_some_and(|margin| margin < 2.0),
        "less than a factor of 2 below the von Neumann limit".to_owned(),
    );
    warn(
        n.plug_slip_m_per_s > 1e-3 * n.reference_velocity_m_per_s && n.plug_slip_m_per_s.is_finite(),
        format!(
            "an unyielded solid held by walls slips {:.2e} m/s, more than 1e-3 of the flow; a smaller time step or \
             `viscosity_independent` walls reduce it",
            n.plug_slip_m_per_s
        ),
    );
    let plug =
        std::iter::once(&scene.fluid.rheology).chain(scene.layers.iter().map(|l| &l.rheology)).any(has_plug);
    warn(
        plug && setup.yielding == YieldTreatment::Exact && n.operator != "central_moment",
        format!(
            "`{}` cannot bring a moving plug to rest with the exact yield stress; `central_moment` can [K3]",
            n.operator
        ),
    );
    warn(
        setup.precision != Precision::Double && n.rounding_floor > 1e-3,
        format!(
            "rounding in `{}` can change velocities by up to {:.1} %; `double` cannot",
            n.precision,
            100.0 * n.rounding_floor
        ),
    );
    warn(
        n.reference_velocity_m_per_s == 0.0,
        "nothing is expected to move: no force, wall or initial flow overcomes the yield stress".to_owned(),
    );
    warnings
}
