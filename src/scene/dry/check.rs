//! Value checks of scenes without fluid. The first problem found is reported; order is that of the file.

use std::collections::{HashMap, HashSet};

use super::check_place::placement;
use super::{ClumpMembers, Contact, ContactLaw, DryScene, GrainSolid};
use crate::geometry::{Axis, Shape};
use crate::scene::check::collisions;
use crate::scene::check::domain::boundaries;
use crate::scene::check::fluid::check_gravity;
use crate::scene::check::numerics::check_arrested;
use crate::scene::check::output::cadence;
use crate::scene::check::probes::{Place, known, probes};
use crate::scene::checker::Checker;
use crate::scene::probe::Subject;
use crate::scene::series::of_grains;
use crate::scene::{KeyRule, SceneError, SceneProblem};

/// Checks every value that can be judged without placing grains.
pub(crate) fn check(scene: &DryScene) -> Result<(), SceneError> {
    let at = Checker { file: &scene.file };
    domain(&at, scene)?;
    if let Some(gravity) = &scene.gravity {
        check_gravity(&at, gravity)?;
    }
    at.ensure(scene.grains.coupling.is_none(), "grains.coupling", || SceneProblem::UnusedKey {
        key: "coupling",
        because: "the scene has no `fluid`",
    })?;
    materials(&at, scene)?;
    clumps(&at, scene)?;
    sets(&at, scene)?;
    numerics(&at, scene)?;
    solids(&at, scene)?;
    let end = scene.stop.end_time_s;
    at.positive("stop.end_time_s", end, "s", "else there is nothing to compute", "a time > 0")?;
    if let Some(arrested) = scene.stop.arrested {
        check_arrested(&at, &arrested, end)?;
    }
    cadence(&at, "output.series", scene.output.series, end)?;
    output(&at, scene)?;
    collisions::check(&at, &of_grains(scene))
}

/// Checks what a scene with fluid, seen as its grains see it, says about them, but for outputs.
pub(crate) fn check_in_fluid(scene: &DryScene) -> Result<(), SceneError> {
    let at = Checker { file: &scene.file };
    materials(&at, scene)?;
    clumps(&at, scene)?;
    sets(&at, scene)?;
    numerics(&at, scene)?;
    let materials: Vec<String> = scene.grains.materials.iter().map(|m| m.name.clone()).collect();
    for (i, solid) in scene.solids.iter().enumerate() {
        let path = |key: &str| format!("solids[{i}].{key}");
        optional_name(&at, &path("material"), "material", solid.material.as_ref(), &materials)?;
        let shape = solid.shape.as_ref().is_none_or(|shape| touchable(shape, solid.invert));
        at.ensure(shape, &path("shape"), || SceneProblem::ShapeNotForGrains {
            what: "touched by grains",
            allowed: TOUCHABLE,
            way_out: "several solids, each of them one of these",
        })?;
    }
    Ok(())
}

const TOUCHABLE: &str = "`box`, `cylinder`, `sphere`, `half_space`, `cone`, `polygon`, `heightfield`, and a `union` of those \
                         that is not inverted";

fn domain(at: &Checker, scene: &DryScene) -> Result<(), SceneError> {
    at.ensure(scene.domain.spacing_m.is_none(), "domain.spacing_m", || SceneProblem::UnusedKey {
        key: "spacing_m",
        because: "a scene without `fluid` has no cells",
    })?;
    for axis in Axis::ALL {
        let a = axis.index();
        let path = format!("domain.size_m[{a}]");
        at.positive(&path, scene.domain.size_m[a], "m", "it is an edge of the box", "a length > 0")?;
    }
    boundaries(at, &scene.domain.boundaries)
}

fn materials(at: &Checker, scene: &DryScene) -> Result<(), SceneError> {
    let list = &scene.grains.materials;
    at.some("grains.materials", list.len(), "a material")?;
    let mut names = HashSet::new();
    for (i, m) in list.iter().enumerate() {
        let path = |key: &str| format!("grains.materials[{i}].{key}");
        at.name(&path("name"), &m.name, &mut names)?;
        let density = path("density_kg_per_m3");
        at.positive(&density, m.density_kg_per_m3, "kg/m³", "grains need mass", "2650 for quartz")?;
        let because = "Hertz contact needs stiffness [D1]";
        at.positive(&path("young_modulus_pa"), m.young_modulus_pa, "Pa", because, "7e10 for glass")?;
        let (found, low, high) = (m.poisson_ratio, -1.0, 0.5);
        at.ensure(found > low && found < high, &path("poisson_ratio"), || SceneProblem::OutOfRange {
            found,
            unit: "",
            low,
            high,
            because: "both ends excluded: beyond them an isotropic solid is unstable",
            way_out: "0.22 for glass",
        })?;
    }
    contact(at, "grains.contact", &scene.grains.contact)?;
    let names: Vec<String> = list.iter().map(|m| m.name.clone()).collect();
    for (i, pair) in scene.grains.pairs.iter().enumerate() {
        for (k, name) in pair.between.iter().enumerate() {
            known(at, &format!("grains.pairs[{i}].between[{k}]"), "material", name, &names)?;
        }
        contact(at, &format!("grains.pairs[{i}].contact"), &pair.contact)?;
    }
    optional_name(at, "grains.wall_material", "material", scene.grains.wall_material.as_ref(), &names)
}

