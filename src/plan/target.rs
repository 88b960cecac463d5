//! `plan --target-error`: what the study `work-precision` says about a scene.

use std::str::FromStr;

use serde::Serialize;

use super::cells::{self, Cells};
use super::expected::Interval;
use super::facts::Facts;
use super::nearest_flow::{Nearest, case_of, scheme_of};
use super::scale;
use super::swept::{self, Swept};
use super::time_step;
use super::{Numbers, Plan};
use crate::plan::work::{Advice, Choice, Operator, Point, Walls, Work, predicted, recommend};
use crate::scene::{Collision, Operator as SceneOperator, Scene, WallChoice, YieldChoice};

/// A relative error to aim at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target(f64);

/// What is wrong with a target error.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TargetError {
    /// Not a number.
    #[error(
        "`{found}` is not a number\n  allowed: a share or a percentage\n  way out: for example `1%` or `0.01`"
    )]
    NotANumber {
        /// As given.
        found: String,
    },
    /// A number that is no error to aim at.
    #[error(
        "found {found}\n  allowed: 1e-6 to 0.5 (0.0001% to 50%); below that rounding and compressibility decide, above it \
         nothing is computed\n  way out: for example `1%` or `0.01`"
    )]
    OutOfRange {
        /// As given.
        found: String,
    },
}

impl FromStr for Target {
    type Err = TargetError;

    fn from_str(text: &str) -> Result<Self, TargetError> {
        let trimmed = text.trim();
        let (digits, unit) =
            trimmed.strip_suffix('%').map_or((trimmed, 1.0), |digits| (digits.trim(), 100.0));
        let found = || text.to_owned();
        let number: f64 = digits.parse().map_err(|_| TargetError::NotANumber { found: found() })?;
        let share = number / unit;
        // A NaN is in no range.
        if (1e-6..=0.5).contains(&share) {
            Ok(Self(share))
        } else {
            Err(TargetError::OutOfRange { found: found() })
        }
    }
}

impl Target {
    /// As a share of the whole.
    #[must_use]
    pub(crate) const fn share(self) -> f64 {
        self.0
    }
}

/// What the table says about a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Quote {
    /// The error aimed at.
    pub target_error: f64,
    /// The answer.
    #[serde(flatten)]
    pub answer: Answer,
}

/// The answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    /// Nothing that was measured covers the scene; why.
    NotCovered(String),
    /// The random scenes of the study `sweep` do, and the table of work and precision does not.
    Swept(Box<Swept>),
    /// It does.
    Covered(Box<Covered>),
}

/// A scene and its nearest flow of the table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Covered {
    /// The nearest flow.
    pub nearest: &'static str,
    /// What its error is.
    pub error_is: &'static str,
    /// What cells are counted along.
    pub cells_are: &'static str,
    /// How the scene differs from it.
    pub differences: Vec<String>,
    /// Those cells in the scene as written.
    pub cells: f64,
    /// Error of the table for the scene as written; `null` where its scheme, its cells or its time step are not in the table.
    pub error_as_written: Option<f64>,
    /// Errors that random scenes like the advice had; empty where none were like it.
    pub expected: Vec<Interval>,
    /// Whether the target is reached in the table and, where there are any, by random scenes like the advice; if not, `advice`
    /// is the most exact run of the table.
    pub reached: bool,
    /// What to do.
    pub advice: Recommended,
}

/// A choice, put into the scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Recommended {
    /// Cells along the length that counts.
    pub cells: f64,
    /// Largest spacing with at least as many cells as the run of the table that divides the edges, m.
    pub spacing_m: f64,
    /// `domain.size_m`: axes of one cell stay one cell thick, m.
    pub size_m: [f64; 3],
    /// `numerics.collision.operator`.
    pub operator: &'static str,
    /// `numerics.wall_rule`; `null` without walls.
    pub wall_rule: Option<&'static str>,
    /// τ of the plastic viscosity in the table.
    pub relaxation_time: f64,
    /// The time step of its plan, s: what that, the speed, compression and the duration leave.
    pub time_step_s: Option<f64>,
    /// Error of the run in the table.
    pub error: f64,
    /// Cell updates of this scene.
    pub cell_updates: Option<f64>,
    /// Backend that is fastest at it.
    pub backend: Option<String>,
    /// Nanoseconds per update with it.
    pub nanoseconds_per_update: Option<f64>,
    /// Expected hours on one thread.
    pub hours: Option<f64>,
    /// When the speed was measured.
    pub measured: Option<String>,
    /// On which machine.
    pub machine: Option<String>,
}

