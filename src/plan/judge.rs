//! What is allowed of a time step: Mach number, relaxation times, stability.

use super::error::PlanProblem;
use super::facts::Facts;
use super::figures::tau_range;
use super::lower::{collision, yield_treatment};
use super::scale::Scales;
use super::time_step::{reference_viscosity, units};
use super::ways::Ways;
use crate::collision::CollisionChoice;
use crate::scene::{Operator, WallChoice};
use crate::setup::Setup;
use crate::stability::{max_stable_speed, table};

/// Largest Mach number; 0.5 is 0.29 cells per step, where the O(Ma²) errors are a quarter.
const MACH_MAX: f64 = 0.5;
/// Least plastic τ, the first column of the stability table.
pub(super) const TAU_MIN: f64 = 0.5005;
/// Largest plastic τ of the operators whose walls do not depend on it.
const TAU_MAX: f64 = 50.0;
/// Largest plastic τ of one-rate operators with half-way walls.
const TAU_MAX_ONE_RATE: f64 = 3.0;

/// What the scene says, whatever the time step.
#[derive(Clone, Copy)]
pub(super) struct Flow<'a> {
    pub facts: &'a Facts<'a>,
    pub scales: &'a Scales,
    /// Widest gap between walls, cells; infinite without walls.
    pub gap: f64,
    /// Speed of the fastest grain, m/s; 0 without grains.
    pub grains: f64,
}

/// Numbers of a flow at one time step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Judged {
    /// s.
    pub dt: f64,
    /// Expected largest velocity, m/s.
    pub velocity: f64,
    /// The same, cells per step.
    pub speed: f64,
    /// Over the speed of sound.
    pub mach: f64,
    /// τ of the plastic viscosity.
    pub tau_plastic: f64,
    /// Least τ expected.
    pub tau_min: f64,
    /// Largest τ; infinite when cells can be unyielded.
    pub tau_max: f64,
    collision: CollisionChoice,
    tau_limit: (f64, &'static str),
}

impl Judged {
    /// A flow at a time step, s.
    pub(super) fn at(flow: &Flow, dt: f64) -> Self {
        let Flow { facts, scales, gap, .. } = *flow;
        let (scene, units) = (facts.scene, units(facts.scene, dt));
        let plastic = reference_viscosity(facts, scales).unwrap_or(f64::NAN);
        let yielding = yield_treatment(&scene.numerics.yield_treatment, &units);
        let (tau_min, tau_max) = tau_range(facts, &units, scales, &yielding);
        let tau_min = if tau_min.is_finite() { tau_min } else { units.tau_of_viscosity(plastic) };
        let speed = units.velocity_to_lattice(scales.velocity);
        let collision = collision(facts);
        let walls = gap.is_finite() && scene.numerics.wall_rule == WallChoice::HalfWay;
        let one_rate = !Operator::of(&collision).has_odd_rate();
        Self {
            dt,
            velocity: scales.velocity,
            speed,
            mach: speed * 3.0_f64.sqrt(),
            tau_plastic: if plastic.is_nan() { tau_min } else { units.tau_of_viscosity(plastic) },
            tau_min,
            tau_max,
            collision,
            tau_limit: if one_rate && walls {
                (TAU_MAX_ONE_RATE, "half-way walls slip by (16(τ−½)² − 3)/(3N²) of the mean flow [B1]")
            } else {
                (TAU_MAX, "beyond it a step is longer than 16 diffusion times of a cell [L6]")
            },
        }
    }

    /// Largest stable speed at the least τ, cells per step; `None` where there is none by linear theory.
    pub(super) fn stable_speed(&self) -> Option<f64> {
        max_stable_speed(&self.collision, self.tau_min).ok().map(|limit| limit.speed)
    }

    /// What is wrong with the step; `ways` works out what would do once something is.
    pub(super) fn verdict(
        &self,
        stable_speed: impl FnOnce() -> Option<f64>,
        ways: impl FnOnce() -> Ways,
    ) -> Result<(), PlanProblem> {
        let (dt, tau) = (self.dt, self.tau_plastic);
        if !tau.is_finite() {
            return Err(PlanProblem::NotFinite { quantity: "the relaxation time", found: tau });
        }
        if self.mach > MACH_MAX {
            let (mach, speed) = (self.mach, self.velocity);
            return Err(PlanProblem::MachTooHigh { mach, speed, dt, limit: MACH_MAX, ways: ways() });
        }
        if tau < TAU_MIN {
            return Err(PlanProblem::TauTooSmall { tau, dt, limit: TAU_MIN, ways: ways() });
        }
        let operator = Operator::of(&self.collision);
        let (limit, because) = self.tau_limit;
        if tau > limit {
            return Err(PlanProblem::TauTooLarge { tau, dt, limit, operator, because, ways: ways() });
        }
        match stable_speed() {
            Some(limit) if self.speed > limit => {
                let (speed, tau) = (self.speed, self.tau_min);
                Err(PlanProblem::Unstable { speed, limit, tau, operator, ways: ways() })
            }
            _ => Ok(()),
        }
    }
}

