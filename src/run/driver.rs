//! The one loop of all runs: step until something is due, look, write, see whether it is over.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use super::checkpoint::{self, Due, Every, Kept, Labels};
use super::error::RunError;
use super::experiment::Experiment;
use super::recorder::Recorder;
use super::rest::{RestOutcome, RestWatch};
use super::schedule::{Cadences, Schedule};
use super::stop::StopReport;
use super::summary::{Ended, Summary};
use crate::output::OutputError;
use crate::output::progress::Progress;
use crate::solver::steady::SteadyOutcome;
use crate::state::{State, StateError, Tape, part, state};

/// What is known of a run before it starts.
pub(super) struct Order {
    /// Name of the scene file.
    pub scene: String,
    /// Hash of the scene's content.
    pub scene_hash: String,
    /// Name of the solver of the fluid.
    pub backend: Option<&'static str>,
    /// Worker threads.
    pub threads: usize,
    /// When things are due and the run is over.
    pub cadences: Cadences,
    /// Those that are due, and the last step.
    pub schedule: Schedule,
    /// What checkpoints of the run say about it.
    pub labels: Labels,
}

/// What a run tells people, and what they tell it.
#[derive(Clone, Copy)]
pub(super) struct Outside<'a> {
    pub progress: &'a Progress,
    /// Ends the run when it becomes true.
    pub interrupt: Option<&'a AtomicBool>,
    /// How often checkpoints are due; `None` for never.
    pub checkpoints: Option<Every>,
    /// The checkpoint to go on from.
    pub resumed: Option<&'a Kept>,
}

impl Outside<'_> {
    fn interrupted(&self) -> bool {
        self.interrupt.is_some_and(|asked| asked.load(Ordering::Relaxed))
    }
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finished {
    /// Steps taken.
    pub steps: u64,
    /// Simulated time, s.
    pub time_s: f64,
    /// Why it ended.
    pub ended: Ended,
    /// What looking for steadiness found; `None` where that was not asked for.
    pub steadiness: Option<SteadyOutcome>,
    /// What looking for rest found; `None` where that was not asked for.
    pub rest: Option<RestOutcome>,
    /// Wall-clock time of the stepping, s.
    pub wall_seconds: f64,
    /// Million updates per second, of cells, or of spheres without fluid.
    pub million_updates_per_second: f64,
}

/// Drives a run to its end and writes its outputs.
///
/// # Errors
/// A guard stops the run, or a file cannot be written. Either leaves behind what can be.
pub(super) fn drive(
    experiment: &mut dyn Experiment,
    recorder: &mut Recorder,
    order: Order,
    outside: Outside<'_>,
) -> Result<Finished, RunError> {
    let rest = order.cadences.arrested.map(RestWatch::new);
    let (written, due) = (Written::default(), Due::new(outside.checkpoints));
    let mut driver =
        Driver { experiment, recorder, order, outside, stepping: 0.0, updates: 0.0, rest, written, due };
    let result = driver.drive();
    outside.progress.finish();
    result
}

struct Driver<'a> {
    experiment: &'a mut dyn Experiment,
    recorder: &'a mut Recorder,
    order: Order,
    outside: Outside<'a>,
    /// Wall-clock time of the stepping, s.
    stepping: f64,
    /// Updates so far; the number of fluid cells changes with a free surface.
    updates: f64,
    /// Looks for rest, where the scene asks for it.
    rest: Option<RestWatch>,
    written: Written,
    due: Due,
}

/// The step of what was written last, so that nothing is written twice.
#[derive(Default)]
struct Written {
    row: Option<u64>,
    fields: Option<u64>,
    grains: Option<u64>,
}
state!(Written: row fields grains);

