//! Running a planned scene into a folder.

mod columns;
mod error;
mod grains;
mod mesh;
mod pictures;
mod probes;
pub(crate) mod schedule;
mod writer;

use std::path::PathBuf;
use std::time::Instant;

pub use error::{RunError, StopReport};

use crate::coupling::Immersed;
use crate::output::progress::Progress;
use crate::plan::Plan;
use crate::scene::Scene;
use crate::setup::{Precision, Setup};
use crate::solver::plain::Plain;
use crate::solver::run::{Backend, Fields, Run, StartError};
use crate::solver::steady::residual;
use grains::GrainPart;
use schedule::Schedule;
use writer::{Writer, summary};

/// How to run.
pub struct Options<'a> {
    /// Output folder; created when missing.
    pub out: PathBuf,
    /// The solver.
    pub backend: &'a dyn Backend,
    /// Worker threads, at least 1; results do not depend on it.
    pub threads: usize,
    /// End time instead of the scene's, s.
    pub until_s: Option<f64>,
    /// Print nothing.
    pub quiet: bool,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finished {
    /// Steps taken.
    pub steps: u64,
    /// Simulated time, s.
    pub time_s: f64,
    /// Residual of the last steadiness check; `None` if there was none.
    pub residual: Option<f64>,
    /// Ended because it was steady.
    pub steady: bool,
    /// Ended because the fluid had come to rest.
    pub arrested: bool,
    /// Wall-clock time of the stepping, s.
    pub wall_seconds: f64,
    /// Million cell updates per second.
    pub million_updates_per_second: f64,
}

/// Cell updates between two movements of the progress bar.
const UPDATES_PER_MOVE: u64 = 2_000_000;

/// Runs a scene and writes its outputs.
///
/// # Errors
/// The backend refuses the set-up, a guard stops the run (what was written before stays), or a
/// file cannot be written.
pub fn run(scene: &Scene, plan: &Plan, options: &Options) -> Result<Finished, RunError> {
    let mut setup = plan.setup.clone();
    setup.threads = options.threads.max(1);
    let steps = options.until_s.map_or(plan.steps, |until| schedule::steps_until(until, &plan.units));
    let mut writer = Writer::new(scene, plan, &options.out)?;
    let (mut run, backend) = start(options.backend, &setup).map_err(RunError::Start)?;
    let progress = Progress::new(&plan.numbers.title, steps, options.quiet);
    if backend != options.backend.name() {
        progress.note(&format!("grains in a fluid are run by the {backend} backend"));
    }
    let mut driver = Driver {
        scene,
        plan,
        options,
        schedule: Schedule::new(scene, &plan.units, steps),
        progress: &progress,
        mass_at_start: run.totals().mass_excess,
        stepping: 0.0,
        updates: 0.0,
        last_check: None,
        residual: None,
        at_rest_since: None,
        backend,
    };
    let result = driver.drive(run.as_mut(), &mut writer);
    progress.finish();
    result
}

/// Steps between two looks for grains that have left; what is beyond a face has no fluid around it.
const STEPS_PER_LOOK: u64 = 50;

/// Starts a run, on the plain backend where the one asked for does not have grains; and the name of the one it is.
fn start(backend: &dyn Backend, setup: &Setup) -> Result<(Box<dyn Run>, &'static str), StartError> {
    match backend.start(setup) {
        Ok(run) if setup.grains.is_some() && run.grains().is_none() => {}
        Err(StartError::Unsupported { .. }) if setup.grains.is_some() => {}
        started => return started.map(|run| (run, backend.name())),
    }
    if setup.precision != Precision::Double {
        let feature = "grains in a fluid";
        return Err(StartError::Together { precision: setup.precision.name(), feature });
    }
    Plain.start(setup).map(|run| (run, Plain.name()))
}

struct Driver<'a> {
    /// Name of the backend that runs.
    backend: &'static str,
    scene: &'a Scene,
    plan: &'a Plan,
    options: &'a Options<'a>,
    schedule: Schedule,
    progress: &'a Progress,
    mass_at_start: f64,
    stepping: f64,
    /// Cell updates so far; the number of fluid cells changes with a free surface.
    updates: f64,
    /// Time of the first of the latest unbroken row of checks that found the fluid at rest, s.
    at_rest_since: Option<f64>,
    last_check: Option<Vec<[f64; 3]>>,
    residual: Option<f64>,
}

