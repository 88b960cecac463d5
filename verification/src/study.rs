//! Studies: a topic with its claims, exhibits and mutants, and the body of its binary.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;

use super::claim::Claim;
use super::exhibit::Exhibit;
use super::golden::{Agreement, Golden, may_bless, package_root};
use super::ladder::Depth;
use super::mutant::Mutant;
use lahar::solver::run::Backend;

mod bless;
mod files;
mod results;
mod table;

pub use results::Results;

/// One topic of verification; a chapter of the report and a binary `study-<id>`.
pub struct Study {
    /// Short name: `poiseuille`.
    pub id: &'static str,
    /// Heading of its chapter.
    pub title: &'static str,
    /// A paragraph or two (Markdown) that tell a stranger what is at stake.
    pub intro: &'static str,
    /// Its claims, in the order of the report.
    pub claims: &'static [Claim],
    /// Tables and figures that are not claims.
    pub exhibits: &'static [Exhibit],
    /// Wrong variants that claims must catch.
    pub mutants: &'static [Mutant],
    /// Known limits, in sentences.
    pub limits: &'static [&'static str],
    /// How closely its numbers must agree with golden ones.
    pub agreement: Agreement,
}

impl Study {
    /// Where a study leaves its results: `target/studies/<id>` of a package root.
    #[must_use]
    pub fn folder(&self, root: &std::path::Path) -> PathBuf {
        root.join("target").join("studies").join(self.id)
    }
}

/// Command line of a study binary.
#[derive(Parser, Debug, Clone, Default)]
#[command(disable_version_flag = true)]
pub struct Options {
    /// Evaluate the full ladders and full-size exhibits instead of the short ones.
    #[arg(long)]
    pub full: bool,
    /// Keep the results as golden files; the reason goes into golden/LOG.md.
    #[arg(long, value_name = "REASON")]
    pub bless: Option<String>,
    /// Only this claim, exhibit or mutant; may be repeated.
    #[arg(long, value_name = "ID")]
    pub only: Vec<String>,
    /// List claims, exhibits and mutants, and stop.
    #[arg(long)]
    pub list: bool,
    /// Rungs evaluated at the same time [default: all cores]. Timed exhibits always run alone.
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
}

impl Options {
    /// Depth of the ladders.
    #[must_use]
    pub fn depth(&self) -> Depth {
        if self.full { Depth::Full } else { Depth::Short }
    }

    /// Whether an id takes part.
    #[must_use]
    pub fn selects(&self, id: &str) -> bool {
        self.only.is_empty() || self.only.iter().any(|o| o == id)
    }
}

/// Runs a study from the command line.
///
/// Exit code 0: all claims hold, all mutants are caught, nothing differs from the golden files;
/// 1: something does not; 2: bad usage.
#[must_use]
pub fn main(study: &Study, backend: &dyn Backend) -> ExitCode {
    parse::<Options>().map_or_else(|code| code, |options| run(study, backend, &options))
}

/// The command line, or the code to leave with.
///
/// # Errors
/// 2 for bad usage, 0 when help was asked for.
pub fn parse<T: Parser>() -> Result<T, ExitCode> {
    T::try_parse().map_err(|error| {
        // Asking for help is not bad usage. A closed pipe is no reason to fail.
        let _ = error.print();
        if error.use_stderr() { ExitCode::from(2) } else { ExitCode::SUCCESS }
    })
}

/// Runs a study with options.
#[must_use]
pub fn run(study: &Study, backend: &dyn Backend, options: &Options) -> ExitCode {
    let known: Vec<&str> = ids(study).map(|(_, id, _)| id).collect();
    if let Some(unknown) = options.only.iter().find(|o| !known.contains(&o.as_str())) {
        eprintln!("error: study-{} has nothing called `{unknown}`; --list shows what it has", study.id);
        return ExitCode::from(2);
    }
    if let Some(Err(error)) = options.bless.as_deref().map(may_bless) {
        eprintln!("error: {error}");
        return ExitCode::from(2);
    }
    if options.list {
        for (what, id, title) in ids(study) {
            println!("{what:8} {id:40} {title}");
        }
        return ExitCode::SUCCESS;
    }
    ExitCode::from(u8::from(!execute(study, backend, options)))
}

fn ids(study: &Study) -> impl Iterator<Item = (&'static str, &'static str, &'static str)> {
    let claims = study.claims.iter().map(|c| ("claim", c.id, c.title));
    let exhibits = study.exhibits.iter().map(|e| ("exhibit", e.id, e.caption));
    claims.chain(exhibits).chain(study.mutants.iter().map(|m| ("mutant", m.id, m.description)))
}

/// Computes, prints, writes, and compares or blesses; true if all is well.
pub(crate) fn execute(study: &Study, backend: &dyn Backend, options: &Options) -> bool {
    let results = Results::compute(study, backend, options);
    print!("{}", table::render(study, &results));
    let root = package_root();
    let folder = study.folder(&root);
    if let Err(error) = files::write(study, &results, &folder) {
        eprintln!("error: {error}");
        return false;
    }
    println!("Records and figures are in {}.", folder.strip_prefix(&root).unwrap_or(&folder).display());
    let golden = Golden::here();
    let kept = match &options.bless {
        Some(reason) => bless::bless(study, &results, &golden, options, reason),
        None => bless::check(study, &results, &golden),
    };
    match kept {
        Ok(well) => well && results.passed(),
        Err(error) => {
            eprintln!("error: {error}");
            false
        }
    }
}
