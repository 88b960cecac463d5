//! Running a planned scene without fluid into a folder.

pub(crate) mod leave;
pub(crate) mod pictures;
pub(crate) mod probes;
pub(crate) mod stop;
mod summary;
mod walls;
pub(crate) mod writer;

use std::path::PathBuf;
use std::time::Instant;

pub use stop::GrainStopReport;
pub use summary::{GrainFingerprint, GrainSummary, fingerprint};

use crate::dem::{Dem, DemError, Setup};
use crate::output::progress::Progress;
use crate::plan::grains::GrainPlan;
use crate::run_scene::RunError;
use crate::run_scene::schedule::Ticker;
use crate::scene::Cadence;
use crate::scene::dry::DryScene;
use crate::units::Units;
use probes::Sampler;
use writer::Writer;

/// How to run.
#[derive(Clone, Debug)]
pub struct GrainOptions {
    /// Output folder; created when missing.
    pub out: PathBuf,
    /// Worker threads, at least 1; results do not depend on it.
    pub threads: usize,
    /// End time instead of the scene's, s.
    pub until_s: Option<f64>,
    /// Print nothing.
    pub quiet: bool,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrainsFinished {
    /// Steps taken.
    pub steps: u64,
    /// Simulated time, s.
    pub time_s: f64,
    /// Why it ended.
    pub why: Ending,
    /// Wall-clock time of the stepping, s.
    pub wall_seconds: f64,
    /// Million sphere updates per second.
    pub million_updates_per_second: f64,
}

/// Why a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// At its end time.
    EndTime,
    /// The grains had come to rest.
    AtRest,
    /// All grains had left through open faces.
    Empty,
}

/// Rows of the time series when the scene does not say.
const DEFAULT_ROWS: u32 = 100;
/// Sphere updates between two movements of the progress bar.
const UPDATES_PER_MOVE: u64 = 1_000_000;
/// Steps between two looks for grains that have left; they fly freely meanwhile.
const STEPS_PER_LOOK: u64 = 200;

/// The grains of a run: the method's state and what the scene knows of it.
pub(crate) struct Grains {
    pub dem: Dem,
    /// The set-up of the grains still there.
    pub setup: Setup,
    /// Number at time 0 of each grain still there.
    pub ids: Vec<u32>,
    /// Number, mass (kg) and energy (J) of the grains that have left.
    pub left: (u64, f64, f64),
    /// Energy balance at time 0, J.
    pub start: f64,
}

/// Runs a scene and writes its outputs.
///
/// # Errors
/// A guard stops the run (what was written before stays), or a file cannot be written.
pub fn run(scene: &DryScene, plan: &GrainPlan, options: &GrainOptions) -> Result<GrainsFinished, RunError> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(options.threads.max(1)).build();
    let pool = pool.map_err(|error| RunError::Threads(error.to_string()))?;
    pool.install(|| start(scene, plan, options))
}

fn start(scene: &DryScene, plan: &GrainPlan, options: &GrainOptions) -> Result<GrainsFinished, RunError> {
    let dt = plan.numbers.time_step_s;
    let units = Units::new(1.0, dt, 1.0);
    let end =
        options.until_s.map_or(plan.steps, |until| crate::run_scene::schedule::steps_until(until, &units));
    let mut writer = Writer::new(scene, plan, &options.out)?;
    let dem =
        Dem::new(&plan.setup).map_err(|error| RunError::Grains(Box::new(stop::refused(scene, &error))))?;
    let grains = Grains {
        start: dem.energies().balance(),
        ids: (0..dem.bodies().len() as u32).collect(),
        setup: plan.setup.clone(),
        dem,
        left: (0, 0.0, 0.0),
    };
    let ticker = |cadence: Cadence| Ticker::new(cadence, &units, end);
    let arrested = scene.stop.arrested.map(|rule| Cadence::EverySeconds(rule.check_every_s));
    let progress = Progress::new(&plan.numbers.title, end, options.quiet);
    let mut driver = Driver {
        scene,
        plan,
        options,
        sampler: Sampler::new(scene, plan, &grains.view()),
        grains,
        end,
        series: ticker(scene.output.series.unwrap_or(Cadence::Count(DEFAULT_ROWS))),
        files: scene.output.grains.map_or(Ticker::never(), ticker),
        checks: arrested.map_or(Ticker::never(), ticker),
        progress: &progress,
        at_rest_since: None,
        stepping: 0.0,
        updates: 0.0,
    };
    let result = driver.drive(&mut writer);
    progress.finish();
    result
}

struct Driver<'a> {
    scene: &'a DryScene,
    plan: &'a GrainPlan,
    options: &'a GrainOptions,
    grains: Grains,
    sampler: Sampler,
    end: u64,
    series: Ticker,
    files: Ticker,
    checks: Ticker,
    progress: &'a Progress,
    /// Time of the first of the latest unbroken row of checks that found the grains at rest, s.
    at_rest_since: Option<f64>,
    stepping: f64,
    updates: f64,
}

