//! Checks of outputs and probes.

use crate::geometry::{Axis, Shape};
use crate::scene::checker::Checker;
use crate::scene::nearest::nearest;
use crate::scene::{Cadence, Measure, Scene, SceneError, SceneProblem};

pub(super) fn check(at: &Checker, scene: &Scene) -> Result<(), SceneError> {
    let end = scene.stop.end_time_s;
    cadence(at, "output.fields", scene.output.fields, end)?;
    cadence(at, "output.series", scene.output.series, end)?;
    let size = scene.domain.size_m;
    let mut names = Vec::new();
    for (i, probe) in scene.output.probes.iter().enumerate() {
        let path = format!("output.probes[{i}]");
        at.name(&format!("{path}.name"), &probe.name, &mut names)?;
        let path = format!("{path}.measure");
        // Loads and ledgers are kept for grains too.
        let kept = scene.grains.is_some() && matches!(probe.measure, Measure::Force { .. } | Measure::Ledger);
        let surface = scene.fluid.initial.is_some() || kept || !probe.measure.needs_surface();
        at.ensure(surface, &path, || SceneProblem::NeedsSurface {
            what: "this measure",
            otherwise: "remove the probe",
        })?;
        match &probe.measure {
            Measure::PointVelocity { at_m } => {
                at.point(&format!("{path}.point_velocity.at_m"), *at_m, size)?;
            }
            Measure::FlowRate { normal, at_m } => {
                at.position(&format!("{path}.flow_rate.at_m"), *normal, *at_m, size)?;
            }
            Measure::Front { along, threshold_m, from_m, above_m } => {
                let path = format!("{path}.front");
                let way_out = "one cell";
                at.positive(&format!("{path}.threshold_m"), *threshold_m, "m", "it is a depth", way_out)?;
                along_bed(at, scene, &format!("{path}.along"), *along)?;
                optional(at, &format!("{path}.from_m"), Some(*along), *from_m, size)?;
                optional(at, &format!("{path}.above_m"), scene.up_axis(), *above_m, size)?;
            }
            Measure::SurfaceProfile { along, at_m, above_m } => {
                let path = format!("{path}.surface_profile");
                along_bed(at, scene, &format!("{path}.along"), *along)?;
                let up = scene.up_axis().unwrap_or(Axis::Z);
                let third = Axis::ALL.into_iter().find(|axis| axis != along && *axis != up);
                optional(at, &format!("{path}.at_m"), third, *at_m, size)?;
                optional(at, &format!("{path}.above_m"), scene.up_axis(), *above_m, size)?;
            }
            Measure::DepthMap { above_m } => {
                optional(at, &format!("{path}.depth_map.above_m"), scene.up_axis(), *above_m, size)?;
            }
            Measure::WindowVelocity { min_m, max_m } => {
                let path = format!("{path}.window_velocity");
                for axis in Axis::ALL {
                    let (low, high) = (min_m[axis.index()], max_m[axis.index()]);
                    at.ensure(low < high, &path, || SceneProblem::EmptyInterval {
                        axis: axis.letter(),
                        low,
                        high,
                    })?;
                }
                at.reaches_box(&path, &Shape::Box { min_m: *min_m, max_m: *max_m }, size)?;
            }
            Measure::Force { solid } => {
                let solids: Vec<String> = scene.solids.iter().map(|solid| solid.name.clone()).collect();
                at.ensure(solids.contains(solid), &format!("{path}.force.solid"), || {
                    SceneProblem::UnknownSolid {
                        name: solid.clone(),
                        nearest: nearest(solid, &solids).map(str::to_owned),
                        solids: solids.clone(),
                    }
                })?;
            }
            Measure::Profile { .. }
            | Measure::MaxSpeed
            | Measure::KineticEnergy
            | Measure::Mass
            | Measure::PlugFraction
            | Measure::YieldedFraction
            | Measure::Volume
            | Measure::Ledger => {}
        }
    }
    Ok(())
}

/// Fronts and sections run along the bed.
fn along_bed(at: &Checker, scene: &Scene, path: &str, along: Axis) -> Result<(), SceneError> {
    let up = scene.up_axis().unwrap_or(Axis::Z);
    at.ensure(along != up, path, || SceneProblem::AcrossBed { axis: along.letter() })
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
