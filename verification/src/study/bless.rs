//! Compares the results of a study with the golden files, or makes them golden.

use std::fmt::Write as _;

use super::{Options, Results, Study};
use crate::golden::{
    Difference, Evaluation, Golden, GoldenError, Shelf, compare, compare_exhibits, compare_mutants, merge,
    revision, today, write,
};
use lahar::output::atomic;

/// What differs from the golden files, by id.
fn differences(study: &Study, results: &Results, golden: &Golden) -> Result<Vec<Change>, GoldenError> {
    let agreement = study.agreement;
    let mut all = Vec::new();
    for (claim, record) in &results.records {
        let old = golden.record(claim.id)?;
        all.push(Change::new(claim.id, old.map(|old| compare(record, &old, agreement))));
    }
    for (exhibit, record) in &results.exhibits {
        let Ok(record) = record else { continue };
        let old = golden.exhibit(exhibit.id, exhibit.timed)?;
        let compared = |old: crate::exhibit::ExhibitRecord| {
            // Timings never repeat, and the short form of an exhibit is not the full one.
            let comparable = !exhibit.timed && old.full == record.full;
            if comparable { compare_exhibits(&record.data, &old.data, agreement) } else { Vec::new() }
        };
        all.push(Change::new(exhibit.id, old.map(compared)));
    }
    for (mutant, record) in &results.mutants {
        let old = golden.mutant(mutant.id)?;
        all.push(Change::new(mutant.id, old.map(|old| compare_mutants(record, &old, agreement))));
    }
    Ok(all)
}

/// How one result relates to its golden file.
struct Change {
    id: &'static str,
    /// `None`: there is no golden file.
    differences: Option<Vec<Difference>>,
}

impl Change {
    fn new(id: &'static str, differences: Option<Vec<Difference>>) -> Self {
        Self { id, differences }
    }

    /// The line of the log; `None` if nothing changed.
    fn line(&self) -> Option<String> {
        let Some(differences) = &self.differences else { return Some(format!("- `{}`: new", self.id)) };
        let worst = worst(differences.iter()).or(differences.first())?;
        // A residual of rounding may change by any factor; what was computed is named beside it.
        let computed = worst_computed(differences).filter(|d| *d != worst);
        let computed = computed.map_or_else(String::new, |d| format!("; of what was computed, {d}"));
        Some(format!("- `{}`: {} places, worst {worst}{computed}", self.id, differences.len()))
    }
}

/// The largest relative change.
fn worst<'a>(differences: impl Iterator<Item = &'a Difference>) -> Option<&'a Difference> {
    let numbers = differences.filter(|d| d.relative.is_finite());
    numbers.max_by(|a, b| a.relative.total_cmp(&b.relative))
}

/// The largest relative change of a number that a claim compares with its reference.
fn worst_computed(differences: &[Difference]) -> Option<&Difference> {
    worst(differences.iter().filter(|d| d.place.ends_with(", computed")))
}

/// Compares; prints what differs and what is missing. True if nothing differs.
pub(super) fn check(study: &Study, results: &Results, golden: &Golden) -> Result<bool, GoldenError> {
    let mut well = true;
    for Change { id, differences } in differences(study, results, golden)? {
        match differences {
            None => println!("{id}: no golden file yet; --bless REASON makes one"),
            Some(differences) => {
                well &= differences.is_empty();
                for difference in differences {
                    println!("GOLDEN {id}: {difference}");
                }
            }
        }
    }
    Ok(well)
}

/// Makes the results golden and logs what changed. Nothing is written unless everything passed.
pub(super) fn bless(
    study: &Study,
    results: &Results,
    golden: &Golden,
    options: &Options,
    reason: &str,
) -> Result<bool, GoldenError> {
    if let Some(id) = results.first_failure() {
        return Err(GoldenError::NotPassed { id: id.to_owned() });
    }
    let changes = differences(study, results, golden)?;
    let mut records = Vec::new();
    for (claim, record) in &results.records {
        let old = golden.record(claim.id)?;
        records.push((claim.id, merge(claim, record, old.as_ref(), study.agreement)?));
    }
    let mut evaluations = golden.evaluations()?;
    for (id, record) in records {
        write(&golden.path(Shelf::Records, id), &record)?;
        evaluations.0.insert(id.to_owned(), Evaluation::now(options.depth()));
    }
    write(&golden.evaluated(), &evaluations)?;
    let mut grown = Vec::new();
    for (exhibit, record) in &results.exhibits {
        let Ok(record) = record else { continue };
        let old = golden.exhibit(exhibit.id, exhibit.timed)?;
        if record.full && old.as_ref().is_some_and(|old| !old.full) {
            grown.push(format!("- `{}`: full size instead of its short form", exhibit.id));
        }
        // A short form does not replace a full one.
        if record.full || old.is_none_or(|old| !old.full) {
            let shelf = if exhibit.timed { Shelf::Measured } else { Shelf::Exhibits };
            write(&golden.path(shelf, exhibit.id), record)?;
        }
    }
    for (mutant, record) in &results.mutants {
        write(&golden.path(Shelf::Mutants, mutant.id), record)?;
    }
    let lines: Vec<String> = changes.iter().filter_map(Change::line).chain(grown).collect();
    log(study, golden, options, reason, &lines)?;
    println!("Blessed; {} of {} results new or changed.", lines.len(), changes.len());
    Ok(true)
}

fn log(
    study: &Study,
    golden: &Golden,
    options: &Options,
    reason: &str,
    lines: &[String],
) -> Result<(), GoldenError> {
    let path = golden.log();
    let head = "# Log of golden files\n\nEvery change of a golden record, with its reason; newest last.\n";
    let mut text = match std::fs::read_to_string(&path) {
        Ok(text) => text,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => head.to_owned(),
        Err(source) => return Err(GoldenError::Read { path, source }),
    };
    let full = if options.full { " --full" } else { "" };
    let reason = reason.split_whitespace().collect::<Vec<_>>().join(" ");
    let after = revision().map_or_else(String::new, |r| format!(", after revision {r}"));
    let _ = write!(text, "\n## {}{after}: study-{}{full}\n\n{reason}\n\n", today(), study.id);
    if lines.is_empty() {
        text.push_str("- no number changed\n");
    }
    for line in lines {
        let _ = writeln!(text, "{line}");
    }
    Ok(atomic::write(&path, text.as_bytes())?)
}
