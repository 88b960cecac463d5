//! How long an update takes.

use std::time::Instant;

use super::points::schemes;
use super::trial::Trial;
use crate::claim::VerifyError;
use lahar::plan::work::{Case, Speed};
use lahar::solver::fast::Fast;
use lahar::solver::plain::Plain;
use lahar::solver::run::{Backend, Run};

/// Rounds of slices; the median of a run's slices counts.
const ROUNDS: usize = 5;
/// Cell updates of a slice: short, full.
const SLICE: [f64; 2] = [5e4, 4e5];

/// The backends that a set-up is timed on.
pub fn backends() -> [&'static dyn Backend; 2] {
    static FAST: Fast = Fast { instructions: None };
    [&Plain, &FAST]
}

/// A run being timed.
struct Timed {
    trial: Trial,
    backend: &'static str,
    run: Box<dyn Run>,
    steps: u64,
    slices: Vec<f64>,
}

/// Speeds of all schemes and backends of a case, in turns: whatever else the machine does hits all of them.
pub fn speeds(case: Case, full: bool) -> Result<Vec<Speed>, VerifyError> {
    let n = match case {
        Case::Slump => 8.0,
        Case::DamBreak | Case::FilmNewtonian | Case::FilmBingham | Case::FilmHerschelBulkley => 12.0,
        _ => 32.0,
    };
    let mut all = Vec::new();
    for scheme in schemes(case) {
        let trial = Trial { case, scheme, n, step: 1.0 };
        let setup = trial.wide()?;
        for backend in backends() {
            let mut run = backend.start(&setup)?;
            let steps = (SLICE[usize::from(full)] / run.fluid_cells() as f64).ceil() as u64;
            // The first steps fill the caches and, after a release, set the fluid in motion.
            if run.advance(steps + 10).is_ok() {
                all.push(Timed { trial, backend: backend.name(), run, steps, slices: Vec::new() });
            }
        }
    }
    for _ in 0..ROUNDS {
        for timed in &mut all {
            let updates = timed.steps as f64 * timed.run.fluid_cells() as f64;
            let start = Instant::now();
            if timed.run.advance(timed.steps).is_ok() {
                timed.slices.push(1e9 * start.elapsed().as_secs_f64() / updates);
            }
        }
    }
    Ok(all.into_iter().filter_map(speed).collect())
}

fn speed(mut timed: Timed) -> Option<Speed> {
    timed.slices.sort_by(f64::total_cmp);
    let nanoseconds = *timed.slices.get(timed.slices.len() / 2)?;
    let Trial { case, scheme, .. } = timed.trial;
    Some(Speed { case, scheme, backend: timed.backend.to_owned(), nanoseconds })
}
