//! Figures of the report, as data.

use crate::exhibit::ExhibitRecord;
use crate::ladder::symbol;
use crate::record::Record;
use lahar::output::plot::{Axis, Plot, Series};

/// Curves in one figure; more make it unreadable.
const CURVES: usize = 6;

/// Error against the ladder's parameter for all claims about an order: one figure per parameter
/// and six claims. Returns file names and plots.
#[must_use]
pub fn convergence(study: &str, records: &[&Record]) -> Vec<(String, Plot)> {
    let ordered: Vec<&Record> = records.iter().filter(|r| r.order.is_some()).copied().collect();
    let mut parameters: Vec<&str> = Vec::new();
    for record in &ordered {
        if !parameters.contains(&record.parameter.as_str()) {
            parameters.push(&record.parameter);
        }
    }
    let mut figures = Vec::new();
    for parameter in parameters {
        let group: Vec<&Record> = ordered.iter().filter(|r| r.parameter == parameter).copied().collect();
        for chunk in group.chunks(CURVES) {
            let name = format!("{study}-convergence-{}.svg", figures.len() + 1);
            figures.push((name, convergence_plot(parameter, chunk)));
        }
    }
    figures
}

fn convergence_plot(parameter: &str, records: &[&Record]) -> Plot {
    let title = format!("Error against {}", symbol(parameter));
    let mut plot = Plot::new(title, Axis::log(parameter, ""), Axis::log("error", ""));
    for record in records {
        let points = record.samples.iter().map(|s| [s.parameter, s.error]).collect();
        plot = plot.with(Series::line_markers(record.claim.clone(), points));
    }
    let mut slopes: Vec<f64> = Vec::new();
    for record in records {
        let Some(order) = &record.order else { continue };
        if !slopes.contains(&order.expected) {
            slopes.push(order.expected);
            plot = plot.with(slope(record, order.expected));
        }
    }
    plot
}

/// The expected slope, a little below the record it belongs to.
fn slope(record: &Record, expected: f64) -> Series {
    let name = format!("order {expected}");
    let (Some(first), Some(last)) = (record.samples.first(), record.samples.last()) else {
        return Series::reference(name, Vec::new());
    };
    let at = |h: f64| [h, 0.6 * first.error * libm::pow(h / first.parameter, -expected)];
    Series::reference(name, vec![at(first.parameter), at(last.parameter)])
}

/// The plots of an exhibit with their file names.
#[must_use]
pub fn of_exhibit(record: &ExhibitRecord) -> Vec<(String, Plot)> {
    let id = &record.exhibit;
    let name = |k: usize| if k == 0 { format!("{id}.svg") } else { format!("{id}-{}.svg", k + 1) };
    record.data.plots.iter().enumerate().map(|(k, plot)| (name(k), plot.clone())).collect()
}
