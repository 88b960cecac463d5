//! Runs a claim and judges the outcome.

use super::claim::{Claim, Metric, Sample, VerifyError};
use super::ladder::{Depth, symbol};
use super::order;
use super::record::{FailedRung, OrderRecord, Record, ToleranceRecord, Verdict};
use lahar::solver::run::Backend;

/// What came of one rung.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The rung.
    pub parameter: f64,
    /// Its sample, or why there is none.
    pub result: Result<Sample, VerifyError>,
}

/// Evaluates one rung.
#[must_use]
pub fn rung(claim: &Claim, backend: &dyn Backend, parameter: f64) -> Outcome {
    Outcome { parameter, result: (claim.measure)(backend, parameter) }
}

/// Evaluates the rungs of a depth one after the other and judges them.
#[must_use]
pub fn evaluate(claim: &Claim, backend: &dyn Backend, depth: Depth) -> Record {
    let outcomes: Vec<Outcome> =
        claim.ladder.rungs(depth).iter().map(|&parameter| rung(claim, backend, parameter)).collect();
    judge(claim, &outcomes)
}

/// Judges the outcomes of a ladder: tolerance, order, rungs without result.
#[must_use]
pub fn judge(claim: &Claim, outcomes: &[Outcome]) -> Record {
    let mut reasons = Vec::new();
    let mut samples = Vec::new();
    let mut failed = Vec::new();
    for Outcome { parameter, result } in outcomes {
        match result {
            Ok(sample) => samples.push(sample.clone()),
            Err(error) => {
                let place = format!("{} = {parameter}", claim.ladder.symbol());
                reasons.push(format!("{place} gave no result: {error}"));
                failed.push(FailedRung { parameter: *parameter, why: error.to_string() });
            }
        }
    }
    let last = outcomes.last().map_or(f64::NAN, |o| o.parameter);
    let slack = check_tolerance(claim, &samples, &failed, last, &mut reasons);
    let order = check_order(claim, &samples, &mut reasons);
    Record {
        claim: claim.id.to_owned(),
        title: claim.title.to_owned(),
        tags: claim.tags.iter().map(|&t| t.to_owned()).collect(),
        kind: claim.kind,
        measures: claim.measures.to_owned(),
        reference: claim.reference.source.to_owned(),
        reference_uncertainty: claim.reference.uncertainty,
        metric: claim.metric,
        parameter: claim.ladder.parameter.to_owned(),
        samples,
        failed,
        order,
        tolerance: ToleranceRecord {
            value: claim.tolerance.value,
            applies_to: claim.tolerance.at.describe(&claim.ladder),
            because: claim.tolerance.because.to_owned(),
        },
        slack,
        verdict: if reasons.is_empty() { Verdict::Pass } else { Verdict::Fail { reasons } },
    }
}

/// Least tolerance / error; adds a reason for every rung above the tolerance (a NaN is above).
fn check_tolerance(
    claim: &Claim,
    samples: &[Sample],
    failed: &[FailedRung],
    last: f64,
    reasons: &mut Vec<String>,
) -> f64 {
    let bound = claim.tolerance.value;
    let mut slack = f64::INFINITY;
    let mut judged = 0;
    for sample in samples.iter().filter(|s| claim.tolerance.at.covers(s.parameter, last)) {
        judged += 1;
        let within = sample.error <= bound;
        if !within {
            let place = format!("{} = {}", claim.ladder.symbol(), sample.parameter);
            reasons.push(format!("{place}: error {:.3e} exceeds the tolerance {bound:.3e}", sample.error));
        }
        // 0/0 means no error against a zero tolerance: nothing is exceeded.
        let room = if sample.error == 0.0 { f64::INFINITY } else { bound / sample.error };
        slack = if room < slack || room.is_nan() { room } else { slack };
    }
    if judged == 0 {
        slack = f64::NAN;
    }
    // A covered rung without result has its own reason already.
    if judged == 0 && !failed.iter().any(|f| claim.tolerance.at.covers(f.parameter, last)) {
        reasons.push(format!("no rung for the tolerance ({})", claim.tolerance.at.describe(&claim.ladder)));
    }
    slack
}

fn check_order(claim: &Claim, samples: &[Sample], reasons: &mut Vec<String>) -> Option<OrderRecord> {
    let band = claim.order?;
    let points: Vec<(f64, f64)> = samples.iter().map(|s| (s.parameter, s.error)).collect();
    let fitted = match order::fit(&points) {
        Ok(fitted) => fitted,
        Err(error) => {
            reasons.push(format!("no order of convergence: {error}"));
            return None;
        }
    };
    let within = if band.at_least {
        fitted.order >= band.expected - band.band
    } else {
        (fitted.order - band.expected).abs() <= band.band
    };
    if !within {
        let sign = if band.at_least { "at least " } else { "" };
        reasons.push(format!(
            "order {:.3} in {}, expected {sign}{} ± {}",
            fitted.order,
            symbol(claim.ladder.parameter),
            band.expected,
            band.band
        ));
    }
    let scalar = matches!(claim.metric, Metric::Relative | Metric::Absolute);
    let values: Vec<(f64, f64)> = samples.iter().map(|s| (s.parameter, s.computed)).collect();
    let richardson = if scalar { order::richardson(&values, fitted.order) } else { None };
    let record =
        OrderRecord { expected: band.expected, band: band.band, at_least: band.at_least, fitted, richardson };
    Some(record)
}
