//! Profiles of the three laws, and the error against depth for each force rule.

use super::support::Sheet;
use super::{newtonian, yielding};
use crate::claim::VerifyError;
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::output::plot::{Axis, Plot, Series};
use lahar::setup::SurfaceForce;
use lahar::solver::run::Backend;
use yielding::Fluid;

/// Profiles.
pub const PROFILES: Exhibit = Exhibit {
    id: "film-profiles",
    caption: "Films of 8.25 cells on 16 degrees: cell values (marks) on the exact profiles (dashed). The last mark is \
              the interface cell, a quarter full: its centre lies above the surface.",
    timed: false,
    run: profiles,
};

fn profiles(backend: &dyn Backend, _full: bool) -> Result<ExhibitData, VerifyError> {
    let depth = 8.25;
    let mut plot = Plot::new(
        "Film of 8.25 cells on an incline",
        Axis::linear("u / surface velocity", ""),
        Axis::linear("z / H", ""),
    );
    for (name, sheet) in [
        ("Newtonian", newtonian::sheet(depth)),
        ("Bingham", yielding::sheet(Fluid::Bingham, depth)),
        ("Herschel-Bulkley, n = 0.33", yielding::sheet(Fluid::HerschelBulkley, depth)),
    ] {
        let flow = if name == "Newtonian" {
            newtonian::rest_of(&sheet, backend)?
        } else {
            sheet.steady(backend, yielding::STEADY)?
        };
        let film = sheet.exact();
        let unit = film.surface_velocity();
        let marks =
            flow.velocity.iter().enumerate().map(|(k, u)| [u / unit, (k as f64 + 0.5) / depth]).collect();
        let curve =
            (0..=64).map(|k| f64::from(k) / 64.0).map(|z| [film.velocity(z * depth) / unit, z]).collect();
        plot =
            plot.with(Series::markers(name, marks)).with(Series::reference(format!("{name}, exact"), curve));
    }
    Ok(ExhibitData { plots: vec![plot], ..ExhibitData::default() })
}

/// Error against depth.
pub const AGAINST_DEPTH: Exhibit = Exhibit {
    id: "film-error-against-depth",
    caption: "Error of the discharge of a Newtonian film against its depth, for the three rules for gravity in \
              interface cells. With full gravity it is of first order and depends on the fill level; by fill it is of \
              second order. In steady flow nothing accelerates and the rule with inertia is the rule by fill.",
    timed: false,
    run: against_depth,
};

fn against_depth(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let depths: &[f64] = if full {
        &[
            1.25, 1.5, 1.75, 2.0, 2.25, 2.5, 3.0, 3.5, 4.0, 4.5, 6.0, 6.5, 8.0, 8.5, 12.5, 16.0, 16.5, 32.0,
            32.5,
        ]
    } else {
        &[1.5, 2.0, 2.5, 3.0, 4.0, 4.5, 6.0, 8.0, 8.5]
    };
    let mut table =
        Table::new("Error of q in per cent", &["H (cells)", "full", "by fill", "by fill and inertia"]);
    let rules = [
        ("full", SurfaceForce::Full),
        ("by fill", SurfaceForce::ByFill),
        ("by fill and inertia", SurfaceForce::ByFillAndInertia),
    ];
    let mut points = [const { Vec::new() }; 3];
    for &depth in depths {
        let mut row = vec![depth.into()];
        for (k, (_, force)) in rules.iter().enumerate() {
            let sheet = Sheet { force: *force, ..newtonian::sheet(depth) };
            let error = newtonian::rest_of(&sheet, backend)?.flux() / sheet.exact().flux() - 1.0;
            points[k].push([depth, error.abs()]);
            row.push((100.0 * error).into());
        }
        table.push(row);
    }
    let mut plot = Plot::new(
        "Discharge of a film: error against depth",
        Axis::log("H", "cells"),
        Axis::log("relative error of q", ""),
    );
    for ((name, _), points) in rules.iter().zip(points) {
        plot = plot.with(Series::line_markers(*name, points));
    }
    plot = plot.with(Series::reference("1/(8 H^2)", depths.iter().map(|h| [*h, 0.125 / (h * h)]).collect()));
    Ok(ExhibitData { tables: vec![table], plots: vec![plot], ..ExhibitData::default() })
}
