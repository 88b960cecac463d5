//! What stopped a fluid, for people.

use crate::dem::DemError;
use crate::plan::Plan;
use crate::run::stop::{StopPlace, StopReport};
use crate::setup::Setup;
use crate::solver::run::{Runaway, Stopped};

/// A report about a run of the scene `file`. `failure`: what the discrete element method says. `number`: number at time
/// 0 of a grain.
pub(super) fn report(
    file: &str,
    plan: &Plan,
    stopped: &Stopped,
    failure: Option<&DemError>,
    number: &dyn Fn(u32) -> usize,
) -> StopReport {
    let units = &plan.units;
    StopReport {
        file: file.to_owned(),
        step: stopped.step,
        time_s: units.time_to_si(stopped.step as f64),
        place: StopPlace::Cell {
            cell: stopped.cell,
            position_m: units.cell_centre_m(stopped.cell),
            tau: stopped.tau,
        },
        found: found(plan, stopped, failure, number),
        cause: cause(plan, stopped),
    }
}

/// What was found, with its unit.
fn found(
    plan: &Plan,
    stopped: &Stopped,
    failure: Option<&DemError>,
    number: &dyn Fn(u32) -> usize,
) -> String {
    let name = |grain: u32| match &plan.grains {
        Some(coupled) => coupled.grains.name(number(grain)),
        None => format!("grain {grain}"),
    };
    let too_fast = |speed: f64, limit: f64| {
        let speed_si = plan.units.velocity_to_si(speed);
        format!("{speed_si:.4e} m/s, {speed:.3} cells per step; the limit is {limit}")
    };
    match stopped.what {
        Runaway::NotFinite => "density or velocity is not a finite number".to_owned(),
        Runaway::NoDensity { density } => {
            format!("density of {density:.4} times the reference density, which is not > 0")
        }
        Runaway::Ledger { residual, bound } => {
            format!("mass changed by {residual:.3e} of the whole in one step; rounding allows {bound:.1e}")
        }
        Runaway::Mass { residual, bound } => {
            format!(
                "mass changed by {residual:.3e} of the whole since the start; rounding allows {bound:.1e}"
            )
        }
        Runaway::Grains { grain } => match failure {
            Some(error) => format!("{}: {error}", name(grain)),
            None => format!("{} could not go on", name(grain)),
        },
        Runaway::GrainTooFast { grain, speed, limit } => {
            format!("{} moves at {}", name(grain), too_fast(speed, limit))
        }
        Runaway::TooFast { speed, limit } => too_fast(speed, limit),
    }
}

/// The likeliest cause, by what the plan already knew.
fn cause(plan: &Plan, stopped: &Stopped) -> &'static str {
    let numbers = &plan.numbers;
    if matches!(stopped.what, Runaway::Ledger { .. } | Runaway::Mass { .. }) {
        "a defect of the solver; please report the scene"
    } else if matches!(stopped.what, Runaway::Grains { .. }) {
        "an impact too fast or a load too high for this Young's modulus; stiffer material, more \
         `grains.coupling.sub_steps`, or a higher `grains.numerics.design_speed_m_per_s`"
    } else if matches!(stopped.what, Runaway::GrainTooFast { .. }) {
        "grains fall faster than the velocity scale assumed; give `numerics.reference_velocity_m_per_s` or a smaller \
         time step"
    } else if matches!(stopped.what, Runaway::TooFast { limit, .. } if limit < Setup::SPEED_LIMIT) {
        "five times the speed that forces, walls and fall can give is passed: the solver has made it, by waves at a relaxation \
         time near ½ [K5] or at a wall; a finer `domain.spacing_m`, a larger viscosity, or `half_way` surfaces"
    } else if stopped.tau < 0.55 {
        "the relaxation time is near ½, where waves grow [K5]; a finer `domain.spacing_m` or a larger viscosity"
    } else if stopped.tau.is_finite() && stopped.tau > 3.0 && !plan.numbers.operator.has_odd_rate() {
        "one relaxation rate at a large relaxation time; `central_moment`, or a smaller time step"
    } else if numbers.mach > 0.17 {
        "the Mach number is high; a smaller time step"
    } else if numbers.reference_velocity_m_per_s == 0.0 {
        "the flow was expected to be at rest; give `numerics.reference_velocity_m_per_s`"
    } else {
        "the flow is faster than the velocity scale assumed; give `numerics.reference_velocity_m_per_s` or a \
         smaller time step"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;
    use std::path::Path;

    /// A Newtonian channel with this force, step and operator; τ = ½ + 3 Δt there.
    fn planned(force: f64, numerics: &str) -> Plan {
        let text = format!(
            r#"{{"domain": {{"size_m": [1, 16, 1], "spacing_m": 1,
                 "boundaries": {{"y_min": "no_slip", "y_max": "no_slip"}}}},
               "fluid": {{"density_kg_per_m3": 1, "rheology": {{"newtonian": {{"viscosity_pa_s": 1}}}},
                 "body_force": {{"constant": {{"force_n_per_m3": [{force}, 0, 0]}}}}}},
               "numerics": {numerics}, "stop": {{"end_time_s": 1000}}}}"#
        );
        let scene = scene::flow_from_json(&text, "drawn.json", Path::new(".")).expect("a scene");
        Plan::with_memory(&scene, None).unwrap_or_else(|error| panic!("{error}"))
    }

    #[test]
    fn the_cause_is_the_first_that_fits() {
        let slow = planned(1e-3, r#"{"time_step_s": 0.1}"#);
        let too_fast = |limit: f64| Runaway::TooFast { speed: 0.5, limit };
        let says = |plan: &Plan, what: Runaway, tau: f64, part: &str| {
            let stopped = Stopped { step: 1, cell: [0; 3], what, tau };
            let found = cause(plan, &stopped);
            assert!(found.contains(part), "{what:?} at {tau}: {found}");
        };
        let most = Setup::SPEED_LIMIT;
        says(&slow, Runaway::Ledger { residual: 1.0, bound: 0.0 }, 0.51, "defect of the solver");
        says(&slow, Runaway::Mass { residual: 1.0, bound: 0.0 }, 0.51, "defect of the solver");
        says(&slow, Runaway::Grains { grain: 0 }, 0.51, "Young's modulus");
        says(&slow, Runaway::GrainTooFast { grain: 0, speed: 0.5, limit: most }, 0.51, "grains fall faster");
        says(&slow, too_fast(0.5 * most), 0.51, "five times the speed");
        says(&slow, too_fast(most), 0.54, "near ½");
        says(&slow, Runaway::NotFinite, 0.56, "faster than the velocity scale");
        says(&slow, too_fast(most), 0.56, "faster than the velocity scale");
        says(&slow, too_fast(most), 4.0, "faster than the velocity scale");
        says(&slow, too_fast(most), f64::INFINITY, "faster than the velocity scale");
        let one_rate = planned(1e-3, r#"{"time_step_s": 0.1, "collision": {"operator": "bgk"}}"#);
        says(&one_rate, too_fast(most), 4.0, "one relaxation rate");
        says(&one_rate, too_fast(most), f64::INFINITY, "faster than the velocity scale");
        // 32 f/μ m/s, of which a tenth of a cell per step is 0.18 of the speed of sound.
        let fast = planned(0.034, r#"{"time_step_s": 0.1}"#);
        assert!(fast.numbers.mach > 0.17, "{}", fast.numbers.mach);
        says(&fast, too_fast(most), 0.8, "Mach number is high");
        let resting = planned(0.0, r#"{"time_step_s": 0.1}"#);
        says(&resting, too_fast(most), 0.8, "expected to be at rest");
    }
}
