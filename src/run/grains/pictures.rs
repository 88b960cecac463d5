//! Plots of what probes say about grains, and the grains seen from the side.

use std::ops::Range;
use std::path::Path;

use crate::geometry::Axis as Direction;
use crate::output::csv::Series;
use crate::output::discs::{self, Disc, Discs};
use crate::output::plot::{Axis, Plot, Series as Curve};
use crate::output::{OutputError, atomic, svg};
use crate::plan::grains::GrainPlan;
use crate::run::measure::Probes;
use crate::run::recorder::Recorder;
use crate::run::view::View;

/// A figure per unit for every probe about grains.
pub(in crate::run) fn plots(recorder: &Recorder, probes: &Probes, title: &str) -> Result<(), OutputError> {
    let folder = recorder.path("plots");
    for ((name, columns), (_, about_grains)) in recorder.groups().iter().zip(probes.iter()) {
        if about_grains {
            series_plots(&folder, title, recorder.series(), name, columns.clone())?;
        }
    }
    Ok(())
}

/// A figure per unit for the columns of a probe.
fn series_plots(
    folder: &Path,
    title: &str,
    series: &Series,
    name: &str,
    columns: Range<usize>,
) -> Result<(), OutputError> {
    let mut from = columns.start;
    // Neighbouring columns of one unit share a figure.
    while from < columns.end {
        let unit = &series.columns[from].unit;
        let same = (from..columns.end).take_while(|&c| &series.columns[c].unit == unit).count();
        let first = series.columns[from].name.as_str();
        // Vectors go by their name without the component.
        let vector = if same > 1 { first.strip_suffix("_x").unwrap_or(first) } else { first };
        let file = if same == columns.len() { name } else { vector };
        series_plot(folder, title, series, file, from..from + same)?;
        from += same;
    }
    Ok(())
}

fn series_plot(
    folder: &Path,
    title: &str,
    series: &Series,
    file: &str,
    range: Range<usize>,
) -> Result<(), OutputError> {
    let first = &series.columns[range.start];
    let unit = if first.unit == "-" { "" } else { first.unit.as_str() };
    let alone = range.len() == 1;
    let mut plot = Plot::new(title, Axis::linear("time", "s"), Axis::linear(file, unit));
    for column in range {
        let points: Vec<[f64; 2]> = series.rows.iter().map(|row| [row[0], row[column]]).collect();
        if alone || points.iter().any(|point| point[1] != 0.0) {
            plot = plot.with(Curve::line(&series.columns[column].name, points));
        }
    }
    let text = svg::draw(&plot)?;
    atomic::write(&folder.join(format!("series_{file}.svg")), text.as_bytes())
}

/// Draws the grains as seen from the side; `plots` is the folder.
pub(in crate::run) fn picture(
    plots: &Path,
    plan: &GrainPlan,
    size_m: [f64; 3],
    grains: &View<'_>,
) -> Result<(), OutputError> {
    let text = discs::draw(&side_view(plan, size_m, grains));
    atomic::write(&plots.join("grains.svg"), text.as_bytes())
}

/// All spheres seen along the shortest axis of the box, but never from above.
fn side_view(plan: &GrainPlan, size: [f64; 3], grains: &View<'_>) -> Discs {
    let g = plan.setup.gravity;
    let up = Direction::ALL.into_iter().max_by(|a, b| g[a.index()].abs().total_cmp(&g[b.index()].abs()));
    let up = up.filter(|axis| g[axis.index()] != 0.0).unwrap_or(Direction::Z);
    let level = Direction::ALL.into_iter().filter(|axis| *axis != up);
    let depth = level.clone().min_by(|a, b| size[a.index()].total_cmp(&size[b.index()]));
    let depth = depth.unwrap_or(Direction::Y);
    let across = level.into_iter().find(|axis| *axis != depth).unwrap_or(Direction::X);
    let (d, a, u) = (depth.index(), across.index(), up.index());
    let fold = |x: f64, k: usize| match plan.setup.period.0[k] {
        Some(length) => x - (x / length).floor() * length,
        None => x,
    };
    let mut discs: Vec<(f64, Disc)> = grains
        .dem
        .members()
        .iter()
        .map(|m| {
            let x = m.position;
            let disc = Disc {
                centre: [fold(x[a], a), fold(x[u], u)],
                radius: m.radius,
                value: m.velocity.norm(),
                driven: m.inverse_mass == 0.0,
            };
            (fold(x[d], d), disc)
        })
        .collect();
    // Far ones first.
    discs.sort_by(|p, q| q.0.total_cmp(&p.0));
    Discs {
        title: format!("{}: {:.4} s", plan.numbers.title, grains.time),
        label: "speed".to_owned(),
        unit: "m/s".to_owned(),
        axes: [across.letter().to_string(), up.letter().to_string()],
        size_m: [size[a], size[u]],
        discs: discs.into_iter().map(|(_, disc)| disc).collect(),
    }
}
