//! Mutation score: how many of a sample of mistakes in lahar its tests notice.
//!
//! One build holds the whole sample; the environment chooses one. Each test is run once without any, which shows which
//! mistakes it reaches; a mistake then meets the tests that reach it, the quickest first, until one fails. A run that was cut
//! short goes on where it was, as long as no file has changed.

mod kept;
mod points;
mod rewrite;
mod runs;
mod score;
mod tree;

use clap::Parser;
use kept::Kept;
use runs::Test;
use score::{Outcome, Row};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;
use tree::{Mutant, Part};

/// What the score is of.
const FOLDERS: &str =
    "rheology,collision,boundary,free_surface,coupling,dem,solver,setup,geometry,units,plan,output,scene,run";

/// How many of a sample of mistakes in lahar its tests notice.
#[derive(Parser)]
struct Options {
    /// Parts of `src`, separated by commas.
    #[arg(long, default_value = FOLDERS)]
    folders: String,
    /// Mistakes in each part.
    #[arg(long, default_value_t = 12)]
    each: usize,
    /// Another seed is another sample.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Tests that each mistake meets at most, s of their running time; those that take longest are left out.
    #[arg(long, default_value_t = 120)]
    most_s: u64,
    /// Where the copy is made and built.
    #[arg(long, default_value = "target/mutation")]
    scratch: PathBuf,
    /// Lists the mistakes, and ends.
    #[arg(long)]
    list: bool,
}

fn main() -> ExitCode {
    match run(&Options::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Result<(), String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .canonicalize()
        .map_err(|error| error.to_string())?;
    let scratch = root.join(&options.scratch);
    let parts =
        options.folders.split(',').map(|folder| Part::read(&root, folder)).collect::<Result<Vec<_>, _>>()?;
    let mut mutants = Vec::new();
    for part in &parts {
        for (file, point) in part.sample(options.each, options.seed) {
            let number = mutants.len() as u32;
            mutants.push(Mutant { number, folder: part.folder.clone(), file, point });
        }
    }
    if options.list {
        for Mutant { file, point, .. } in &mutants {
            println!("{file}:{} {}: {}", point.line, point.function, point.change);
        }
        return Ok(());
    }
    let copy = scratch.join("copy");
    let sample = format!("{} {} {} {}", options.folders, options.each, options.seed, options.most_s);
    let mutants = viable(&root, &copy, mutants)?;
    let kept = Kept::open(&scratch, &tree::fingerprint(&root, &sample)?)?;
    let tests = match kept.tests()? {
        Some(tests) => tests,
        None => {
            let programs = runs::programs(&copy)?;
            let (tests, failed) = runs::all(&programs, &scratch)?;
            eprintln!("left out, since they fail in the copy: {failed:?}");
            kept.keep_tests(&tests)?;
            tests
        }
    };
    eprintln!("{} tests", tests.len());
    let mut outcomes = kept.outcomes()?;
    let equivalent = score::equivalent(&root)?;
    let mut rows = Vec::new();
    for mutant in mutants {
        let outcome = match outcomes.remove(&mutant.number) {
            Some(outcome) => outcome,
            None => {
                let outcome = outcome(mutant.number, &tests, Duration::from_secs(options.most_s))?;
                kept.keep_outcome(mutant.number, &outcome)?;
                outcome
            }
        };
        let row = Row::new(&mutant, outcome, &equivalent);
        eprintln!("[{}] {row}", rows.len() + 1);
        rows.push(row);
        // Seeds of failures found with a mistake are not the project's.
        let _ = std::fs::remove_dir_all(copy.join("proptest-regressions"));
    }
    let text = score::table(&parts, &rows, options.seed, options.most_s);
    std::fs::write(root.join("verification/mutation/score.md"), &text).map_err(|error| error.to_string())?;
    print!("{text}");
    Ok(())
}

/// What becomes of a mistake.
fn outcome(number: u32, tests: &[Test], most: Duration) -> Result<Outcome, String> {
    if tests.iter().all(|test| !test.reached.contains(&number)) {
        return Ok(Outcome::NotReached);
    }
    Ok(match runs::killer(number, tests, most)? {
        Ok(test) => Outcome::Noticed(test),
        Err(left_out) => Outcome::Survived { left_out },
    })
}

/// The copy with those mistakes that compile.
fn viable(root: &Path, copy: &Path, mut mutants: Vec<Mutant>) -> Result<Vec<Mutant>, String> {
    loop {
        tree::write(root, copy, &mutants)?;
        let bad = tree::unviable(copy)?;
        if bad.is_empty() {
            return Ok(mutants);
        }
        eprintln!("{} of {} mistakes do not compile", bad.len(), mutants.len());
        mutants.retain(|mutant| !bad.contains(&mutant.number));
    }
}
