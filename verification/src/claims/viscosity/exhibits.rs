//! Tables and figures of the study.

use super::convergence::{along, schemes};
use super::table::entry;
use super::vortices::{energies, reference_energy};
use super::waves::Wave;
use crate::claim::VerifyError;
use crate::exact::shear_wave::galilean_viscosity_ratio;
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::output::plot::{Axis, Plot, Series};
use lahar::solver::run::Backend;

pub(super) const EXHIBITS: &[Exhibit] = &[
    Exhibit {
        id: "viscosity-against-resolution",
        caption: "Error of the viscosity of a shear wave along an axis against the cells per wave, all four operators; the dashed line has slope −2.",
        timed: false,
        run: viscosity,
    },
    Exhibit {
        id: "galilean-defect",
        caption: "Viscosity of a shear wave in a mean flow along its wave vector: BGK and TRT follow 1 − 3U², the central-moment and the regularised operator do not.",
        timed: false,
        run: defect,
    },
    Exhibit {
        id: "taylor-green-energies",
        caption: "Kinetic energy of the three-dimensional Taylor-Green vortex at Re = 20 and the spectral reference.",
        timed: false,
        run: taylor_green,
    },
];

fn viscosity(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let sizes: &[usize] = if full { &[8, 16, 32, 64, 128] } else { &[8, 16, 32, 64] };
    let mut data = ExhibitData::default();
    for tau in [0.55, 0.8, 1.8] {
        let mut table = Table::new(
            format!("ν_eff/ν of a shear wave along an axis, τ = {tau}"),
            &["N", "BGK", "reference", "TRT 3/16", "reference", "central moment", "regularised"],
        );
        let mut curves: [Vec<[f64; 2]>; 4] = std::array::from_fn(|_| Vec::new());
        for &n in sizes {
            let mut ratios = [0.0; 4];
            for (index, (_, collision, relaxation)) in schemes(tau).into_iter().enumerate() {
                ratios[index] = Wave::axis(n).viscosity_ratio(backend, collision, relaxation)?;
                curves[index].push([n as f64, (ratios[index] - 1.0).abs()]);
            }
            let known = |op: &str| entry(op, tau, n as f64, "axis").map_or_else(|| "–".into(), Into::into);
            table.push(vec![
                n.into(),
                ratios[0].into(),
                known("BGK"),
                ratios[1].into(),
                known("TRT3/16"),
                ratios[2].into(),
                ratios[3].into(),
            ]);
        }
        let mut plot = Plot::new(
            format!("Viscosity error of a shear wave, τ = {tau}"),
            Axis::log("N", "cells per wave"),
            Axis::log("|ν_eff/ν − 1|", ""),
        );
        for ((name, _, _), points) in schemes(tau).into_iter().zip(curves) {
            plot = plot.with(Series::line_markers(name, points));
        }
        let slope = sizes.iter().map(|&n| [n as f64, 4.0 / (n * n) as f64]).collect();
        data.plots.push(plot.with(Series::reference("slope −2", slope)));
        data.tables.push(table);
    }
    Ok(data)
}

fn defect(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let speeds: &[f64] = if full {
        &[0.0, 0.025, 0.05, 0.075, 0.1, 0.125, 0.15, 0.173]
    } else {
        &[0.0, 0.05, 0.1, 0.15, 0.173]
    };
    let mut table = Table::new(
        "ν_eff/ν of a shear wave of 128 cells along the mean flow U, τ = 0.8",
        &["U", "BGK", "TRT", "central moment", "regularised", "1 − 3U²"],
    );
    let mut curves: [Vec<[f64; 2]>; 4] = std::array::from_fn(|_| Vec::new());
    for &speed in speeds {
        let mut row = vec![speed.into()];
        for (index, (_, collision, relaxation)) in schemes(0.8).into_iter().enumerate() {
            let ratio = along(128, speed).viscosity_ratio(backend, collision, relaxation)?;
            curves[index].push([speed, ratio]);
            row.push(ratio.into());
        }
        row.push(galilean_viscosity_ratio(speed).into());
        table.push(row);
    }
    let mut plot = Plot::new(
        "Galilean defect in shear",
        Axis::linear("U", "cells per step"),
        Axis::linear("ν_eff/ν", ""),
    );
    for ((name, _, _), points) in schemes(0.8).into_iter().zip(curves) {
        plot = plot.with(Series::line_markers(name, points));
    }
    let theory = speeds.iter().map(|&u| [u, galilean_viscosity_ratio(u)]).collect();
    Ok(ExhibitData {
        tables: vec![table],
        plots: vec![plot.with(Series::reference("1 − 3U²", theory))],
        notes: Vec::new(),
    })
}

fn taylor_green(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let sizes: &[usize] = if full { &[16, 32, 64] } else { &[16, 24, 32] };
    let mut columns = vec!["t k U".to_owned(), "spectral".to_owned()];
    columns.extend(sizes.iter().map(|n| format!("N = {n}")));
    let heads: Vec<&str> = columns.iter().map(String::as_str).collect();
    let mut table = Table::new("Mean |u|²/2 over U²", &heads);
    let runs: Vec<[f64; 5]> = sizes.iter().map(|&n| energies(backend, n)).collect::<Result<_, _>>()?;
    let mut reference = vec![[0.0, 0.125]];
    for time in 1..=5 {
        let exact = reference_energy(time)?;
        reference.push([time as f64, exact]);
        let mut row = vec![time.into(), exact.into()];
        row.extend(runs.iter().map(|energies| energies[time - 1].into()));
        table.push(row);
    }
    let mut plot = Plot::new(
        "Taylor-Green vortex at Re = 20",
        Axis::linear("t k U", ""),
        Axis::log("mean |u|²/2", "U²"),
    )
    .with(Series::reference("spectral", reference));
    for (n, energies) in sizes.iter().zip(&runs) {
        let points = energies.iter().enumerate().map(|(i, &e)| [(i + 1) as f64, e]).collect();
        plot = plot.with(Series::markers(format!("N = {n}"), points));
    }
    Ok(ExhibitData { tables: vec![table], plots: vec![plot], notes: Vec::new() })
}
