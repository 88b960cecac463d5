//! Loads on solids and walls over a run, in numbers.

use serde::{Deserialize, Serialize};

use crate::output::number;

/// What one `force` or `torque` probe has seen, at every step since time 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoadSummary {
    /// Name of the probe.
    pub probe: String,
    /// What is pushed, and by whom.
    pub load: String,
    /// The point of all moments.
    pub about_m: [f64; 3],
    /// The axis that moments about do not overturn: the one along which gravity is strongest.
    pub up: char,
    /// Time between samples, a step: a raw peak is the mean over one step.
    #[serde(with = "number")]
    pub sampled_every_s: f64,
    /// ∫ F dt since time 0.
    pub impulse_n_s: [f64; 3],
    /// ∫ M dt since time 0.
    pub angular_impulse_n_m_s: [f64; 3],
    /// Peaks of single steps; `None` before the first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub raw: Option<LoadPeaks>,
    /// Length of the moving mean: what was asked for in whole steps.
    #[serde(with = "number")]
    pub window_s: f64,
    /// Peaks of the moving mean; `None` in a run that is shorter.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub windowed: Option<LoadPeaks>,
}

/// The instants at which a load was largest in one sense or another; of equals the first.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoadPeaks {
    /// Largest force.
    pub force: LoadInstant,
    /// Largest component along x, whatever its sign.
    pub force_x: LoadInstant,
    /// Likewise along y.
    pub force_y: LoadInstant,
    /// Likewise along z.
    pub force_z: LoadInstant,
    /// Largest overturning moment.
    pub overturning: LoadInstant,
}

/// A load at one time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoadInstant {
    /// The end of the step; of a moving mean the middle of its window.
    #[serde(with = "number")]
    pub time_s: f64,
    /// Force.
    pub force_n: [f64; 3],
    /// Its magnitude.
    #[serde(with = "number")]
    pub magnitude_n: f64,
    /// Moment about `about_m`.
    pub moment_n_m: [f64; 3],
    /// Magnitude of its part across `up`.
    #[serde(with = "number")]
    pub overturning_n_m: f64,
    /// Where the line of action of the force meets the plane through `about_m` normal to the axis along which the force is
    /// largest; `None` without a force.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub centre_of_pressure_m: Option<[f64; 3]>,
}
