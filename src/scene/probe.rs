//! Probes: what the time series, profiles and maps of a run hold. One language for scenes with fluid, without, and
//! with both.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::geometry::Axis;

/// A named measurement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Probe {
    /// Unique name: column of `series.csv` or its beginning, or file name of a profile.
    pub name: String,
    /// What is measured.
    pub measure: Measure,
}

/// What a probe measures. Gas cells and driven grains never count.
///
/// Three words are about fluid as well as about grains: `kinetic_energy`, `max_speed` and `mass`. They mean the fluid in
/// the `probes` of a scene with fluid, and the grains in `grain_probes` and in scenes without fluid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Measure {
    /// Velocity of the cell that holds a point, m/s.
    PointVelocity {
        /// The point, m.
        at_m: [f64; 3],
    },
    /// Velocity, shear rate and yielded fraction averaged over planes normal to an axis, written
    /// with every set of fields.
    Profile {
        /// The axis along which the profile runs.
        along: Axis,
    },
    /// Largest speed, m/s; of grains that of a centre of mass.
    MaxSpeed,
    /// Kinetic energy, J; of grains that of translation and rotation.
    KineticEnergy,
    /// Mass of the fluid, kg; of the grains in the box, kg, and their number.
    Mass,
    /// Fraction of the fluid cells that are unyielded, no unit.
    PlugFraction,
    /// Volume per time through a plane, m³/s.
    FlowRate {
        /// The axis normal to the plane.
        normal: Axis,
        /// Position of the plane on that axis, m: the layer of cells that holds it.
        at_m: f64,
    },
    /// Fraction of the fluid cells that are yielded, no unit: one less `plug_fraction`.
    YieldedFraction,
    /// Volume of the fluid, m³, from the fill of the cells.
    Volume,
    /// Farthest position along an axis at which the flow is deeper than a threshold, m; depth is the fill
    /// of a column normal to the bed, and the position is interpolated between columns. The box edge, or
    /// `from_m`, when no column is deep enough.
    Front {
        /// The axis the front moves along, towards larger coordinates.
        along: Axis,
        /// Depth that counts as flow, m.
        threshold_m: f64,
        /// Columns before this position do not count, m.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        from_m: Option<f64>,
        /// Only fluid above this height counts, m: the top of an erodible bed.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        above_m: Option<f64>,
    },
    /// Bed, depth, surface and mean velocity of the columns of a section along an axis, written with
    /// every set of fields.
    SurfaceProfile {
        /// The axis the section runs along.
        along: Axis,
        /// Where the section is on the third axis, m; the middle when not given.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        at_m: Option<f64>,
        /// Only fluid above this height counts, m.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        above_m: Option<f64>,
    },
    /// Depth and surface height of all columns, written with every set of fields as an image of one layer.
    DepthMap {
        /// Only fluid above this height counts, m.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        above_m: Option<f64>,
    },
    /// Mean velocity of the fluid inside a box, m/s, and the volume of that fluid, m³ (004 Eq 5.4; its
    /// mean over the whole window is the product of the two over the volume of the window).
    WindowVelocity {
        /// Low corner, m.
        min_m: [f64; 3],
        /// High corner, m.
        max_m: [f64; 3],
    },
    /// A force on something solid. On a `solid` in a fluid: force, N, its impulse since time 0, N s, and the wetted area
    /// of its faces by axis and side, m², by momentum exchange; the pressure of the air counts as 0. With grains this is
    /// the part of the fluid, and that of contacts follows: its mean over the time since the last row, N, its largest
    /// value in that time, N, and its impulse since time 0, N s. `on` something: force of the grains alone, N, and its
    /// torque about the centre of rotation, N m.
    ///
    /// At the end `loads` in `summary.json` gives impulse, peaks, centre of pressure and overturning moment of all of it.
    Force {
        /// Name of a solid in the fluid. Give this or `on`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        solid: Option<String>,
        /// What the grains push. Give this or `solid`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        on: Option<Target>,
        /// The point of the moments in `summary.json`, m. When not given that of a `solid` is the middle of its foot, the
        /// lower side of the box around it, and that `on` something its centre of rotation.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        about_m: Option<[f64; 3]>,
        /// Length of the moving mean in `summary.json`, s; the time between rows of the series when not given.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        window_s: Option<f64>,
    },
    /// Torque of the fluid on a solid, N m, by momentum exchange; of the last step, and the pressure of the air counts as
    /// 0 as in `force`.
    Torque {
        /// Name of a solid in the fluid.
        solid: String,
        /// The point it is about, m; the solid's centre of rotation when not given.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        about_m: Option<[f64; 3]>,
        /// Length of the moving mean in `summary.json`, s; the time between rows of the series when not given.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        window_s: Option<f64>,
    },
    /// Mass, kg, and what became of it: relative residual of the ledger, outflow and parked excess, kg,
    /// momentum residual, N s, and the number of cells that changed kind.
    Ledger,
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

/// What the words mean that fluid and grains share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// The fluid.
    Fluid,
    /// The grains.
    Grains,
}

/// What must be in a scene for a measure to mean anything.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Needs {
    /// A fluid.
    Fluid,
    /// A fluid with a free surface.
    Surface,
    /// A fluid whose mass is booked: with a free surface or with grains.
    Books,
    /// Grains.
    Grains,
    /// Grains in a fluid.
    Both,
    /// Grains in a fluid with a free surface.
    BothAndSurface,
}

impl Measure {
    /// What must be in the scene; `subject`: what the words mean that fluid and grains share.
    pub(crate) fn needs(&self, subject: Subject) -> Needs {
        match self {
            Self::PointVelocity { .. }
            | Self::Profile { .. }
            | Self::PlugFraction
            | Self::YieldedFraction
            | Self::FlowRate { .. }
            | Self::WindowVelocity { .. }
            | Self::Force { on: None, .. }
            | Self::Torque { .. } => Needs::Fluid,
            Self::Volume | Self::Front { .. } | Self::SurfaceProfile { .. } | Self::DepthMap { .. } => {
                Needs::Surface
            }
            Self::Ledger => Needs::Books,
            Self::KineticEnergy | Self::MaxSpeed | Self::Mass => match subject {
                Subject::Fluid => Needs::Fluid,
                Subject::Grains => Needs::Grains,
            },
            Self::Force { on: Some(_), .. }
            | Self::Contacts
            | Self::Energies
            | Self::Momentum
            | Self::Grain { .. }
            | Self::Flux { .. }
            | Self::Pile { .. }
            | Self::SetSpeed { .. }
            | Self::Segregation { .. }
            | Self::GrainFront { .. } => Needs::Grains,
            Self::FluidForce { .. } => Needs::Both,
            Self::Submergence { .. } => Needs::BothAndSurface,
        }
    }

    /// Whether it is about grains, in a fluid or without; `subject` as in [`Self::needs`].
    pub(crate) fn is_about_grains(&self, subject: Subject) -> bool {
        matches!(self.needs(subject), Needs::Grains | Needs::Both | Needs::BothAndSurface)
    }

    /// Whether it is written with every set of fields instead of into the time series.
    pub(crate) fn is_file(&self) -> bool {
        matches!(self, Self::Profile { .. } | Self::SurfaceProfile { .. } | Self::DepthMap { .. })
    }

    /// The solid in the fluid whose load it is, if it is one.
    pub(crate) fn loaded_solid(&self) -> Option<&str> {
        match self {
            Self::Force { solid, .. } => solid.as_deref(),
            Self::Torque { solid, .. } => Some(solid),
            _ => None,
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
