//! A claim: one checkable statement about the physics, declared once and used by
//! `cargo test` (short ladder), the study binaries (full ladder) and `REPORT.md`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use lahar::output::number;
use lahar::solver::run::{Backend, StartError, Stopped};
use lahar::solver::steady::SteadyOutcome;

/// One checkable statement.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// Unique, kebab-case: `poiseuille-bingham-l2`.
    pub id: &'static str,
    /// One sentence, as a heading of the report.
    pub title: &'static str,
    /// Tags of docs/method.md that it checks: `["L5", "Y3"]`, and paper equations: `["004 Eq 3.55"]`.
    pub tags: &'static [&'static str],
    /// What is measured, with its unit or normalisation.
    pub measures: &'static str,
    /// What it is compared with.
    pub reference: Reference,
    /// How a rung's error is formed.
    pub metric: Metric,
    /// The rungs.
    pub ladder: Ladder,
    /// Expected order of convergence in 1/parameter, if the claim is about one.
    pub order: Option<OrderBand>,
    /// Largest accepted error.
    pub tolerance: Tolerance,
    /// Verification, validation, or a failure that theory predicts.
    pub kind: Kind,
    /// Computes one rung.
    pub measure: fn(&dyn Backend, f64) -> Result<Sample, VerifyError>,
}

/// Where the truth comes from. Never lahar itself.
#[derive(Clone, Copy, Debug)]
pub struct Reference {
    /// Formula, table or paper, in words a reader can follow.
    pub source: &'static str,
    /// The reference's own relative uncertainty; 0 for a formula.
    pub uncertainty: f64,
}

/// How the error of a rung is formed (information for the report; `measure` computes it).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Metric {
    /// Relative L2 norm over cells.
    L2,
    /// Relative largest difference over cells.
    LInf,
    /// |computed − reference| / |reference| of one number.
    Relative,
    /// |computed − reference| of one number.
    Absolute,
}

/// The values of the ladder parameter.
#[derive(Clone, Copy, Debug)]
pub struct Ladder {
    /// Name and unit: `"N (cells across)"`, `"tau"`.
    pub parameter: &'static str,
    /// For the gate (`cargo test`).
    pub short: &'static [f64],
    /// For the study binary with `--full`.
    pub full: &'static [f64],
}

/// Expected order: error ∝ parameter^(−order).
#[derive(Clone, Copy, Debug)]
pub struct OrderBand {
    /// Expected order.
    pub expected: f64,
    /// Accepted deviation, both sides. Infinite on the high side is written `at_least`.
    pub band: f64,
    /// Only a lower bound: order ≥ expected − band.
    pub at_least: bool,
}

/// Largest accepted error and the reason for it.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Bound on the rung's error.
    pub value: f64,
    /// Which rungs it applies to.
    pub at: Rung,
    /// What it stands on.
    pub basis: Basis,
    /// A rounding bound, a scheme constant times Δx^p, or the reference's uncertainty.
    pub because: &'static str,
}

/// What a tolerance stands on. Where it is in doubt, it is [`Basis::AfterSeeing`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// It follows from rounding, from the known error of the scheme or from what a theory leaves out; no
    /// number of it was read off a run of lahar.
    Derived,
    /// It comes with the reference: its digits, its scatter, or the bound that a hard case asked for before
    /// anything was measured.
    Reference,
    /// A number of it was read off runs of lahar, or was chosen without a derivation. It shows that the
    /// error stays where it was found, not that it is as small as theory wants it.
    AfterSeeing,
}

/// Which rungs a tolerance applies to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rung {
    /// Every rung.
    Every,
    /// The finest (last) rung.
    Last,
    /// The rung with this parameter; must be in the short ladder.
    At(f64),
}

/// What sort of statement a claim is; the report keeps them in separate chapters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Against mathematics.
    Verification,
    /// Against experiment.
    Validation,
    /// A failure or model error that theory predicts in numbers.
    PredictedFailure,
}

/// One rung's result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// The rung.
    #[serde(with = "number")]
    pub parameter: f64,
    /// Measured number (or norm of the measured field).
    #[serde(with = "number")]
    pub computed: f64,
    /// Reference number (or norm of the reference field).
    #[serde(with = "number")]
    pub reference: f64,
    /// The error in the claim's metric.
    #[serde(with = "number")]
    pub error: f64,
    /// Further numbers worth a column, by name with unit. Bit-compared with the golden record
    /// like the rest: no wall-clock times here.
    #[serde(default, with = "number::map", skip_serializing_if = "BTreeMap::is_empty")]
    pub extra: BTreeMap<String, f64>,
}

impl Sample {
    /// One number against its reference, \|computed − reference\| / \|reference\|.
    #[must_use]
    pub fn relative(parameter: f64, computed: f64, reference: f64) -> Self {
        let error = (computed - reference).abs() / reference.abs();
        Self { parameter, computed, reference, error, extra: BTreeMap::new() }
    }

