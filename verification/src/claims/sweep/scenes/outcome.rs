//! What became of a random scene, and whether its plan said so.

use std::path::Path;

use rayon::prelude::*;
use serde_json::{Value, json};

use super::draw::{Drawn, Exact};
use super::fluid::{self, Ended};
use super::grains;
use crate::claim::VerifyError;
use lahar::plan::Plan;
use lahar::plan::expected::{Expectation, Row, Scenes};
use lahar::plan::grains::GrainPlan;
use lahar::scene;
use lahar::solver::run::Backend;

/// Scenes below this number are small: the gate runs them.
pub const SMALL: u64 = 1000;
/// Cell updates of a small scene.
const UPDATES: f64 = 3e5;
/// Cell updates of the others.
const MANY_UPDATES: f64 = 6e6;
/// Scenes that are drawn until one is cheap enough.
const ATTEMPTS: u64 = 64;
/// Error over the end of its interval beyond which there is no excuse.
pub const FAR: f64 = 3.0;

/// What became of a scene.
pub enum End {
    /// The plan refused it: the first line of why.
    Refused(String),
    /// It ran.
    Ran {
        /// What the plan expected.
        expected: Expectation,
        /// Warnings of the plan.
        warnings: Vec<String>,
        /// Errors; infinite for a run that was stopped.
        errors: [f64; 2],
        /// How it ended where there are none.
        failed: Option<String>,
    },
}

/// A scene and its end.
pub struct Outcome {
    /// Number it was drawn from.
    pub number: u64,
    /// The scene.
    pub drawn: Drawn,
    /// What became of it.
    pub end: End,
}

/// Plan of a drawn scene.
enum Planned {
    Flow(Box<Plan>),
    Grains(Box<GrainPlan>),
}

fn planned(drawn: &Drawn, scene: &Value) -> Result<Planned, String> {
    let (text, folder) = (scene.to_string(), Path::new("."));
    let first = |e: String| e.lines().next().unwrap_or_default().to_owned();
    if let Exact::Grains(_) = drawn.exact {
        let scene = scene::dry_from_json(&text, "drawn", folder).map_err(|e| first(e.to_string()))?;
        let plan = GrainPlan::with_memory(&scene, None).map_err(|e| first(e.to_string()))?;
        return Ok(Planned::Grains(Box::new(plan)));
    }
    let scene = scene::flow_from_json(&text, "drawn", folder).map_err(|e| first(e.to_string()))?;
    let plan = Plan::with_memory(&scene, None).map_err(|e| first(e.to_string()))?;
    Ok(Planned::Flow(Box::new(plan)))
}

/// The plan of a scene with the time step that was drawn, which the scene then has.
fn with_step(drawn: &mut Drawn) -> Result<Planned, String> {
    let chosen = planned(drawn, &drawn.scene)?;
    let (Planned::Flow(plan), Some(factor)) = (&chosen, drawn.step) else { return Ok(chosen) };
    drawn.scene["numerics"]["time_step_s"] = json!(plan.units.dt_s * factor);
    planned(drawn, &drawn.scene)
}

/// Cell updates; 0 for grains, which are always cheap.
fn updates(planned: &Planned, exact: &Exact) -> f64 {
    match planned {
        Planned::Flow(plan) => fluid::steps(plan, exact) * plan.numbers.fluid_cells as f64,
        Planned::Grains(plan) => 0.2 * plan.steps as f64,
    }
}

impl Outcome {
    /// Draws, plans and runs the scene of a number.
    ///
    /// # Errors
    /// An exact solution has no root, or a run cannot be started.
    pub fn of(backend: &dyn Backend, number: u64) -> Result<Self, VerifyError> {
        let most = if number < SMALL { UPDATES } else { MANY_UPDATES };
        for attempt in 0..ATTEMPTS {
            let mut drawn = Drawn::new(number, attempt)?;
            let end = match with_step(&mut drawn) {
                Err(why) => End::Refused(why),
                Ok(plan) if updates(&plan, &drawn.exact) > most => continue,
                Ok(plan) => run(backend, plan, &drawn.exact)?,
            };
            return Ok(Self { number, drawn, end });
        }
        Err(VerifyError::Numerics { what: "a random scene", detail: "none is cheap enough".into() })
    }

    /// Outcomes of numbers, several at a time, in order.
    ///
    /// # Errors
    /// As [`Self::of`].
    pub fn of_all(backend: &dyn Backend, numbers: &[u64]) -> Result<Vec<Self>, VerifyError> {
        numbers.par_iter().with_max_len(1).map(|&k| Self::of(backend, k)).collect()
    }

    /// As a row of the table; `None` for what was refused.
    pub fn row(&self) -> Option<Row> {
        match &self.end {
            End::Refused(_) => None,
            End::Ran { expected, errors, .. } => Some(Row { likeness: expected.like()?, errors: *errors }),
        }
    }

    /// How far it is from what the plan expected.
    pub fn verdict(&self, scenes: &Scenes) -> Verdict {
        let End::Ran { errors, warnings, .. } = &self.end else { return Verdict::Refused };
        let warned = !warnings.is_empty();
        let expected = self.row().map(|row| scenes.expect(row.likeness));
        let Some(Expectation::Measured { errors: intervals, .. }) = expected else {
            return Verdict::Outside;
        };
        if intervals.iter().any(|interval| !interval.is_known()) {
            return Verdict::Unknown;
        }
        let times = intervals.iter().zip(errors).filter(|(_, error)| !error.is_nan());
        let worst = times.map(|(interval, error)| times_of(interval, *error)).fold(0.0, f64::max);
        if worst <= 1.0 { Verdict::Within(worst) } else { Verdict::Beyond { times: worst, warned } }
    }
}

/// The error over the end of its interval; an interval without end holds everything.
fn times_of(interval: &lahar::plan::expected::Interval, error: f64) -> f64 {
    if interval.holds(error) { interval.times(error).min(1.0) } else { interval.times(error) }
}

/// What a plan was worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// The plan refused the scene.
    Refused,
    /// The plan said that nothing like it was measured.
    Outside,
    /// Every error was within its interval; the largest share of one.
    Within(f64),
    /// The plan said that scenes like it were stopped by a guard, and that nothing is known.
    Unknown,
    /// One was not.
    Beyond {
        /// Over the end of its interval.
        times: f64,
        /// Whether the plan warned of something.
        warned: bool,
    },
}

fn run(backend: &dyn Backend, planned: Planned, exact: &Exact) -> Result<End, VerifyError> {
    match (planned, exact) {
        (Planned::Grains(plan), Exact::Grains(exact)) => {
            let (errors, failed) = match grains::errors(&plan, exact) {
                Ok(errors) => (errors, None),
                Err(error) => ([f64::INFINITY; 2], Some(error.to_string())),
            };
            let warnings = plan.numbers.warnings.iter().map(ToString::to_string).collect();
            Ok(End::Ran { expected: plan.numbers.expected.clone(), warnings, errors, failed })
        }
        (Planned::Flow(plan), exact) => {
            let (errors, failed) = match fluid::run(backend, &plan, exact)? {
                Ended::Errors(errors) => (errors, None),
                Ended::Failed(why) => ([f64::INFINITY; 2], Some(why)),
            };
            let warnings = plan.numbers.warnings.iter().map(ToString::to_string).collect();
            Ok(End::Ran { expected: plan.numbers.expected.clone(), warnings, errors, failed })
        }
        (Planned::Grains(_), _) => {
            Err(VerifyError::Numerics { what: "a random scene", detail: "grains without a solution".into() })
        }
    }
}
