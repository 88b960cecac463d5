//! Compares the results of a study with the golden files, or makes them golden.

use super::{Options, Results, Study};
use crate::golden::{
    Difference, Evaluation, Golden, GoldenError, Shelf, compare, compare_exhibits, compare_mutants, merge,
    write,
};

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
    ///
    /// The physical quantity comes first: what the claim compares with its reference, then its error, then all else, each by its
    /// change over the size of the quantity. A residual of rounding, which may change by any factor, is not what changed.
    fn line(&self) -> Option<String> {
        let Some(differences) = &self.differences else { return Some(format!("- `{}`: new", self.id)) };
        let ending = |what: &str| largest(differences.iter().filter(|d| d.place.ends_with(what)));
        let first =
            ending(", computed").or_else(|| ending(", error")).or_else(|| largest(differences.iter()));
        let first = first.or(differences.first())?;
        let size = if first.scaled <= ROUNDING { ", rounding" } else { "" };
        let places = differences.len();
        let others = if places == 1 { String::new() } else { format!("; {places} places in all") };
        Some(format!("- `{}`: {first}{size}{others}", self.id))
    }
}

/// Changes up to this, over the size of the quantity, are called rounding in the log: some thousand operations of 1.1e-16 each.
const ROUNDING: f64 = 1e-12;

/// The largest change over the size of its quantity.
fn largest<'a>(differences: impl Iterator<Item = &'a Difference>) -> Option<&'a Difference> {
    let numbers = differences.filter(|d| d.scaled.is_finite());
    numbers.max_by(|a, b| a.scaled.total_cmp(&b.scaled))
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
    let mut written = Vec::new();
    for (id, record) in records {
        write(&golden.path(Shelf::Records, id), &record)?;
        evaluations.0.insert(id.to_owned(), Evaluation::now(options.depth()));
        written.push((Shelf::Records, id));
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
            written.push((shelf, exhibit.id));
        }
    }
    for (mutant, record) in &results.mutants {
        write(&golden.path(Shelf::Mutants, mutant.id), record)?;
        written.push((Shelf::Mutants, mutant.id));
    }
    let mut seals = golden.seals()?;
    for (shelf, id) in written {
        seals.seal(golden, &evaluations, shelf, id)?;
    }
    write(&golden.seals_file(), &seals)?;
    let lines: Vec<String> = changes.iter().filter_map(Change::line).chain(grown).collect();
    let full = if options.full { " --full" } else { "" };
    golden.log_change(&format!("study-{}{full}", study.id), reason, &lines)?;
    println!("Blessed; {} of {} results new or changed.", lines.len(), changes.len());
    Ok(true)
}
