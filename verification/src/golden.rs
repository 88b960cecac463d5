//! Golden files: results kept under version control and compared with every later one.
//!
//! Everything the solver computes is compared bit for bit. Fitted orders come from faer, whose
//! kernels depend on the processor, and are compared to 1e-9 relative; so are all numbers of a
//! study that declares [`Agreement::Relative`] because its samples are eigenvalues.

use std::io;
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::claim::{Claim, Sample};
use super::evaluate::{Outcome, judge};
use super::exhibit::ExhibitRecord;
use super::mutant::MutantRecord;
use super::record::Record;
use lahar::output::{OutputError, atomic};

pub mod age;
mod compare;
mod evaluated;
mod log;
mod place;
pub mod seals;

pub use compare::{Agreement, Difference, compare, compare_exhibits, compare_mutants};
pub use evaluated::{Evaluation, Evaluations};
pub use place::{circumstances, package_root, revision, today};
pub use seals::{Breach, Seal, Seals};

/// Why golden files could not be used.
#[derive(Debug, thiserror::Error)]
pub enum GoldenError {
    /// A file could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A file could not be read.
    #[error("cannot read {}: {source}", path.display())]
    Read { path: PathBuf, source: io::Error },
    /// A file is not what it should be.
    #[error("{}: {source}", path.display())]
    Json { path: PathBuf, source: serde_json::Error },
    /// Golden files are changed by people who look at them.
    #[error("--bless is refused where the environment variable CI is set")]
    UnderCi,
    /// The log would say nothing.
    #[error("--bless needs a reason in words")]
    NoReason,
    /// Some rungs would keep numbers of another version.
    #[error("`{claim}` changed, and its golden record has rungs that were not evaluated: add --full")]
    NeedsFull { claim: String },
    /// Results that fail are not worth keeping.
    #[error("`{id}` did not pass; nothing is blessed (use --only to bless others)")]
    NotPassed { id: String },
}

/// The folder of golden files.
#[derive(Clone, Debug)]
pub struct Golden {
    root: PathBuf,
}

/// What a golden file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shelf {
    /// Records of claims.
    Records,
    /// Exhibits without timings.
    Exhibits,
    /// Exhibits with timings.
    Measured,
    /// Records of mutants.
    Mutants,
}

impl Shelf {
    /// Its folder below `golden`.
    #[must_use]
    pub fn folder(self) -> &'static str {
        match self {
            Self::Records => "records",
            Self::Exhibits => "exhibits",
            Self::Measured => "measured",
            Self::Mutants => "mutants",
        }
    }
}

impl Golden {
    /// The folder `golden` of a package root.
    #[must_use]
    pub fn under(root: &Path) -> Self {
        Self { root: root.join("golden") }
    }

    /// The folder `golden` of [`package_root`].
    #[must_use]
    pub fn here() -> Self {
        Self::under(&package_root())
    }

    /// Where figures of the report are kept.
    #[must_use]
    pub fn figures(&self) -> PathBuf {
        self.root.join("figures")
    }

    /// Where changes are logged.
    #[must_use]
    pub fn log(&self) -> PathBuf {
        self.root.join("LOG.md")
    }

    /// Where it is kept when and how far each claim was last evaluated.
    #[must_use]
    pub fn evaluated(&self) -> PathBuf {
        self.root.join("evaluated.json")
    }

    /// The file of an id.
    #[must_use]
    pub fn path(&self, shelf: Shelf, id: &str) -> PathBuf {
        self.root.join(shelf.folder()).join(format!("{id}.json"))
    }

    /// The golden record of a claim, if there is one.
    ///
    /// # Errors
    /// The file is there but cannot be read.
    pub fn record(&self, claim: &str) -> Result<Option<Record>, GoldenError> {
        read(&self.path(Shelf::Records, claim))
    }

