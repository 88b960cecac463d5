//! Checks of probes, whatever they are about.

use std::collections::HashSet;

use crate::geometry::{Axis, Shape};
use crate::scene::checker::Checker;
use crate::scene::nearest::nearest;
use crate::scene::probe::{Needs, Subject, Target};
use crate::scene::{FACE_KEYS, KeyRule, Measure, Probe, SceneError, SceneProblem};

/// A list of probes and what there is in its scene.
pub(in crate::scene) struct Place {
    /// JSON path of the list.
    pub path: &'static str,
    /// What the words mean that fluid and grains share.
    pub subject: Subject,
    /// End time, s.
    pub end_s: f64,
    /// Edge lengths of the box, m.
    pub size_m: [f64; 3],
    /// Whether there is a fluid.
    pub fluid: bool,
    /// Whether it has a free surface.
    pub surface: bool,
    /// Whether there are grains.
    pub grains: bool,
    /// The axis normal to the bed; `None` without a force.
    pub up: Option<Axis>,
    /// Names of the solids.
    pub solids: Vec<String>,
    /// Names of the sets of grains.
    pub sets: Vec<String>,
}

/// Checks a list; `names` are those that columns have already.
pub(in crate::scene) fn probes(
    at: &Checker,
    list: &[Probe],
    place: &Place,
    names: &mut HashSet<String>,
) -> Result<(), SceneError> {
    for (i, probe) in list.iter().enumerate() {
        let path = format!("{}[{i}]", place.path);
        at.file_name(&format!("{path}.name"), &probe.name, names)?;
        let path = format!("{path}.measure");
        is_there(at, &path, probe.measure.needs(place.subject), place)?;
        measure(at, &path, &probe.measure, place)?;
    }
    Ok(())
}

/// Whether the scene has what a measure needs.
fn is_there(at: &Checker, path: &str, needs: Needs, place: &Place) -> Result<(), SceneError> {
    let fluid = !matches!(needs, Needs::Grains);
    at.ensure(place.fluid || !fluid, path, || SceneProblem::NeedsFluid)?;
    let grains = matches!(needs, Needs::Grains | Needs::Both | Needs::BothAndSurface);
    at.ensure(place.grains || !grains, path, || SceneProblem::NeedsGrains)?;
    let surface = match needs {
        Needs::Surface | Needs::BothAndSurface => true,
        // Ledgers are kept for grains too.
        Needs::Books => !place.grains,
        Needs::Fluid | Needs::Grains | Needs::Both => false,
    };
    at.ensure(place.surface || !surface, path, || SceneProblem::NeedsSurface {
        what: "this measure",
        otherwise: "remove the probe",
    })
}

