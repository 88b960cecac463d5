//! Which runs are made.

use std::sync::Mutex;

use super::trial::{Outcome, Trial};
use crate::claim::VerifyError;
use lahar::plan::work::{Case, Operator, Point, Scheme, Walls};
use lahar::solver::run::Backend;

/// Cell updates that a run may use: short, full.
pub(super) const BUDGET: [f64; 2] = [4e6, 6e7];

/// A run of the table: its point, and why there is none.
pub type Made = (Point, Option<String>);

/// The schemes that are compared in a case.
pub fn schemes(case: Case) -> Vec<Scheme> {
    let both = [Walls::Independent, Walls::HalfWay];
    let of = |operators: &[Operator]| -> Vec<Scheme> {
        let pair = |&operator: &Operator| both.map(|walls| Scheme { operator, walls });
        operators.iter().flat_map(pair).collect()
    };
    match case {
        Case::Vortex => [Operator::CentralMoment, Operator::Trt, Operator::Bgk]
            .map(|operator| Scheme { operator, walls: Walls::None })
            .to_vec(),
        Case::ChannelNewtonian | Case::FilmNewtonian | Case::DamBreak => {
            of(&[Operator::CentralMoment, Operator::Trt, Operator::Bgk])
        }
        _ => {
            let mut all = of(&[Operator::CentralMoment, Operator::Trt]);
            all.push(Scheme { operator: Operator::LaggedClamp, walls: Walls::HalfWay });
            all
        }
    }
}

/// N.
fn sizes(case: Case, full: bool) -> &'static [f64] {
    match (case, full) {
        (Case::ChannelNewtonian, false) => &[8.0, 16.0],
        (Case::ChannelBingham | Case::ChannelHerschelBulkley, false) => &[8.0, 16.0, 32.0, 64.0, 128.0],
        (Case::ChannelNewtonian | Case::ChannelBingham | Case::ChannelHerschelBulkley, true) => {
            &[8.0, 12.0, 16.0, 24.0, 32.0, 48.0, 64.0, 96.0, 128.0, 192.0]
        }
        (Case::Vortex, false) => &[8.0, 16.0, 24.0, 32.0, 48.0, 64.0],
        (Case::Vortex, true) => &[8.0, 16.0, 24.0, 32.0, 48.0, 64.0, 96.0, 128.0, 192.0],
        (Case::FilmNewtonian | Case::FilmBingham | Case::FilmHerschelBulkley, false) => {
            &[4.0, 8.0, 16.0, 32.0]
        }
        (Case::FilmNewtonian | Case::FilmBingham | Case::FilmHerschelBulkley, true) => {
            &[3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0, 48.0]
        }
        (Case::Slump, false) => &[4.0, 6.0, 8.0],
        (Case::Slump, true) => &[4.0, 5.0, 6.0, 8.0, 10.0, 12.0],
        (Case::DamBreak, false) => &[4.0, 6.0],
        (Case::DamBreak, true) => &[4.0, 6.0, 9.0, 12.0, 18.0],
    }
}

/// Δt/Δx² over the standard one. The clamp of the papers' scheme is at a fixed viscosity: large steps
/// give large τ there, and an error that grows with the square of the step.
fn steps(case: Case, operator: Operator) -> &'static [f64] {
    match (case, operator) {
        (Case::Slump | Case::DamBreak, _) => &[1.0, 2.0],
        (_, Operator::LaggedClamp) => &[0.05, 0.2, 1.0],
        (Case::Vortex, _) => &[0.5, 1.0, 2.0],
        (Case::FilmNewtonian | Case::FilmBingham | Case::FilmHerschelBulkley, _) => &[0.5, 1.0, 2.0],
        _ => &[0.25, 1.0, 4.0],
    }
}

/// All runs of a case.
pub fn trials(case: Case, full: bool) -> Vec<Trial> {
    let mut all = Vec::new();
    for scheme in schemes(case) {
        for &step in steps(case, scheme.operator) {
            all.extend(sizes(case, full).iter().map(|&n| Trial { case, scheme, n, step }));
        }
    }
    all
}

/// Makes all runs, once per process, backend and size: the exhibits of errors and of times both need them.
pub fn points(backend: &dyn Backend, full: bool) -> Vec<Made> {
    static SEEN: Mutex<Vec<(&'static str, bool, Vec<Made>)>> = Mutex::new(Vec::new());
    let mut seen = SEEN.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    if let Some((.., made)) = seen.iter().find(|(name, size, _)| (*name, *size) == (backend.name(), full)) {
        return made.clone();
    }
    let made: Vec<Made> = Case::ALL.iter().flat_map(|&case| case_points(backend, case, full)).collect();
    seen.push((backend.name(), full, made.clone()));
    made
}

/// Updates grow at least with this power of N.
fn growth(case: Case) -> f64 {
    match case {
        // Their square of cells, and as many steps.
        Case::Vortex | Case::Slump => 4.0,
        // Steps do not depend on N.
        Case::DamBreak => 2.0,
        _ => 3.0,
    }
}

fn case_points(backend: &dyn Backend, case: Case, full: bool) -> Vec<Made> {
    let budget = BUDGET[usize::from(full)];
    let mut all: Vec<Made> = Vec::new();
    for trial in trials(case, full) {
        let nothing = trial.point(Outcome { error: f64::NAN, steps: 0, updates: 0.0 });
        let before = all.last().filter(|(p, _)| (p.scheme, p.step) == (trial.scheme, trial.step));
        let expected = match before {
            // Finer runs of the same scheme and step take longer still.
            Some((_, Some(why))) if *why == too_long(budget) => continue,
            Some((p, None)) => p.updates * libm::pow(trial.n / p.n, growth(case)),
            _ => 0.0,
        };
        // A run is not begun that would not end within the budget.
        if expected > 1.2 * budget {
            all.push((nothing, Some(too_long(budget))));
            continue;
        }
        all.push(match trial.run(backend, budget) {
            Ok(outcome) => (trial.point(outcome), None),
            Err(VerifyError::NotSteady { .. }) => (nothing, Some(too_long(budget))),
            Err(error) => (nothing, Some(error.to_string())),
        });
    }
    all
}

fn too_long(budget: f64) -> String {
    format!("more than {budget:.0e} updates")
}
