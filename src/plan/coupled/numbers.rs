//! The numbers of grains in a fluid.

use serde::Serialize;

use super::classes::{ClassNumbers, PACKING, classes};
use super::speed::{HELD_ABOVE, yield_number};
use super::{Coupled, Findings, LOW_DENSITY_RATIO, LUBRICATED_GAP, gap_viscosity, ratios};
use crate::collision::{CollisionChoice, OddRate};
use crate::coupling::{GrainRefill, GrainWall};
use crate::plan::law::apparent_viscosity;
use crate::plan::print::short;
use crate::plan::scale::Scales;
use crate::rheology::bagnold::Mixture;
use crate::scene::{Boundary, FACE_KEYS, Scene};
use crate::setup::Setup;
use crate::units::Units;

/// Bytes per cell of the box for the owner of a covered cell.
const OWNER: u64 = 4;
/// Bytes per link between fluid and a covered cell.
const LINK: u64 = 12;
/// Links of a sphere over its radius in cells squared: lines of the 18 directions that cross it, 6π + 12√2π.
const LINKS: f64 = 72.0;

/// What `lahar plan` shows about grains in a fluid.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CoupledNumbers {
    /// Grains.
    pub grains: usize,
    /// Of these, clumps.
    pub clumps: usize,
    /// Of these, driven.
    pub driven: usize,
    /// Spheres that grains consist of.
    pub spheres: usize,
    /// Walls that grains touch: faces and surfaces of solids.
    pub walls: usize,
    /// Least and largest radius, m.
    pub radius_m: [f64; 2],
    /// The same, cells.
    pub radius_cells: [f64; 2],
    /// Error of the drag on the smallest grain to expect, relative.
    pub drag_error: f64,
    /// Mass of the free grains, kg.
    pub mass_kg: f64,
    /// Volume of the grains over that of grains and fluid.
    pub solid_fraction: f64,
    /// Least and largest density of a free grain over that of the fluid; `null` without free grains.
    pub density_ratio: Option<[f64; 2]>,
    /// How surfaces return populations.
    pub wall: &'static str,
    /// What freed cells start from.
    pub refill: &'static str,
    /// Rules of lubrication; `null` without.
    pub lubrication: Option<LubricationNumbers>,
    /// Steps of the grains in a step of the fluid.
    pub sub_steps: u32,
    /// What fixed them: `given`, `contacts` or `lubrication`.
    pub sub_steps_from: &'static str,
    /// Step of the grains, s.
    pub time_step_s: f64,
    /// Shortest contact, s.
    pub contact_time_s: f64,
    /// Steps in it.
    pub steps_per_contact: f64,
    /// Speed contacts are planned for, m/s.
    pub design_speed_m_per_s: f64,
    /// Expected fastest grain relative to the fluid, m/s.
    pub speed_m_per_s: f64,
    /// Fastest grain, cells per step.
    pub speed_lattice: f64,
    /// ρ U d/μ of the largest grain at that speed.
    pub particle_reynolds: f64,
    /// σ0/(|ρs − ρ| g d) of the largest grain over its value at which a sphere is held; 0 without a yield stress.
    pub held: f64,
    /// Axes along which a uniform pressure gradient carries the weight.
    pub balanced: [bool; 3],
    /// Axes along which the pressure of fluid at rest is left out.
    pub weightless: [bool; 3],
    /// Links between fluid and grains.
    pub links: f64,
    /// Bytes that grains add.
    pub bytes: u64,
    /// Spheres times their steps.
    pub sphere_updates: f64,
    /// Shear rate of the Bagnold numbers, 1/s.
    pub shear_rate_per_s: f64,
    /// Size classes.
    pub classes: Vec<ClassNumbers>,
    /// Why there are no Bagnold numbers, if so.
    pub no_bagnold: Option<String>,
    /// What to know about faces.
    pub notes: Vec<String>,
}

/// Rules of lubrication.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LubricationNumbers {
    /// Gap below which it acts, cells.
    pub cutoff_cells: f64,
    /// Smallest gap that counts, cells.
    pub smallest_gap_cells: f64,
    /// Whether sliding is resisted.
    pub tangential: bool,
    /// Gap below which the time step limits the friction, cells.
    pub limited_gap_cells: f64,
}

pub(super) struct Given<'a> {
    pub scene: &'a Scene,
    pub units: &'a Units,
    pub setup: &'a Setup,
    pub coupled: &'a Coupled,
    pub findings: &'a Findings,
    pub scales: &'a Scales,
    /// Volume of fluid and grains, m³.
    pub mixture_m3: f64,
}

/// Error of the drag on a sphere of `r` cells: 5 % at 2.2, 1.2 % at 3.35, 0.4 % at 5, third order between.
pub(super) fn drag_error(r: f64) -> f64 {
    let ratio = 2.2 / r;
    0.05 * ratio * ratio * ratio
}

