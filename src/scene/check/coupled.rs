//! Checks of grains in a fluid.

use crate::scene::checker::Checker;
use crate::scene::{Boundary, LubricationChoice, Scene, SceneError, SceneProblem, dry};

/// Most steps of the grains in a step of the fluid.
const MOST_SUB_STEPS: f64 = 100_000.0;

pub(super) fn check(at: &Checker, scene: &Scene) -> Result<(), SceneError> {
    let Some(view) = scene.as_dry() else { return without(at, scene) };
    at.ensure(scene.layers.is_empty(), "layers", || SceneProblem::NotWithGrains {
        what: "a second fluid",
        allowed: "one fluid around the grains",
    })?;
    dry::check_in_fluid(&view)?;
    super::output::check_grains(at, scene)?;
    coupling(at, scene)
}

fn coupling(at: &Checker, scene: &Scene) -> Result<(), SceneError> {
    let rules = scene.coupling();
    let path = |key: &str| format!("grains.coupling.{key}");
    let range = |key: &str, found: f64, unit, [low, high]: [f64; 2], because, way_out| {
        at.ensure((low..=high).contains(&found), &path(key), || SceneProblem::OutOfRange {
            found,
            unit,
            low,
            high,
            because,
            way_out,
        })
    };
    if let LubricationChoice::On(lubrication) = rules.lubrication {
        let default = crate::setup::suspension::Lubrication::default();
        let cutoff = lubrication.cutoff_cells.unwrap_or(default.cutoff);
        let (key, because) = ("lubrication.cutoff_cells", "wider gaps are resolved, and would count twice");
        range(key, cutoff, "cells", [0.01, 2.0], because, "leave it out for 0.74")?;
        let least = lubrication.smallest_gap_cells.unwrap_or(default.smallest_gap);
        let (key, because) =
            ("lubrication.smallest_gap_cells", "the force grows like 1/gap, up to the cut-off");
        range(key, least, "cells", [1e-6, cutoff], because, "leave it out for 0.001, or `\"off\"` for none")?;
    }
    if let Some(steps) = rules.sub_steps {
        let because = "a step of the fluid holds at least one of the grains";
        let way_out = "leave it out: `plan` chooses";
        range("sub_steps", f64::from(steps), "", [1.0, MOST_SUB_STEPS], because, way_out)?;
    }
    let given = scene.grains.as_ref().is_some_and(|grains| grains.numerics.time_step_s.is_some());
    at.ensure(!given || rules.sub_steps.is_none(), "grains.numerics.time_step_s", || {
        SceneProblem::UnusedKey { key: "time_step_s", because: "`grains.coupling.sub_steps` fixes it" }
    })?;
    let Some(balanced) = rules.balanced else { return Ok(()) };
    let pulls = |a: usize| scene.gravity.is_some_and(|g| crate::scene::force::gravity_vector(&g)[a] != 0.0);
    let faces = scene.domain.boundaries.by_axis();
    let along = (0..3).any(|a| faces[a][0] == Boundary::Periodic && pulls(a));
    at.ensure(along && scene.fluid.initial.is_none(), &path("balanced"), || SceneProblem::UnusedKey {
        key: "balanced",
        because: if scene.fluid.initial.is_some() {
            "with a free surface the weight rests on the bed"
        } else {
            "gravity does not act along a periodic axis"
        },
    })?;
    at.ensure(!balanced || scene.fluid.body_force.is_none(), &path("balanced"), || {
        SceneProblem::NotWithGrains {
            what: "a pressure gradient that balances the weight, and a body force,",
            allowed: "one of the two: the gradient would balance the body force too",
        }
    })
}

/// A scene without grains.
fn without(at: &Checker, scene: &Scene) -> Result<(), SceneError> {
    const BECAUSE: &str = "the scene has no `grains`";
    for (i, solid) in scene.solids.iter().enumerate() {
        at.ensure(solid.material.is_none(), &format!("solids[{i}].material"), || SceneProblem::UnusedKey {
            key: "material",
            because: BECAUSE,
        })?;
    }
    at.ensure(scene.output.grains.is_none(), "output.grains", || SceneProblem::UnusedKey {
        key: "grains",
        because: BECAUSE,
    })?;
    at.ensure(scene.output.grain_probes.is_empty(), "output.grain_probes", || SceneProblem::UnusedKey {
        key: "grain_probes",
        because: BECAUSE,
    })
}
