//! Time series as comma-separated text, units in the header.

use std::path::Path;

use super::{OutputError, atomic};
use crate::state::state;

/// One column: what it holds and in which unit (`-` if none).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Column {
    /// What it holds: `front`.
    pub name: String,
    /// Its unit: `m`.
    pub unit: String,
}

/// A table of numbers; every row has one number per column.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// The columns.
    pub columns: Vec<Column>,
    /// The rows.
    pub rows: Vec<Vec<f64>>,
}

state!(Column: name unit);
state!(Series: columns rows);

impl Series {
    /// An empty table with columns given as (name, unit).
    #[must_use]
    pub fn new(columns: &[(&str, &str)]) -> Self {
        let columns =
            columns.iter().map(|&(name, unit)| Column { name: name.to_owned(), unit: unit.to_owned() });
        Self { columns: columns.collect(), rows: Vec::new() }
    }

    /// Appends a row.
    ///
    /// # Errors
    /// [`OutputError::Length`] when the row does not fit the columns.
    pub fn push(&mut self, row: &[f64]) -> Result<(), OutputError> {
        let (found, expected) = (row.len(), self.columns.len());
        if found != expected {
            return Err(OutputError::Length { what: "row of the time series".to_owned(), found, expected });
        }
        self.rows.push(row.to_vec());
        Ok(())
    }

    /// The table as text: `name [unit]` headers, numbers in the shortest form that reads back to
    /// the same bits.
    #[must_use]
    pub(crate) fn to_text(&self) -> String {
        self.rows.iter().fold(self.head(), |text, row| text + &Self::line(row))
    }

    /// The first line of the text.
    pub(crate) fn head(&self) -> String {
        let header: Vec<String> = self.columns.iter().map(|c| format!("{} [{}]", c.name, c.unit)).collect();
        header.join(",") + "\n"
    }

    /// The line of a row.
    pub(crate) fn line(row: &[f64]) -> String {
        let numbers: Vec<String> = row.iter().map(|x| number(*x)).collect();
        numbers.join(",") + "\n"
    }

    /// Writes the table.
    ///
    /// # Errors
    /// I/O.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        atomic::write(path, self.to_text().as_bytes())
    }

    /// Reads a table written by [`Self::write`].
    ///
    /// # Errors
    /// I/O, or [`OutputError::Malformed`] naming the line.
    pub fn read(path: &Path) -> Result<Self, OutputError> {
        let text = std::fs::read_to_string(path).map_err(|source| OutputError::Io {
            path: path.to_path_buf(),
            doing: "read",
            source,
        })?;
        Self::parse(&text).map_err(|(line, problem)| OutputError::Malformed {
            path: path.to_path_buf(),
            line,
            problem,
        })
    }

    fn parse(text: &str) -> Result<Self, (usize, String)> {
        let mut lines = text.lines().enumerate();
        let (_, header) = lines.next().ok_or((1, "the file is empty".to_owned()))?;
        let columns = header.split(',').map(column).collect::<Result<Vec<_>, _>>().map_err(|e| (1, e))?;
        let mut series = Self { columns, rows: Vec::new() };
        for (k, line) in lines {
            let row = line
                .split(',')
                .map(|x| x.trim().parse::<f64>().map_err(|_| (k + 1, format!("`{x}` is not a number"))))
                .collect::<Result<Vec<_>, _>>()?;
            series.push(&row).map_err(|e| (k + 1, e.to_string()))?;
        }
        Ok(series)
    }
}

fn column(text: &str) -> Result<Column, String> {
    let (name, unit) = text
        .trim()
        .strip_suffix(']')
        .and_then(|t| t.split_once(" ["))
        .ok_or(format!("column `{text}` is not of the form `name [unit]`"))?;
    Ok(Column { name: name.to_owned(), unit: unit.to_owned() })
}

/// Plain notation near 1, exponents elsewhere; both are shortest round-trip forms.
fn number(x: f64) -> String {
    if x == 0.0 || !x.is_finite() || (1e-4..1e7).contains(&x.abs()) {
        format!("{x}")
    } else {
        format!("{x:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_round_trip_with_units() {
        let mut series = Series::new(&[("time", "s"), ("front", "m"), ("plug_fraction", "-")]);
        series.push(&[0.1, 1.0 / 3.0, -0.0]).unwrap();
        series.push(&[1e-300, f64::INFINITY, 6.02e23]).unwrap();
        assert!(series.to_text().starts_with("time [s],front [m],plug_fraction [-]\n0.1,"));
        let back = Series::parse(&series.to_text()).unwrap();
        assert_eq!(back.columns, series.columns);
        for (a, b) in back.rows.iter().flatten().zip(series.rows.iter().flatten()) {
            assert_eq!(a.to_bits(), b.to_bits());
        }
    }

    #[test]
    fn wrong_row_and_bad_text_are_refused() {
        let mut series = Series::new(&[("time", "s")]);
        assert!(series.push(&[1.0, 2.0]).is_err());
        assert_eq!(Series::parse("time [s]\n1\nx\n").unwrap_err().0, 3);
        assert!(Series::parse("time\n").unwrap_err().1.contains("name [unit]"));
    }
}
