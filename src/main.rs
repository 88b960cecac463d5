//! The command line.

// These end the program when nobody reads; `output::terminal` does not.
#![deny(clippy::print_stdout, clippy::print_stderr)]

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand, ValueEnum};

use lahar::bench::{self, BenchError};
use lahar::output::OutputError;
use lahar::output::terminal::{print, say};
use lahar::plan::target::Target;
use lahar::plan::{Layout, PlanError, Planned};
use lahar::run::{Ended, Every, Finished, Interrupt, Options, RunError};
use lahar::scene::{self, SceneError, SceneProblem};
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
    after_help = "Exit codes: 0 done, 2 bad input, 3 run stopped by a guard, 4 input or output failed, 128 + n ended by \
                  signal n (129 hang-up, 130 interrupt, 143 terminate)."
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
        /// Output folder; files of an earlier run there are removed [default: out/<name of the scene>].
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
        /// Refuse a folder with an earlier run instead.
        #[arg(long)]
        keep: bool,
        /// Write the state into the output folder, to go on from: `10min`, `90s`, `2h` or `5000steps` after the last time.
        #[arg(long, value_name = "INTERVAL", allow_hyphen_values = true)]
        checkpoint_every: Option<Every>,
        /// Go on from the last state in this output folder.
        #[arg(long, value_name = "DIR", conflicts_with_all = ["out", "keep"])]
        resume: Option<PathBuf>,
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
    #[error("cannot listen for signals: {0}")]
    Signals(std::io::Error),
}

impl Failure {
    fn code(&self) -> u8 {
        match self {
            Self::Scene(error)
                if matches!(
                    *error.problem,
                    SceneProblem::Unreadable { .. } | SceneProblem::NotAFile { .. }
                ) =>
            {
                IO
            }
            Self::Scene(_) | Self::Plan(_) | Self::NoTarget(_) => BAD_INPUT,
            Self::Run(error) => match error {
                RunError::Start(_) | RunError::Kept { .. } | RunError::Stranger { .. } => BAD_INPUT,
                RunError::Checkpoint { .. } => BAD_INPUT,
                RunError::Stopped(_) => STOPPED,
                RunError::Threads(_) | RunError::Folder { .. } | RunError::InUse { .. } => IO,
                RunError::Output(_) => IO,
            },
            Self::Signals(_) => IO,
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
        Command::Run { scene, out, keep, checkpoint_every, resume, backend, threads, until, quiet } => {
            let until_s = until;
            run(
                &scene,
                &RunArguments { out, keep, checkpoint_every, resume, backend, threads, until_s, quiet },
            )
        }
        Command::Plan { scene, json, backend, target_error } => plan(&scene, json, backend, target_error),
        Command::Bench { json, quick, threads, only } => {
            measure(json, &bench::Options { quick, threads: count(threads), only })
        }
        Command::Schema => printed(&scene::schema()),
    };
    match result {
        Ok(code) => code,
        // The reader of a pipe left: nothing to complain about.
        Err(Failure::Print(error)) if error.kind() == std::io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(failure) => {
            say(&format!("error: {failure}"));
            ExitCode::from(failure.code())
        }
    }
}

/// What the command line says about a run, but for the scene.
struct RunArguments {
    out: Option<PathBuf>,
    keep: bool,
    checkpoint_every: Option<Every>,
    resume: Option<PathBuf>,
    backend: BackendName,
    threads: Option<u16>,
    until_s: Option<f64>,
    quiet: bool,
}

fn run(path: &Path, arguments: &RunArguments) -> Result<ExitCode, Failure> {
    let &RunArguments { ref out, keep, checkpoint_every, ref resume, backend, threads, until_s, quiet } =
        arguments;
    let planned = Planned::new(scene::load(path)?, backend.layout())?;
    let out = resume.clone().or(out.clone()).unwrap_or_else(|| default_folder(planned.file()));
    if !quiet {
        say(&planned.headline());
        if let (BackendName::Fast, Planned::Flow(_, plan)) = (backend, &planned)
            && let Some(what) = only_plain(&plan.setup)
        {
            say(&format!("note: {what} is run by the plain backend"));
        }
        for warning in planned.warnings() {
            say(&format!("warning: {warning}"));
        }
    }
    let signals = Interrupt::listen().map_err(Failure::Signals)?;
    let options = Options {
        keep,
        threads: count(threads),
        until_s,
        quiet,
        interrupt: Some(signals.flag()),
        checkpoint_every,
        resume: resume.is_some(),
        ..Options::new(out, backend.backend())
    };
    let finished = lahar::run::run(&planned, &options)?;
    if !quiet {
        say(&done(&planned, &finished));
        say(&format!("results in {}", options.out.display()));
        if finished.ended == Ended::Interrupted && checkpoint_every.is_some() {
            say(&format!("go on with --resume {}", options.out.display()));
        }
    }
    Ok(match finished.ended {
        Ended::Interrupted => ExitCode::from(signals.exit_code()),
        _ => ExitCode::SUCCESS,
    })
}

/// How a run went, in a line.
fn done(planned: &Planned, finished: &Finished) -> String {
    let steady = finished.steadiness.map(|found| format!(", {found}")).unwrap_or_default();
    let rest = finished.rest.map(|found| format!(", {found}")).unwrap_or_default();
    let updates = match planned {
        Planned::Flow(..) => "updates",
        Planned::Dry(..) => "sphere updates",
    };
    format!(
        "done: {} steps, {:.6} s ({}{steady}{rest}), {:.1} s of computing, {:.2} million {updates} per second",
        finished.steps,
        finished.time_s,
        finished.ended.words(),
        finished.wall_seconds,
        finished.million_updates_per_second
    )
}

fn default_folder(file: &str) -> PathBuf {
    let name = Path::new(file).file_stem().map_or_else(|| "scene".into(), |stem| stem.to_os_string());
    PathBuf::from("out").join(name)
}

fn plan(
    path: &Path,
    json: bool,
    backend: BackendName,
    target_error: Option<Target>,
) -> Result<ExitCode, Failure> {
    let planned = Planned::new(scene::load(path)?, backend.layout())?;
    let quote = match target_error {
        Some(target) => {
            Some(planned.quote(target)?.ok_or_else(|| Failure::NoTarget(planned.file().to_owned()))?)
        }
        None => None,
    };
    if json {
        printed(&format!("{}\n", planned.json(quote.as_ref())?))
    } else {
        printed(&format!("{planned}{}", quote.map_or_else(String::new, |quote| quote.to_string())))
    }
}

/// Worker threads: as given, or all there are.
fn count(threads: Option<u16>) -> usize {
    threads
        .map_or_else(|| std::thread::available_parallelism().map_or(1, std::num::NonZero::get), usize::from)
}

fn measure(json: bool, options: &bench::Options) -> Result<ExitCode, Failure> {
    let report = bench::run(options, &mut |line| say(line))?;
    if json {
        printed(&format!("{}\n", serde_json::to_string_pretty(&report)?))
    } else {
        printed(&report.to_string())
    }
}

fn printed(text: &str) -> Result<ExitCode, Failure> {
    print(text)?;
    Ok(ExitCode::SUCCESS)
}