/// Least restitution: down to it collisions are tested to make no energy, and take steps that end.
const LEAST_RESTITUTION: f64 = 1e-6;

fn contact(at: &Checker, path: &str, contact: &Contact) -> Result<(), SceneError> {
    let restitution = |key: &str, e: f64| {
        at.ensure((LEAST_RESTITUTION..=1.0).contains(&e), &format!("{path}.law.{key}.restitution"), || {
            SceneProblem::OutOfRange {
                found: e,
                unit: "",
                low: LEAST_RESTITUTION,
                high: 1.0,
                because: "the share of the speed that a collision leaves; with less the dashpot sets the time step",
                way_out: "0.9 for hard spheres, 0.001 for collisions that leave as good as nothing",
            }
        })
    };
    let more = |key: &str, value: f64, unit: &'static str| {
        at.not_negative(&format!("{path}.{key}"), value, unit, "it only resists", "0 for none")
    };
    match contact.law {
        ContactLaw::ViscoElastic { dissipative_time_s } => {
            more("law.visco_elastic.dissipative_time_s", dissipative_time_s, "s")?;
        }
        ContactLaw::Tsuji { restitution: e } => restitution("tsuji", e)?,
        ContactLaw::TsujiDamping { alpha } => more("law.tsuji_damping.alpha", alpha, "")?,
        ContactLaw::Linear { stiffness_n_per_m, restitution: e, tangential_ratio } => {
            let path = |key: &str| format!("{path}.law.linear.{key}");
            let (because, way_out) = ("a spring needs stiffness", "1e5");
            at.positive(&path("stiffness_n_per_m"), stiffness_n_per_m, "N/m", because, way_out)?;
            at.positive(&path("tangential_ratio"), tangential_ratio, "", because, "0.2857, which is 2/7")?;
            restitution("linear", e)?;
        }
    }
    more("friction", contact.friction, "")?;
    more("rolling_friction", contact.rolling_friction, "")?;
    more("tangential_damping", contact.tangential_damping, "")
}

fn clumps(at: &Checker, scene: &DryScene) -> Result<(), SceneError> {
    let mut names = HashSet::new();
    for (i, clump) in scene.grains.clumps.iter().enumerate() {
        at.name(&format!("grains.clumps[{i}].name"), &clump.name, &mut names)?;
        let path = format!("grains.clumps[{i}].members");
        match &clump.members {
            ClumpMembers::Tetrahedron { edge_over_radius } => {
                let path = format!("{path}.tetrahedron.edge_over_radius");
                let (low, high) = (0.0, 2.0);
                at.ensure(*edge_over_radius > low && *edge_over_radius <= high, &path, || {
                    SceneProblem::OutOfRange {
                        found: *edge_over_radius,
                        unit: "",
                        low,
                        high,
                        because: "0 excluded, there the four are one; beyond 2 they do not touch",
                        way_out: "1.2 for a rounded clump, 2 for an angular one",
                    }
                })?;
            }
            ClumpMembers::Spheres(members) => {
                at.some(&format!("{path}.spheres"), members.len(), "a sphere")?;
                for (k, member) in members.iter().enumerate() {
                    let path = format!("{path}.spheres[{k}].radius_m");
                    at.positive(&path, member.radius_m, "m", "it is a radius", "remove the sphere")?;
                }
            }
        }
    }
    Ok(())
}

fn sets(at: &Checker, scene: &DryScene) -> Result<(), SceneError> {
    at.some("grains.sets", scene.grains.sets.len(), "a set of grains")?;
    let materials: Vec<String> = scene.grains.materials.iter().map(|m| m.name.clone()).collect();
    let clumps: Vec<String> = scene.grains.clumps.iter().map(|c| c.name.clone()).collect();
    let mut names = HashSet::new();
    let mut folded = HashMap::new();
    for (i, set) in scene.grains.sets.iter().enumerate() {
        let path = |key: &str| format!("grains.sets[{i}].{key}");
        at.file_name(&path("name"), &set.name, &mut names)?;
        let twin = folded.insert(set.name.to_ascii_lowercase(), set.name.clone());
        at.ensure(twin.is_none(), &path("name"), || SceneProblem::NamesCollide {
            what: "the file",
            name: format!("grains_final_{}.csv", set.name),
            by: set.name.clone(),
            other: twin,
        })?;
        optional_name(at, &path("material"), "material", set.material.as_ref(), &materials)?;
        optional_name(at, &path("clump"), "clump", set.clump.as_ref(), &clumps)?;
        let random = path("random_speed_m_per_s");
        let because = "it is a standard deviation";
        at.not_negative(&random, set.random_speed_m_per_s, "m/s", because, "0 for none")?;
        placement(at, &path("place"), set, scene.domain.size_m)?;
    }
    Ok(())
}

