//! What a guard found, for people.

use std::fmt;

use super::View;
use crate::dem::{DemError, V3};
use crate::plan::grains::GrainPlan;
use crate::scene::dry::DryScene;

/// Why the discrete element method stopped.
#[derive(Clone, Debug, PartialEq)]
pub struct GrainStopReport {
    /// Scene file.
    pub file: String,
    /// Step.
    pub step: u64,
    /// Time, s.
    pub time_s: f64,
    /// Which grains.
    pub who: String,
    /// Where, m.
    pub position_m: Option<[f64; 3]>,
    /// What was found, with its unit.
    pub found: String,
    /// The likely cause and what to do.
    pub cause: &'static str,
}

/// A report with the names of the scene.
pub(super) fn report(
    scene: &DryScene,
    plan: &GrainPlan,
    grains: &View<'_>,
    error: &DemError,
) -> GrainStopReport {
    let name = |grain: usize| plan.name(grains.ids.get(grain).map_or(grain, |&id| id as usize));
    let place = |grain: usize| grains.dem.bodies().position.get(grain).map(|x: &V3| [x.x, x.y, x.z]);
    let base = refused(scene, error);
    match error {
        DemError::Overlap { step, time_s, pair, grains: (first, second), overlap_m, share, limit } => {
            let wall = pair.split_once(" and wall ").map(|(_, wall)| wall);
            let other = match (second, wall) {
                (Some(second), _) => name(*second),
                (None, Some(wall)) => format!("wall {wall}"),
                (None, None) => "a wall".to_owned(),
            };
            let early = *step < 10;
            GrainStopReport {
                step: *step,
                time_s: *time_s,
                who: format!("{} and {other}", name(*first)),
                position_m: place(*first),
                found: format!(
                    "overlap of {overlap_m:.4e} m, {share:.3} of the smaller radius; the limit is {limit}"
                ),
                cause: if early {
                    "an impact much faster than `grains.numerics.design_speed_m_per_s`, or material too soft for it"
                } else {
                    "an impact too fast or a load too high for this Young's modulus; stiffer material, or a smaller \
                     time step if the design speed was too low"
                },
                ..base
            }
        }
        DemError::NotFinite { step, time_s, grain } => GrainStopReport {
            step: *step,
            time_s: *time_s,
            who: name(*grain),
            position_m: None,
            found: "position or velocity is not a finite number".to_owned(),
            cause: "forces beyond the range of 64-bit numbers: check radius, density and Young's modulus",
            ..base
        },
        DemError::Spin { step, time_s, grain, spin_rad_s, step_s } => GrainStopReport {
            step: *step,
            time_s: *time_s,
            who: name(*grain),
            position_m: place(*grain),
            found: format!("spin of {spin_rad_s:.3e} rad/s, too fast for steps of {step_s:.3e} s"),
            cause: "a very uneven clump in a fast collision; a smaller `grains.numerics.time_step_s`",
            ..base
        },
        _ => base,
    }
}

/// A report without a state.
pub(super) fn refused(scene: &DryScene, error: &DemError) -> GrainStopReport {
    GrainStopReport {
        file: scene.file.clone(),
        step: 0,
        time_s: 0.0,
        who: "grains".to_owned(),
        position_m: None,
        found: error.to_string(),
        cause: "see the message",
    }
}

impl fmt::Display for GrainStopReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: stopped at step {}, time {:.9} s", self.file, self.step, self.time_s)?;
        write!(f, "  where: {}", self.who)?;
        if let Some([x, y, z]) = self.position_m {
            write!(f, ", at ({x:.6}, {y:.6}, {z:.6}) m")?;
        }
        writeln!(f, "\n  found: {}", self.found)?;
        writeln!(f, "  likely cause: {}", self.cause)?;
        write!(f, "  files written before stay as they are")
    }
}
