//! Mutants: wrong variants, most of them misprints of the papers, that a named claim must catch.

use serde::{Deserialize, Serialize};

use super::claim::{Claim, Sample, VerifyError};
use super::evaluate::{Outcome, judge, rung};
use super::record::{Record, Verdict};
use lahar::output::number;
use lahar::solver::run::Backend;

/// A wrong variant.
#[derive(Clone, Copy)]
pub struct Mutant {
    /// Unique among claims, exhibits and mutants, kebab-case.
    pub id: &'static str,
    /// Entry of the errata it codes, or the rule of the method it breaks: `ERRATA 14 (000 Eq 10)`.
    pub erratum: &'static str,
    /// What is wrong in it, in a sentence.
    pub description: &'static str,
    /// Id of the claim that must fail.
    pub caught_by: &'static str,
    /// The rung at which it must fail its tolerance; `None`: the whole short ladder with its order.
    pub rung: Option<f64>,
    /// The wrong variant itself.
    pub subject: Subject,
}

/// Where the mistake sits.
#[derive(Clone, Copy)]
pub enum Subject {
    /// A solver with the mistake; the claim's own measurement runs on it.
    Backend(fn() -> Box<dyn Backend>),
    /// A formula with the mistake: stands in for the claim's measurement, on the honest backend.
    Measure(fn(&dyn Backend, f64) -> Result<Sample, VerifyError>),
}

/// What gives a mutant away.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Detection {
    /// An error above the tolerance.
    Error,
    /// An order outside its band, with all errors within their tolerance.
    Order,
    /// No number at all: a guard stopped the run, or it did not settle.
    NoResult,
    /// Nothing: the mutant escapes.
    Escaped,
}

/// What came of a mutant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MutantRecord {
    /// Id of the mutant.
    pub mutant: String,
    /// Entry of the errata.
    pub erratum: String,
    /// What is wrong in it.
    pub description: String,
    /// The claim that must fail.
    pub caught_by: String,
    /// Whether it did, while the honest claim holds.
    pub caught: bool,
    /// What gave it away.
    pub detection: Detection,
    /// Error of the mutant at its rung, or its largest one; NaN without a result.
    #[serde(with = "number")]
    pub error: f64,
    /// The claim's tolerance.
    #[serde(with = "number")]
    pub tolerance: f64,
    /// How it was caught or why it escaped, in words.
    pub how: String,
}

/// Puts a mutant before the claim that must catch it. The honest claim is evaluated at the same
/// rungs: a claim that fails anyway detects nothing.
#[must_use]
pub fn evaluate(mutant: &Mutant, claim: &Claim, backend: &dyn Backend) -> MutantRecord {
    let control: Vec<Outcome> = rungs(mutant, claim).iter().map(|&p| rung(claim, backend, p)).collect();
    confirm(uncontrolled(mutant, claim, backend), mutant, claim, &control)
}

/// Withdraws a detection when the honest claim, with these outcomes at the mutant's [`rungs`], fails
/// as well.
#[must_use]
pub fn confirm(record: MutantRecord, mutant: &Mutant, claim: &Claim, control: &[Outcome]) -> MutantRecord {
    match judge(&at_rungs(mutant, claim), control).verdict {
        Verdict::Pass => record,
        Verdict::Fail { reasons } => MutantRecord {
            caught: false,
            detection: Detection::Escaped,
            how: format!("the honest claim fails as well: {}", reasons.join("; ")),
            ..record
        },
    }
}

/// The rungs at which a mutant is tried.
#[must_use]
pub fn rungs(mutant: &Mutant, claim: &Claim) -> Vec<f64> {
    mutant.rung.map_or_else(|| claim.ladder.short.to_vec(), |parameter| vec![parameter])
}

/// The claim as it is judged for a mutant: a single rung has no order.
fn at_rungs(mutant: &Mutant, claim: &Claim) -> Claim {
    if mutant.rung.is_some() { Claim { order: None, ..*claim } } else { *claim }
}

/// Puts a mutant before the claim that must catch it, without the control: for where the honest claim is
/// evaluated beside it.
#[must_use]
pub fn uncontrolled(mutant: &Mutant, claim: &Claim, backend: &dyn Backend) -> MutantRecord {
    let mut claim = at_rungs(mutant, claim);
    let held;
    let subject: &dyn Backend = match mutant.subject {
        Subject::Backend(make) => {
            held = make();
            &*held
        }
        Subject::Measure(measure) => {
            claim.measure = measure;
            backend
        }
    };
    let outcomes: Vec<Outcome> = rungs(mutant, &claim).iter().map(|&p| rung(&claim, subject, p)).collect();
    let record = judge(&claim, &outcomes);
    let (detection, how) = detect(&claim, &outcomes, &record);
    let largest = |m: f64, e: f64| if e <= m { m } else { e };
    MutantRecord {
        mutant: mutant.id.to_owned(),
        erratum: mutant.erratum.to_owned(),
        description: mutant.description.to_owned(),
        caught_by: mutant.caught_by.to_owned(),
        caught: detection != Detection::Escaped,
        detection,
        error: record.samples.iter().map(|s| s.error).reduce(largest).unwrap_or(f64::NAN),
        tolerance: claim.tolerance.value,
        how,
    }
}

/// A mutant that cannot be started at all is not caught: nothing was measured. Nor is one whose
/// rung the tolerance does not cover.
fn detect(claim: &Claim, outcomes: &[Outcome], record: &Record) -> (Detection, String) {
    let refused = outcomes.iter().find_map(|o| match &o.result {
        Err(error @ VerifyError::Start(_)) => Some(error.to_string()),
        _ => None,
    });
    if let Some(why) = refused {
        return (Detection::Escaped, format!("not measured: {why}"));
    }
    let last = outcomes.last().map_or(f64::NAN, |o| o.parameter);
    let covered = |parameter: f64| claim.tolerance.at.covers(parameter, last);
    if !outcomes.iter().any(|o| covered(o.parameter)) {
        return (Detection::Escaped, "the claim's tolerance does not apply to this rung".to_owned());
    }
    let Verdict::Fail { reasons } = &record.verdict else {
        return (Detection::Escaped, "the claim passes in spite of the mistake".to_owned());
    };
    let within = |s: &Sample| s.error <= claim.tolerance.value;
    let detection = if record.samples.iter().any(|s| covered(s.parameter) && !within(s)) {
        Detection::Error
    } else if record.failed.is_empty() {
        Detection::Order
    } else {
        Detection::NoResult
    };
    (detection, reasons.join("; "))
}