impl Driver<'_> {
    fn drive(&mut self, run: &mut dyn Run, writer: &mut Writer) -> Result<Finished, RunError> {
        let mut fields = run.fields();
        if let Some(grains) = &mut writer.grains {
            grains.begin(run);
        }
        writer.row(run, &fields)?;
        writer.fields(run, &fields)?;
        writer.grains(run)?;
        let (mut steady, mut arrested) = (false, false);
        while run.step() < self.schedule.end && !steady && !arrested {
            let due = self.schedule.next(run.step());
            self.advance(run, due, writer)?;
            // The old fields go before the new ones come: never two sets at a time.
            drop(std::mem::take(&mut fields));
            fields = run.fields();
            steady = self.schedule.steady.take_if_due(due) && self.is_steady(&fields);
            arrested = self.schedule.arrested.take_if_due(due) && self.is_arrested(run, &fields, writer);
            let last = steady || arrested || due >= self.schedule.end;
            if self.schedule.series.take_if_due(due) || last {
                writer.row(run, &fields)?;
            }
            let files = self.schedule.fields.take_if_due(due) || last;
            if files {
                writer.fields(run, &fields)?;
                self.progress.note(&self.line(run, &fields));
            }
            if self.schedule.grains.take_if_due(due) || last || (files && self.scene.output.grains.is_none())
            {
                writer.grains(run)?;
            }
        }
        writer.finish(run, &fields)?;
        let finished = Finished { steady, arrested, ..self.finished(run) };
        self.summary(run, &fields, writer, &finished, None)?;
        Ok(finished)
    }

    /// Steps up to `due` in pieces, so that the bar moves.
    fn advance(&mut self, run: &mut dyn Run, due: u64, writer: &mut Writer) -> Result<(), RunError> {
        let every_step = writer.every_step();
        let piece = if every_step { 1 } else { (UPDATES_PER_MOVE / run.fluid_cells().max(1)).max(1) };
        let opens = writer.grains.as_ref().is_some_and(GrainPart::has_open_faces);
        while run.step() < due {
            let (from, cells) = (run.step(), run.fluid_cells());
            let to_look = if opens { STEPS_PER_LOOK - from % STEPS_PER_LOOK } else { piece };
            let clock = Instant::now();
            let result = run.advance(piece.min(to_look).min(due - from));
            self.stepping += clock.elapsed().as_secs_f64();
            // The mean of before and after.
            self.updates += 0.5 * (cells + run.fluid_cells()) as f64 * (run.step() - from) as f64;
            self.progress.set(run.step());
            if let Err(stopped) = result {
                let failure = run.grains().and_then(Immersed::failure);
                let number = |grain| writer.grains.as_ref().map_or(grain, |grains| grains.number(grain));
                let report = StopReport::new(self.plan, self.scene, &stopped, failure, &number);
                let finished = self.finished(run);
                writer.finish_series()?;
                let fields = run.fields();
                self.summary(run, &fields, writer, &finished, Some(report.to_string()))?;
                return Err(RunError::Stopped(Box::new(report)));
            }
            if let Some(grains) = &mut writer.grains {
                if every_step {
                    grains.sample(run);
                }
                if opens && run.step().is_multiple_of(STEPS_PER_LOOK) {
                    grains.take_out(run);
                }
            }
        }
        Ok(())
    }

    fn is_steady(&mut self, fields: &Fields) -> bool {
        let tolerance = self.scene.stop.steady.map_or(0.0, |steady| steady.tolerance);
        let now = fields.velocity.clone();
        let before = self.last_check.replace(now);
        self.residual = before.map(|before| residual(&before, &fields.velocity));
        self.residual.is_some_and(|r| r <= tolerance)
    }

    /// Whether every check of the last `for_s` found fluid and grains slower than the limit.
    fn is_arrested(&mut self, run: &dyn Run, fields: &Fields, writer: &Writer) -> bool {
        let Some(rule) = self.scene.stop.arrested else { return false };
        let time = self.plan.units.time_to_si(run.step() as f64);
        let grains = writer.grains.as_ref().map_or(0.0, |grains| grains.max_speed(run));
        let fluid = self.plan.units.velocity_to_si(probes::weighted_speed(fields));
        if fluid.max(grains) >= rule.speed_m_per_s {
            self.at_rest_since = None;
            return false;
        }
        let since = *self.at_rest_since.get_or_insert(time);
        // Checks fall on whole steps: half a step is no difference.
        time - since >= rule.for_s - 0.5 * self.plan.units.dt_s
    }

    fn line(&self, run: &dyn Run, fields: &Fields) -> String {
        let units = &self.plan.units;
        let speed = units.velocity_to_si(probes::max_speed(fields));
        let time = units.time_to_si(run.step() as f64);
        let residual = self.residual.map_or_else(String::new, |r| format!(", residual {r:.2e}"));
        format!(
            "step {} of {}, {time:.6} s, largest speed {speed:.4e} m/s{residual}",
            run.step(),
            self.schedule.end
        )
    }

    fn finished(&self, run: &dyn Run) -> Finished {
        Finished {
            steps: run.step(),
            time_s: self.plan.units.time_to_si(run.step() as f64),
            residual: self.residual,
            steady: false,
            arrested: false,
            wall_seconds: self.stepping,
            million_updates_per_second: if self.stepping > 0.0 {
                1e-6 * self.updates / self.stepping
            } else {
                0.0
            },
        }
    }

    fn summary(
        &self,
        run: &dyn Run,
        fields: &Fields,
        writer: &Writer,
        finished: &Finished,
        stopped: Option<String>,
    ) -> Result<(), RunError> {
        let change = (run.totals().mass_excess - self.mass_at_start) / run.fluid_cells().max(1) as f64;
        let mut summary = summary(self.scene, self.plan, run, fields);
        summary.backend = self.backend.to_owned();
        summary.grains = writer.grains.as_ref().and_then(|grains| grains.summary(run));
        summary.threads = self.options.threads.max(1);
        summary.wall_seconds = finished.wall_seconds;
        summary.million_updates_per_second = finished.million_updates_per_second;
        summary.mass_residual = run.ledger().map_or(change, |ledger| ledger.mass_residual);
        summary.stopped = stopped;
        summary.write(&writer.path("summary.json")).map_err(RunError::Output)
    }
}