/// What the table this build carries says about a scene and its plan.
///
/// # Errors
/// The table was not readable when lahar was built.
pub fn quote(scene: &Scene, plan: &Plan, target: Target) -> Result<Quote, serde_json::Error> {
    Ok(quote_from(&Work::built_in()?, scene, plan, target))
}

/// What another table says about a scene and its plan.
#[must_use]
pub(crate) fn quote_from(work: &Work, scene: &Scene, plan: &Plan, target: Target) -> Quote {
    let facts = Facts::of(scene);
    let cells = cells::fill(&facts);
    let answer = match case_of(&facts, &plan.numbers, &cells) {
        Err(why) => measured(&facts, plan, target, why),
        Ok(Nearest { case, .. }) if target.share() < case.reference_error() => Answer::NotCovered(format!(
            "the nearest flow, {}, is compared with lubrication theory, which is itself off by up to {} %",
            case.name(),
            100.0 * case.reference_error()
        )),
        Ok(nearest) => {
            let case = nearest.case;
            let covered = covered(work, &facts, plan, &cells, target, nearest);
            covered.map_or_else(
                || {
                    let name = case.name();
                    let why =
                        format!("the table has no result for `{name}` that this scene could be run with");
                    measured(&facts, plan, target, why)
                },
                |covered| Answer::Covered(Box::new(covered)),
            )
        }
    };
    Quote { target_error: target.share(), answer }
}

/// What random scenes say where the table does not; `why` it does not.
fn measured(facts: &Facts, plan: &Plan, target: Target, why: String) -> Answer {
    match swept::search(facts, &plan.numbers, target.share()) {
        Some(swept) => Answer::Swept(Box::new(Swept { why, ..swept })),
        None => Answer::NotCovered(why),
    }
}

fn covered(
    work: &Work,
    facts: &Facts,
    plan: &Plan,
    cells: &Cells,
    target: Target,
    Nearest { case, along, differences }: Nearest,
) -> Option<Covered> {
    let numbers = &plan.numbers;
    let error_as_written = scheme_of(facts, &plan.setup, case)
        .and_then(|scheme| predicted(work, case, scheme, numbers.tau_plastic, along))
        .and_then(|(error, outside)| (!outside).then_some(error));
    let (choice, in_table) = match recommend(work, case, target.share()) {
        Advice::Reached(choice) => (choice, true),
        Advice::Missed(choice) => (choice, false),
        Advice::Empty => return None,
    };
    let wanted = if in_table { target.share() } else { f64::INFINITY };
    let within = runnable(facts, numbers, cells, &choice, along, wanted);
    let reached = in_table && within.is_some();
    let (changed, found) =
        within.or_else(|| runnable(facts, numbers, cells, &choice, along, f64::INFINITY))?;
    Some(Covered {
        nearest: case.name(),
        error_is: case.error(),
        cells_are: case.length(),
        differences,
        cells: along,
        error_as_written,
        expected: found.numbers.expected.errors().to_vec(),
        reached,
        advice: recommended(work, numbers, &choice, along, &changed, &found),
    })
}

fn recommended(
    work: &Work,
    numbers: &Numbers,
    choice: &Choice,
    along: f64,
    changed: &Scene,
    plan: &Plan,
) -> Recommended {
    let point = &choice.point;
    let spacing = changed.domain.spacing_m;
    let dt = plan.numbers.time_step_s;
    // Axes of one cell stay one cell thick.
    let axes = numbers.extents.iter().filter(|&&n| n > 1).count();
    let more = (0..axes).fold(1.0, |product, _| product * numbers.spacing_m / spacing);
    let updates = numbers.fluid_cells as f64 * more * (numbers.end_time_s / dt).ceil();
    let nanoseconds = choice.speed.as_ref().map(|(_, nanoseconds)| *nanoseconds);
    let measured = work.measured.as_ref().filter(|_| nanoseconds.is_some());
    Recommended {
        cells: along * numbers.spacing_m / spacing,
        spacing_m: spacing,
        size_m: changed.domain.size_m,
        operator: match point.scheme.operator {
            Operator::CentralMoment => "central_moment",
            Operator::Trt => "trt",
            Operator::Bgk | Operator::LaggedClamp => "bgk",
        },
        wall_rule: match point.scheme.walls {
            Walls::None => None,
            Walls::Independent => Some("viscosity_independent"),
            Walls::HalfWay => Some("half_way"),
        },
        relaxation_time: point.tau,
        time_step_s: Some(dt),
        error: point.error,
        cell_updates: Some(updates),
        backend: choice.speed.as_ref().map(|(backend, _)| backend.clone()),
        nanoseconds_per_update: nanoseconds,
        hours: nanoseconds.map(|ns| 1e-9 * ns * updates / 3600.0),
        measured: measured.map(|m| m.date.clone()),
        machine: measured.map(|m| m.machine.clone()),
    }
}