fn measure(at: &Checker, path: &str, measure: &Measure, place: &Place) -> Result<(), SceneError> {
    let size = place.size_m;
    let known_set = |key: &str, set: &str| known(at, &format!("{path}.{key}.set"), "set", set, &place.sets);
    match measure {
        Measure::PointVelocity { at_m } => at.point(&format!("{path}.point_velocity.at_m"), *at_m, size),
        Measure::FlowRate { normal, at_m } => {
            at.position(&format!("{path}.flow_rate.at_m"), *normal, *at_m, size)
        }
        Measure::Front { along, threshold_m, from_m, above_m } => {
            front(at, &format!("{path}.front"), *along, *threshold_m, [*from_m, *above_m], place)
        }
        Measure::SurfaceProfile { along, at_m, above_m } => {
            section(at, &format!("{path}.surface_profile"), *along, [*at_m, *above_m], place)
        }
        Measure::DepthMap { above_m } => {
            optional(at, &format!("{path}.depth_map.above_m"), place.up, *above_m, size)
        }
        Measure::WindowVelocity { min_m, max_m } => {
            window(at, &format!("{path}.window_velocity"), *min_m, *max_m, size)
        }
        Measure::Force { .. } | Measure::Torque { .. } => load(at, path, measure, place),
        Measure::Grain { set, .. } => known_set("grain", set),
        Measure::FluidForce { set, .. } => known_set("fluid_force", set),
        Measure::Submergence { set, .. } => known_set("submergence", set),
        Measure::SetSpeed { set } => known_set("set_speed", set),
        Measure::Segregation { classes, .. } => {
            classes_in_range(at, &format!("{path}.segregation.classes"), classes.unwrap_or(3))
        }
        Measure::GrainFront { share, .. } => {
            let because = "0.5 excluded: beyond it there is no front";
            let path = format!("{path}.grain_front.share");
            share_in_range(at, &path, share.unwrap_or(0.02), because, "leave it out for 0.02")
        }
        Measure::Flux { normal, at_m } => at.position(&format!("{path}.flux.at_m"), *normal, *at_m, size),
        Measure::Pile { along, up, share } => {
            let path = format!("{path}.pile");
            across(at, &format!("{path}.along"), *along, up.unwrap_or(Axis::Z))?;
            let because = "0.5 excluded: beyond it nothing is left";
            let path = format!("{path}.share");
            share_in_range(at, &path, share.unwrap_or(0.005), because, "leave it out for 0.005")
        }
        Measure::Profile { .. }
        | Measure::MaxSpeed
        | Measure::KineticEnergy
        | Measure::Mass
        | Measure::PlugFraction
        | Measure::YieldedFraction
        | Measure::Volume
        | Measure::Ledger
        | Measure::Contacts
        | Measure::Energies
        | Measure::Momentum => Ok(()),
    }
}

/// A front: `[from_m, above_m]` are optional places in the box.
fn front(
    at: &Checker,
    path: &str,
    along: Axis,
    threshold_m: f64,
    [from_m, above_m]: [Option<f64>; 2],
    place: &Place,
) -> Result<(), SceneError> {
    at.positive(&format!("{path}.threshold_m"), threshold_m, "m", "it is a depth", "one cell")?;
    across(at, &format!("{path}.along"), along, place.up.unwrap_or(Axis::Z))?;
    optional(at, &format!("{path}.from_m"), Some(along), from_m, place.size_m)?;
    optional(at, &format!("{path}.above_m"), place.up, above_m, place.size_m)
}

/// Fronts, sections and piles run along the bed, across `up`.
fn across(at: &Checker, path: &str, along: Axis, up: Axis) -> Result<(), SceneError> {
    at.ensure(along != up, path, || SceneProblem::AcrossBed { axis: along.letter() })
}

/// A section runs along the bed; `third_m` is its place on the third axis, `above_m` a height.
fn section(
    at: &Checker,
    path: &str,
    along: Axis,
    [third_m, above_m]: [Option<f64>; 2],
    place: &Place,
) -> Result<(), SceneError> {
    let up = place.up.unwrap_or(Axis::Z);
    across(at, &format!("{path}.along"), along, up)?;
    let third = Axis::ALL.into_iter().find(|axis| *axis != along && *axis != up);
    optional(at, &format!("{path}.at_m"), third, third_m, place.size_m)?;
    optional(at, &format!("{path}.above_m"), place.up, above_m, place.size_m)
}

/// A box that is not empty and reaches into that of the scene.
fn window(
    at: &Checker,
    path: &str,
    min_m: [f64; 3],
    max_m: [f64; 3],
    size: [f64; 3],
) -> Result<(), SceneError> {
    for axis in Axis::ALL {
        let (low, high) = (min_m[axis.index()], max_m[axis.index()]);
        at.ensure(low < high, path, || SceneProblem::EmptyInterval { axis: axis.letter(), low, high })?;
    }
    at.reaches_box(path, &Shape::Box { min_m, max_m }, size)
}

/// A load is on something that is there, and its moving mean within the run.
fn load(at: &Checker, path: &str, measure: &Measure, place: &Place) -> Result<(), SceneError> {
    match measure {
        Measure::Force { solid, on, window_s, .. } => {
            moving_mean(at, &format!("{path}.force.window_s"), *window_s, place)?;
            force(at, &format!("{path}.force"), solid.as_deref(), on.as_ref(), place)
        }
        Measure::Torque { solid, window_s, .. } => {
            moving_mean(at, &format!("{path}.torque.window_s"), *window_s, place)?;
            solid_in_fluid(at, &format!("{path}.torque.solid"), solid, place)
        }
        _ => Ok(()),
    }
}

