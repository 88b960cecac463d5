//! Numerical choices, when to stop, and what to write.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::field_choice::{FieldName, FieldPrecision, FieldRegion};
use super::{Operator, Probe, Subject};

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
    /// Where the surfaces of solids lie. Without it in their true place, unless a solid moves or a
    /// motion changes in time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solid_surface: Option<SolidSurface>,
    /// Source in the third moments (experimental).
    #[serde(default)]
    pub stress_source: bool,
    /// Precision of what is stored and computed with.
    #[serde(default)]
    pub precision: PrecisionChoice,
    /// Rules of the free surface; only with `fluid.initial`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub free_surface: Option<SurfaceRules>,
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

/// Precision of the populations. Single precision is deterministic too, takes half the memory and about half
/// the time, and rounds velocities to 2⁻²⁴ of themselves in every step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum PrecisionChoice {
    /// Stored and computed with in 64 bits.
    #[default]
    Double,
    /// Stored and computed with in 32 bits.
    Single,
    /// Stored in 32 bits, computed with in 64.
    SingleStorage,
}

/// Rules of the free surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceRules {
    /// How gravity and body force act in partly filled cells.
    #[serde(default)]
    pub gravity: SurfaceGravity,
    /// What a cell that becomes partly filled starts from.
    #[serde(default)]
    pub refill: RefillChoice,
    /// Which neighbours take the mass that a cell leaves over when it fills or empties.
    #[serde(default)]
    pub excess: ExcessChoice,
    /// ε: a cell is full above (1 + ε) of its density and empty below −ε of it, no unit; 0.01 when not
    /// given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fill_margin: Option<f64>,
    /// η: the same margin, measured inwards, for cells that touch no air or no full cell, no unit; 0.1
    /// when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lonely_margin: Option<f64>,
}

/// How gravity and body force act in partly filled cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum SurfaceGravity {
    /// As if they were full.
    Full,
    /// In proportion to their fill: exact rest at any level.
    #[default]
    ByFill,
    /// In proportion to their fill, and the rest accelerates with the liquid: for fluid that falls freely.
    ByFillAndInertia,
}

/// What a cell that becomes partly filled starts from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum RefillChoice {
    /// Equilibrium at the mean density and velocity of its neighbours.
    #[default]
    Equilibrium,
    /// Equilibrium at the mean density and velocity of its neighbours, with their mean stress.
    WithStress,
}

/// Which neighbours take the mass that a cell leaves over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ExcessChoice {
    /// All partly filled ones in equal parts.
    #[default]
    Even,
    /// The partly filled ones in proportion to how far they lie along the normal of the surface.
    AlongNormal,
}

/// Collision operator and the parameters of its odd relaxation rate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Collision {
    /// Which operator; `central_moment` when not given, `trt` when not given with grains in a Newtonian fluid: only then
    /// the drag of a grain does not depend on the viscosity.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub operator: Option<Operator>,
    /// Λ = (τ⁺ − ½)(τ⁻ − ½), no unit; 0.1875 when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub magic: Option<f64>,
    /// θ, least τ⁻ − ½, no unit; 0.05 when not given, and then less in mud at rest below a free surface, which would creep.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub floor: Option<f64>,
    /// Below this τ⁺ − ½ the product Λ is given up for stability; 0.05 when not given, 0.15 with grains
    /// and `central_moment`, whose odd moments would grow along a surface that moves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lowered_below: Option<f64>,
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

/// Where the surfaces of solids lie; faces of the box always lie half-way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum SolidSurface {
    /// Half-way between the cells on either side: curved and oblique solids are stairs.
    HalfWay,
    /// In their true place, by central linear interpolation along the links between cells.
    CentralLinear,
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
    /// End earlier when the fluid has come to rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arrested: Option<Arrested>,
}

/// At rest when a measure of the speed stays below a limit at every check of a stretch of time. With fluid and grains it
/// must be below for either.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Arrested {
    /// Which speed it is that must stay below the limit; the speed that 99 % of the mass does not exceed when not given.
    #[serde(default)]
    pub measure: RestMeasure,
    /// The limit, m/s.
    pub speed_m_per_s: f64,
    /// How long it must stay below, s.
    pub for_s: f64,
    /// Time between checks, s.
    pub check_every_s: f64,
}

/// Share of the mass that has to be slow when the scene does not say.
const SLOW_SHARE: f64 = 0.99;

fn slow_share() -> f64 {
    SLOW_SHARE
}

/// The speed that counts for being at rest. Gas cells and driven grains never count; grains count with the speed of their
/// centres of mass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum RestMeasure {
    /// The least speed that a share of the mass does not exceed: what the rest of it does, be it spray at 10 m/s or
    /// a surface cell that creeps, does not count.
    MassPercentile {
        /// The share, no unit; 0.99 when not given.
        #[serde(default = "slow_share")]
        share: f64,
    },
    /// √(2 E/m) with the kinetic energy E and the mass m: the root mean square of the speed over the mass. A single fast
    /// drop of mass m₁ and speed v₁ counts with v₁ √(m₁/m).
    Rms,
    /// The largest speed, of fluid each cell's times its fill: a single cell or grain can keep it up.
    Largest,
}

impl Default for RestMeasure {
    fn default() -> Self {
        Self::MassPercentile { share: SLOW_SHARE }
    }
}

/// Steady when at two checks in a row the largest change of velocity over one check interval, divided by the largest speed,
/// is below the tolerance, and so is the change that is still to come if it goes on decaying as it did, while the momentum
/// changes by less than that share of the body force, and when no look in between, at each of 24 successive steps and
/// at halves of the interval, differs by more than the tolerance. A run that ends before that says what still changes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Steady {
    /// Largest relative change, now and still to come, no unit.
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
    /// Which fields the files hold: all that the scene has when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub field_names: Option<Vec<FieldName>>,
    /// The part of the box that they hold: all of it when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub field_region: Option<FieldRegion>,
    /// Numbers in them.
    #[serde(default, skip_serializing_if = "FieldPrecision::is_double")]
    pub field_precision: FieldPrecision,
    /// Rows of the time series: 100 when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub series: Option<Cadence>,
    /// What the time series and profiles hold.
    #[serde(default)]
    pub probes: Vec<Probe>,
    /// Files of the grains for ParaView; with the fields when not given. Only with `grains`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grains: Option<Cadence>,
    /// More of it, where `kinetic_energy`, `max_speed` and `mass` are those of the grains. Only with `grains`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub grain_probes: Vec<Probe>,
}

impl Output {
    /// All probes of a scene with fluid, in the order of their columns, and what the words that fluid and grains share
    /// mean in each.
    pub(crate) fn all_probes(&self) -> impl Iterator<Item = (&Probe, Subject)> {
        let fluid = self.probes.iter().map(|probe| (probe, Subject::Fluid));
        fluid.chain(self.grain_probes.iter().map(|probe| (probe, Subject::Grains)))
    }
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
