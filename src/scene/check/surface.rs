//! Checks of the initial fluid and of what goes only with a free surface, or not with one.

use std::collections::HashSet;

use crate::geometry::Axis;
use crate::scene::checker::Checker;
use crate::scene::{Boundary, FACE_KEYS, FillLevel, InitialVelocity, Scene, SceneError, SceneProblem};

pub(super) fn check(at: &Checker, scene: &Scene) -> Result<(), SceneError> {
    let Some(initial) = &scene.fluid.initial else { return without(at, scene) };
    let path = "fluid.initial";
    let empty = initial.fill_level.is_none() && initial.shapes.is_empty();
    at.ensure(!empty, path, || SceneProblem::EmptyInitial)?;
    if let Some(level) = &initial.fill_level {
        fill_level(at, scene, level)?;
    }
    let mut names = HashSet::new();
    for (i, part) in initial.shapes.iter().enumerate() {
        let path = format!("{path}.shapes[{i}]");
        if let Some(name) = &part.name {
            at.name(&format!("{path}.name"), name, &mut names)?;
        }
        at.shape(&format!("{path}.shape"), &part.shape, scene.domain.size_m, false)?;
    }
    at.ensure(scene.layers.is_empty(), "layers", || SceneProblem::NotWithSurface {
        what: "a second fluid",
        allowed: "one fluid below the surface",
    })?;
    let still =
        matches!(scene.fluid.initial_velocity, InitialVelocity::AtRest | InitialVelocity::Uniform { .. });
    at.ensure(still, "fluid.initial_velocity", || SceneProblem::NotWithSurface {
        what: "a wave or a vortex at time 0",
        allowed: "`at_rest` or `uniform`",
    })?;
    rules(at, scene)
}

fn fill_level(at: &Checker, scene: &Scene, level: &FillLevel) -> Result<(), SceneError> {
    let path = "fluid.initial.fill_level";
    at.ensure(level.axis.is_some() || scene.up_axis().is_some(), path, || SceneProblem::LevelWithoutAxis)?;
    if let Some(axis) = level.axis.or_else(|| scene.up_axis()) {
        at.position(&format!("{path}.height_m"), axis, level.height_m, scene.domain.size_m)?;
    }
    Ok(())
}

fn rules(at: &Checker, scene: &Scene) -> Result<(), SceneError> {
    let Some(rules) = scene.numerics.free_surface else { return Ok(()) };
    let margins =
        [("fill_margin", rules.fill_margin, 1e-6, 0.1), ("lonely_margin", rules.lonely_margin, 0.0, 0.5)];
    for (key, value, low, high) in margins {
        let Some(found) = value else { continue };
        at.ensure((low..=high).contains(&found), &format!("numerics.free_surface.{key}"), || {
            SceneProblem::OutOfRange {
                found,
                unit: "",
                low,
                high,
                because: "a margin keeps cells from changing to and fro [F4]; a large one lets them over- or underfill",
                way_out: "leave it out for the default",
            }
        })?;
    }
    Ok(())
}

/// Without `fluid.initial`.
fn without(at: &Checker, scene: &Scene) -> Result<(), SceneError> {
    for (axis, faces) in Axis::ALL.into_iter().zip(scene.domain.boundaries.by_axis()) {
        for (face, key) in faces.iter().zip(FACE_KEYS[axis.index()]) {
            at.ensure(*face != Boundary::Open, &format!("domain.boundaries.{key}"), || {
                SceneProblem::NeedsSurface { what: "an open face", otherwise: "make the face a wall" }
            })?;
        }
    }
    at.ensure(scene.numerics.free_surface.is_none(), "numerics.free_surface", || SceneProblem::NeedsSurface {
        what: "this block",
        otherwise: "remove it",
    })
}
