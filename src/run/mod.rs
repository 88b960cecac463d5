//! Running a planned scene into a folder, whatever is in it.
//!
//! [`run()`] is the one way in. One loop (`driver`) moves what the scene holds: a fluid, with or without grains in it
//! (`fluid`), or grains alone (`grains`). `measure` says what probes say, `recorder` keeps the time series.

mod driver;
mod error;
mod fluid;
mod folder;
mod grains;
mod interrupt;
pub mod load_summary;
mod measure;
mod papers;
mod recorder;
pub mod rest;
mod schedule;
mod series_plots;
mod stop;
pub mod summary;
mod view;

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

pub use driver::Finished;
pub use error::RunError;
pub use grains::books::fingerprint;
pub use interrupt::Interrupt;
pub use load_summary::{LoadInstant, LoadPeaks, LoadSummary};
pub use rest::RestOutcome;
pub use stop::{StopPlace, StopReport};
pub use summary::{Ended, Summary};

use crate::output::progress::Progress;
use crate::output::terminal::say;
use crate::plan::grains::GrainPlan;
use crate::plan::{Plan, Planned};
use crate::scene::Scene;
use crate::scene::dry::DryScene;
use crate::solver::run::Backend;
use crate::units::Units;
use driver::{Order, Outside};
use fluid::Flow;
use folder::Folder;
use grains::Dry;
use recorder::Recorder;
use schedule::{Cadences, Schedule, steps_until};

/// How to run.
#[derive(Clone)]
pub struct Options<'a> {
    /// Output folder; created when missing. Files of an earlier run are removed.
    pub out: PathBuf,
    /// Refuse a folder with an earlier run instead.
    pub keep: bool,
    /// The solver of the fluid; of no effect without one.
    pub backend: &'a dyn Backend,
    /// Worker threads, at least 1; results do not depend on it.
    pub threads: usize,
    /// End time instead of the scene's, s.
    pub until_s: Option<f64>,
    /// Print nothing.
    pub quiet: bool,
    /// Ends the run after the steps under way, with all its files, when it becomes true.
    pub interrupt: Option<&'a AtomicBool>,
}

impl<'a> Options<'a> {
    /// On one thread, to the scene's end time, quietly.
    #[must_use]
    pub fn new(out: PathBuf, backend: &'a dyn Backend) -> Self {
        Self { out, keep: false, backend, threads: 1, until_s: None, quiet: true, interrupt: None }
    }
}

/// Runs a scene and writes its outputs.
///
/// # Errors
/// The folder cannot be used, the backend refuses the set-up, a guard stops the run (what was written stays), or a file cannot
/// be written.
pub fn run(planned: &Planned, options: &Options<'_>) -> Result<Finished, RunError> {
    let (folder, removed) = Folder::claim(&options.out, options.keep, Some(&papers::source(planned)))?;
    if removed > 0 && !options.quiet {
        say(&format!("note: removed {removed} files of an earlier run from {}", options.out.display()));
    }
    papers::write(planned, &folder)?;
    let mut recorder = Recorder::new(Arc::new(folder));
    match planned {
        Planned::Flow(scene, plan) => flow(scene, plan, options, &mut recorder),
        Planned::Dry(scene, plan) => {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(options.threads.max(1)).build();
            pool.map_err(RunError::Threads)?.install(|| dry(scene, plan, options, &mut recorder))
        }
    }
}

fn flow(
    scene: &Scene,
    plan: &Plan,
    options: &Options<'_>,
    recorder: &mut Recorder,
) -> Result<Finished, RunError> {
    let threads = options.threads.max(1);
    let end = options.until_s.map_or(plan.steps, |until| steps_until(until, &plan.units));
    let cadences = Cadences::of_flow(scene);
    let order = Order {
        scene: scene.file.clone(),
        scene_hash: summary::hash_of(scene),
        backend: Some(options.backend.name()),
        threads,
        schedule: Schedule::new(&cadences, &plan.units, end),
        cadences,
    };
    let mut flow = Flow::start(scene, plan, options.backend, threads, recorder)?;
    flow.watch(end);
    let progress = Progress::new(&plan.numbers.title, end, options.quiet);
    driver::drive(&mut flow, recorder, order, Outside { progress: &progress, interrupt: options.interrupt })
}

fn dry(
    scene: &DryScene,
    plan: &GrainPlan,
    options: &Options<'_>,
    recorder: &mut Recorder,
) -> Result<Finished, RunError> {
    // Only time has a scale.
    let units = Units::new(1.0, plan.numbers.time_step_s, 1.0);
    let end = options.until_s.map_or(plan.steps, |until| steps_until(until, &units));
    let cadences = Cadences::of_grains(scene);
    let order = Order {
        scene: scene.file.clone(),
        scene_hash: summary::hash_of(scene),
        backend: None,
        threads: options.threads.max(1),
        schedule: Schedule::new(&cadences, &units, end),
        cadences,
    };
    let mut dry = Dry::start(scene, plan, recorder)?;
    let progress = Progress::new(&plan.numbers.title, end, options.quiet);
    driver::drive(&mut dry, recorder, order, Outside { progress: &progress, interrupt: options.interrupt })
}
