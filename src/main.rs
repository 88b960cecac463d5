//! The command line.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand, ValueEnum};

use lahar::bench::{self, BenchError};
use lahar::output::OutputError;
use lahar::plan::grains::GrainPlan;
use lahar::plan::target::{self, Target};
use lahar::plan::{Layout, Plan, PlanError};
use lahar::run_grains::{self, Ending, GrainOptions};
use lahar::run_scene::{self, Options, RunError};
use lahar::scene::dry::DryScene;
use lahar::scene::{self, AnyScene, SceneError, SceneProblem};
use lahar::solver::choose::{Best, only_plain};
use lahar::solver::plain::Plain;
use lahar::solver::run::Backend;

const BAD_INPUT: u8 = 2;
const STOPPED: u8 = 3;
const IO: u8 = 4;

/// Lattice-Boltzmann flows of yield-stress fluids.
#[derive(Parser)]
#[command(
    name = "lahar",
    version,
    after_help = "Exit codes: 0 done, 2 bad input, 3 run stopped by a guard, 4 input or output failed."
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Run a scene and write fields, series, plots and a summary.
    Run {
        /// Scene file.
        scene: PathBuf,
        /// Output folder [default: out/<name of the scene>].
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
        /// Solver.
        #[arg(long, value_enum, default_value = "fast")]
        backend: BackendName,
        /// Worker threads; results do not depend on it [default: all].
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
        threads: Option<u16>,
        /// End time in seconds, instead of the scene's.
        #[arg(long, value_name = "S", value_parser = end_time)]
        until: Option<f64>,
        /// Print nothing but errors.
        #[arg(long)]
        quiet: bool,
    },
    /// Show what a scene needs, what it does not, and what it costs; run nothing.
    Plan {
        /// Scene file.
        scene: PathBuf,
        /// As JSON; infinite numbers are null.
        #[arg(long)]
        json: bool,
        /// Solver whose memory is counted.
        #[arg(long, value_enum, default_value = "fast")]
        backend: BackendName,
        /// Also say which spacing, scheme and time step reach this relative error, and at what cost: `1%`
        /// or `0.01`.
        #[arg(long, value_name = "E", allow_hyphen_values = true)]
        target_error: Option<Target>,
    },
    /// Measure this machine: bandwidth, speed of a fixed list of flows, shares of the ceiling.
    Bench {
        /// As JSON.
        #[arg(long)]
        json: bool,
        /// About ten times smaller and shorter: half a minute.
        #[arg(long)]
        quick: bool,
        /// Largest number of threads [default: all].
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
        threads: Option<u16>,
        /// Only this group or case, or `bandwidth`; an unknown name lists them all.
        #[arg(long, value_name = "NAME")]
        only: Option<String>,
    },
    /// Print the JSON Schema of a scene.
    Schema,
}

#[derive(Clone, Copy, ValueEnum)]
enum BackendName {
    /// Packs, blocks, threads.
    Fast,
    /// Scalar reference solver.
    Plain,
}

impl BackendName {
    fn backend(self) -> &'static dyn Backend {
        match self {
            Self::Fast => &Best,
            Self::Plain => &Plain,
        }
    }

    fn layout(self) -> Layout {
        self.backend().layout()
    }
}

fn end_time(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds > 0.0 && seconds.is_finite() => Ok(seconds),
        _ => Err("a number of seconds > 0 is wanted".to_owned()),
    }
}