/// A force is on a solid in the fluid or on what grains push.
fn force(
    at: &Checker,
    path: &str,
    solid: Option<&str>,
    on: Option<&Target>,
    place: &Place,
) -> Result<(), SceneError> {
    const KEYS: &[&str] = &["solid", "on"];
    match (solid, on) {
        (Some(solid), None) => solid_in_fluid(at, &format!("{path}.solid"), solid, place),
        (None, Some(Target::Solid(name))) => {
            known(at, &format!("{path}.on.solid"), "solid", name, &place.solids)
        }
        (None, Some(Target::Face(name))) => {
            let faces: Vec<String> = FACE_KEYS.iter().flatten().map(|key| (*key).to_owned()).collect();
            known(at, &format!("{path}.on.face"), "face", name, &faces)
        }
        (solid, on) => {
            let found = if solid.is_some() && on.is_some() { KEYS.to_vec() } else { Vec::new() };
            let because = "`solid` is pushed by fluid and grains, `on` by grains alone";
            at.fail(path, SceneProblem::KeyCount { found, of: KEYS, rule: KeyRule::ExactlyOne, because })
        }
    }
}

/// Length of a moving mean within the run.
fn moving_mean(at: &Checker, path: &str, window_s: Option<f64>, place: &Place) -> Result<(), SceneError> {
    let Some(found) = window_s else { return Ok(()) };
    at.positive(
        path,
        found,
        "s",
        "it is an interval",
        "leave it out for the time between rows of the series",
    )?;
    at.ensure(found <= place.end_s, path, || SceneProblem::BeyondEnd { found, end: place.end_s })
}

fn solid_in_fluid(at: &Checker, path: &str, solid: &str, place: &Place) -> Result<(), SceneError> {
    let solids = &place.solids;
    at.ensure(solids.iter().any(|name| name == solid), path, || SceneProblem::UnknownSolid {
        name: solid.to_owned(),
        nearest: nearest(solid, solids).map(str::to_owned),
        solids: solids.clone(),
    })
}

fn classes_in_range(at: &Checker, path: &str, classes: u32) -> Result<(), SceneError> {
    let (found, low, high) = (f64::from(classes), 2.0, 10.0);
    at.ensure((low..=high).contains(&found), path, || SceneProblem::OutOfRange {
        found,
        unit: "",
        low,
        high,
        because: "sizes are compared with each other, and each class is a column",
        way_out: "leave it out for 3",
    })
}

/// A share of the mass, 0 to ½, the latter excluded.
fn share_in_range(
    at: &Checker,
    path: &str,
    found: f64,
    because: &'static str,
    way_out: &'static str,
) -> Result<(), SceneError> {
    let (low, high) = (0.0, 0.5);
    at.ensure(found >= low && found < high, path, || SceneProblem::OutOfRange {
        found,
        unit: "",
        low,
        high,
        because,
        way_out,
    })
}

fn optional(
    at: &Checker,
    path: &str,
    axis: Option<Axis>,
    value: Option<f64>,
    size: [f64; 3],
) -> Result<(), SceneError> {
    match value {
        Some(value) => at.position(path, axis.unwrap_or(Axis::Z), value, size),
        None => Ok(()),
    }
}

/// A name out of a list of them.
pub(in crate::scene) fn known(
    at: &Checker,
    path: &str,
    kind: &'static str,
    name: &str,
    names: &[String],
) -> Result<(), SceneError> {
    at.ensure(names.iter().any(|other| other == name), path, || SceneProblem::UnknownName {
        kind,
        name: name.to_owned(),
        nearest: nearest(name, names).map(str::to_owned),
        names: names.to_vec(),
    })
}
