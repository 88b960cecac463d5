//! The numbers of a plan without fluid.

use serde::Serialize;

use super::speed::bytes_per_grain;
use crate::dem::contact::restitution::hertz_largest_overlap;
use crate::dem::material::{Compiled, PairLaw};
use crate::dem::{Dem, Integrator, Pace, Setup, Surface};
use crate::plan::cost;
use crate::plan::disk::Files;
use crate::plan::drawn::odd_density;
use crate::plan::expected::{self, Expectation};
use crate::plan::holding::holding;
use crate::plan::needs::Need;
use crate::plan::warning::Warning;
use crate::scene::dry::DryScene;

/// What `lahar plan` prints for a scene without fluid.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GrainNumbers {
    /// Title of the scene, or its file.
    pub title: String,
    /// Grains.
    pub grains: usize,
    /// Of these, clumps.
    pub clumps: usize,
    /// Of these, driven.
    pub driven: usize,
    /// Spheres that grains consist of.
    pub spheres: usize,
    /// Walls: planes, surfaces, meshes.
    pub walls: usize,
    /// Triangles of meshes.
    pub triangles: usize,
    /// Least radius of a grain, m.
    pub least_radius_m: f64,
    /// Largest radius of a grain, m.
    pub largest_radius_m: f64,
    /// Largest over least radius of a sphere.
    pub size_ratio: f64,
    /// Mass of the grains that are not driven, kg.
    pub mass_kg: f64,
    /// Volume of the grains over that of the box.
    pub solid_fraction: f64,
    /// Pairs that touch at time 0.
    pub contacts: usize,
    /// Speed the time step is chosen for, m/s.
    pub design_speed_m_per_s: f64,
    /// Whether the scene gave it.
    pub design_speed_given: bool,
    /// Shortest contact, s.
    pub contact_time_s: f64,
    /// Between which grains.
    pub contact_pair: String,
    /// s.
    pub time_step_s: f64,
    /// Whether the scene gave it.
    pub time_step_given: bool,
    /// Step that the dashpots and springs of contacts allow, s.
    pub damping_step_s: f64,
    /// Steps in the shortest contact.
    pub steps_per_contact: f64,
    /// Steps to the end time.
    pub steps: u64,
    /// s.
    pub end_time_s: f64,
    /// Deepest overlap of an impact at the design speed, as a share of the radius.
    pub impact_overlap: f64,
    /// Overlap at the bottom of all grains piled up over the height of the box, as a share of the radius.
    pub static_overlap: f64,
    /// Share of the radius at which a run is stopped.
    pub overlap_limit: f64,
    /// Restitution of two largest and of two smallest grains of the first material at the design speed.
    pub restitution: [f64; 2],
    /// Errors to expect of collisions, and of grains that slide and roll.
    pub expected: Expectation,
    /// Name of the integrator.
    pub integrator: &'static str,
    /// What the run computes, and what it does not.
    pub passes: Vec<Need>,
    /// Bytes.
    pub bytes: u64,
    /// Files, by kind; empty for grains in a fluid, whose plan lists them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub files: Vec<Files>,
    /// Spheres times steps.
    pub sphere_updates: f64,
    /// Rough time on one thread, s.
    pub estimated_seconds: f64,
    /// What to know before running.
    pub warnings: Vec<Warning>,
}