    /// One number against its reference, \|computed − reference\|.
    #[must_use]
    pub fn absolute(parameter: f64, computed: f64, reference: f64) -> Self {
        Self { parameter, computed, reference, error: (computed - reference).abs(), extra: BTreeMap::new() }
    }

    /// A field against its reference, ‖computed − reference‖₂ / ‖reference‖₂; `computed` and
    /// `reference` become the root mean squares. Fields of different length give a NaN error.
    #[must_use]
    pub fn l2(parameter: f64, computed: &[f64], reference: &[f64]) -> Self {
        let squares = |v: &[f64]| v.iter().fold(0.0, |s, x| s + x * x);
        let differences = computed.iter().zip(reference).fold(0.0, |s, (a, b)| s + (a - b) * (a - b));
        let same = computed.len() == reference.len();
        let error = if same { (differences / squares(reference)).sqrt() } else { f64::NAN };
        let mean = |v: &[f64]| (squares(v) / v.len() as f64).sqrt();
        Self {
            parameter,
            computed: mean(computed),
            reference: mean(reference),
            error,
            extra: BTreeMap::new(),
        }
    }

    /// A field against its reference, max\|computed − reference\| / max\|reference\|; `computed` and
    /// `reference` become the largest absolute values. Fields of different length give a NaN error.
    #[must_use]
    pub fn linf(parameter: f64, computed: &[f64], reference: &[f64]) -> Self {
        // A NaN anywhere must end in a NaN error, so the comparison lets it through.
        let greatest = |m: f64, x: f64| if x.abs() <= m { m } else { x.abs() };
        let largest = |v: &[f64]| v.iter().fold(0.0, |m, &x| if f64::is_nan(m) { m } else { greatest(m, x) });
        let differences: Vec<f64> = computed.iter().zip(reference).map(|(a, b)| a - b).collect();
        let same = computed.len() == reference.len();
        let error = if same { largest(&differences) / largest(reference) } else { f64::NAN };
        Self {
            parameter,
            computed: largest(computed),
            reference: largest(reference),
            error,
            extra: BTreeMap::new(),
        }
    }

    /// Adds a further number, named with its unit.
    #[must_use]
    pub fn with(mut self, name: &str, value: f64) -> Self {
        self.extra.insert(name.to_owned(), value);
        self
    }
}

/// Why a claim could not be evaluated.
#[derive(Clone, Debug, thiserror::Error)]
pub enum VerifyError {
    /// The backend refused the set-up.
    #[error("could not start: {0}")]
    Start(#[from] StartError),
    /// A guard stopped the run.
    #[error("stopped at step {} in cell {:?}: {:?}", .0.step, .0.cell, .0.what)]
    Stopped(Stopped),
    /// A fit or an iteration failed.
    #[error("{what} did not work out: {detail}")]
    Numerics { what: &'static str, detail: String },
    /// The run did not become steady.
    #[error("after {steps} steps, with a tolerance of {wanted:.0e}: {found}")]
    NotSteady { steps: u64, wanted: f64, found: String },
    /// Grains were refused, or a guard stopped them.
    #[error("grains: {0}")]
    Grains(#[from] lahar::dem::DemError),
}

impl VerifyError {
    /// Of an attempt that ended too early.
    pub fn not_steady(outcome: &SteadyOutcome, wanted: f64) -> Self {
        Self::NotSteady { steps: outcome.steps, wanted, found: outcome.to_string() }
    }
}

impl From<Stopped> for VerifyError {
    fn from(stopped: Stopped) -> Self {
        Self::Stopped(stopped)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn norms_of_known_fields() {
        let s = Sample::l2(1.0, &[3.0, 5.0], &[3.0, 4.0]);
        assert_eq!((s.error, s.reference), (0.2, 12.5_f64.sqrt()));
        assert_eq!(Sample::linf(1.0, &[3.0, -5.0], &[3.0, -4.0]).error, 0.25);
        assert_eq!(Sample::relative(1.0, -1.5, -2.0).error, 0.25);
        assert_eq!(Sample::absolute(1.0, -1.5, -2.0).error, 0.5);
    }

    #[test]
    fn nan_and_unequal_lengths_never_look_right() {
        for field in [[f64::NAN, 1.0], [1.0, f64::NAN]] {
            assert!(Sample::linf(1.0, &field, &[1.0, 1.0]).error.is_nan());
            assert!(Sample::l2(1.0, &field, &[1.0, 1.0]).error.is_nan());
        }
        assert!(Sample::l2(1.0, &[1.0], &[1.0, 1.0]).error.is_nan());
        assert!(Sample::linf(1.0, &[1.0], &[1.0, 1.0]).error.is_nan());
    }
}
