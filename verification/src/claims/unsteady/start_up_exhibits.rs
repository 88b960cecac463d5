//! Start-up of yield-stress channel flow: error against the time step, and profiles.

use super::start_up::{B3, Case, Fluid, Start};
use super::support::from_middle;
use crate::claim::VerifyError;
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::output::plot::{Axis, Plot, Series};
use lahar::setup::WallRule;
use lahar::solver::run::Backend;

/// Error against plastic τ, with and without \[B3\].
pub const ERROR_AGAINST_TAU: Exhibit = Exhibit {
    id: "start-up-error-against-tau",
    caption: "Start-up from rest: error over all times against the plastic relaxation time at fixed N, \
              with the half-way wall as it stands and with the viscosity-independent wall.",
    timed: false,
    run: error_against_tau,
};

/// Profiles of two starts.
pub const PROFILES: Exhibit = Exhibit {
    id: "start-up-profiles",
    caption: "Bingham start-up on 32 cells at plastic tau 0.65 with the viscosity-independent wall (marks) against \
              the one-dimensional reference (dashed), at the four times of the claims in h2/nu.",
    timed: false,
    run: profiles,
};

fn profiles(backend: &dyn Backend, _full: bool) -> Result<ExhibitData, VerifyError> {
    let mut plots = Vec::new();
    for (start, title) in
        [(Start::Sudden, "Force switched on at once"), (Start::Smooth, "Force that sets in smoothly")]
    {
        let case = Case { fluid: Fluid::Bingham, start, wall: B3, cells: 32, tau: 0.65, floor: 0.05 };
        let (computed, exact) = case.profiles(backend)?;
        let mut plot = Plot::new(title, Axis::linear("y / h", ""), Axis::linear("u mu / G h2", ""));
        for (time, (u, v)) in start.times().iter().zip(computed.iter().zip(&exact)) {
            let points = |values: &[f64]| -> Vec<[f64; 2]> {
                let y = |j: usize| from_middle(j, case.cells) / case.h();
                (case.cells / 2..case.cells).map(|j| [y(j), values[j]]).collect()
            };
            plot = plot.with(Series::markers(format!("t = {time}"), points(u)));
            plot = plot.with(Series::reference(format!("reference, t = {time}"), points(v)));
        }
        plots.push(plot);
    }
    Ok(ExhibitData { plots, ..ExhibitData::default() })
}

fn error_against_tau(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let cells: &[usize] = if full { &[16, 32, 64] } else { &[16, 32] };
    let taus: &[f64] = if full { &[0.55, 0.575, 0.65, 0.8, 1.1, 1.25, 2.0] } else { &[0.65, 0.8, 1.1, 2.0] };
    let mut table = Table::new(
        "Relative L2 error of the start-up against plastic tau",
        &["fluid", "N", "wall", "tau", "all times", "t = 1/16", "t = 1/8", "t = 1/4", "t = 1/2"],
    );
    let mut plot = Plot::new(
        "Start-up error against plastic relaxation time",
        Axis::log("tau - 1/2", ""),
        Axis::log("relative L2 error", ""),
    );
    for (start, fluid, name) in [
        (Start::Sudden, Fluid::Bingham, "sudden Bingham"),
        (Start::Sudden, Fluid::HerschelBulkley, "sudden HB"),
        (Start::Smooth, Fluid::Bingham, "smooth Bingham"),
        (Start::Smooth, Fluid::HerschelBulkley, "smooth HB"),
    ] {
        for (wall, rule) in [(WallRule::HalfWay, "half-way"), (B3, "[B3]")] {
            for &n in cells {
                let mut points = Vec::new();
                for &tau in taus {
                    let sample =
                        Case { fluid, start, wall, cells: n, tau, floor: 0.05 }.sample(backend, tau)?;
                    points.push([tau - 0.5, sample.error]);
                    let mut row = vec![name.into(), n.into(), rule.into(), tau.into(), sample.error.into()];
                    row.extend(
                        start
                            .times()
                            .iter()
                            .map(|t| sample.extra[&format!("error at t = {t} h2/nu [-]")].into()),
                    );
                    table.push(row);
                }
                plot = plot.with(Series::line_markers(format!("{name}, N={n}, {rule}"), points));
            }
        }
    }
    let notes = vec![
        "The curvature of the profile at the wall is taken from F - grad p where the apparent viscosity does not \
         account for it, and F is not the stress gradient while the flow accelerates: compare the two walls row by \
         row. In steady flow [B3] removes the wall error."
            .to_owned(),
    ];
    Ok(ExhibitData { tables: vec![table], plots: vec![plot], notes })
}
