//! The table of runs, the figures, and the recommendations.

use super::points::{Made, points, schemes};
use super::times::speeds;
use crate::claim::VerifyError;
use crate::exhibit::{Entry, Exhibit, ExhibitData, Table};
use lahar::output::plot::{Axis, Plot, Series};
use lahar::plan::work::{Advice, Case, Choice, Point, Work, recommend, table_of_points, table_of_speeds};
use lahar::solver::run::Backend;

/// Errors recommended for.
pub const TARGETS: [f64; 3] = [1e-2, 1e-3, 1e-4];

/// Error and work, the same bits on every machine.
pub const POINTS: Exhibit = Exhibit {
    id: "work-precision-points",
    caption: "Error reached and cell updates it took, for every flow, scheme, resolution and time step. These numbers \
              are the same for both backends and on every machine. `lahar plan --target-error` reads this table.",
    timed: false,
    run: |backend, full| {
        let made = points(backend, full);
        let mut data = ExhibitData { tables: vec![table_of_points(&made)], ..ExhibitData::default() };
        for case in Case::ALL {
            let axes = (Axis::log("work", "cell updates"), Axis::log("error", ""));
            let mut plot = Plot::new(case.name(), axes.0, axes.1);
            for scheme in schemes(case) {
                let series = made
                    .iter()
                    .filter(|(p, failed)| failed.is_none() && p.case == case && p.scheme == scheme)
                    .map(|(p, _)| [p.updates, p.error])
                    .collect();
                plot = plot.with(Series::markers(scheme.name(), series));
            }
            data.plots.push(plot);
        }
        data.notes.extend(Case::ALL.iter().map(|case| {
            format!("*{}*: N is {}; the error is the {}.", case.name(), case.length(), case.error())
        }));
        Ok(data)
    },
};

/// Seconds: updates times nanoseconds per update.
pub const TIMES: Exhibit = Exhibit {
    id: "work-precision-times",
    caption: "Time to a given error: the cell updates of `work-precision-points` times the nanoseconds per update \
              measured here, in turns, with each scheme and backend on one thread (median of five slices on a wide \
              version of the flow). Populations are stored in double precision throughout.",
    timed: true,
    run: times,
};

fn times(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let made: Vec<Made> = points(backend, full);
    let points: Vec<Point> = made.iter().filter(|(_, failed)| failed.is_none()).map(|(p, _)| *p).collect();
    let mut work = Work { points, speeds: Vec::new(), measured: None };
    for case in Case::ALL {
        work.speeds.extend(speeds(case, full)?);
    }
    let mut data = ExhibitData::default();
    data.tables.push(advice(&work));
    data.tables.push(table_of_speeds(&work.speeds));
    for case in Case::ALL {
        data.plots.push(figure(&work, case));
    }
    data.notes.push(
        "Recommended is the cheapest run within the target; of runs whose costs differ by less than a factor of 1.25 \
         the one with the default scheme. A flow whose reference is lubrication theory cannot show an error below \
         what that theory leaves out, a few per cent."
            .to_owned(),
    );
    Ok(data)
}

/// One curve per scheme and backend: for every error the least time, over time steps and resolutions.
fn figure(work: &Work, case: Case) -> Plot {
    let mut plot =
        Plot::new(case.name(), Axis::log("computing time, one thread", "s"), Axis::log("error", ""));
    for speed in work.speeds.iter().filter(|s| s.case == case) {
        let runs = work.points.iter().filter(|p| p.case == case && p.scheme == speed.scheme);
        let cost = runs.map(|p| [1e-9 * speed.nanoseconds * p.updates, p.error]).collect();
        let name = format!("{}, {}", speed.scheme.name(), speed.backend);
        plot = plot.with(Series::line_markers(name, front(cost)));
    }
    plot
}

/// The points that no other beats in both coordinates, by cost.
fn front(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut least = f64::INFINITY;
    points.retain(|p| {
        let better = p[1] < least;
        least = if better { p[1] } else { least };
        better
    });
    points
}

/// The recommended choice per target error.
fn advice(work: &Work) -> Table {
    let columns = [
        "flow",
        "target error",
        "collision",
        "walls",
        "N",
        "plastic τ",
        "error",
        "million updates",
        "backend",
        "seconds",
    ];
    let mut table = Table::new("Recommended choice per target error", &columns);
    for case in Case::ALL {
        for target in TARGETS {
            let mut row: Vec<Entry> = vec![case.name().into(), format!("{} %", 100.0 * target).into()];
            match recommend(work, case, target) {
                Advice::Reached(choice) => row.extend(entries(&choice)),
                Advice::Missed(best) => {
                    row.push(format!("not reached; best: {}", best.point.scheme.operator.name()).into());
                    row.extend(entries(&best).into_iter().skip(1));
                }
                Advice::Empty => row.push("no result".into()),
            }
            table.push(row);
        }
    }
    table
}

fn entries(choice: &Choice) -> Vec<Entry> {
    let p = &choice.point;
    let mut row: Vec<Entry> = vec![
        p.scheme.operator.name().into(),
        p.scheme.walls.name().into(),
        p.n.into(),
        p.tau.into(),
        p.error.into(),
        (1e-6 * p.updates).into(),
    ];
    if let Some((backend, _)) = &choice.speed {
        row.push(backend.clone().into());
    }
    if let Some(seconds) = choice.seconds() {
        row.push(seconds.into());
    }
    row
}
