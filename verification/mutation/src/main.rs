//! Mutation score: how many of a sample of mistakes in lahar its tests notice.
//!
//! One build holds the whole sample; the environment chooses one. Each test is run once without any, which shows which
//! mistakes it reaches; a mistake then meets the tests that reach it, the quickest first, until one fails.

mod points;
mod rewrite;
mod runs;
mod score;
mod tree;

use clap::Parser;
use score::{Outcome, Row};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
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
    let mutants = viable(&root, &copy, mutants)?;
    let programs = runs::programs(&copy)?;
    let (tests, failed) = runs::all(&programs, &scratch)?;
    eprintln!(
        "{} tests of {} programs; left out, since they fail in the copy: {failed:?}",
        tests.len(),
        programs.len()
    );
    let equivalent = score::equivalent(&root)?;
    let mut rows = Vec::new();
    for mutant in mutants {
        let outcome = match runs::killer(mutant.number, &tests)? {
            Some(test) => Outcome::Noticed(test),
            None if tests.iter().all(|test| !test.reached.contains(&mutant.number)) => Outcome::NotReached,
            None => Outcome::Survived,
        };
        let row = Row::new(&mutant, outcome, &equivalent);
        eprintln!("[{}] {row}", rows.len() + 1);
        rows.push(row);
        // Seeds of failures found with a mistake are not the project's.
        let _ = std::fs::remove_dir_all(copy.join("proptest-regressions"));
    }
    let text = score::table(&parts, &rows, options.seed);
    std::fs::write(root.join("verification/mutation/score.md"), &text).map_err(|error| error.to_string())?;
    print!("{text}");
    Ok(())
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