/// Bytes that grains add to a run: owners of cells, links, lists of covered cells.
pub(in crate::plan) fn added_bytes(setup: &Setup) -> u64 {
    let Some(grains) = &setup.grains else { return 0 };
    let dx = grains.units.dx_m;
    let one = |radius: f64| {
        let r = radius / dx;
        (LINKS * r * r) as u64 * LINK + (4.19 * r * r * r) as u64 * 4
    };
    let spheres: u64 = grains.dem.grains.iter().map(|grain| one(grain.radius)).sum();
    let gear = grains.dem.integrator != crate::dem::Integrator::Verlet;
    let members = |grain: &crate::dem::Grain| match grain.shape {
        crate::dem::Shape::Sphere => 1.0,
        crate::dem::Shape::Clump(k) => grains.dem.clumps.get(k).map_or(1.0, |c| c.members.len() as f64),
    };
    let bodies = |grain| crate::plan::grains::speed::bytes_per_grain(members(grain), gear);
    let bodies = grains.dem.grains.iter().map(bodies).sum::<f64>() as u64;
    setup.cells() as u64 * OWNER + spheres + bodies
}

pub(super) fn numbers(given: &Given) -> (CoupledNumbers, Vec<String>) {
    let Given { scene, units, setup, coupled, findings, scales, .. } = *given;
    let (grains, stepping) = (&coupled.grains, &findings.stepping);
    let dem = &grains.setup;
    let n = &grains.numbers;
    let law = &scene.fluid.rheology;
    let density = scene.fluid.density_kg_per_m3;
    let radius_m = [n.least_radius_m, n.largest_radius_m];
    let radius_cells = radius_m.map(|r| units.length_to_lattice(r));
    let of_one = |r: f64| 4.0 / 3.0 * std::f64::consts::PI * r * r * r;
    let volume: f64 = dem.grains.iter().map(|grain| of_one(grain.radius)).sum();
    let solid_fraction = volume / given.mixture_m3;
    let density_ratio =
        ratios(scene, dem).map(|(_, ratio)| ratio).fold(None, |range: Option<[f64; 2]>, ratio| {
            Some(range.map_or([ratio; 2], |[low, high]| [low.min(ratio), high.max(ratio)]))
        });
    let diameter = 2.0 * n.largest_radius_m;
    let around = findings.slip / diameter;
    let viscosity = if around > 0.0 { apparent_viscosity(law, around) } else { f64::INFINITY };
    let excess = ratios(scene, dem).map(|(_, ratio)| (ratio - 1.0).abs() * density).fold(0.0, f64::max);
    let rate = scales.shear_rate;
    let mixture = Mixture {
        solid_fraction,
        maximum_packing: PACKING,
        grain_density: density_ratio.map_or(density, |[low, high]| 0.5 * (low + high) * density),
        fluid_density: density,
        viscosity_pa_s: if rate > 0.0 { apparent_viscosity(law, rate) } else { f64::NAN },
        shear_rate: rate,
    };
    let (classes, no_bagnold) = classes(dem, units.dx_m, &mixture);
    let held = yield_number(law, excess, dem.gravity.norm(), diameter) / HELD_ABOVE;
    let numbers = CoupledNumbers {
        grains: n.grains,
        clumps: n.clumps,
        driven: n.driven,
        spheres: n.spheres,
        walls: n.walls,
        radius_m,
        radius_cells,
        drag_error: drag_error(radius_cells[0]),
        mass_kg: n.mass_kg,
        solid_fraction,
        density_ratio,
        wall: match coupled.suspension.wall {
            GrainWall::HalfWay => "half_way",
            GrainWall::CentralLinear => "central_linear",
        },
        refill: match coupled.suspension.refill {
            GrainRefill::WithStress => "with_stress",
            GrainRefill::Equilibrium => "equilibrium",
            GrainRefill::Neighbours => "neighbours",
        },
        lubrication: coupled.suspension.lubrication.map(|rules| LubricationNumbers {
            cutoff_cells: rules.cutoff,
            smallest_gap_cells: rules.smallest_gap,
            tangential: rules.tangential,
            limited_gap_cells: stepping.limited_gap,
        }),
        sub_steps: stepping.sub_steps,
        sub_steps_from: match (stepping.given, stepping.for_gaps) {
            (true, _) => "given",
            (false, true) => "lubrication",
            (false, false) => "contacts",
        },
        time_step_s: n.time_step_s,
        contact_time_s: n.contact_time_s,
        steps_per_contact: n.steps_per_contact,
        design_speed_m_per_s: n.design_speed_m_per_s,
        speed_m_per_s: findings.slip,
        speed_lattice: findings.fastest,
        particle_reynolds: density * findings.slip * diameter / viscosity,
        held,
        balanced: coupled.suspension.balanced,
        weightless: std::array::from_fn(|a| coupled.suspension.pressure_gradient[a] != 0.0),
        links: dem.grains.iter().map(|g| LINKS * (g.radius / units.dx_m) * (g.radius / units.dx_m)).sum(),
        bytes: added_bytes(setup),
        sphere_updates: n.sphere_updates,
        shear_rate_per_s: rate,
        classes,
        no_bagnold,
        notes: notes(scene, held, &setup.collision),
    };
    let warnings = warnings(given, &numbers);
    (numbers, warnings)
}