/// Whatever ends a command early.
#[derive(Debug, thiserror::Error)]
enum Failure {
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Plan(#[from] PlanError),
    #[error(transparent)]
    Run(#[from] RunError),
    #[error(transparent)]
    Bench(#[from] BenchError),
    #[error(
        "{0}: `--target-error` is about flows, and this scene has no fluid\n  way out: leave it out; `steps_per_contact` sets the accuracy of contacts"
    )]
    NoTarget(String),
    #[error("cannot write as JSON: {0}")]
    Json(#[from] serde_json::Error),
    #[error("cannot print: {0}")]
    Print(#[from] std::io::Error),
}

impl Failure {
    fn code(&self) -> u8 {
        match self {
            Self::Scene(error) if matches!(*error.problem, SceneProblem::Unreadable { .. }) => IO,
            Self::Scene(_) | Self::Plan(_) | Self::NoTarget(_) => BAD_INPUT,
            Self::Run(RunError::Start(_)) => BAD_INPUT,
            Self::Run(RunError::Stopped(_) | RunError::Grains(_)) => STOPPED,
            Self::Run(RunError::Threads(_) | RunError::Folder { .. } | RunError::Output(_)) => IO,
            Self::Bench(BenchError::Stopped { .. } | BenchError::Grains { .. }) => STOPPED,
            Self::Bench(BenchError::Threads(_)) => IO,
            Self::Bench(_) => BAD_INPUT,
            Self::Json(_) | Self::Print(_) => IO,
        }
    }
}

impl From<OutputError> for Failure {
    fn from(error: OutputError) -> Self {
        Self::Run(RunError::Output(error))
    }
}

fn main() -> ExitCode {
    // clap prints its own message and leaves with 2 when the command line is wrong.
    let cli = Cli::parse();
    let result = match cli.command {
        Command::Run { scene, out, backend, threads, until, quiet } => {
            run(&scene, out, backend, threads, until, quiet)
        }
        Command::Plan { scene, json, backend, target_error } => plan(&scene, json, backend, target_error),
        Command::Bench { json, quick, threads, only } => {
            measure(json, &bench::Options { quick, threads: count(threads), only })
        }
        Command::Schema => print(&scene::schema()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        // The reader of a pipe left: nothing to complain about.
        Err(Failure::Print(error)) if error.kind() == std::io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::from(failure.code())
        }
    }
}

fn run(
    path: &Path,
    out: Option<PathBuf>,
    backend: BackendName,
    threads: Option<u16>,
    until_s: Option<f64>,
    quiet: bool,
) -> Result<(), Failure> {
    let scene = match scene::read(path)? {
        AnyScene::Flow(scene) => scene,
        AnyScene::Dry(scene) => return run_dry(&scene, out, threads, until_s, quiet),
    };
    let plan = Plan::for_layout(&scene, backend.layout())?;
    let out = out.unwrap_or_else(|| default_folder(&scene.file));
    if !quiet {
        let n = &plan.numbers;
        let [nx, ny, nz] = n.extents;
        let sentence = n.time_step_rule.sentence();
        eprintln!(
            "{}: {nx} × {ny} × {nz} cells, {} steps of {:.4e} s ({sentence})",
            n.title, n.steps, n.time_step_s
        );
        if let (BackendName::Fast, Some(what)) = (backend, only_plain(&plan.setup)) {
            eprintln!("note: {what} is run by the plain backend");
        }
        for warning in &n.warnings {
            eprintln!("warning: {warning}");
        }
    }
    let options = Options { out, backend: backend.backend(), threads: count(threads), until_s, quiet };
    let finished = run_scene::run(&scene, &plan, &options)?;
    if !quiet {
        let why = match (finished.steady, finished.arrested) {
            (true, _) => "steady",
            (_, true) => "at rest",
            _ => "end time",
        };
        let residual = finished.residual.map_or_else(String::new, |r| format!(", residual {r:.2e}"));
        eprintln!(
            "done: {} steps, {:.6} s ({why}{residual}), {:.1} s of computing, {:.2} million updates per second",
            finished.steps, finished.time_s, finished.wall_seconds, finished.million_updates_per_second
        );
        eprintln!("results in {}", options.out.display());
    }
    Ok(())
}

/// Runs grains without fluid; there is one way to compute them.
fn run_dry(
    scene: &DryScene,
    out: Option<PathBuf>,
    threads: Option<u16>,
    until_s: Option<f64>,
    quiet: bool,
) -> Result<(), Failure> {
    let plan = GrainPlan::new(scene)?;
    let out = out.unwrap_or_else(|| default_folder(&scene.file));
    if !quiet {
        let n = &plan.numbers;
        eprintln!(
            "{}: {} grains of {} spheres, {} steps of {:.4e} s",
            n.title, n.grains, n.spheres, n.steps, n.time_step_s
        );
        for warning in &n.warnings {
            eprintln!("warning: {warning}");
        }
    }
    let options = GrainOptions { out, threads: count(threads), until_s, quiet };
    let finished = run_grains::run(scene, &plan, &options)?;
    if !quiet {
        let why = match finished.why {
            Ending::EndTime => "end time",
            Ending::AtRest => "at rest",
            Ending::Empty => "all grains have left",
        };
        eprintln!(
            "done: {} steps, {:.6} s ({why}), {:.1} s of computing, {:.2} million sphere updates per second",
            finished.steps, finished.time_s, finished.wall_seconds, finished.million_updates_per_second
        );
        eprintln!("results in {}", options.out.display());
    }
    Ok(())
}

fn default_folder(file: &str) -> PathBuf {
    let name = Path::new(file).file_stem().map_or_else(|| "scene".into(), |stem| stem.to_os_string());
    PathBuf::from("out").join(name)
}

fn plan(path: &Path, json: bool, backend: BackendName, target_error: Option<Target>) -> Result<(), Failure> {
    let scene = match scene::read(path)? {
        AnyScene::Flow(scene) => scene,
        AnyScene::Dry(scene) => return plan_dry(&scene, json, target_error),
    };
    let plan = Plan::for_layout(&scene, backend.layout())?;
    let quote = target_error.map(|target| target::quote(&scene, &plan, target)).transpose()?;
    if json {
        /// The numbers, with the quote beside them where it was asked for.
        #[derive(serde::Serialize)]
        struct WithTarget<'a> {
            #[serde(flatten)]
            numbers: &'a lahar::plan::Numbers,
            #[serde(skip_serializing_if = "Option::is_none")]
            target: Option<target::Quote>,
        }
        let all = WithTarget { numbers: &plan.numbers, target: quote };
        print(&format!("{}\n", serde_json::to_string_pretty(&all)?))
    } else {
        print(&format!("{plan}{}", quote.map_or_else(String::new, |quote| quote.to_string())))
    }
}

fn plan_dry(scene: &DryScene, json: bool, target_error: Option<Target>) -> Result<(), Failure> {
    if target_error.is_some() {
        return Err(Failure::NoTarget(scene.file.clone()));
    }
    let plan = GrainPlan::new(scene)?;
    if json {
        print(&format!("{}\n", serde_json::to_string_pretty(&plan.numbers)?))
    } else {
        print(&plan.to_string())
    }
}

/// Worker threads: as given, or all there are.
fn count(threads: Option<u16>) -> usize {
    threads
        .map_or_else(|| std::thread::available_parallelism().map_or(1, std::num::NonZero::get), usize::from)
}

fn measure(json: bool, options: &bench::Options) -> Result<(), Failure> {
    let report = bench::run(options, &mut |line| eprintln!("{line}"))?;
    if json {
        print(&format!("{}\n", serde_json::to_string_pretty(&report)?))
    } else {
        print(&report.to_string())
    }
}

/// Prints to standard output without panicking when nobody reads.
fn print(text: &str) -> Result<(), Failure> {
    use std::io::Write;
    std::io::stdout().write_all(text.as_bytes())?;
    Ok(())
}
