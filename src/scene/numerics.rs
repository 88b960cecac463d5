//! Numerical choices, when to stop, and what to write.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::geometry::Axis;

/// Numerical choices. All optional: without them the run uses the scheme known to be best.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Numerics {
    /// Collision operator.
    #[serde(default)]
    pub collision: Collision,
    /// How the yield stress enters.
    #[serde(default)]
    pub yield_treatment: YieldChoice,
    /// Wall velocity used by half-way bounce-back.
    #[serde(default)]
    pub wall_rule: WallChoice,
    /// Source in the third moments (experimental).
    #[serde(default)]
    pub stress_source: bool,
    /// Time step, s. At most one of `time_step_s`, `relaxation_time`, `target_mach`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_step_s: Option<f64>,
    /// τ of the reference (plastic) viscosity, no unit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relaxation_time: Option<f64>,
    /// Reference velocity over the speed of sound, no unit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub target_mach: Option<f64>,
    /// Expected largest velocity, m/s; estimated when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference_velocity_m_per_s: Option<f64>,
}

/// Collision operator and the parameters of its odd relaxation rate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Collision {
    /// Which operator.
    #[serde(default)]
    pub operator: Operator,
    /// Λ = (τ⁺ − ½)(τ⁻ − ½), no unit; 0.1875 when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub magic: Option<f64>,
    /// θ, least τ⁻ − ½, no unit; 0.05 when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub floor: Option<f64>,
    /// Below this τ⁺ − ½ the product Λ is given up for stability; 0.05 when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lowered_below: Option<f64>,
}

/// The four operators.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Operator {
    /// One relaxation time.
    Bgk,
    /// Two relaxation times.
    Trt,
    /// Central moments about the co-moving state.
    #[default]
    CentralMoment,
    /// Recursive-regularised.
    Regularised,
}

/// How the relaxation time follows from the law.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum YieldChoice {
    /// Solved exactly in each cell; no viscosity limit.
    #[default]
    Exact,
    /// Solved in each cell, then clamped.
    ImplicitClamped(ClampLimits),
    /// From the previous step's relaxation time, then clamped.
    LaggedClamped(ClampLimits),
}

/// Limits of a clamp: a pair of relaxation times or a pair of viscosities.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClampLimits {
    /// Least τ, no unit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tau_min: Option<f64>,
    /// Largest τ, no unit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tau_max: Option<f64>,
    /// Least viscosity, Pa s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub viscosity_min_pa_s: Option<f64>,
    /// Largest viscosity, Pa s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub viscosity_max_pa_s: Option<f64>,
}

/// Wall velocity used by half-way bounce-back.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum WallChoice {
    /// The wall's own: plain half-way bounce-back, whose slip grows with viscosity.
    HalfWay,
    /// Corrected link by link for the known slip, so that the result does not depend on viscosity
    /// and unyielded material rests.
    #[default]
    ViscosityIndependent,
}

/// When the run ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stop {
    /// End time, s.
    pub end_time_s: f64,
    /// End earlier when nothing changes any more.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steady: Option<Steady>,
}

/// Steady when the largest change of velocity over one check interval, divided by the largest
/// speed, is below the tolerance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Steady {
    /// Largest relative change, no unit.
    pub tolerance: f64,
    /// Time between checks, s.
    pub check_every_s: f64,
}

/// What is written.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Output {
    /// Fields for ParaView: at the end only when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fields: Option<Cadence>,
    /// Rows of the time series: 100 when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub series: Option<Cadence>,
    /// What the time series and profiles hold.
    #[serde(default)]
    pub probes: Vec<Probe>,
}

/// How often; time 0 and the end are always included.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Cadence {
    /// Every so many seconds.
    #[serde(rename = "every_s")]
    EverySeconds(f64),
    /// So many times, evenly spread over the run.
    Count(u32),
}

/// A named measurement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Probe {
    /// Unique name: column of `series.csv`, or file name of a profile.
    pub name: String,
    /// What is measured.
    pub measure: Measure,
}

/// What a probe measures.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
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
    /// Largest speed, m/s.
    MaxSpeed,
    /// Kinetic energy, J.
    KineticEnergy,
    /// Mass of the fluid, kg.
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
}
