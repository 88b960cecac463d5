//! Checks of outputs.

use std::collections::HashSet;

use super::probes::{Place, probes};
use crate::scene::checker::Checker;
use crate::scene::field_choice;
use crate::scene::probe::Subject;
use crate::scene::{Cadence, Scene, SceneError, SceneProblem};

pub(super) fn check(at: &Checker, scene: &Scene) -> Result<(), SceneError> {
    let end = scene.stop.end_time_s;
    cadence(at, "output.fields", scene.output.fields, end)?;
    cadence(at, "output.series", scene.output.series, end)?;
    field_choice::check(at, scene)?;
    let mut names = HashSet::new();
    probes(at, &scene.output.probes, &place(scene, "output.probes", Subject::Fluid), &mut names)
}

/// The grains' part: how often they are written, and probes with names that the others do not have.
pub(super) fn check_grains(at: &Checker, scene: &Scene) -> Result<(), SceneError> {
    cadence(at, "output.grains", scene.output.grains, scene.stop.end_time_s)?;
    let mut names = scene.output.probes.iter().map(|probe| probe.name.clone()).collect();
    let place = place(scene, "output.grain_probes", Subject::Grains);
    probes(at, &scene.output.grain_probes, &place, &mut names)
}

/// What there is to be measured.
fn place(scene: &Scene, path: &'static str, subject: Subject) -> Place {
    let sets = scene.grains.iter().flat_map(|grains| &grains.sets);
    Place {
        path,
        subject,
        end_s: scene.stop.end_time_s,
        size_m: scene.domain.size_m,
        fluid: true,
        surface: scene.fluid.initial.is_some(),
        grains: scene.grains.is_some(),
        up: scene.up_axis(),
        solids: scene.solids.iter().map(|solid| solid.name.clone()).collect(),
        sets: sets.map(|set| set.name.clone()).collect(),
    }
}

/// An interval within the run, or a number that can be counted.
pub(in crate::scene) fn cadence(
    at: &Checker,
    path: &str,
    cadence: Option<Cadence>,
    end: f64,
) -> Result<(), SceneError> {
    match cadence {
        None => Ok(()),
        Some(Cadence::EverySeconds(every)) => {
            let path = format!("{path}.every_s");
            at.positive(&path, every, "s", "it is an interval", "leave the block out for the default")?;
            at.ensure(every <= end, &path, || SceneProblem::BeyondEnd { found: every, end })
        }
        Some(Cadence::Count(count)) => {
            let path = format!("{path}.count");
            let (found, low, high) = (f64::from(count), 1.0, 100_000.0);
            at.ensure((low..=high).contains(&found), &path, || SceneProblem::OutOfRange {
                found,
                unit: "",
                low,
                high,
                because: "each one is a file or a row",
                way_out: "leave the block out for the default",
            })
        }
    }
}
