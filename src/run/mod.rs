//! Running a planned scene into a folder, whatever is in it.
//!
//! [`run()`] is the one way in. One loop (`driver`) moves what the scene holds: a fluid, with or without grains in it
//! (`fluid`), or grains alone (`grains`). `measure` says what probes say, `recorder` keeps the time series.

mod checkpoint;
mod driver;
mod error;
mod experiment;
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

pub use checkpoint::{CheckpointProblem, Every};
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
use checkpoint::{Kept, Labels};
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
    /// How often the state is written, to go on from; `None` for never.
    pub checkpoint_every: Option<Every>,
    /// Go on from the checkpoint in the output folder.
    pub resume: bool,
}

impl<'a> Options<'a> {
    /// On one thread, to the scene's end time, quietly.
    #[must_use]
    pub fn new(out: PathBuf, backend: &'a dyn Backend) -> Self {
        Self {
            out,
            keep: false,
            backend,
            threads: 1,
            until_s: None,
            quiet: true,
            interrupt: None,
            checkpoint_every: None,
            resume: false,
        }
    }
}

/// Runs a scene, or the rest of it, and writes its outputs.
///
/// # Errors
/// The folder or its checkpoint cannot be used, the backend refuses the set-up, a guard stops the run (what was written stays),
/// or a file cannot be written.
pub fn run(planned: &Planned, options: &Options<'_>) -> Result<Finished, RunError> {
    let kept = if options.resume { Some(kept(planned, options)?) } else { None };
    let folder = match kept {
        Some(_) => Folder::reopen(&options.out)?,
        None => new_folder(planned, options)?,
    };
    let mut recorder = Recorder::new(Arc::new(folder));
    match planned {
        Planned::Flow(scene, plan) => flow(scene, plan, options, kept.as_ref(), &mut recorder),
        Planned::Dry(scene, plan) => {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(options.threads.max(1)).build();
            let pool = pool.map_err(RunError::Threads)?;
            pool.install(|| dry(scene, plan, options, kept.as_ref(), &mut recorder))
        }
    }
}

/// A folder without files of an earlier run, with the scene and its plan.
fn new_folder(planned: &Planned, options: &Options<'_>) -> Result<Folder, RunError> {
    let (folder, removed) = Folder::claim(&options.out, options.keep, Some(&papers::source(planned)))?;
    if removed > 0 && !options.quiet {
        say(&format!("note: removed {removed} files of an earlier run from {}", options.out.display()));
    }
    papers::write(planned, &folder)?;
    Ok(folder)
}

/// The checkpoint of the folder, if it is one of this scene.
fn kept(planned: &Planned, options: &Options<'_>) -> Result<Kept, RunError> {
    let failed = |problem| RunError::Checkpoint { path: options.out.join(checkpoint::FILE), problem };
    let kept = Kept::find(&options.out).map_err(failed)?;
    let mut own = match planned {
        Planned::Flow(scene, plan) => labels_of_flow(scene, plan, options),
        Planned::Dry(scene, plan) => labels_of_grains(scene, plan, options),
    };
    if options.until_s.is_none() {
        own.end = kept.labels.end;
    }
    kept.belongs_to(&own).map_err(failed)?;
    Ok(kept)
}

fn labels_of_flow(scene: &Scene, plan: &Plan, options: &Options<'_>) -> Labels {
    Labels {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        solver: options.backend.name().to_owned(),
        scene: summary::hash_of(scene),
        bodies: hash_of_bodies(plan),
        end: options.until_s.map_or(plan.steps, |until| steps_until(until, &plan.units)),
    }
}

fn labels_of_grains(scene: &DryScene, plan: &GrainPlan, options: &Options<'_>) -> Labels {
    let units = units_of_grains(plan);
    Labels {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        solver: "grains".to_owned(),
        scene: summary::hash_of(scene),
        bodies: hash_of_grains(plan),
        end: options.until_s.map_or(plan.steps, |until| steps_until(until, &units)),
    }
}

/// Hash of solids, fluid as drawn, and grains.
fn hash_of_bodies(plan: &Plan) -> String {
    let fill = plan.setup.free_surface.iter().flat_map(|surface| surface.fill.iter());
    let mut bytes: Vec<u8> = fill.flat_map(|fill| fill.to_le_bytes()).collect();
    bytes.extend_from_slice(&plan.setup.solids);
    bytes.extend(plan.grains.iter().flat_map(|coupled| hash_of_grains(&coupled.grains).into_bytes()));
    summary::hash(&bytes)
}

/// Hash of grains and walls.
fn hash_of_grains(plan: &GrainPlan) -> String {
    summary::hash(format!("{:?}", plan.setup).as_bytes())
}

/// Only time has a scale.
fn units_of_grains(plan: &GrainPlan) -> Units {
    Units::new(1.0, plan.numbers.time_step_s, 1.0)
}

fn flow(
    scene: &Scene,
    plan: &Plan,
    options: &Options<'_>,
    resumed: Option<&Kept>,
    recorder: &mut Recorder,
) -> Result<Finished, RunError> {
    let threads = options.threads.max(1);
    let labels = resumed.map_or_else(|| labels_of_flow(scene, plan, options), |kept| kept.labels.clone());
    let end = labels.end;
    let cadences = Cadences::of_flow(scene);
    let order = Order {
        scene: scene.file.clone(),
        scene_hash: labels.scene.clone(),
        backend: Some(options.backend.name()),
        threads,
        schedule: Schedule::new(&cadences, &plan.units, end),
        cadences,
        labels,
    };
    let mut flow = Flow::start(scene, plan, options.backend, threads, recorder)?;
    flow.watch(end);
    let progress = Progress::new(&plan.numbers.title, end, options.quiet);
    driver::drive(&mut flow, recorder, order, outside(options, &progress, resumed))
}

fn dry(
    scene: &DryScene,
    plan: &GrainPlan,
    options: &Options<'_>,
    resumed: Option<&Kept>,
    recorder: &mut Recorder,
) -> Result<Finished, RunError> {
    let labels = resumed.map_or_else(|| labels_of_grains(scene, plan, options), |kept| kept.labels.clone());
    let end = labels.end;
    let cadences = Cadences::of_grains(scene);
    let order = Order {
        scene: scene.file.clone(),
        scene_hash: labels.scene.clone(),
        backend: None,
        threads: options.threads.max(1),
        schedule: Schedule::new(&cadences, &units_of_grains(plan), end),
        cadences,
        labels,
    };
    let mut dry = Dry::start(scene, plan, recorder)?;
    let progress = Progress::new(&plan.numbers.title, end, options.quiet);
    driver::drive(&mut dry, recorder, order, outside(options, &progress, resumed))
}

fn outside<'a>(options: &'a Options<'_>, progress: &'a Progress, resumed: Option<&'a Kept>) -> Outside<'a> {
    Outside { progress, interrupt: options.interrupt, checkpoints: options.checkpoint_every, resumed }
}