impl Flow<'_> {
    /// Whether a step passes all checks of a step, and grains stay below the speed at which a run is stopped.
    ///
    /// `margin` multiplies the speeds: 1 asks for no more than what is checked.
    pub(super) fn allows(&self, dt: f64, margin: f64) -> bool {
        let mut judged = Judged::at(self, dt);
        judged.speed *= margin;
        judged.mach *= margin;
        let grains = margin * self.grains * dt / self.facts.scene.domain.spacing_m;
        let steps = self.facts.scene.stop.end_time_s / dt;
        grains <= Setup::SPEED_LIMIT
            && steps.round() >= 1.0
            && judged.verdict(|| judged.stable_speed(), Ways::default).is_ok()
    }

    /// The interval outside which no step passes, s: the least plastic τ, the largest one, and the Mach number.
    fn interval(&self) -> Option<(f64, f64)> {
        let probe = Judged::at(self, self.facts.scene.stop.end_time_s);
        // τ − ½ and the speed are proportional to Δt.
        let of_tau = |tau: f64| probe.dt * (tau - 0.5) / (probe.tau_plastic - 0.5);
        let low = of_tau(TAU_MIN) * (1.0 + EDGE);
        let mut high = of_tau(probe.tau_limit.0) * (1.0 - EDGE);
        high = high.min(probe.dt);
        if probe.mach > 0.0 {
            high = high.min(probe.dt * MACH_MAX / probe.mach * (1.0 - EDGE));
        }
        (low > 0.0 && low <= high && high.is_finite()).then_some((low, high))
    }

    /// The admissible step nearest to one that is not, s; `None` if none was found.
    ///
    /// The interval of Mach number and plastic τ is searched on a ladder of [`RUNGS`] steps, the nearest first, and the
    /// edge towards `from` is then found by halving. Speeds keep a margin of [`MARGIN`] where that is possible: the
    /// expected speed is an estimate.
    pub(super) fn nearest_step(&self, from: f64) -> Option<f64> {
        let (low, high) = self.interval()?;
        let start = from.clamp(low, high);
        let rungs =
            if table::interpolated(&collision(self.facts), 1.0).is_some() { RUNGS } else { FEW_RUNGS };
        let rung = |k: u32| low * libm::pow(high / low, f64::from(k) / f64::from(rungs));
        let mut ladder: Vec<f64> = std::iter::once(start).chain((0..=rungs).map(rung)).collect();
        ladder.sort_by(|a, b| apart(*a, from).total_cmp(&apart(*b, from)));
        [MARGIN, 1.0].into_iter().find_map(|margin| {
            let found = ladder.iter().copied().find(|&dt| self.allows(dt, margin))?;
            Some(self.towards(found, start, margin))
        })
    }

    /// The last step from `good` towards `aim` that passes.
    fn towards(&self, mut good: f64, mut aim: f64, margin: f64) -> f64 {
        if good == aim {
            return good;
        }
        for _ in 0..HALVINGS {
            let middle = (good * aim).sqrt();
            if self.allows(middle, margin) { good = middle } else { aim = middle }
        }
        good
    }
}

/// Distance of two steps on a logarithmic scale.
fn apart(a: f64, b: f64) -> f64 {
    libm::log(a / b).abs()
}

/// Steps tried between the least and the largest.
const RUNGS: u32 = 24;
/// The same with operators that are not in the stability table: each costs about a second.
const FEW_RUNGS: u32 = 4;
/// Halvings of the stretch between two of them: 2⁻⁶ of a rung.
const HALVINGS: u32 = 6;
/// Speeds of a searched step are kept this much below their limits: the expected speed is an estimate.
const MARGIN: f64 = 1.1;
/// Room for rounding at the ends of the interval.
const EDGE: f64 = 1e-9;