pub(super) fn numbers(
    scene: &DryScene,
    setup: &Setup,
    dem: &Dem,
    pace: &Pace,
    steps: u64,
    estimated: f64,
) -> GrainNumbers {
    let b = dem.bodies();
    let [least, largest] = extremes(b.radius.iter().copied());
    let [smallest, greatest] = extremes(dem.members().iter().map(|member| member.radius));
    let volume: f64 =
        (0..b.len()).map(|i| b.mass[i] / setup.materials.list[setup.grains[i].material].density_kg_m3).sum();
    let dt = dem.time_step();
    let clumps = setup.grains.iter().filter(|g| g.shape != crate::dem::Shape::Sphere).count();
    let members = dem.members().len();
    let gear = setup.integrator != Integrator::Verlet;
    let updates = members as f64 * steps as f64;
    let mut n = GrainNumbers {
        title: scene.title.clone().unwrap_or_else(|| scene.file.clone()),
        grains: b.len(),
        clumps,
        driven: b.driven.len(),
        spheres: members,
        walls: setup.walls.len(),
        triangles: triangles(setup),
        least_radius_m: least,
        largest_radius_m: largest,
        size_ratio: greatest / smallest,
        mass_kg: dem.ledger().mass,
        solid_fraction: volume / scene.domain.size_m.iter().product::<f64>(),
        contacts: dem.pair_counts().1,
        design_speed_m_per_s: setup.design_speed_m_s,
        design_speed_given: scene.grains.numerics.design_speed_m_per_s.is_some(),
        contact_time_s: pace.shortest.seconds,
        contact_pair: pace.shortest.pair.clone(),
        time_step_s: dt,
        time_step_given: scene.grains.numerics.time_step_s.is_some(),
        damping_step_s: pace.stable.advised_s,
        steps_per_contact: pace.shortest.seconds / dt,
        steps,
        end_time_s: scene.stop.end_time_s,
        impact_overlap: impact_overlap(setup),
        static_overlap: static_overlap(scene, setup, volume),
        overlap_limit: setup.overlap_limit,
        restitution: [largest, least].map(|r| restitution(setup, r)),
        expected: expectation(setup, pace, dt, least),
        integrator: integrator(setup.integrator),
        passes: Vec::new(),
        bytes: (b.len() as f64 * bytes_per_grain(members as f64 / b.len().max(1) as f64, gear)) as u64,
        files: Vec::new(),
        sphere_updates: updates,
        estimated_seconds: cost::of_grains(steps as f64, updates),
        warnings: Vec::new(),
    };
    n.passes = passes(setup, &n);
    n.warnings = warnings(scene, setup, &n, estimated);
    n
}

/// What to expect of contacts at a time step, s, with grains down to a radius, m.
fn expectation(setup: &Setup, pace: &Pace, dt: f64, least: f64) -> Expectation {
    Expectation::of(expected::of_grains(setup, pace.shortest.seconds / dt, restitution(setup, least)))
}

/// Least and largest of radii; infinite and 0 without any.
fn extremes(radii: impl Iterator<Item = f64>) -> [f64; 2] {
    radii.fold([f64::INFINITY, 0.0], |[least, largest], r| [least.min(r), largest.max(r)])
}

/// Triangles of all meshes.
fn triangles(setup: &Setup) -> usize {
    let meshes = setup.walls.iter().filter_map(|wall| match &wall.surface {
        Surface::Mesh(mesh) => Some(mesh.triangles.len()),
        Surface::Plane { .. } | Surface::Box { .. } | Surface::Cylinder { .. } | Surface::Sphere { .. } => {
            None
        }
    });
    meshes.sum()
}

const fn integrator(integrator: Integrator) -> &'static str {
    match integrator {
        Integrator::Verlet => "velocity Verlet",
        Integrator::Gear => "Gear, six values, 3/16",
        Integrator::GearConservative => "Gear, six values, 3/20",
    }
}

/// Every pair law between two materials of the scene.
fn laws(setup: &Setup) -> impl Iterator<Item = (f64, PairLaw)> {
    let table = setup.materials.compile().ok();
    let count = setup.materials.list.len() as u32;
    let density = |k: u32| setup.materials.list[k as usize].density_kg_m3;
    let pairs = (0..count).flat_map(move |i| (i..count).map(move |j| (i, j)));
    let all: Vec<(f64, PairLaw)> = table
        .iter()
        .flat_map(|t| pairs.clone().map(|(i, j)| (density(i).max(density(j)), *t.law(i, j))))
        .collect();
    all.into_iter()
}

/// δ/r of two equal spheres at the design speed (Hertz, without damping): it does not depend on r.
fn impact_overlap(setup: &Setup) -> f64 {
    let v = setup.design_speed_m_s;
    laws(setup)
        .map(|(density, law)| {
            let mass = 0.5 * density * 4.0 / 3.0 * std::f64::consts::PI;
            match law.normal {
                // δ = v √(m/k), at r = the largest radius.
                Compiled::Linear { stiffness, .. } => {
                    let r = setup.grains.iter().map(|g| g.radius).fold(0.0, f64::max);
                    v * (mass * r / stiffness).sqrt()
                }
                Compiled::Tsuji { .. } | Compiled::ViscoElastic { .. } => {
                    hertz_largest_overlap(mass, law.young, 0.5, v)
                }
            }
        })
        .fold(0.0, f64::max)
}