impl Driver<'_> {
    fn drive(&mut self) -> Result<Finished, RunError> {
        if let Some(kept) = self.outside.resumed {
            let path = self.recorder.folder().file(checkpoint::FILE)?;
            let read = kept.read(|tape| self.state(tape));
            read.map_err(|problem| RunError::Checkpoint { path, problem })?;
            self.experiment.look();
            self.recorder.write_series()?;
            self.outside.progress.note(&format!("going on: {}", self.line()));
        }
        self.due.start(self.experiment.step());
        self.summary(&self.finished(Ended::Running), None)?;
        let ended = match self.reach_end() {
            Ok(ended) => ended,
            Err(RunError::Output(error)) => return Err(self.output_failed(error)),
            Err(other) => return Err(other),
        };
        let finished = self.finished(ended);
        self.summary(&finished, None)?;
        self.experiment.finish(self.recorder)?;
        if ended != Ended::Interrupted {
            self.recorder.folder().close()?;
        }
        self.recorder.folder().sync(true)?;
        Ok(finished)
    }

    /// Steps and outputs, those of the end too but for tables and pictures.
    fn reach_end(&mut self) -> Result<Ended, RunError> {
        if self.outside.resumed.is_none() {
            self.row()?;
            self.fields()?;
            self.grains()?;
            self.recorder.folder().sync(false)?;
        }
        loop {
            let due = self.order.schedule.next(self.experiment.step()).min(self.experiment.next_look());
            self.advance(due)?;
            self.experiment.look();
            let arrived = self.experiment.step() >= due || self.experiment.is_empty();
            if arrived {
                let ended = self.ended();
                self.outputs(ended.is_some())?;
                if let Some(ended) = ended {
                    return Ok(ended);
                }
            }
            if self.outside.interrupted() {
                // Before the outputs of an end that the run would not have had.
                if self.outside.checkpoints.is_some() {
                    self.checkpoint();
                }
                self.outputs(true)?;
                return Ok(Ended::Interrupted);
            }
            self.checkpoint_if_due();
        }
    }

    fn checkpoint_if_due(&mut self) {
        if self.due.take(self.experiment.step()) {
            self.checkpoint();
        }
    }

    /// Writes a checkpoint; the one before stays until the new one is complete, and if that cannot be written.
    fn checkpoint(&mut self) {
        let labels = self.order.labels.clone();
        let path = self.recorder.folder().file(checkpoint::FILE);
        let written = path.and_then(|path| checkpoint::write(&path, &labels, |tape| self.state(tape)));
        if let Err(error) = written {
            self.outside.progress.note(&format!("warning: no checkpoint: {error}"));
        }
    }

    /// Everything that the rest of the run depends on.
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let Self { experiment, recorder, order, rest, written, stepping, updates, outside: _, due: _ } = self;
        order.schedule.state(tape)?;
        part(rest, tape)?;
        written.state(tape)?;
        stepping.state(tape)?;
        updates.state(tape)?;
        recorder.state(tape)?;
        experiment.state(tape)
    }

    /// Steps up to `due` in strides, so that the bar moves.
    fn advance(&mut self, due: u64) -> Result<(), RunError> {
        while self.experiment.step() < due && !self.experiment.is_empty() && !self.outside.interrupted() {
            let (from, size) = (self.experiment.step(), self.experiment.size());
            let clock = Instant::now();
            let result = self.experiment.advance(self.experiment.stride().min(due - from));
            self.stepping += clock.elapsed().as_secs_f64();
            // The mean of before and after.
            let taken = (self.experiment.step() - from) as f64;
            self.updates += 0.5 * (size + self.experiment.size()) as f64 * taken;
            self.outside.progress.set(self.experiment.step());
            if let Err(report) = result {
                return Err(self.stopped(report));
            }
            self.experiment.tidy();
            // At the end of the stretch outputs come first.
            if self.experiment.step() < due && !self.experiment.is_empty() {
                self.checkpoint_if_due();
            }
        }
        Ok(())
    }

    /// Writes what there is after a guard stopped the run. What cannot be written is said; the guard's reason is what the run
    /// ends with.
    fn stopped(&mut self, report: Box<StopReport>) -> RunError {
        self.experiment.look();
        let finished = self.finished(Ended::Stopped);
        // The summary first: it is small, and says most.
        let summary = self.summary(&finished, Some(report.to_string()));
        for result in [summary, self.outputs(true), self.experiment.finish(self.recorder)] {
            if let Err(error) = result {
                self.outside.progress.note(&format!("warning: {error}"));
            }
        }
        // The disk has what it could take.
        let _ = self.recorder.folder().sync(true);
        RunError::Stopped(report)
    }

    /// Writes what may still fit after a file could not be written: rows that are missing, and a summary.
    fn output_failed(&mut self, error: OutputError) -> RunError {
        let finished = self.finished(Ended::OutputFailed);
        // Where these cannot be written either, the first error is the one that people are told.
        let _ = self.recorder.write_series();
        let _ = self.summary(&finished, Some(error.to_string()));
        RunError::Output(error)
    }

    /// Whether the run is over, and why.
    fn ended(&mut self) -> Option<Ended> {
        let now = self.experiment.step();
        let steady = self.experiment.is_steady();
        let at_rest = self.order.schedule.arrested.take_if_due(now) && self.is_at_rest();
        if steady {
            Some(Ended::Steady)
        } else if at_rest {
            Some(Ended::AtRest)
        } else if self.experiment.is_empty() {
            Some(Ended::Empty)
        } else {
            (now >= self.order.schedule.end).then_some(Ended::EndTime)
        }
    }

    /// Looks whether everything is at rest.
    fn is_at_rest(&mut self) -> bool {
        let Some(watch) = &mut self.rest else { return false };
        let pace = self.experiment.pace(watch.measure());
        watch.look(self.experiment.time_s(), pace, self.experiment.step_s())
    }

    /// Writes what is due; `last`: everything.
    fn outputs(&mut self, last: bool) -> Result<(), OutputError> {
        let now = self.experiment.step();
        if self.order.schedule.series.take_if_due(now) || last {
            self.row()?;
        }
        let due = self.order.schedule.take_files(now, last);
        if due.files {
            self.fields()?;
            self.outside.progress.note(&self.line());
        }
        if due.grains {
            self.grains()?;
        }
        if due.files || due.grains { self.recorder.folder().sync(false) } else { Ok(()) }
    }

    fn row(&mut self) -> Result<(), OutputError> {
        if self.written.row.replace(self.experiment.step()) == Some(self.experiment.step()) {
            return Ok(());
        }
        let row = self.experiment.row();
        self.recorder.row(self.experiment.time_s(), &row)
    }

    fn fields(&mut self) -> Result<(), OutputError> {
        if self.written.fields.replace(self.experiment.step()) == Some(self.experiment.step()) {
            return Ok(());
        }
        self.experiment.write_fields()
    }

    fn grains(&mut self) -> Result<(), OutputError> {
        if self.written.grains.replace(self.experiment.step()) == Some(self.experiment.step()) {
            return Ok(());
        }
        self.experiment.write_grains()
    }

    fn line(&self) -> String {
        let residual = self.experiment.steadiness().filter(|found| found.residual.is_finite());
        let residual =
            residual.map_or_else(String::new, |found| format!(", residual {:.2e}", found.residual));
        format!(
            "step {} of {}, {:.6} s, {}{residual}",
            self.experiment.step(),
            self.order.schedule.end,
            self.experiment.time_s(),
            self.experiment.line()
        )
    }

    fn finished(&self, ended: Ended) -> Finished {
        let rate = if self.stepping > 0.0 { 1e-6 * self.updates / self.stepping } else { 0.0 };
        Finished {
            steps: self.experiment.step(),
            time_s: self.experiment.time_s(),
            ended,
            steadiness: self.experiment.steadiness(),
            rest: self.rest.as_ref().map(RestWatch::outcome),
            wall_seconds: self.stepping,
            million_updates_per_second: rate,
        }
    }

    fn summary(&self, finished: &Finished, stopped: Option<String>) -> Result<(), OutputError> {
        let summary = Summary {
            scene: self.order.scene.clone(),
            scene_hash: self.order.scene_hash.clone(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            backend: self.order.backend.map(str::to_owned),
            threads: self.order.threads,
            steps: finished.steps,
            time_s: finished.time_s,
            ended: finished.ended,
            wall_seconds: finished.wall_seconds,
            million_updates_per_second: finished.million_updates_per_second,
            parts: self.experiment.parts(),
            not_steady: finished.steadiness.filter(|found| !found.steady).map(|found| found.to_string()),
            rest: finished.rest,
            loads: self.experiment.loads(),
            stopped,
        };
        summary.write(&self.recorder.folder().file("summary.json")?)
    }
}
