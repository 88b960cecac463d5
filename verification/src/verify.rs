//! `verify`: whether golden files are what was blessed, which of them are older than their code, and all of them computed again.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use std::process::ExitCode;

use clap::Parser;

use crate::claims::studies;
use crate::format::table;
use crate::golden::age::changed_since;
use crate::golden::seals::{files, key};
use crate::golden::{Breach, Golden, GoldenError, Seals, may_bless, package_root};
use crate::study::{self, Study};
use lahar::solver::run::Backend;

/// Looks at golden files: whether they are what was blessed, and which are older than the code that makes them.
#[derive(Parser, Debug, Clone)]
#[command(
    name = "verify",
    disable_version_flag = true,
    after_help = "Exit codes: 0 as blessed, 1 something is not, 2 bad usage, 4 input or output failed."
)]
struct Options {
    /// Compute everything again, on full ladders and at full size, and compare: hours to days.
    #[arg(long)]
    full: bool,
    /// Only this study; may be repeated.
    #[arg(long, value_name = "ID")]
    study: Vec<String>,
    /// Name every file that is older than its code, not only how many there are.
    #[arg(long)]
    list: bool,
    /// Rungs evaluated at the same time [default: all cores].
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Seal golden files as they are, without computing anything or writing a number: after a merge. The reason goes into
    /// golden/LOG.md.
    #[arg(long, value_name = "REASON", conflicts_with = "full")]
    stamp: Option<String>,
}

/// The binary.
#[must_use]
pub fn main(backend: &dyn Backend) -> ExitCode {
    let options: Options = match study::parse() {
        Ok(options) => options,
        Err(code) => return code,
    };
    if let Some(unknown) = options.study.iter().find(|id| !studies().iter().any(|s| s.id == **id)) {
        let _ = writeln!(std::io::stderr(), "error: there is no study `{unknown}`");
        return ExitCode::from(2);
    }
    if let Some(Err(error)) = options.stamp.as_deref().map(may_bless) {
        let _ = writeln!(std::io::stderr(), "error: {error}");
        return ExitCode::from(2);
    }
    let done = match &options.stamp {
        Some(reason) => stamp(&Golden::here(), reason),
        None => look(backend, &options),
    };
    match done {
        Ok(well) => ExitCode::from(u8::from(!well)),
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "error: {error}");
            ExitCode::from(4)
        }
    }
}

fn say(text: &str) {
    // Nobody may be reading.
    let _ = writeln!(std::io::stdout(), "{text}");
}

/// Seals, ages, and if wanted everything again; true if all is as blessed.
fn look(backend: &dyn Backend, options: &Options) -> Result<bool, GoldenError> {
    let golden = Golden::here();
    let seals = golden.seals()?;
    let breaches = seals.breaches(&golden, studies())?;
    breaches.iter().for_each(|(key, breach)| say(&format!("golden/{key} {breach}")));
    say(&format!("{} golden files, {} of them not as blessed.\n", seals.0.len(), breaches.len()));
    let is_chosen = |s: &Study| options.study.is_empty() || options.study.iter().any(|id| id == s.id);
    let chosen: Vec<&Study> = studies().iter().copied().filter(|study| is_chosen(study)).collect();
    say(&ages(&package_root(), &chosen, &seals, options.list));
    let mut well = breaches.is_empty();
    if options.full {
        let all = study::Options { full: true, threads: options.threads, ..study::Options::default() };
        for study in chosen {
            say(&format!("study-{}", study.id));
            well &= study::execute(study, backend, &all);
        }
    }
    Ok(well)
}

/// A table of the studies with the golden files that are older than their code.
fn ages(root: &Path, chosen: &[&Study], seals: &Seals, list: bool) -> String {
    let (mut rows, mut names) = (Vec::new(), String::new());
    for study in chosen {
        let mut known: BTreeMap<&str, Option<Vec<String>>> = BTreeMap::new();
        let (mut all, mut old, mut unknown, mut first) = (0, 0, 0, "–");
        for (shelf, id) in files(study) {
            let Some(seal) = seals.0.get(&key(shelf, id)) else { continue };
            all += 1;
            first = if first == "–" || seal.date.as_str() < first { &seal.date } else { first };
            let revision = seal.revision.as_deref();
            let changed = revision.map(|r| known.entry(r).or_insert_with(|| changed_since(root, study, r)));
            match changed.and_then(|changed| changed.as_ref()) {
                None => unknown += 1,
                Some(changed) if changed.is_empty() => {}
                Some(changed) => {
                    old += 1;
                    let (key, date, revision) = (key(shelf, id), &seal.date, revision.unwrap_or("?"));
                    let _ = writeln!(
                        names,
                        "{key}: of {date}, revision {revision}; {} files of its code have changed since",
                        changed.len()
                    );
                }
            }
        }
        let counts = [all, old, unknown].map(|n: u32| n.to_string());
        rows.push([vec![study.id.to_owned()], counts.to_vec(), vec![first.to_owned()]].concat());
    }
    let mut out = String::new();
    table(
        &mut out,
        &["study", "golden files", "older than their code", "of unknown age", "oldest of"],
        &rows,
    );
    out + "A file is older than its code if anything has changed in it, words included: the gate computes the short ladders \
           of all of them, `--full` the rest.\n"
        + if list { &names } else { "" }
}

/// Seals what is there, and logs what had no seal or another one; true.
fn stamp(golden: &Golden, reason: &str) -> Result<bool, GoldenError> {
    let found = golden.stamp(studies())?;
    let sealed = |(key, breach): &(String, Breach)| match breach {
        Breach::Changed => Some(format!("- `{key}`: sealed as it is; it was not computed here")),
        Breach::Missing => Some(format!("- `{key}`: gone")),
        Breach::Undeclared | Breach::Unsealed => None,
    };
    let mut lines: Vec<String> = found.iter().filter_map(sealed).collect();
    let first = found.iter().filter(|(_, breach)| *breach == Breach::Unsealed).count();
    if first > 0 {
        lines.push(format!("- {first} files sealed for the first time; no number changed"));
    }
    golden.log_change("verify --stamp", reason, &lines)?;
    lines.iter().for_each(|line| say(line));
    Ok(found.iter().all(|(key, breach)| {
        let undeclared = *breach == Breach::Undeclared;
        if undeclared {
            say(&format!("golden/{key} {breach}: remove it"));
        }
        !undeclared
    }))
}