/// The scene with a choice put into it, and its plan: with at least as many cells as the choice has, of spacings that divide
/// the edges of the box; the first that has a plan, of which random scenes like it were within `wanted`. Where there are too few, one that
/// would be like some of them is taken only if none of the [`FINER`] coarsest has better. `None` where none has a plan.
fn runnable(
    facts: &Facts,
    numbers: &Numbers,
    cells: &Cells,
    choice: &Choice,
    along: f64,
    wanted: f64,
) -> Option<(Scene, Plan)> {
    let point = &choice.point;
    let common = swept::common(numbers);
    // A share of 1e-9 above a whole number is rounding.
    let least = (point.n * common as f64 / along * (1.0 - 1e-9)).ceil().max(1.0) as usize;
    let mut guess = None;
    let measured = (least..least + FINER).find_map(|parts| {
        let mut changed = swept::at(facts.scene, numbers, common, parts)?;
        put(&mut changed, point)?;
        let scales = scale::scales(facts, cells);
        let step = time_step::with_tau(&Facts::of(&changed), &scales, cells.pool.as_ref(), point.tau);
        // As in the table, else as `plan` would choose it.
        [step, None].into_iter().find_map(|step| {
            let mut tried = changed.clone();
            tried.numerics.time_step_s = step;
            let plan = Plan::new(&tried).ok()?;
            let expected = &plan.numbers.expected;
            let reaches = swept::reaches(expected.errors(), wanted);
            if expected.errors().is_empty() && expected.like().is_some() && wanted.is_finite() {
                guess = guess.take().or(Some((tried, plan)));
                return None;
            }
            reaches.then_some((tried, plan))
        })
    });
    measured.or(guess)
}

/// Gives a scene the scheme of a run of the table.
fn put(scene: &mut Scene, point: &Point) -> Option<()> {
    let numerics = &mut scene.numerics;
    (numerics.time_step_s, numerics.relaxation_time, numerics.target_mach) = (None, None, None);
    numerics.collision = Collision::default();
    numerics.collision.operator = Some(match point.scheme.operator {
        Operator::CentralMoment => SceneOperator::CentralMoment,
        Operator::Trt => SceneOperator::Trt,
        Operator::Bgk => SceneOperator::Bgk,
        // The limits of its clamp belong to the flow they were measured in.
        Operator::LaggedClamp => return None,
    });
    numerics.yield_treatment = YieldChoice::Exact;
    match point.scheme.walls {
        Walls::None => {}
        Walls::Independent => numerics.wall_rule = WallChoice::ViscosityIndependent,
        Walls::HalfWay => numerics.wall_rule = WallChoice::HalfWay,
    }
    Some(())
}

/// Spacings tried beyond the one with the cells of the table.
const FINER: usize = 64;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn targets_as_shares_and_percentages() {
        for (text, share) in [("1%", 0.01), ("0.01", 0.01), ("0.1 %", 0.001), (" 1e-4 ", 1e-4), ("50%", 0.5)]
        {
            assert_eq!(text.parse::<Target>().map(Target::share), Ok(share), "{text}");
        }
        for text in ["", "%", "one", "1%%", "1 per cent"] {
            assert!(matches!(text.parse::<Target>(), Err(TargetError::NotANumber { .. })), "{text}");
        }
        for text in ["0", "-1%", "1", "51%", "NaN", "inf", "1e-7"] {
            assert!(matches!(text.parse::<Target>(), Err(TargetError::OutOfRange { .. })), "{text}");
        }
    }
}
