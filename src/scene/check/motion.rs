//! Checks of motions in time.

use crate::scene::checker::Checker;
use crate::scene::{Boundary, Motion, Scene, SceneError, SceneProblem};

/// Motions belong to walls that can move and to solids, and say something at every time.
pub(super) fn check(at: &Checker, scene: &Scene) -> Result<(), SceneError> {
    let faces = scene.domain.boundaries.by_axis();
    for (axis, side, key, motion) in scene.domain.motion.named() {
        let path = format!("domain.motion.{key}");
        let moves = matches!(faces[axis][side], Boundary::MovingWall { .. });
        let because = "the face of this name is no `moving_wall`";
        at.ensure(moves, &path, || SceneProblem::UnusedKey { key, because })?;
        one(at, &path, motion, scene)?;
    }
    for (i, solid) in scene.solids.iter().enumerate() {
        let Some(motion) = &solid.motion else { continue };
        // A solid whose velocity and spin are 0 may have one: a sweep over them may begin there.
        one(at, &format!("solids[{i}].motion"), motion, scene)?;
    }
    Ok(())
}

fn one(at: &Checker, path: &str, motion: &Motion, scene: &Scene) -> Result<(), SceneError> {
    at.ensure(scene.grains.is_none(), path, || SceneProblem::NotWithGrains {
        what: "a wall whose velocity changes in time",
        allowed: "walls that move steadily: grains feel the velocity of time 0",
    })?;
    match motion {
        Motion::Oscillating { frequency_hz: 0.0, amplitude: 0.0, .. } => Ok(()),
        Motion::Oscillating { frequency_hz, .. } => {
            let path = format!("{path}.oscillating.frequency_hz");
            let way_out = "leave `motion` out for a steady velocity";
            at.positive(&path, *frequency_hz, "1/s", "it is a frequency", way_out)
        }
        Motion::Table { points } => {
            let path = format!("{path}.table.points");
            at.some(&path, points.len(), "a pair of a time and a factor")?;
            for (k, pair) in points.windows(2).enumerate() {
                let (before, found) = (pair[0][0], pair[1][0]);
                at.ensure(before < found, &format!("{path}[{}]", k + 1), || {
                    SceneProblem::TimesNotAscending { before, found }
                })?;
            }
            Ok(())
        }
    }
}
