//! How walls and solids move in time.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Key names of the faces, `[axis][low, high]`.
pub const FACE_KEYS: [[&str; 2]; 3] = [["x_min", "x_max"], ["y_min", "y_max"], ["z_min", "z_max"]];

/// A factor by which the velocity of a wall or solid is multiplied in time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Motion {
    /// mean + amplitude cos(2π frequency t + phase).
    Oscillating {
        /// Frequency, 1/s.
        frequency_hz: f64,
        /// Amplitude of the factor, no unit; 1 when not given.
        #[serde(default = "one")]
        amplitude: f64,
        /// Mean of the factor, no unit; 0 when not given.
        #[serde(default)]
        mean: f64,
        /// Phase at time 0, radians.
        #[serde(default)]
        phase_rad: f64,
    },
    /// Linear between points, constant before the first and after the last.
    Table {
        /// Pairs of a time, s, and the factor from then on, no unit; times ascend.
        points: Vec<[f64; 2]>,
    },
}

const fn one() -> f64 {
    1.0
}

impl Motion {
    /// The largest magnitude of the factor.
    #[must_use]
    pub(crate) fn most(&self) -> f64 {
        match self {
            Self::Oscillating { amplitude, mean, .. } => amplitude.abs() + mean.abs(),
            Self::Table { points } => {
                points.iter().fold(0.0, |most: f64, p| if p[1].abs() > most { p[1].abs() } else { most })
            }
        }
    }
}

/// One motion per moving wall of the box; a wall that is not named moves steadily.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Motions {
    /// Of the wall at x = 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x_min: Option<Motion>,
    /// Of the wall at x = size.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x_max: Option<Motion>,
    /// Of the wall at y = 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y_min: Option<Motion>,
    /// Of the wall at y = size.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y_max: Option<Motion>,
    /// Of the wall at z = 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub z_min: Option<Motion>,
    /// Of the wall at z = size.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub z_max: Option<Motion>,
}

impl Motions {
    /// Whether every wall moves steadily.
    #[must_use]
    pub(crate) fn is_empty(&self) -> bool {
        self.by_axis().iter().flatten().all(|motion| motion.is_none())
    }

    /// `[axis][low, high]`.
    #[must_use]
    pub(crate) const fn by_axis(&self) -> [[Option<&Motion>; 2]; 3] {
        [
            [self.x_min.as_ref(), self.x_max.as_ref()],
            [self.y_min.as_ref(), self.y_max.as_ref()],
            [self.z_min.as_ref(), self.z_max.as_ref()],
        ]
    }

    /// Those that are named, with axis, side and key.
    pub(crate) fn named(&self) -> impl Iterator<Item = (usize, usize, &'static str, &Motion)> {
        let each =
            |axis: usize, side: usize| Some((axis, side, FACE_KEYS[axis][side], self.by_axis()[axis][side]?));
        (0..6).filter_map(move |face| each(face / 2, face % 2))
    }
}
