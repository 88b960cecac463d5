//! Checks of numerical choices and of when to stop.

use crate::scene::checker::Checker;
use crate::scene::{
    Arrested, ClampLimits, Collision, KeyRule, Numerics, PrecisionChoice, RestMeasure, SceneError,
    SceneProblem, Stop, YieldChoice,
};

const STEP_KEYS: &[&str] = &["time_step_s", "relaxation_time", "target_mach"];

pub(super) fn check_numerics(at: &Checker, numerics: &Numerics) -> Result<(), SceneError> {
    collision(at, &numerics.collision)?;
    precision(at, numerics)?;
    match &numerics.yield_treatment {
        YieldChoice::Exact => {}
        YieldChoice::ImplicitClamped(limits) => {
            clamp(at, "numerics.yield_treatment.implicit_clamped", limits)?;
        }
        YieldChoice::LaggedClamped(limits) => {
            clamp(at, "numerics.yield_treatment.lagged_clamped", limits)?;
        }
    }
    time_step(at, numerics)
}

/// Single precision is in the fast backend only; what only the plain one has cannot be had with it.
fn precision(at: &Checker, numerics: &Numerics) -> Result<(), SceneError> {
    let double = numerics.precision == PrecisionChoice::Double;
    at.ensure(double || !numerics.stress_source, "numerics.precision", || SceneProblem::OnlyDouble {
        what: "`numerics.stress_source`",
    })
}

fn time_step(at: &Checker, numerics: &Numerics) -> Result<(), SceneError> {
    let given = [numerics.time_step_s, numerics.relaxation_time, numerics.target_mach];
    let found: Vec<&str> = STEP_KEYS.iter().zip(given).filter_map(|(key, v)| v.map(|_| *key)).collect();
    at.ensure(found.len() <= 1, "numerics", || SceneProblem::KeyCount {
        found: found.clone(),
        of: STEP_KEYS,
        rule: KeyRule::AtMostOne,
        because: "each of them fixes the time step, τ = ½ + 3μΔt/(ρΔx²) [L6]",
    })?;
    if let Some(dt) = numerics.time_step_s {
        let way_out = "leave it out: `plan` chooses";
        at.positive("numerics.time_step_s", dt, "s", "time goes forward", way_out)?;
    }
    if let Some(tau) = numerics.relaxation_time {
        at.ensure(tau > 0.5, "numerics.relaxation_time", || SceneProblem::OutOfRange {
            found: tau,
            unit: "",
            low: 0.5,
            high: 50.0,
            because: "the lower end excluded: ν = (τ − ½)/3 must be > 0 [L6]",
            way_out: "0.6 to 1.5",
        })?;
    }
    if let Some(mach) = numerics.target_mach {
        at.ensure(mach > 0.0 && mach <= 0.5, "numerics.target_mach", || SceneProblem::OutOfRange {
            found: mach,
            unit: "",
            low: 0.0,
            high: 0.5,
            because: "the lower end excluded: the equilibrium is of second order in Ma [L3]",
            way_out: "0.05 to 0.1",
        })?;
    }
    if let Some(velocity) = numerics.reference_velocity_m_per_s {
        let way_out = "leave it out: `plan` estimates it";
        at.positive("numerics.reference_velocity_m_per_s", velocity, "m/s", "it is a speed", way_out)?;
    }
    Ok(())
}

fn collision(at: &Checker, collision: &Collision) -> Result<(), SceneError> {
    let path = "numerics.collision";
    let one_rate = collision.operator.is_some_and(|operator| !operator.has_odd_rate());
    let given =
        [("magic", collision.magic), ("floor", collision.floor), ("lowered_below", collision.lowered_below)];
    for (key, value) in given {
        let Some(value) = value else { continue };
        let path = format!("{path}.{key}");
        // 0 switches it off, as these operators do.
        at.ensure(!one_rate || value == 0.0, &path, || SceneProblem::UnusedKey {
            key,
            because: "only `trt` and `central_moment` have an odd relaxation rate of their own [K2]",
        })?;
        if one_rate {
            continue;
        }
        if key == "magic" {
            at.positive(&path, value, "", "Λ = (τ⁺ − ½)(τ⁻ − ½) [K2]", "0.1875: walls exactly half-way")?;
        } else {
            at.not_negative(&path, value, "", "it bounds a relaxation time minus ½", "0.05")?;
        }
    }
    Ok(())
}

