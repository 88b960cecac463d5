//! The choice of Δt.

use serde::Serialize;

use super::facts::Facts;
use super::scale::Scales;
use super::surface::Pool;
use crate::scene::{BodyForce, Motion, Scene};
use crate::units::Units;

/// Speed in cells per step aimed at when the scene leaves Δt to `plan` (Ma = 0.087).
const SPEED: f64 = 0.05;
/// Speed allowed when τ would otherwise fall below [`TAU_LOW`] (Ma = 0.17).
const SPEED_HIGH: f64 = 0.1;
/// τ of the plastic viscosity aimed at: larger ones cost accuracy in time, ν Δt/Δx² = 1/6 here.
pub(super) const TAU: f64 = 1.0;
/// τ below which stability and wall accuracy cannot both be had \[K5\].
const TAU_LOW: f64 = 0.55;
/// Largest 3 g H Δt²/Δx² \[F7\].
const COMPRESSION: f64 = 0.02;
/// Compression worth a warning: twice what a chosen step has.
pub(super) const COMPRESSION_MAX: f64 = 0.04;
/// Steps per period of an oscillating force, and least number of steps of a run.
const STEPS_PER_PERIOD: f64 = 200.0;

/// What fixed the time step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum StepRule {
    /// `numerics.time_step_s`.
    Given,
    /// `numerics.relaxation_time`.
    RelaxationTime,
    /// `numerics.target_mach`.
    TargetMach,
    /// Chosen: reference velocity 0.05 cells per step.
    Speed,
    /// Chosen: fastest surge of a free surface 0.1 cells per step.
    Surge,
    /// Chosen: up to 0.1 cells per step, to keep τ at 0.55.
    SpeedForTau,
    /// Chosen: plastic τ = 1.
    Tau,
    /// Chosen: compression by the force against walls.
    Compression,
    /// Chosen: resolution of the oscillation or of the run's duration.
    Duration,
    /// Chosen: nearest to the usual choice that stability, Mach number and relaxation time admit.
    Admissible,
}

impl StepRule {
    /// One line for people.
    #[must_use]
    pub(crate) fn sentence(self) -> &'static str {
        match self {
            Self::Given => "given by `numerics.time_step_s`",
            Self::RelaxationTime => "from `numerics.relaxation_time` of the plastic viscosity",
            Self::TargetMach => "from `numerics.target_mach` and the reference velocity",
            Self::Speed => {
                "chosen: reference velocity at 0.05 cells per step (least of that, plastic τ = 1, \
                 3fHΔt²/(ρΔx²) = 0.02, 200 steps)"
            }
            Self::Surge => {
                "chosen: fastest surge at 0.1 cells per step (least of that, plastic τ = 1, \
                 3fHΔt²/(ρΔx²) = 0.02, 200 steps)"
            }
            Self::SpeedForTau => {
                "chosen: reference velocity above 0.05, up to 0.1 cells per step, to bring the plastic τ up to 0.55"
            }
            Self::Tau => {
                "chosen: plastic τ = 1 (least of that, 0.05 cells per step, 3fHΔt²/(ρΔx²) = 0.02, 200 steps)"
            }
            Self::Compression => {
                "chosen: compression by the wall-normal force, 3fHΔt²/(ρΔx²) = 0.02 (least of that, 0.05 cells per step, \
                 plastic τ = 1, 200 steps)"
            }
            Self::Duration => {
                "chosen: 200 steps per oscillation or run (least of that, 0.05 cells per step, plastic τ = 1, \
                 3fHΔt²/(ρΔx²) = 0.02)"
            }
            Self::Admissible => {
                "chosen: the step nearest to the usual one (0.05 cells per step, plastic τ = 1, 3fHΔt²/(ρΔx²) = 0.02, \
                 200 steps) that is stable and has a tabulated τ"
            }
        }
    }

    /// The JSON path to blame.
    #[must_use]
    pub(crate) fn path(self) -> &'static str {
        match self {
            Self::Given => "numerics.time_step_s",
            Self::RelaxationTime => "numerics.relaxation_time",
            Self::TargetMach => "numerics.target_mach",
            Self::Speed
            | Self::Surge
            | Self::SpeedForTau
            | Self::Tau
            | Self::Compression
            | Self::Duration
            | Self::Admissible => "numerics",
        }
    }

    /// Whether the scene left the choice to `plan`.
    #[must_use]
    pub(crate) fn chosen(self) -> bool {
        !matches!(self, Self::Given | Self::RelaxationTime | Self::TargetMach)
    }
}

