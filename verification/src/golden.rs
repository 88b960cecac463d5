//! Golden files: results kept under version control and compared with every later one.
//!
//! Everything the solver computes is compared bit for bit. Fitted orders come from faer, whose
//! kernels depend on the processor, and are compared to 1e-9 relative; so are all numbers of a
//! study that declares [`Agreement::Relative`] because its samples are eigenvalues.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::claim::{Claim, Metric, Sample};
use super::evaluate::{Outcome, judge};
use super::exhibit::{ExhibitData, ExhibitRecord, Measured};
use super::mutant::MutantRecord;
use super::record::Record;
use lahar::output::{OutputError, atomic};

/// How closely numbers must agree with the golden ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Agreement {
    /// Same bits (any NaN equals any NaN).
    Bits,
    /// |now − golden| ≤ this × the scale of the numbers; for results of processor-dependent kernels.
    Relative(f64),
}

/// Agreement of fitted quantities: rounding of a least-squares solve (1e-14) with ample room.
const FITTED: Agreement = Agreement::Relative(1e-9);

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

    /// The file of an id.
    #[must_use]
    pub fn path(&self, shelf: Shelf, id: &str) -> PathBuf {
        let folder = match shelf {
            Shelf::Records => "records",
            Shelf::Exhibits => "exhibits",
            Shelf::Measured => "measured",
            Shelf::Mutants => "mutants",
        };
        self.root.join(folder).join(format!("{id}.json"))
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

    /// The golden record of a mutant, if there is one.
    ///
    /// # Errors
    /// The file is there but cannot be read.
    pub fn mutant(&self, id: &str) -> Result<Option<MutantRecord>, GoldenError> {
        read(&self.path(Shelf::Mutants, id))
    }
}

/// The nearest folder with golden files: from the package Cargo is running, else from the current
/// directory, upwards; where there is none, that package or directory itself.
#[must_use]
pub fn package_root() -> PathBuf {
    let start = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    let start = start.or_else(|| std::env::current_dir().ok()).unwrap_or_else(|| PathBuf::from("."));
    start.ancestors().find(|folder| folder.join("golden").is_dir()).unwrap_or(&start).to_path_buf()
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

/// One place where a result is not the golden one.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Where: `N = 32, error`.
    pub place: String,
    /// The golden entry.
    pub golden: String,
    /// The present one.
    pub now: String,
    /// |now − golden| / |golden|; NaN if not two numbers.
    pub relative: f64,
}

impl fmt::Display for Difference {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}: golden {}, now {}", self.place, self.golden, self.now)?;
        if self.relative.is_finite() { write!(out, " (relative {:.2e})", self.relative) } else { Ok(()) }
    }
}

/// Compares a record with the golden one at the rungs both have; a rung of `now` that the golden
/// record lacks is a difference, the reverse is not.
#[must_use]
pub fn compare(now: &Record, golden: &Record, agreement: Agreement) -> Vec<Difference> {
    let mut all = Vec::new();
    let symbol = super::ladder::symbol(&now.parameter);
    for sample in &now.samples {
        let place = format!("{symbol} = {}", sample.parameter);
        match golden.samples.iter().find(|g| g.parameter.to_bits() == sample.parameter.to_bits()) {
            Some(g) => compare_samples(&place, sample, g, now.metric, agreement, &mut all),
            None => all.push(words(place, "no such rung", "evaluated")),
        }
    }
    for rung in &now.failed {
        all.push(words(format!("{symbol} = {}", rung.parameter), "a sample", &rung.why));
    }
    if now.samples.len() == golden.samples.len()
        && let (Some(a), Some(b)) = (&now.order, &golden.order)
    {
        compare_numbers("order", a.fitted.order, b.fitted.order, 1.0, FITTED, &mut all);
    }
    all
}

fn compare_samples(
    place: &str,
    now: &Sample,
    golden: &Sample,
    metric: Metric,
    agreement: Agreement,
    all: &mut Vec<Difference>,
) {
    // An error that is all rounding may move by itself; what counts is the scale it was formed on.
    let size = golden.computed.abs().max(golden.reference.abs());
    let scale = if metric == Metric::Absolute { size } else { 1.0 };
    let at = |name: &str| format!("{place}, {name}");
    compare_numbers(&at("computed"), now.computed, golden.computed, size, agreement, all);
    compare_numbers(&at("reference"), now.reference, golden.reference, size, agreement, all);
    compare_numbers(&at("error"), now.error, golden.error, scale, agreement, all);
    for (name, &value) in &now.extra {
        match golden.extra.get(name) {
            Some(&g) => compare_numbers(&at(name), value, g, g.abs(), agreement, all),
            None => all.push(words(at(name), "nothing", "a number")),
        }
    }
    for name in golden.extra.keys().filter(|name| !now.extra.contains_key(*name)) {
        all.push(words(at(name), "a number", "nothing"));
    }
}

/// Compares two exhibits, number by number.
#[must_use]
pub fn compare_exhibits(now: &ExhibitData, golden: &ExhibitData, agreement: Agreement) -> Vec<Difference> {
    let mut all = Vec::new();
    match (serde_json::to_value(now), serde_json::to_value(golden)) {
        (Ok(a), Ok(b)) => compare_values("", &a, &b, agreement, &mut all),
        _ => all.push(words("exhibit".to_owned(), "JSON", "not expressible as JSON")),
    }
    all
}

