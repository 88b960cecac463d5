//! The command line of `fuzz`.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use clap::Parser;

use super::corpus::Corpus;
use super::mutant::{Maker, Reader, kept};
use super::tally::{Outcome, Tally};
use super::watch;
use crate::golden::package_root;
use crate::study;

/// Mutants that one worker is given: reading the corpus takes as long as some of them.
const PORTION: u64 = 100;
/// Address space of a worker, bytes: what a plan says to need more is refused by the plan, and what a reader takes beyond it ends
/// the worker. Boxes of ten million cells, which take a plan some seconds each when nothing is optimised, need more.
const MEMORY: u64 = 1 << 30;

/// Puts mutants of scenes, meshes, tables, series and checkpoints through their readers, `plan` and `run`.
#[derive(Parser, Debug, Clone)]
#[command(
    name = "fuzz",
    disable_version_flag = true,
    after_help = "Exit codes: 0 no faults, 1 faults (kept in target/fuzz), 2 bad usage, 4 input or output failed."
)]
struct Options {
    /// Mutants.
    #[arg(long, value_name = "N", default_value_t = 1000)]
    count: u64,
    /// First mutant.
    #[arg(long, value_name = "K", default_value_t = 0)]
    from: u64,
    /// Go on for this long instead of `--count` mutants.
    #[arg(long, value_name = "MINUTES")]
    minutes: Option<f64>,
    /// Other mutants.
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Only those of one reader.
    #[arg(long)]
    reader: Option<Reader>,
    /// Run what was planned for this many steps, if it is small; 0: only plan.
    #[arg(long, value_name = "STEPS", default_value_t = 3)]
    steps: u64,
    /// Workers at the same time [default: all cores].
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Be a worker, in this folder: for the program itself.
    #[arg(long, hide = true)]
    worker: Option<PathBuf>,
}

/// The binary.
#[must_use]
pub fn main() -> ExitCode {
    let options: Options = match study::parse() {
        Ok(options) => options,
        Err(code) => return code,
    };
    let done = match &options.worker {
        Some(folder) => work(&options, folder).map(|()| 0),
        None => watch(&options),
    };
    match done {
        Ok(faults) => ExitCode::from(u8::from(faults > 0)),
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "error: {error}");
            ExitCode::from(4)
        }
    }
}

/// A worker: its mutants, one after the other.
fn work(options: &Options, folder: &Path) -> Result<(), Box<dyn std::error::Error>> {
    limit_memory()?;
    let root = package_root();
    std::fs::create_dir_all(folder)?;
    Corpus::beside(&root, folder)?;
    let mut maker = Maker {
        corpus: Corpus::read(&root)?,
        folder: folder.to_owned(),
        seed: options.seed,
        reader: options.reader,
        steps: options.steps,
        checkpoints: None,
    };
    for number in options.from..options.from + options.count {
        watch::begin(number)?;
        watch::end(&maker.give(number)?)?;
    }
    Ok(())
}

#[cfg(unix)]
fn limit_memory() -> std::io::Result<()> {
    use rustix::process::{Resource, getrlimit, setrlimit};
    let mut limit = getrlimit(Resource::As);
    limit.current = Some(limit.current.map_or(MEMORY, |now| now.min(MEMORY)));
    Ok(setrlimit(Resource::As, limit)?)
}

#[cfg(not(unix))]
fn limit_memory() -> std::io::Result<()> {
    Ok(())
}

/// What the threads of the watch share.
struct Shared<'a> {
    options: &'a Options,
    /// First mutant that nobody has been given.
    next: AtomicU64,
    /// The one behind the last.
    end: u64,
    until: Option<Instant>,
    tally: Mutex<Tally>,
    folder: PathBuf,
}

/// The watch; the number of faults.
fn watch(options: &Options) -> Result<u64, Box<dyn std::error::Error>> {
    let minutes =
        |m: f64| Duration::try_from_secs_f64(m * 60.0).ok().and_then(|time| Instant::now().checked_add(time));
    let until = options.minutes.map(|m| minutes(m).ok_or("--minutes wants a time")).transpose()?;
    let shared = Shared {
        options,
        next: AtomicU64::new(options.from),
        end: if until.is_some() { u64::MAX } else { options.from.saturating_add(options.count) },
        until,
        tally: Mutex::default(),
        folder: package_root().join("target/fuzz").join(std::process::id().to_string()),
    };
    let threads = options.threads.or_else(|| std::thread::available_parallelism().ok().map(usize::from));
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..threads.unwrap_or(1).max(1))
            .map(|k| {
                scope.spawn({
                    let shared = &shared;
                    move || shared.portions(k)
                })
            })
            .collect();
        threads.into_iter().try_for_each(|thread| {
            thread.join().unwrap_or_else(|_| Err(std::io::Error::other("a thread ended")))
        })
    })?;
    // Gone already if no worker was started.
    let _ = std::fs::remove_dir_all(&shared.folder);
    let tally = shared.tally.into_inner()?;
    let faults = tally.faults();
    writeln!(std::io::stdout(), "{tally}seed {}: {faults} faults", options.seed)?;
    Ok(faults)
}

impl Shared<'_> {
    /// Takes portions until there are none.
    fn portions(&self, thread: usize) -> std::io::Result<()> {
        let folder = self.folder.join(thread.to_string());
        loop {
            let from = self.next.fetch_add(PORTION, Ordering::Relaxed);
            let to = from.saturating_add(PORTION).min(self.end);
            if from >= to || self.until.is_some_and(|until| Instant::now() >= until) {
                return Ok(());
            }
            let program = std::env::current_exe()?;
            let command = |from: u64, to: u64| self.worker(&program, &folder, from, to - from);
            watch::over(from, to, watch::LIMIT, command, |number, outcome, seconds| {
                self.report(&folder, number, &outcome, seconds);
            })?;
        }
    }

    fn worker(&self, program: &Path, folder: &Path, from: u64, count: u64) -> Command {
        let mut command = Command::new(program);
        let pairs = [
            ("--from", from),
            ("--count", count),
            ("--seed", self.options.seed),
            ("--steps", self.options.steps),
        ];
        for (key, value) in pairs {
            command.arg(key).arg(value.to_string());
        }
        if let Some(reader) = self.options.reader {
            command.arg("--reader").arg(format!("{reader:?}").to_lowercase());
        }
        command.arg("--worker").arg(folder);
        // One allocator's arena per thread would take up the address space; large arrays on the stack where nothing is optimised.
        command.env("MALLOC_ARENA_MAX", "2").env("RUST_MIN_STACK", "67108864").env("RAYON_NUM_THREADS", "1");
        command
    }

    fn report(&self, folder: &Path, number: u64, outcome: &Outcome, seconds: f64) {
        let turn = Maker::turn(self.options.reader, number);
        if let Ok(mut tally) = self.tally.lock() {
            tally.add(turn, outcome, seconds);
        }
        let Outcome::Fault(what) = outcome else { return };
        let keep = self.folder.with_file_name(format!("fault_{}_{number}", self.options.seed));
        let mut out = std::io::stdout().lock();
        let _ = writeln!(out, "FAULT {number} ({turn:?}): {what}\n  kept in {}", keep.display());
        let _ = std::fs::create_dir_all(&keep);
        for path in kept(folder, turn) {
            let _ = std::fs::copy(&path, keep.join(path.file_name().unwrap_or_default()));
        }
    }
}