fn numerics(at: &Checker, scene: &DryScene) -> Result<(), SceneError> {
    let n = &scene.grains.numerics;
    let path = |key: &str| format!("grains.numerics.{key}");
    let positive = |key: &str, value: Option<f64>, unit: &'static str| {
        let because = "else nothing moves on";
        at.positive(&path(key), value.unwrap_or(1.0), unit, because, "leave it out for the default")
    };
    positive("time_step_s", n.time_step_s, "s")?;
    positive("design_speed_m_per_s", n.design_speed_m_per_s, "m/s")?;
    let range = |key: &str, value: Option<f64>, low: f64, high: f64, because: &'static str| {
        let found = value.unwrap_or(low);
        at.ensure(found >= low && found <= high, &path(key), || SceneProblem::OutOfRange {
            found,
            unit: "",
            low,
            high,
            because,
            way_out: "leave it out for the default",
        })
    };
    let both = n.time_step_s.is_some() && n.steps_per_contact.is_some();
    at.ensure(!both, &path("steps_per_contact"), || SceneProblem::UnusedKey {
        key: "steps_per_contact",
        because: "the time step is given",
    })?;
    range("steps_per_contact", n.steps_per_contact, 10.0, 1e6, "below 10 a collision is not resolved [D3]")?;
    range("overlap_limit", n.overlap_limit, 1e-6, 0.9, "the contact laws hold for small overlaps")?;
    range("start_overlap", n.start_overlap, 0.0, 0.9, "deeper is no contact")?;
    range("skin", n.skin, 1e-3, 2.0, "shorter lists are made anew all the time, longer ones are slow")
}

fn solids(at: &Checker, scene: &DryScene) -> Result<(), SceneError> {
    let materials: Vec<String> = scene.grains.materials.iter().map(|m| m.name.clone()).collect();
    let mut names = HashSet::new();
    for (i, solid) in scene.solids.iter().enumerate() {
        let path = |key: &str| format!("solids[{i}].{key}");
        at.name(&path("name"), &solid.name, &mut names)?;
        optional_name(at, &path("material"), "material", solid.material.as_ref(), &materials)?;
        body(at, i, solid, scene.domain.size_m)?;
    }
    Ok(())
}

const BODY: &[&str] = &["shape", "mesh"];

fn body(at: &Checker, i: usize, solid: &GrainSolid, size_m: [f64; 3]) -> Result<(), SceneError> {
    let path = |key: &str| format!("solids[{i}].{key}");
    match (&solid.shape, &solid.mesh) {
        (Some(shape), None) => {
            at.shape(&path("shape"), shape, size_m, solid.invert)?;
            at.ensure(touchable(shape, solid.invert), &path("shape"), || SceneProblem::ShapeNotForGrains {
                what: "touched by grains",
                allowed: TOUCHABLE,
                way_out: "several solids, or a `mesh`",
            })
        }
        (None, Some(mesh)) => {
            at.ensure(!solid.invert, &path("invert"), || SceneProblem::UnusedKey {
                key: "invert",
                because: "a mesh is touched from both sides",
            })?;
            let scale = path("mesh.scale");
            at.positive(&scale, mesh.scale.unwrap_or(1.0), "", "it is a length", "0.001 for millimetres")
        }
        (shape, mesh) => {
            let found = if shape.is_some() && mesh.is_some() { BODY.to_vec() } else { Vec::new() };
            let because = "both say where the wall is";
            at.fail(
                format!("solids[{i}]"),
                SceneProblem::KeyCount { found, of: BODY, rule: KeyRule::ExactlyOne, because },
            )
        }
    }
}

/// Whether contact with the surface of a shape can be found.
fn touchable(shape: &Shape, inverted: bool) -> bool {
    match shape {
        Shape::Box { .. } | Shape::Cylinder { .. } | Shape::Sphere { .. } => true,
        Shape::HalfSpace { .. } | Shape::Cone { .. } => true,
        Shape::Polygon { .. } | Shape::Heightfield(_) => !inverted,
        Shape::Union(parts) => !inverted && parts.iter().all(|part| touchable(part, false)),
        Shape::Intersection(_) | Shape::Difference { .. } => false,
    }
}

fn output(at: &Checker, scene: &DryScene) -> Result<(), SceneError> {
    cadence(at, "output.grains", scene.output.grains, scene.stop.end_time_s)?;
    let place = Place {
        path: "output.probes",
        subject: Subject::Grains,
        end_s: scene.stop.end_time_s,
        size_m: scene.domain.size_m,
        fluid: false,
        surface: false,
        grains: true,
        up: None,
        solids: scene.solids.iter().map(|s| s.name.clone()).collect(),
        sets: scene.grains.sets.iter().map(|s| s.name.clone()).collect(),
    };
    probes(at, &scene.output.probes, &place, &mut HashSet::new())
}

fn optional_name(
    at: &Checker,
    path: &str,
    kind: &'static str,
    name: Option<&String>,
    names: &[String],
) -> Result<(), SceneError> {
    name.map_or(Ok(()), |name| known(at, path, kind, name, names))
}