impl Driver<'_> {
    fn drive(&mut self, writer: &mut Writer) -> Result<GrainsFinished, RunError> {
        writer.row(&mut self.sampler, &self.grains.view())?;
        writer.files(&self.grains.view())?;
        let mut why = None;
        while why.is_none() {
            let now = self.grains.dem.steps();
            let due = self.series.next().min(self.files.next()).min(self.checks.next());
            let due = due.clamp(now + 1, self.end.max(now + 1));
            self.advance(due, writer)?;
            let now = self.grains.dem.steps();
            why = if self.checks.take_if_due(now) && self.is_at_rest() {
                Some(Ending::AtRest)
            } else if self.grains.nothing_left() {
                Some(Ending::Empty)
            } else {
                (now >= self.end).then_some(Ending::EndTime)
            };
            if self.series.take_if_due(now) || why.is_some() {
                writer.row(&mut self.sampler, &self.grains.view())?;
            }
            if self.files.take_if_due(now) || why.is_some() {
                writer.files(&self.grains.view())?;
                self.progress.note(&self.line());
            }
        }
        let finished = self.finished(why.unwrap_or(Ending::EndTime));
        writer.finish(&self.grains.view())?;
        self.summary(writer, &finished, None)?;
        Ok(finished)
    }

    /// Steps up to `due` in pieces: the bar moves, and grains that have left are taken out.
    fn advance(&mut self, due: u64, writer: &Writer) -> Result<(), RunError> {
        let opens = self.plan.open.iter().flatten().any(|open| *open);
        while self.grains.dem.steps() < due && !self.grains.nothing_left() {
            let (from, spheres) = (self.grains.dem.steps(), self.grains.dem.members().len());
            let mut piece = (UPDATES_PER_MOVE / spheres.max(1) as u64).max(1);
            if opens {
                piece = piece.min(STEPS_PER_LOOK - from % STEPS_PER_LOOK);
            }
            let clock = Instant::now();
            let result = self.grains.dem.step(piece.min(due - from));
            self.stepping += clock.elapsed().as_secs_f64();
            self.updates += spheres as f64 * (self.grains.dem.steps() - from) as f64;
            self.progress.set(self.grains.dem.steps());
            if let Err(error) = result {
                return Err(self.stopped(&error, writer)?);
            }
            if opens {
                leave::take_out(&mut self.grains, self.scene, self.plan);
            }
        }
        Ok(())
    }

    /// Writes what there is and says why the run stopped.
    fn stopped(&self, error: &DemError, writer: &Writer) -> Result<RunError, RunError> {
        let report = stop::report(self.scene, self.plan, &self.grains.view(), error);
        writer.finish_series()?;
        self.summary(writer, &self.finished(Ending::EndTime), Some(report.to_string()))?;
        Ok(RunError::Grains(Box::new(report)))
    }

    /// Whether every check of the last `for_s` found the grains slower than the limit.
    fn is_at_rest(&mut self) -> bool {
        let Some(rule) = self.scene.stop.arrested else { return false };
        let time = self.grains.dem.time();
        if self.grains.max_speed() >= rule.speed_m_per_s {
            self.at_rest_since = None;
            return false;
        }
        let since = *self.at_rest_since.get_or_insert(time);
        // Checks fall on whole steps: half a step is no difference.
        time - since >= rule.for_s - 0.5 * self.grains.dem.time_step()
    }

    fn line(&self) -> String {
        let g = &self.grains;
        let left = if g.left.0 > 0 { format!(", {} left", g.left.0) } else { String::new() };
        format!(
            "step {} of {}, {:.6} s, largest speed {:.4e} m/s, {} contacts{left}",
            g.dem.steps(),
            self.end,
            g.dem.time(),
            g.max_speed(),
            g.dem.pair_counts().1
        )
    }

    fn finished(&self, why: Ending) -> GrainsFinished {
        let rate = if self.stepping > 0.0 { 1e-6 * self.updates / self.stepping } else { 0.0 };
        GrainsFinished {
            steps: self.grains.dem.steps(),
            time_s: self.grains.dem.time(),
            why,
            wall_seconds: self.stepping,
            million_updates_per_second: rate,
        }
    }

    fn summary(
        &self,
        writer: &Writer,
        finished: &GrainsFinished,
        stopped: Option<String>,
    ) -> Result<(), RunError> {
        let threads = self.options.threads.max(1);
        let summary = summary::summary(self.scene, &self.grains.view(), finished, threads, stopped);
        summary.write(&writer.path("summary.json")).map_err(RunError::Output)
    }
}

/// Grains to be measured and written, whoever moves them.
#[derive(Clone, Copy)]
pub(crate) struct View<'a> {
    pub dem: &'a Dem,
    /// The set-up of the grains still there.
    pub setup: &'a Setup,
    /// Number at time 0 of each grain still there.
    pub ids: &'a [u32],
    /// Number, mass (kg) and energy (J) of the grains that have left.
    pub left: (u64, f64, f64),
    /// Energy balance at time 0, J.
    pub start: f64,
    /// Time since the start, s.
    pub time: f64,
}

impl Grains {
    pub fn view(&self) -> View<'_> {
        View {
            dem: &self.dem,
            setup: &self.setup,
            ids: &self.ids,
            left: self.left,
            start: self.start,
            time: self.dem.time(),
        }
    }

    fn nothing_left(&self) -> bool {
        self.left.0 > 0 && self.view().free().next().is_none()
    }

    fn max_speed(&self) -> f64 {
        self.view().max_speed()
    }
}

impl<'a> View<'a> {
    /// Grains that are not driven.
    pub fn free(&self) -> impl Iterator<Item = usize> + use<'a> {
        let b = self.dem.bodies();
        (0..b.len()).filter(|&i| b.inverse_mass[i] > 0.0)
    }

    /// Largest speed of a free grain, m/s.
    pub fn max_speed(&self) -> f64 {
        let b = self.dem.bodies();
        // NaN must not hide behind a comparison; the method's own guard stops on it.
        self.free().map(|i| b.velocity[i].norm()).fold(0.0, f64::max)
    }

    /// What the energy balance has changed by since time 0, with what left, J.
    pub fn unexplained(&self) -> f64 {
        self.dem.energies().balance() + self.left.2 - self.start
    }
}
