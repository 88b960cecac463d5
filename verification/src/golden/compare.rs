//! Results against golden ones, number by number.

use std::fmt;

use serde_json::Value;

use crate::claim::{Metric, Sample};
use crate::exhibit::ExhibitData;
use crate::mutant::MutantRecord;
use crate::record::Record;

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
    /// |now − golden| over the size of the quantity, that of the flow and not of a residual; NaN if not two numbers.
    pub scaled: f64,
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
    let symbol = crate::ladder::symbol(&now.parameter);
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
    for difference in &mut all {
        if let Some(name) = cell(&difference.place, golden) {
            difference.place = name;
        }
    }
    all
}

/// The name of an entry of a table, which is at a place like `tables.0.rows.3.4.number`.
fn cell(place: &str, exhibit: &ExhibitData) -> Option<String> {
    let parts: Vec<&str> = place.split('.').collect();
    let ["tables", table, "rows", row, column, _] = parts[..] else { return None };
    let table = exhibit.tables.get(table.parse::<usize>().ok()?)?;
    let column = table.columns.get(column.parse::<usize>().ok()?)?;
    Some(format!("{}, row {}, {column}", table.title, row.parse::<usize>().ok()? + 1))
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
            scaled: (now - golden).abs() / scale,
        });
    }
}

fn words(place: String, golden: &str, now: &str) -> Difference {
    let (golden, now) = (golden.to_owned(), now.to_owned());
    Difference { place, golden, now, relative: f64::NAN, scaled: f64::NAN }
}

fn brief(value: &Value) -> String {
    let text = value.to_string();
    if text.chars().count() > 60 { format!("{}…", text.chars().take(60).collect::<String>()) } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

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
