//! When a dry run stops and what it writes.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::geometry::Axis;
use crate::scene::{Arrested, Cadence};

/// When the run ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrainStop {
    /// End time, s.
    pub end_time_s: f64,
    /// End earlier when the fastest grain has been slower than a limit for a while.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arrested: Option<Arrested>,
}

/// What is written.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrainOutput {
    /// Grains and contacts for ParaView: at the start and the end only when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grains: Option<Cadence>,
    /// Rows of the time series: 100 when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub series: Option<Cadence>,
    /// What the time series holds; energies and contacts when nothing is named.
    #[serde(default)]
    pub probes: Vec<GrainProbe>,
}

/// A named measurement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrainProbe {
    /// Unique name: column of `series.csv`, or its beginning.
    pub name: String,
    /// What is measured.
    pub measure: GrainMeasure,
}

/// What a probe measures. Driven grains do not count.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum GrainMeasure {
    /// Kinetic energy of translation and rotation, J.
    KineticEnergy,
    /// Largest speed of a centre of mass, m/s.
    MaxSpeed,
    /// Mass, kg, and number of the grains in the box.
    Mass,
    /// Number of touching pairs, of contacts with walls, and contacts per grain.
    Contacts,
    /// The books, J: kinetic, rotational, potential, elastic, lost to normal damping, friction and rolling, work of
    /// walls and driven grains, and what the sum has changed by since time 0.
    Energies,
    /// Momentum, N s.
    Momentum,
    /// Centre, m, velocity, m/s, and spin, rad/s, of one grain.
    Grain {
        /// Name of the set.
        set: String,
        /// Number within the set, from 0.
        #[serde(default)]
        number: u64,
    },
    /// Mass, kg, and number of grains that have crossed a plane since time 0, towards larger coordinates less back.
    Flux {
        /// The axis normal to the plane.
        normal: Axis,
        /// Position of the plane on that axis, m.
        at_m: f64,
    },
    /// Force of the grains, N, and its torque about the centre of rotation, N m.
    Force {
        /// What is pushed.
        on: Target,
    },
    /// Where a pile ends: coordinates along an axis, below and above which lies the given share of the mass, and
    /// height along `up`, above which lies the same share; m.
    Pile {
        /// The axis along which it runs out.
        along: Axis,
        /// The axis along which height is measured; z when not given.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        up: Option<Axis>,
        /// Share of the mass left out at each end, no unit; 0.005 when not given.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        share: Option<f64>,
    },
    /// Mean velocity, m/s, and mean speed, m/s, of the grains of a set.
    SetSpeed {
        /// Name of the set.
        set: String,
    },
    /// How sizes separate: mean height of each size class, m, smallest grains first; classes hold equal numbers of
    /// grains.
    Segregation {
        /// The axis along which height is measured; z when not given.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        up: Option<Axis>,
        /// Number of classes; 3 when not given.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        classes: Option<u32>,
    },
    /// Front of the grains, m: the coordinate beyond which lies the given share of their mass.
    GrainFront {
        /// The axis along which they run out, towards larger coordinates.
        along: Axis,
        /// Share of the mass beyond the front, no unit; 0.02 when not given.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        share: Option<f64>,
    },
    /// Force, N, and torque, N m, of the fluid on one grain, and force of contacts and lubrication, N: means of the
    /// last step of the fluid. Only with `fluid`.
    FluidForce {
        /// Name of the set.
        set: String,
        /// Number within the set, from 0.
        #[serde(default)]
        number: u64,
    },
    /// Depth of the centre of one grain below the free surface of its column, m, negative above it. Only with a free
    /// surface.
    Submergence {
        /// Name of the set.
        set: String,
        /// Number within the set, from 0.
        #[serde(default)]
        number: u64,
    },
}

/// What a measure needs besides grains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Needs {
    /// Nothing.
    Grains,
    /// A fluid around them.
    Fluid,
    /// A fluid with a free surface.
    Surface,
}

impl GrainMeasure {
    /// What it needs besides grains.
    pub(crate) fn needs(&self) -> Needs {
        match self {
            Self::FluidForce { .. } => Needs::Fluid,
            Self::Submergence { .. } => Needs::Surface,
            _ => Needs::Grains,
        }
    }
}

/// What a force acts on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Target {
    /// A named solid.
    Solid(String),
    /// A face of the box: `x_min`, …
    Face(String),
}
