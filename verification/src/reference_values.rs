//! Numbers computed outside lahar, one entry per quantity (`verification/reference_values.json`).
//!
//! Every entry has a name, the inputs it was computed for, a value (a number, a list or a record
//! of numbers), its provenance and the number of decimal digits it is good to.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use serde::Deserialize;
use serde_json::Value;

const TABLE: &str = include_str!("../reference_values.json");

/// One reference value.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// Name of the quantity; several entries share one when they differ in their inputs.
    pub name: String,
    /// What it was computed for, by name.
    pub inputs: BTreeMap<String, Value>,
    /// The value: a number, a list or a record of numbers.
    pub value: Value,
    /// Unit, empty for dimensionless or any consistent system.
    pub unit: String,
    /// How it was obtained.
    pub provenance: String,
    /// Significant decimal digits.
    pub digits: u32,
    /// Remarks.
    #[serde(default)]
    pub note: String,
}

/// An input to look an entry up by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input<'a> {
    /// A number, compared exactly.
    Number(f64),
    /// A word.
    Text(&'a str),
}

/// Why a reference value could not be given.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReferenceError {
    /// The table itself cannot be read.
    #[error("verification/reference_values.json: {0}")]
    Table(String),
    /// Not exactly one entry has this name and these inputs.
    #[error("{found} reference values are named `{name}` with the inputs asked for; one is needed")]
    NotUnique { name: String, found: usize },
    /// The value has another shape than asked for.
    #[error("reference value `{name}` is not {wanted}")]
    Shape { name: String, wanted: &'static str },
}

impl Entry {
    /// The value, if it is one number.
    pub fn number(&self) -> Result<f64, ReferenceError> {
        self.value.as_f64().ok_or_else(|| self.shape("a number"))
    }

    /// One number of a record.
    pub fn field(&self, key: &str) -> Result<f64, ReferenceError> {
        self.value.get(key).and_then(Value::as_f64).ok_or_else(|| self.shape("a record with that number"))
    }

    /// The value, if it is a list of numbers.
    pub fn list(&self) -> Result<Vec<f64>, ReferenceError> {
        self.numbers(Some(&self.value))
    }

    /// A numeric input.
    pub fn input(&self, key: &str) -> Result<f64, ReferenceError> {
        self.inputs.get(key).and_then(Value::as_f64).ok_or_else(|| self.shape("given for that input"))
    }

    /// An input that is a word.
    pub fn input_text(&self, key: &str) -> Result<&str, ReferenceError> {
        self.inputs.get(key).and_then(Value::as_str).ok_or_else(|| self.shape("given for that input"))
    }

    /// An input that is a list of numbers.
    pub fn input_list(&self, key: &str) -> Result<Vec<f64>, ReferenceError> {
        self.numbers(self.inputs.get(key))
    }

    /// Relative tolerance that the stated digits allow, 10^(1 − digits): one unit of the last digit.
    pub fn tolerance(&self) -> f64 {
        1.0 / (1..self.digits).fold(1.0, |scale, _| 10.0 * scale)
    }

    fn numbers(&self, value: Option<&Value>) -> Result<Vec<f64>, ReferenceError> {
        value
            .and_then(Value::as_array)
            .and_then(|list| list.iter().map(Value::as_f64).collect())
            .ok_or_else(|| self.shape("a list of numbers"))
    }

    fn shape(&self, wanted: &'static str) -> ReferenceError {
        ReferenceError::Shape { name: self.name.clone(), wanted }
    }

    fn matches(&self, name: &str, inputs: &[(&str, Input<'_>)]) -> bool {
        self.name == name
            && inputs.iter().all(|(key, wanted)| match (self.inputs.get(*key), wanted) {
                (Some(value), Input::Number(number)) => value.as_f64() == Some(*number),
                (Some(value), Input::Text(text)) => value.as_str() == Some(*text),
                (None, _) => false,
            })
    }
}

/// The whole table, parsed once.
pub fn table() -> Result<&'static [Entry], ReferenceError> {
    static PARSED: OnceLock<Result<Vec<Entry>, ReferenceError>> = OnceLock::new();
    PARSED
        .get_or_init(|| serde_json::from_str(TABLE).map_err(|e| ReferenceError::Table(e.to_string())))
        .as_deref()
        .map_err(Clone::clone)
}

/// All entries of one name.
pub fn all(name: &str) -> Result<impl Iterator<Item = &'static Entry>, ReferenceError> {
    Ok(table()?.iter().filter(move |entry| entry.name == name))
}

/// The one entry with this name and these inputs (others may be left out).
///
/// # Errors
/// `NotUnique` if no entry or more than one fits.
pub fn find(name: &str, inputs: &[(&str, Input<'_>)]) -> Result<&'static Entry, ReferenceError> {
    let mut fitting = table()?.iter().filter(|entry| entry.matches(name, inputs));
    match (fitting.next(), fitting.count()) {
        (Some(entry), 0) => Ok(entry),
        (first, more) => Err(ReferenceError::NotUnique {
            name: name.to_owned(),
            found: usize::from(first.is_some()) + more,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_by_name_and_inputs() {
        let inputs = [
            ("N", Input::Number(16.0)),
            ("tau", Input::Number(1.8)),
            ("op", Input::Text("BGK")),
            ("k", Input::Text("axis")),
        ];
        let entry = find("shear_wave_nu_ratio", &inputs).unwrap();
        assert_eq!(entry.number(), Ok(0.9141847702256558));
        assert_eq!(entry.tolerance(), 1e-7);
        assert_eq!(find("poiseuille_bingham", &[]).unwrap().field("gdot_wall"), Ok(2.5));
    }

    #[test]
    fn refuses_the_missing_the_ambiguous_and_the_misshapen() {
        assert!(matches!(find("no_such", &[]), Err(ReferenceError::NotUnique { found: 0, .. })));
        assert!(matches!(
            find("shear_wave_nu_ratio", &[]),
            Err(ReferenceError::NotUnique { found: 144, .. })
        ));
        let record = find("poiseuille_bingham", &[]).unwrap();
        assert!(matches!(record.number(), Err(ReferenceError::Shape { .. })));
        assert!(matches!(record.field("no_such"), Err(ReferenceError::Shape { .. })));
    }

    #[test]
    fn every_entry_states_its_precision() {
        assert!(table().unwrap().iter().all(|entry| entry.digits >= 1 && !entry.provenance.is_empty()));
    }
}
