//! Figures and tables of the study.

use super::galilean::vortex_defect;
use super::limits::{ODD_RATE_REFERENCE, at_odd_time};
use super::noise::{INTERVAL, history};
use crate::claim::VerifyError;
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::collision::CollisionChoice;
use lahar::output::plot::{Axis, Plot, Series};
use lahar::solver::run::Backend;
use lahar::stability::table::{OPERATORS, table};

fn name(collision: &CollisionChoice) -> &'static str {
    OPERATORS.iter().find(|(_, c)| c == collision).map_or("other", |(name, _)| name)
}

/// The stability map.
pub const MAP: Exhibit = Exhibit {
    id: "stability-map",
    caption: "Largest stable speed against tau for every operator at its default parameters, least of the directions x, xy and xyz. Lines: 1.9 (tau - 1/2)^(1/2), the trend of BGK, and 6.1 (tau - 1/2), the trend of TRT with a fixed product of 3/16.",
    timed: false,
    run: |_, _| {
        let mut plot = Plot::new(
            "Largest stable speed",
            Axis::log("tau - 1/2", ""),
            Axis::log("speed", "cells per step"),
        );
        let mut tables = Vec::new();
        let mut excess = Vec::new();
        for column in table() {
            let name = name(&column.collision);
            let mut table = Table::new(format!("{name}: largest stable speed"), &["tau", "x", "xy", "xyz"]);
            let mut points = Vec::new();
            for row in &column.rows {
                let [x, xy, xyz] = row.limits.map(|l| l.speed);
                table.push(vec![row.tau.into(), x.into(), xy.into(), xyz.into()]);
                points.push([row.tau - 0.5, row.least()]);
            }
            if excess.is_empty() {
                excess = points.iter().map(|p| p[0]).collect();
            }
            plot = plot.with(Series::line_markers(name, points));
            tables.push(table);
        }
        let fit = |law: fn(f64) -> f64, top: f64| -> Vec<[f64; 2]> {
            excess.iter().map(|&e| [e, law(e)]).filter(|p| p[1] <= top).collect()
        };
        let plot = plot
            .with(Series::reference("1.9 (tau - 1/2)^(1/2)", fit(|e| 1.9 * e.sqrt(), 0.3)))
            .with(Series::reference("6.1 (tau - 1/2)", fit(|e| 6.1 * e, 0.3)));
        Ok(ExhibitData { tables, plots: vec![plot], notes: Vec::new() })
    },
};

/// The limit against the odd relaxation time.
pub const ODD_RATE: Exhibit = Exhibit {
    id: "stability-odd-rate",
    caption: "Largest stable speed at tau = 0.501 against the odd relaxation time: why the product 3/16 is given up near tau = 1/2.",
    timed: false,
    run: |_, full| {
        let mut table = Table::new("tau = 0.501", &["tau minus", "x", "x, reference", "xy", "xy, reference"]);
        let mut found = [Vec::new(), Vec::new()];
        let mut reference = [Vec::new(), Vec::new()];
        // The first two take longest.
        for (tau_minus, x, xy) in ODD_RATE_REFERENCE.into_iter().skip(if full { 0 } else { 3 }) {
            let [a, b] = at_odd_time(tau_minus)?;
            table.push(vec![tau_minus.into(), a.into(), x.into(), b.into(), xy.into()]);
            let at = tau_minus - 0.5;
            found[0].push([at, a]);
            found[1].push([at, b]);
            reference[0].push([at, x]);
            reference[1].push([at, xy]);
        }
        let ([x, xy], [x_reference, xy_reference]) = (found, reference);
        let plot = Plot::new(
            "Limit at tau = 0.501",
            Axis::log("odd tau - 1/2", ""),
            Axis::log("speed", "cells per step"),
        )
        .with(Series::line("along x", x))
        .with(Series::line("along xy", xy))
        .with(Series::markers("along x, reference", x_reference))
        .with(Series::markers("along xy, reference", xy_reference));
        Ok(ExhibitData { tables: vec![table], plots: vec![plot], notes: Vec::new() })
    },
};

/// Noise in time.
pub const HISTORY: Exhibit = Exhibit {
    id: "stability-noise",
    caption: "H1: noise of 1e-9 in a stream of u = 0.05 along (1,1,0) at tau = 0.501, 16³ cells: runs (marks) and the exact linear evolution of the same noise (lines).",
    timed: false,
    run: |backend: &dyn Backend, full| {
        let mut plot = Plot::new("Noise in a fast stream", Axis::linear("steps", ""), Axis::log("noise", ""));
        let wanted: &[usize] = if full { &[0, 1, 2, 3, 4] } else { &[0, 1] };
        for &at in wanted {
            let (name, collision) = OPERATORS[at];
            let history = history(backend, collision)?;
            let points = |norms: &[f64]| -> Vec<[f64; 2]> {
                norms.iter().enumerate().map(|(i, &n)| [f64::from(INTERVAL) * i as f64, n]).collect()
            };
            plot = plot
                .with(Series::line(format!("{name}, linear theory"), points(&history.predicted)))
                .with(Series::markers(name, points(&history.measured)));
        }
        Ok(ExhibitData { tables: Vec::new(), plots: vec![plot], notes: Vec::new() })
    },
};

/// Carried vortices.
pub const GALILEAN: Exhibit = Exhibit {
    id: "stability-galilean",
    caption: "H10: change of the decay rate of carried Taylor-Green vortices, tau = 0.8, for every operator.",
    timed: false,
    run: |backend: &dyn Backend, _| {
        let mut table = Table::new(
            "Defect of the decay rate",
            &["operator", "Ma 0.1", "Ma 0.2", "Ma 0.3", "over U² at Ma 0.3"],
        );
        for (name, collision) in OPERATORS {
            let mut row = vec![name.into()];
            let mut last = (0.0, 1.0);
            for mach in [0.1, 0.2, 0.3] {
                let speed = mach * (1.0_f64 / 3.0).sqrt();
                last = (vortex_defect(backend, collision, speed)?, speed);
                row.push(last.0.into());
            }
            row.push((last.0 / (last.1 * last.1)).into());
            table.push(row);
        }
        Ok::<_, VerifyError>(ExhibitData { tables: vec![table], plots: Vec::new(), notes: Vec::new() })
    },
};