/// δ/r below a pile: the weight of all grains on the floor of the box, (2r)² of it on each.
fn static_overlap(scene: &DryScene, setup: &Setup, volume: f64) -> f64 {
    let g = setup.gravity;
    let Some(axis) = (0..3).filter(|&k| g[k] != 0.0).max_by(|&a, &b| g[a].abs().total_cmp(&g[b].abs()))
    else {
        return 0.0;
    };
    let floor: f64 = (0..3).filter(|&k| k != axis).map(|k| scene.domain.size_m[k]).product();
    let r = setup.grains.iter().map(|g| g.radius).fold(0.0, f64::max);
    laws(setup)
        .map(|(density, law)| {
            let force = density * volume * g[axis].abs() / floor * 4.0 * r * r;
            match law.normal {
                Compiled::Linear { stiffness, .. } => force / stiffness / r,
                // F = (4/3) E* √R* δ^{3/2} with R* = r/2.
                Compiled::Tsuji { .. } | Compiled::ViscoElastic { .. } => {
                    libm::pow(0.75 * force / (law.young * (0.5 * r).sqrt()), 2.0 / 3.0) / r
                }
            }
        })
        .fold(0.0, f64::max)
}

/// Restitution of two equal spheres of the first material at the design speed.
fn restitution(setup: &Setup, r: f64) -> f64 {
    use crate::dem::contact::restitution::{cut_off, visco_elastic};
    let Some((density, law)) = laws(setup).next() else { return f64::NAN };
    match law.normal {
        Compiled::Linear { ratio, .. } => cut_off(ratio),
        Compiled::Tsuji { alpha } => cut_off(alpha / 5f64.sqrt()),
        Compiled::ViscoElastic { time } => {
            let mass = 0.5 * density * 4.0 / 3.0 * std::f64::consts::PI * r * r * r;
            let k = 4.0 / 3.0 * law.young * (0.5 * r).sqrt();
            let a = time * libm::pow(k / mass, 0.4) * libm::pow(setup.design_speed_m_s, 0.2);
            // Beyond this damping next to nothing is left, and the integration would take for ever.
            if a > 20.0 { 0.0 } else { visco_elastic(a, 2000).0 }
        }
    }
}

fn passes(setup: &Setup, n: &GrainNumbers) -> Vec<Need> {
    let rolling = setup.materials.compile().is_ok_and(|table| table.any_rolling);
    let moving = setup.walls.iter().any(crate::dem::Wall::shifts);
    let periodic = setup.period.0.iter().any(Option::is_some);
    vec![
        Need::of(
            "contacts of grains",
            n.grains > 1,
            "lists of neighbours, made anew when a grain has moved",
            "one grain",
        ),
        Need::of("contacts with walls", n.walls > 0, "faces of the box or solids", "no wall"),
        Need::of("meshes", n.triangles > 0, "triangles in a tree", "no mesh"),
        Need::of("moving walls", moving, "a wall changes its place", "walls stay where they are"),
        Need::of("periodic images", periodic, "a periodic axis", "no periodic axis"),
        Need::of("rotation of clumps", n.clumps > 0, "clumps have three moments of inertia", "spheres only"),
        Need::of("rolling resistance", rolling, "a pair with `rolling_friction`", "no pair has any"),
        Need::of("fluid", false, "", "no populations, no fill levels, no cells: none is allocated"),
    ]
}

/// The warnings, in the order in which they are printed.
fn warnings(scene: &DryScene, setup: &Setup, n: &GrainNumbers, estimated: f64) -> Vec<Warning> {
    let (overlap, limit, design) = (n.impact_overlap, n.overlap_limit, setup.design_speed_m_s);
    let slow = n.design_speed_given && design < 0.5 * estimated;
    let soft = setup.materials.list.iter().any(|m| m.young_pa < 1e5);
    let materials = scene.grains.materials.iter();
    let odd = materials.filter_map(|m| odd_density(&format!("`{}`", m.name), m.density_kg_per_m3));
    let mut all = holding([
        (overlap > limit, Warning::ImpactStops { overlap, limit }),
        (overlap <= limit && overlap > 0.05, Warning::ImpactDeep { overlap }),
        (n.static_overlap > 0.02, Warning::PileDeep { overlap: n.static_overlap }),
        (slow, Warning::DesignSpeed { design_m_per_s: design, expected_m_per_s: estimated }),
        (n.steps_per_contact < 20.0, Warning::FewSteps { steps: n.steps_per_contact }),
        (falls(setup) && setup.walls.is_empty() && n.driven == 0, Warning::FallForEver),
        (n.estimated_seconds > 86_400.0, Warning::Days { days: n.estimated_seconds / 86_400.0 }),
        (soft && scene.gravity.is_some(), Warning::Soft),
    ]);
    all.extend(odd);
    all
}

/// Whether gravity pulls along a periodic axis.
fn falls(setup: &Setup) -> bool {
    let strength = setup.gravity.norm();
    (0..3).any(|k| setup.period.0[k].is_some() && setup.gravity[k].abs() > 1e-12 * strength)
}