/// Compares two mutants: whether they were caught, and the error measured.
#[must_use]
pub fn compare_mutants(now: &MutantRecord, golden: &MutantRecord, agreement: Agreement) -> Vec<Difference> {
    let mut all = Vec::new();
    if now.caught != golden.caught {
        let word = |caught| if caught { "caught" } else { "escaped" };
        all.push(words("mutant".to_owned(), word(golden.caught), word(now.caught)));
    }
    compare_numbers("error", now.error, golden.error, golden.error.abs(), agreement, &mut all);
    all
}

fn compare_values(place: &str, now: &Value, golden: &Value, agreement: Agreement, all: &mut Vec<Difference>) {
    let inner = |name: &str| if place.is_empty() { name.to_owned() } else { format!("{place}.{name}") };
    match (now, golden) {
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            for (k, (x, y)) in a.iter().zip(b).enumerate() {
                compare_values(&inner(&k.to_string()), x, y, agreement, all);
            }
        }
        (Value::Object(a), Value::Object(b)) if a.keys().eq(b.keys()) => {
            for (name, x) in a {
                compare_values(&inner(name), x, &b[name], agreement, all);
            }
        }
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().unwrap_or(f64::NAN), b.as_f64().unwrap_or(f64::NAN));
            compare_numbers(place, a, b, b.abs().max(1.0), agreement, all);
        }
        (a, b) if a == b => {}
        (a, b) => all.push(words(place.to_owned(), &brief(b), &brief(a))),
    }
}

fn compare_numbers(
    place: &str,
    now: f64,
    golden: f64,
    scale: f64,
    agreement: Agreement,
    all: &mut Vec<Difference>,
) {
    let same = now.to_bits() == golden.to_bits() || (now.is_nan() && golden.is_nan());
    let agree = same
        || match agreement {
            Agreement::Bits => false,
            Agreement::Relative(bound) => (now - golden).abs() <= bound * scale,
        };
    if !agree {
        all.push(Difference {
            place: place.to_owned(),
            golden: format!("{golden:e}"),
            now: format!("{now:e}"),
            relative: (now - golden).abs() / golden.abs(),
        });
    }
}

fn words(place: String, golden: &str, now: &str) -> Difference {
    Difference { place, golden: golden.to_owned(), now: now.to_owned(), relative: f64::NAN }
}

fn brief(value: &Value) -> String {
    let text = value.to_string();
    if text.chars().count() > 60 { format!("{}…", text.chars().take(60).collect::<String>()) } else { text }
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

/// Today's date (UTC), `2026-11-22`.
#[must_use]
pub fn today() -> String {
    let since = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    civil(since.map_or(0, |d| d.as_secs() / 86_400))
}

/// Calendar date of a day counted from 1970-01-01 (Gregorian).
fn civil(day: u64) -> String {
    // Years are counted from March, so that the leap day ends a year; 719 468 days from 0000-03-01.
    let shifted = day + 719_468;
    let (era, in_era) = (shifted / 146_097, shifted % 146_097);
    let year_of_era = (in_era - in_era / 1_460 + in_era / 36_524 - in_era / 146_096) / 365;
    let in_year = in_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month = (5 * in_year + 2) / 153;
    let date = in_year - (153 * month + 2) / 5 + 1;
    let (month, carry) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    format!("{:04}-{month:02}-{date:02}", era * 400 + year_of_era + carry)
}

/// Date, processor and core count of this machine.
#[must_use]
pub fn circumstances() -> Measured {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model =
        info.lines().find_map(|l| l.strip_prefix("model name")?.split_once(':').map(|(_, m)| m.trim()));
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let model = model.unwrap_or(std::env::consts::ARCH);
    Measured { date: today(), machine: format!("{model}, {cores} logical cores") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_calendar() {
        // `date -u -d @N` of the GNU core utilities.
        for (day, date) in
            [(0, "1970-01-01"), (11_016, "2000-02-29"), (19_782, "2024-02-29"), (20_779, "2026-11-22")]
        {
            assert_eq!(civil(day), date);
        }
    }

    #[test]
    fn one_bit_is_a_difference_and_nan_equals_nan() {
        let mut all = Vec::new();
        compare_numbers("x", 1.0, 1.0, 1.0, Agreement::Bits, &mut all);
        compare_numbers("x", f64::NAN, -f64::NAN, 1.0, Agreement::Bits, &mut all);
        assert!(all.is_empty());
        compare_numbers("x", 1.0 + f64::EPSILON, 1.0, 1.0, Agreement::Bits, &mut all);
        compare_numbers("x", -0.0, 0.0, 1.0, Agreement::Bits, &mut all);
        compare_numbers("x", 1.0 + 1e-8, 1.0, 1.0, Agreement::Relative(1e-9), &mut all);
        compare_numbers("x", f64::NAN, 1.0, 1.0, Agreement::Relative(1e-9), &mut all);
        assert_eq!(all.len(), 4);
        compare_numbers("x", 1.0 + 1e-10, 1.0, 1.0, Agreement::Relative(1e-9), &mut all);
        assert_eq!(all.len(), 4);
    }
}
