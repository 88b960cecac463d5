//! What a run writes: its folder and its time series, which reaches the disk row by row.

use std::fs::File;
use std::io::Write;
use std::sync::Arc;

use super::folder::Folder;
use super::measure::quantity::Quantity;
use crate::output::OutputError;
use crate::output::csv::Series;
use crate::state::{State, StateError, Tape};

/// Knows the folder, and what the probes have said so far.
pub(super) struct Recorder {
    folder: Arc<Folder>,
    series: Series,
    /// Columns of each probe.
    groups: Vec<(String, std::ops::Range<usize>)>,
    /// The file of the series; `None` before the first row.
    file: Option<SeriesFile>,
}

/// The file of a series.
struct SeriesFile {
    file: File,
    /// Rows that are in it, and its length with them, bytes.
    rows: usize,
    length: u64,
}

impl State for Recorder {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let Self { series, groups, file, folder: _ } = self;
        series.state(tape)?;
        let mut ranges: Vec<(String, (usize, usize))> =
            groups.drain(..).map(|(name, range)| (name, (range.start, range.end))).collect();
        ranges.state(tape)?;
        *groups = ranges.into_iter().map(|(name, (start, end))| (name, start..end)).collect();
        if tape.reads() {
            // Rows of later times may be in it.
            *file = None;
        }
        Ok(())
    }
}

impl Recorder {
    /// Nothing said so far.
    pub fn new(folder: Arc<Folder>) -> Self {
        Self { folder, series: Series::new(&[]), groups: Vec::new(), file: None }
    }

    /// The folder.
    pub(crate) fn folder(&self) -> &Arc<Folder> {
        &self.folder
    }

    /// Adds a row to the time series: what each probe says at a time. The first row names the columns.
    ///
    /// # Errors
    /// The number of columns is not that of the first row; I/O.
    pub(crate) fn row(&mut self, time_s: f64, probes: &[(String, Vec<Quantity>)]) -> Result<(), OutputError> {
        if self.series.columns.is_empty() {
            self.begin(probes);
        }
        let values = probes.iter().flat_map(|(_, quantities)| quantities).map(|quantity| quantity.value);
        self.series.push(&std::iter::once(time_s).chain(values).collect::<Vec<f64>>())?;
        self.write_series()
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

    /// Brings the rows that are not in the file into it. What cannot be written whole is taken back.
    ///
    /// # Errors
    /// I/O.
    pub(crate) fn write_series(&mut self) -> Result<(), OutputError> {
        let path = self.folder.file("series.csv")?;
        let io = |doing| {
            let path = path.clone();
            move |source| OutputError::Io { path, doing, source }
        };
        let of = match &mut self.file {
            Some(of) => of,
            None => {
                let file = File::create(&path).map_err(io("create"))?;
                self.file.insert(SeriesFile { file, rows: 0, length: 0 })
            }
        };
        let head = if of.length == 0 { self.series.head() } else { String::new() };
        let rows = &self.series.rows[of.rows..];
        let text = rows.iter().fold(head, |text, row| text + &Series::line(row));
        if let Err(source) = of.file.write_all(text.as_bytes()) {
            // The error of the write is the one worth reporting.
            let _ = of.file.set_len(of.length);
            let _ = std::io::Seek::seek(&mut of.file, std::io::SeekFrom::Start(of.length));
            return Err(io("write")(source));
        }
        (of.rows, of.length) = (self.series.rows.len(), of.length + text.len() as u64);
        Ok(())
    }
}
