//! Plots of the time series.

use std::ops::Range;

use super::measure::Probes;
use super::recorder::Recorder;
use crate::output::plot::{Axis, Plot, Series as Curve};
use crate::output::{OutputError, atomic, svg};

/// All plots of all probes.
///
/// # Errors
/// I/O.
pub(super) fn draw(recorder: &Recorder, probes: &Probes, title: &str) -> Result<(), OutputError> {
    for ((_, columns), listed) in recorder.groups().iter().zip(probes.iter()) {
        for (file, range) in listed.plots() {
            plot(recorder, title, &file, columns.start + range.start..columns.start + range.end)?;
        }
    }
    Ok(())
}

/// Columns of the time series in one plot; those that are zero throughout only when alone.
fn plot(recorder: &Recorder, title: &str, file: &str, range: Range<usize>) -> Result<(), OutputError> {
    let (series, alone) = (recorder.series(), range.len() == 1);
    let first = &series.columns[range.start];
    let unit = if first.unit == "-" { "" } else { first.unit.as_str() };
    let label = if alone { first.name.as_str() } else { file.strip_prefix("series_").unwrap_or(file) };
    let mut plot = Plot::new(title, Axis::linear("time", "s"), Axis::linear(label, unit));
    for column in range {
        let points: Vec<[f64; 2]> = series.rows.iter().map(|row| [row[0], row[column]]).collect();
        if alone || points.iter().any(|point| point[1] != 0.0) {
            plot = plot.with(Curve::line(&series.columns[column].name, points));
        }
    }
    atomic::write(&recorder.folder().plot(&format!("{file}.svg"))?, svg::draw(&plot)?.as_bytes())
}
