//! Checks of outputs and probes.

use super::{Checker, SceneError, SceneProblem};
use crate::scene::{Cadence, Measure, Scene};

pub(super) fn check(at: &Checker, scene: &Scene) -> Result<(), SceneError> {
    let end = scene.stop.end_time_s;
    cadence(at, "output.fields", scene.output.fields, end)?;
    cadence(at, "output.series", scene.output.series, end)?;
    let size = scene.domain.size_m;
    let mut names = Vec::new();
    for (i, probe) in scene.output.probes.iter().enumerate() {
        let path = format!("output.probes[{i}]");
        at.name(&format!("{path}.name"), &probe.name, &mut names)?;
        match probe.measure {
            Measure::PointVelocity { at_m } => {
                at.point(&format!("{path}.measure.point_velocity.at_m"), at_m, size)?;
            }
            Measure::FlowRate { normal, at_m } => {
                at.position(&format!("{path}.measure.flow_rate.at_m"), normal, at_m, size)?;
            }
            Measure::Profile { .. }
            | Measure::MaxSpeed
            | Measure::KineticEnergy
            | Measure::Mass
            | Measure::PlugFraction => {}
        }
    }
    Ok(())
}

fn cadence(at: &Checker, path: &str, cadence: Option<Cadence>, end: f64) -> Result<(), SceneError> {
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
