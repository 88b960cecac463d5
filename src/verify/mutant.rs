//! Mutants: wrong variants, most of them misprints of the papers, that a named claim must catch.

use serde::{Deserialize, Serialize};

use super::claim::{Claim, Sample, VerifyError};
use super::evaluate::{Outcome, judge, rung};
use super::record::{Record, Verdict, number};
use crate::solver::run::Backend;

/// A wrong variant.
#[derive(Clone, Copy)]
pub struct Mutant {
    /// Unique among claims, exhibits and mutants, kebab-case.
    pub id: &'static str,
    /// Entry of the errata it codes, or the design rule it breaks: `ERRATA 14 (000 Eq 10)`.
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
    /// Whether it did.
    pub caught: bool,
    /// Error of the mutant at its rung, or its largest one; NaN without a result.
    #[serde(with = "number")]
    pub error: f64,
    /// The claim's tolerance.
    #[serde(with = "number")]
    pub tolerance: f64,
    /// How it was caught or why it escaped, in words.
    pub how: String,
}

/// Puts a mutant before the claim that must catch it.
#[must_use]
pub fn evaluate(mutant: &Mutant, claim: &Claim, backend: &dyn Backend) -> MutantRecord {
    let mut claim = *claim;
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
    let one;
    let rungs: &[f64] = match mutant.rung {
        Some(parameter) => {
            one = [parameter];
            claim.order = None;
            &one
        }
        None => claim.ladder.short,
    };
    let outcomes: Vec<Outcome> = rungs.iter().map(|&p| rung(&claim, subject, p)).collect();
    let record = judge(&claim, &outcomes);
    let (caught, how) = detection(&claim, &outcomes, &record);
    let largest = |m: f64, e: f64| if e <= m { m } else { e };
    MutantRecord {
        mutant: mutant.id.to_owned(),
        erratum: mutant.erratum.to_owned(),
        description: mutant.description.to_owned(),
        caught_by: mutant.caught_by.to_owned(),
        caught,
        error: record.samples.iter().map(|s| s.error).reduce(largest).unwrap_or(f64::NAN),
        tolerance: claim.tolerance.value,
        how,
    }
}

/// A mutant that cannot be started at all is not caught: nothing was measured. Nor is one whose
/// rung the tolerance does not cover.
fn detection(claim: &Claim, outcomes: &[Outcome], record: &Record) -> (bool, String) {
    let refused = outcomes.iter().find_map(|o| match &o.result {
        Err(error @ VerifyError::Start(_)) => Some(error.to_string()),
        _ => None,
    });
    if let Some(why) = refused {
        return (false, format!("not measured: {why}"));
    }
    let last = outcomes.last().map_or(f64::NAN, |o| o.parameter);
    if !outcomes.iter().any(|o| claim.tolerance.at.covers(o.parameter, last)) {
        return (false, "the claim's tolerance does not apply to this rung".to_owned());
    }
    match &record.verdict {
        Verdict::Fail { reasons } => (true, reasons.join("; ")),
        Verdict::Pass => (false, "the claim passes in spite of the mistake".to_owned()),
    }
}