fn notes(scene: &Scene, held: f64, collision: &CollisionChoice) -> Vec<String> {
    let faces = scene.domain.boundaries.by_axis();
    let mut keys = Vec::new();
    for (axis, keys_of) in FACE_KEYS.iter().enumerate() {
        for (side, key) in keys_of.iter().enumerate() {
            if faces[axis][side] == Boundary::Open {
                keys.push(format!("`{key}`"));
            }
        }
    }
    let mut notes = Vec::new();
    if !keys.is_empty() {
        notes.push(format!("{} open: fluid and grains that pass leave", keys.join(", ")));
    }
    if held >= 1.0 && matches!(collision, CollisionChoice::CentralMoment(_)) {
        notes.push(
            "grains that the yield stress holds creep on with `central_moment`, at up to 1 % of their speed without it; \
             with `trt` in `numerics.collision.operator` they creep several times more slowly"
                .into(),
        );
    }
    notes
}

fn warnings(given: &Given, n: &CoupledNumbers) -> Vec<String> {
    let mut out = Vec::new();
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let mut warn = |yes: bool, text: String| {
        if yes {
            out.push(text);
        }
    };
    warn(
        n.radius_cells[0] < 2.0,
        format!(
            "the smallest grain has a radius of {} cells: expect its drag to be off by {}; 2.2 cells give 5 %, 3.35 \
             cells 1.2 %, 5 cells 0.4 %",
            short(n.radius_cells[0]),
            percent(n.drag_error)
        ),
    );
    warn(
        n.density_ratio.is_some_and(|[low, _]| low < LOW_DENSITY_RATIO),
        format!(
            "a grain has {} of the fluid's density: below {LOW_DENSITY_RATIO} the added mass of the fluid outweighs it, and its \
             motion rings for some steps",
            n.density_ratio.map_or_else(String::new, |[low, _]| short(low))
        ),
    );
    warn(
        n.lubrication.is_some_and(|rules| rules.limited_gap_cells > LUBRICATED_GAP * (1.0 + 1e-9)),
        format!("lubrication is limited by the time step below {LUBRICATED_GAP} cells"),
    );
    warn(
        n.speed_lattice > 0.1,
        format!("grains move up to {} cells per step: errors of several per cent", short(n.speed_lattice)),
    );
    let lowest = given.units.tau_of_viscosity(gap_viscosity(given.scene, given.scales));
    if let Some((below, way_out)) = unstable_below(&given.setup.collision, given.coupled.suspension.wall) {
        warn(
            lowest < below && n.speed_lattice > 0.05,
            format!(
                "grains move up to {} cells per step at a relaxation time of {lowest:.3}: below {below} with more than 0.05 cells \
                 per step the flow around them blows up with these rules; {way_out}",
                short(n.speed_lattice)
            ),
        );
    }
    // What the grains by themselves warn of, less what is about falling for ever: the fluid holds them.
    let dry = given.coupled.grains.numbers.warnings.iter();
    out.extend(
        dry.filter(|warning| !warning.contains("fall for ever") && !warning.contains("days")).cloned(),
    );
    out
}

/// τ⁺ below which fast grains make a collision operator fail, as measured with a sphere of 3.3 cells at 0.08 to 0.15
/// cells per step; `None`: not down to 0.505.
fn unstable_below(collision: &CollisionChoice, wall: GrainWall) -> Option<(f64, &'static str)> {
    match collision {
        CollisionChoice::CentralMoment(odd) if odd.lowered_below < OddRate::AMONG_GRAINS.lowered_below => {
            Some((0.6, "leave out `numerics.collision.lowered_below`"))
        }
        CollisionChoice::Trt(_) if wall == GrainWall::HalfWay => {
            Some((0.52, "take the surface `central_linear`, a shorter time step or a coarser grid"))
        }
        CollisionChoice::Regularised => Some((0.55, "take another operator")),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drag_error_meets_what_was_measured() {
        // Of periodic arrays: −4.7, −1.2, −0.43 %; within a fifth.
        for (r, measured) in [(2.2, 0.047), (3.35, 0.012), (5.0, 0.0043)] {
            assert!((drag_error(r) / measured - 1.0).abs() < 0.2, "{r}");
        }
    }
}