    /// The golden version of an exhibit, if there is one.
    ///
    /// # Errors
    /// The file is there but cannot be read.
    pub fn exhibit(&self, id: &str, timed: bool) -> Result<Option<ExhibitRecord>, GoldenError> {
        read(&self.path(if timed { Shelf::Measured } else { Shelf::Exhibits }, id))
    }

    /// When and how far each claim was last evaluated; empty if there is no such file.
    ///
    /// # Errors
    /// The file is there but cannot be read.
    pub fn evaluations(&self) -> Result<Evaluations, GoldenError> {
        Ok(read(&self.evaluated())?.unwrap_or_default())
    }

    /// The golden record of a mutant, if there is one.
    ///
    /// # Errors
    /// The file is there but cannot be read.
    pub fn mutant(&self, id: &str) -> Result<Option<MutantRecord>, GoldenError> {
        read(&self.path(Shelf::Mutants, id))
    }
}

/// Reads JSON; `None` if there is no such file.
fn read<T: DeserializeOwned>(path: &Path) -> Result<Option<T>, GoldenError> {
    let text = match std::fs::read_to_string(path) {
        Ok(text) => text,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(source) => return Err(GoldenError::Read { path: path.to_path_buf(), source }),
    };
    let value = serde_json::from_str(&text);
    value.map(Some).map_err(|source| GoldenError::Json { path: path.to_path_buf(), source })
}

/// Writes indented JSON.
///
/// # Errors
/// I/O.
pub fn write<T: Serialize>(path: &Path, value: &T) -> Result<(), GoldenError> {
    let text = serde_json::to_string_pretty(value);
    let mut text = text.map_err(|source| GoldenError::Json { path: path.to_path_buf(), source })?;
    text.push('\n');
    Ok(atomic::write(path, text.as_bytes())?)
}

/// The record to keep when only some of a golden record's rungs were evaluated again.
///
/// # Errors
/// [`GoldenError::NeedsFull`] when the evaluated rungs changed, so that the others are outdated.
pub fn merge(
    claim: &Claim,
    now: &Record,
    golden: Option<&Record>,
    agreement: Agreement,
) -> Result<Record, GoldenError> {
    let evaluated = |g: &Sample| now.samples.iter().any(|s| s.parameter.to_bits() == g.parameter.to_bits());
    let in_ladder = |g: &Sample| claim.ladder.full.iter().any(|f| f.to_bits() == g.parameter.to_bits());
    let kept: Vec<&Sample> = golden
        .map(|g| g.samples.iter().filter(|s| !evaluated(s) && in_ladder(s)).collect())
        .unwrap_or_default();
    let (Some(golden), false) = (golden, kept.is_empty()) else { return Ok(now.clone()) };
    let new_rung = |d: &Difference| d.golden == "no such rung";
    if compare(now, golden, agreement).iter().any(|d| !new_rung(d)) {
        return Err(GoldenError::NeedsFull { claim: claim.id.to_owned() });
    }
    let mut samples: Vec<Sample> = now.samples.iter().chain(kept).cloned().collect();
    let position = |s: &Sample| claim.ladder.full.iter().position(|f| f.to_bits() == s.parameter.to_bits());
    samples.sort_by_key(position);
    Ok(rejudge(claim, &samples))
}

/// Judges stored samples by the present declaration of their claim.
#[must_use]
pub fn rejudge(claim: &Claim, samples: &[Sample]) -> Record {
    let outcome = |s: &Sample| Outcome { parameter: s.parameter, result: Ok(s.clone()) };
    judge(claim, &samples.iter().map(outcome).collect::<Vec<_>>())
}

/// Whether blessing is allowed here and now.
///
/// # Errors
/// [`GoldenError::UnderCi`], [`GoldenError::NoReason`].
pub fn may_bless(reason: &str) -> Result<(), GoldenError> {
    if std::env::var_os("CI").is_some_and(|v| !v.is_empty()) {
        return Err(GoldenError::UnderCi);
    }
    if reason.split_whitespace().next().is_none() { Err(GoldenError::NoReason) } else { Ok(()) }
}
