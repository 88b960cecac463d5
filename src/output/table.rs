//! Tables and the exhibits of studies as they are stored.

use serde::{Deserialize, Serialize};

use super::number;
use super::plot::Plot;

/// What an exhibit shows.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ExhibitData {
    /// Tables.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tables: Vec<Table>,
    /// Figures.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub plots: Vec<Plot>,
    /// Sentences below them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// A table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// Heading.
    pub title: String,
    /// Column heads with units.
    pub columns: Vec<String>,
    /// Rows, one entry per column.
    pub rows: Vec<Vec<Entry>>,
}

/// An entry of a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Entry {
    /// Words.
    Text(String),
    /// A number, shown with at most four significant digits.
    Number(#[serde(with = "number")] f64),
}

impl Table {
    /// An empty table.
    #[must_use]
    pub fn new(title: impl Into<String>, columns: &[&str]) -> Self {
        let columns = columns.iter().map(|&c| c.to_owned()).collect();
        Self { title: title.into(), columns, rows: Vec::new() }
    }

    /// Adds a row; entries beyond the columns are dropped, missing ones stay empty.
    pub fn push(&mut self, mut row: Vec<Entry>) {
        row.resize(self.columns.len(), Entry::Text(String::new()));
        self.rows.push(row);
    }
}

impl From<f64> for Entry {
    fn from(x: f64) -> Self {
        Self::Number(x)
    }
}

impl From<usize> for Entry {
    fn from(n: usize) -> Self {
        Self::Text(n.to_string())
    }
}

impl From<u64> for Entry {
    fn from(n: u64) -> Self {
        Self::Text(n.to_string())
    }
}

impl From<&str> for Entry {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Entry {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

/// An exhibit as it is stored.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExhibitRecord {
    /// Id of the exhibit.
    pub exhibit: String,
    /// Full size or the short one.
    pub full: bool,
    /// When and where, for timed exhibits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub measured: Option<Measured>,
    /// What it shows.
    pub data: ExhibitData,
}

/// Circumstances of a timing.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Measured {
    /// Date, `2026-11-22`.
    pub date: String,
    /// Processor and number of logical cores.
    pub machine: String,
}
