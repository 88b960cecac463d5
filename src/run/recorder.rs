//! The folder of a run and its time series.

use std::path::{Path, PathBuf};

use super::error::RunError;
use super::measure::quantity::Quantity;
use crate::output::OutputError;
use crate::output::csv::Series;

/// Knows the folder, and what the probes have said so far.
pub(super) struct Recorder {
    folder: PathBuf,
    series: Series,
    /// Columns of each probe.
    groups: Vec<(String, std::ops::Range<usize>)>,
}

impl Recorder {
    /// Makes the folder, and one for plots in it.
    ///
    /// # Errors
    /// The folder cannot be made.
    pub fn new(folder: &Path) -> Result<Self, RunError> {
        for path in [folder.to_path_buf(), folder.join("plots")] {
            std::fs::create_dir_all(&path).map_err(|source| RunError::Folder { path, source })?;
        }
        Ok(Self { folder: folder.to_path_buf(), series: Series::new(&[]), groups: Vec::new() })
    }

    /// A file of the folder.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Adds a row to the time series: what each probe says at a time. The first row names the columns.
    ///
    /// # Errors
    /// The number of columns is not that of the first row.
    pub(crate) fn row(&mut self, time_s: f64, probes: &[(String, Vec<Quantity>)]) -> Result<(), OutputError> {
        if self.series.columns.is_empty() {
            self.begin(probes);
        }
        let values = probes.iter().flat_map(|(_, quantities)| quantities).map(|quantity| quantity.value);
        self.series.push(&std::iter::once(time_s).chain(values).collect::<Vec<f64>>())
    }

    fn begin(&mut self, probes: &[(String, Vec<Quantity>)]) {
        let mut columns = vec![("time".to_owned(), "s")];
        for (name, quantities) in probes {
            let first = columns.len();
            columns.extend(quantities.iter().map(|quantity| (quantity.column(name), quantity.unit)));
            self.groups.push((name.clone(), first..columns.len()));
        }
        let columns: Vec<(&str, &str)> = columns.iter().map(|(name, unit)| (name.as_str(), *unit)).collect();
        self.series = Series::new(&columns);
    }

    /// The time series so far.
    pub(crate) fn series(&self) -> &Series {
        &self.series
    }

    /// Name and columns of every probe, in their order; empty before the first row.
    pub(crate) fn groups(&self) -> &[(String, std::ops::Range<usize>)] {
        &self.groups
    }

    /// Writes the time series so far.
    ///
    /// # Errors
    /// I/O.
    pub(crate) fn write_series(&self) -> Result<(), OutputError> {
        self.series.write(&self.path("series.csv"))
    }
}