fn clamp(at: &Checker, path: &str, limits: &ClampLimits) -> Result<(), SceneError> {
    let taus = (limits.tau_min, limits.tau_max);
    let viscosities = (limits.viscosity_min_pa_s, limits.viscosity_max_pa_s);
    match (taus, viscosities) {
        ((Some(low), Some(high)), (None, None)) => {
            at.ensure(low > 0.5, &format!("{path}.tau_min"), || SceneProblem::OutOfRange {
                found: low,
                unit: "",
                low: 0.5,
                high,
                because: "the lower end excluded: ν = (τ − ½)/3 must be > 0 [L6]",
                way_out: "0.501",
            })?;
            at.ensure(low < high, path, || SceneProblem::LimitsSwapped { low, high, unit: "" })
        }
        ((None, None), (Some(low), Some(high))) => {
            let key = format!("{path}.viscosity_min_pa_s");
            at.positive(
                &key,
                low,
                "Pa s",
                "τ − ½ = 3ν must be > 0 [L6]",
                "a tenth of the plastic viscosity",
            )?;
            at.ensure(low < high, path, || SceneProblem::LimitsSwapped { low, high, unit: "Pa s" })
        }
        _ => {
            let of: &[&str] = &["tau_min", "tau_max", "viscosity_min_pa_s", "viscosity_max_pa_s"];
            let given =
                [limits.tau_min, limits.tau_max, limits.viscosity_min_pa_s, limits.viscosity_max_pa_s];
            let found = of.iter().zip(given).filter_map(|(key, v)| v.map(|_| *key)).collect();
            let because = "a clamp needs both its limits, in one kind of unit [Y4]";
            at.fail(path, SceneProblem::KeyCount { found, of, rule: KeyRule::OnePair, because })
        }
    }
}

pub(super) fn check_stop(at: &Checker, stop: &Stop) -> Result<(), SceneError> {
    at.positive("stop.end_time_s", stop.end_time_s, "s", "else there is nothing to compute", "a time > 0")?;
    if let Some(steady) = stop.steady {
        let path = "stop.steady.tolerance";
        let tolerance = steady.tolerance;
        at.ensure(tolerance > 0.0 && tolerance < 1.0, path, || SceneProblem::OutOfRange {
            found: tolerance,
            unit: "",
            low: 0.0,
            high: 1.0,
            because: "both ends excluded: it is a relative change",
            way_out: "1e-8",
        })?;
        let path = "stop.steady.check_every_s";
        let every = steady.check_every_s;
        at.positive(path, every, "s", "it is an interval", "a hundredth of `stop.end_time_s`")?;
        let end = stop.end_time_s;
        at.ensure(every <= end, path, || SceneProblem::BeyondEnd { found: every, end })?;
    }
    match stop.arrested {
        Some(arrested) => check_arrested(at, &arrested, stop.end_time_s),
        None => Ok(()),
    }
}

/// The rule that ends a run at rest.
pub(in crate::scene) fn check_arrested(
    at: &Checker,
    arrested: &Arrested,
    end: f64,
) -> Result<(), SceneError> {
    let path = |key: &str| format!("stop.arrested.{key}");
    let way_out = "a thousandth of the speed of the flow";
    at.positive(&path("speed_m_per_s"), arrested.speed_m_per_s, "m/s", "it is a speed", way_out)?;
    for (key, found) in [("for_s", arrested.for_s), ("check_every_s", arrested.check_every_s)] {
        at.positive(&path(key), found, "s", "it is an interval", "a hundredth of `stop.end_time_s`")?;
        at.ensure(found <= end, &path(key), || SceneProblem::BeyondEnd { found, end })?;
    }
    match arrested.measure {
        RestMeasure::MassPercentile { share } => {
            slow_share(at, &path("measure.mass_percentile.share"), share)
        }
        RestMeasure::Rms | RestMeasure::Largest => Ok(()),
    }
}

/// Share of the mass that has to be slow.
fn slow_share(at: &Checker, path: &str, found: f64) -> Result<(), SceneError> {
    let (low, high) = (0.5, 1.0);
    at.ensure(found >= low && found < high, path, || SceneProblem::OutOfRange {
        found,
        unit: "",
        low,
        high,
        because: "1 excluded: that is `largest`, which one cell of spray keeps up; with half of the mass moving nothing is \
                  at rest",
        way_out: "leave it out for 0.99",
    })
}
