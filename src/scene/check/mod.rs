//! Value checks. The first problem found is reported; order is that of the file.

pub(super) mod collisions;
mod coupled;
pub(super) mod domain;
pub(super) mod fluid;
mod motion;
pub(super) mod numerics;
pub(super) mod output;
pub(super) mod probes;
mod surface;

use super::checker::Checker;
use super::{Scene, SceneError};

/// Checks every value that can be judged without numerical parameters.
pub(super) fn check(scene: &Scene) -> Result<(), SceneError> {
    let at = Checker { file: &scene.file };
    domain::check(&at, &scene.domain)?;
    if let Some(gravity) = &scene.gravity {
        fluid::check_gravity(&at, gravity)?;
    }
    fluid::check_fluid(&at, scene)?;
    surface::check(&at, scene)?;
    fluid::check_layers(&at, scene)?;
    fluid::check_solids(&at, scene)?;
    motion::check(&at, scene)?;
    coupled::check(&at, scene)?;
    numerics::check_numerics(&at, &scene.numerics)?;
    numerics::check_stop(&at, &scene.stop)?;
    output::check(&at, scene)?;
    collisions::check(&at, &super::series::of_flow(scene))
}