/// Viscosity without yield stress at the reference shear rate, Pa s; `None` when the law has no
/// such scale.
#[must_use]
pub(crate) fn reference_viscosity(facts: &Facts, scales: &Scales) -> Option<f64> {
    let curve = facts.curve();
    curve.constant_plastic_viscosity().or_else(|| {
        // At rest the yield stress sets the rate: the viscous stress is as large.
        let at_rest = || curve.shear_rate_at(2.0 * curve.plastic_stress());
        let rate = if scales.shear_rate > 0.0 { scales.shear_rate } else { at_rest() };
        (rate > 0.0).then(|| curve.plastic_viscosity(rate))
    })
}

/// Δt where nothing is given: the least of what `tau` of the plastic viscosity, the speed, compression and
/// the duration allow.
pub(super) fn free(
    facts: &Facts,
    scales: &Scales,
    pool: Option<&Pool>,
    tau: f64,
    viscosity: f64,
) -> (f64, StepRule) {
    let scene = facts.scene;
    let dx = scene.domain.spacing_m;
    let rho = scene.fluid.density_kg_per_m3;
    let of_tau = |tau: f64| (tau - 0.5) / 3.0 * rho * dx * dx / viscosity;
    let of_speed = |u: f64| u * dx / scales.velocity;
    let mut best = (of_tau(tau), StepRule::Tau);
    let mut lower = |dt: f64, rule| {
        if dt < best.0 {
            best = (dt, rule);
        }
    };
    if scales.velocity > 0.0 {
        let surge = pool.is_some_and(|pool| !pool.level);
        let (slow, rule) =
            if surge { (of_speed(SPEED_HIGH), StepRule::Surge) } else { (of_speed(SPEED), StepRule::Speed) };
        let (fast, low) = (of_speed(SPEED_HIGH), of_tau(TAU_LOW));
        if low <= slow || surge {
            lower(slow, rule);
        } else {
            lower(if low < fast { low } else { fast }, StepRule::SpeedForTau);
        }
    }
    lower(compression_step(facts, pool), StepRule::Compression);
    lower(duration(scene) / STEPS_PER_PERIOD, StepRule::Duration);
    best
}

/// Δt with another aim for τ of the plastic viscosity, whatever the scene gives; `None` when the law has no
/// viscosity of its own.
#[must_use]
pub(crate) fn with_tau(facts: &Facts, scales: &Scales, pool: Option<&Pool>, tau: f64) -> Option<f64> {
    let viscosity = reference_viscosity(facts, scales)?;
    Some(free(facts, scales, pool, tau, viscosity).0)
}

/// \[F7\]: 3 f H Δt²/(ρ Δx²) along the walled axis where it is largest, and the Δt with which it is 2 %.
pub(super) fn compression(facts: &Facts, pool: Option<&Pool>, dt: f64) -> [f64; 2] {
    let step = compression_step(facts, pool);
    [COMPRESSION * (dt / step) * (dt / step), step]
}

/// \[F7\]: the largest Δt with 3 f H Δt²/(ρ Δx²) ≤ 0.02 along every walled axis; H is the
/// edge of the box, or the longest stretch of fluid below a free surface.
fn compression_step(facts: &Facts, pool: Option<&Pool>) -> f64 {
    let scene = facts.scene;
    let heights = pool.map_or(scene.domain.size_m, |pool| pool.runs);
    let dx = scene.domain.spacing_m;
    let mut least = f64::INFINITY;
    for force in facts.forces.driving_extremes {
        for (axis, closed) in facts.closed.into_iter().enumerate() {
            let weight = 3.0 * force[axis].abs() * heights[axis];
            if closed && weight > 0.0 {
                let dt = dx * (COMPRESSION * scene.fluid.density_kg_per_m3 / weight).sqrt();
                least = if dt < least { dt } else { least };
            }
        }
    }
    least
}

/// The shortest duration that must be resolved, s.
fn duration(scene: &Scene) -> f64 {
    let end = scene.stop.end_time_s;
    match scene.fluid.body_force {
        Some(BodyForce::Oscillating { frequency_hz, .. }) if frequency_hz * end > 1.0 => {
            least_period(scene, 1.0 / frequency_hz)
        }
        _ => least_period(scene, end),
    }
}

/// The shortest period of a wall or solid, at most `longest`, s.
fn least_period(scene: &Scene, longest: f64) -> f64 {
    let walls = scene.domain.motion.named().map(|(.., motion)| motion);
    walls.chain(scene.solids.iter().filter_map(|solid| solid.motion.as_ref())).fold(
        longest,
        |least, motion| match motion {
            Motion::Oscillating { frequency_hz, .. } if frequency_hz * least > 1.0 => 1.0 / frequency_hz,
            Motion::Oscillating { .. } | Motion::Table { .. } => least,
        },
    )
}

/// Units of a scene at a time step.
#[must_use]
pub(crate) fn units(scene: &Scene, dt: f64) -> Units {
    Units::new(scene.domain.spacing_m, dt, scene.fluid.density_kg_per_m3)
}
