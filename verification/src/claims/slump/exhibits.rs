//! Profiles on several grids, spread against time, and what the papers' clamp makes of the same heap.

use super::shear::{HEAP, watch};
use super::twin::{self, EDGE_OVER_GYRATION, SteepRest};
use crate::claim::VerifyError;
use crate::exact::thin_layer::Snapshot;
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::output::plot::{Axis, Plot, Series};
use lahar::solver::run::Backend;

/// Profiles.
pub const PROFILES: Exhibit = Exhibit {
    id: "slump-profiles",
    caption: "Depth of the low heap against radius at t = 320 mu/(rho g H), mean of rings one cell wide, beside the \
              depth-averaged twin at the same time, Roussel and Coussot's rest shape and the next order of it.",
    timed: false,
    run: profiles,
};

/// Spread.
pub const CLAMP: Exhibit = Exhibit {
    id: "slump-clamp",
    caption: "Spread of the same heap with the exact yield stress and with the papers' clamp (tau_max = 1.5, largest over \
              least viscosity 1000), each beside its depth-averaged twin. The clamped fluid never stops.",
    timed: false,
    run: clamp,
};

/// τ_max and μ_max/μ_min of the papers.
const TAU_MAX: f64 = 1.5;
const RATIO: f64 = 1000.0;

fn profiles(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let time = [320.0];
    let mut plot = Plot::new("Low heap at t = 320", Axis::linear("r / H", ""), Axis::linear("h / H", ""));
    let grids: &[f64] = if full { &[6.0, 9.0, 12.0] } else { &[6.0] };
    for &n in grids {
        let (views, _) = watch(backend, &HEAP, &HEAP.setup(n), n, &time)?;
        let view = &views[0];
        let points = view.r.iter().zip(&view.h).filter(|(r, _)| **r < HEAP.reach);
        plot = plot.with(Series::markers(format!("N = {n}"), points.map(|(r, h)| [*r, *h]).collect()));
    }
    let samples: Vec<f64> = (0..=280).map(|i| f64::from(i) * 0.02).collect();
    let curve = |h: &dyn Fn(f64) -> f64| samples.iter().map(|r| [*r, h(*r)]).collect::<Vec<_>>();
    let references = twin::ideal(&HEAP, &time)?;
    let (rest, steep) = (twin::rest(&HEAP)?, SteepRest::new(&HEAP, SteepRest::FACTORS[0]));
    plot = plot
        .with(Series::line("start", curve(&|r| HEAP.weight(r))))
        .with(Series::line("twin", curve(&|r| twin::depth(&references[0], r))))
        .with(Series::reference("Roussel-Coussot, at rest", curve(&|r| rest.height(r))))
        .with(Series::reference("next order, at rest", curve(&|r| steep.height(r))));
    Ok(ExhibitData { plots: vec![plot], ..ExhibitData::default() })
}

fn spread_plot(times: &[f64], radii: &[Vec<f64>; 4]) -> Result<Plot, VerifyError> {
    let names = ["exact yield", "clamped", "twin", "clamped twin"];
    let mut plot =
        Plot::new("Spread against time", Axis::log("t", "mu/(rho g H)"), Axis::linear("R / H", ""));
    for (k, (name, radii)) in names.iter().zip(radii).enumerate() {
        let points: Vec<[f64; 2]> = times.iter().zip(radii).map(|(t, r)| [*t, *r]).collect();
        plot = plot.with(if k < 2 {
            Series::line_markers(*name, points)
        } else {
            Series::reference(*name, points)
        });
    }
    let rest = twin::rest(&HEAP)?.edge();
    let ends = vec![[times[0], rest], [times[times.len() - 1], rest]];
    Ok(plot.with(Series::line("Roussel-Coussot", ends)))
}

fn clamp(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let n = 6.0;
    let longest = if full { 8 } else { 6 };
    let times: Vec<f64> = (0..=longest).map(|i| 5.0 * f64::from(1 << i)).collect();
    let most = (TAU_MAX - 0.5) / 3.0 / HEAP.viscosity(n);
    let (exact, _) = watch(backend, &HEAP, &HEAP.setup(n), n, &times)?;
    let (clamped, _) = watch(backend, &HEAP, &HEAP.clamped(n, TAU_MAX, RATIO), n, &times)?;
    let (ideal_twin, clamped_twin) =
        (twin::ideal(&HEAP, &times)?, twin::clamped(&HEAP, most, RATIO, &times)?);
    let radii = [
        exact.iter().map(|view| view.gyration).collect::<Vec<_>>(),
        clamped.iter().map(|view| view.gyration).collect(),
        ideal_twin.iter().map(twin::gyration).collect(),
        clamped_twin.iter().map(|s: &Snapshot| twin::gyration(s)).collect(),
    ]
    .map(|radii| radii.into_iter().map(|r| r * EDGE_OVER_GYRATION).collect::<Vec<f64>>());
    let mut table = Table::new(
        "R = (21/8)^1/2 times the radius of gyration, and its growth since the row above in cells per 1000 steps",
        &[
            "t [mu/(rho g H)]",
            "R exact yield [H]",
            "R clamped [H]",
            "R twin [H]",
            "R clamped twin [H]",
            "growth, exact yield",
            "growth, clamped",
            "largest speed, exact yield [lattice]",
            "largest speed, clamped [lattice]",
        ],
    );
    for (i, time) in times.iter().enumerate() {
        let mut row = vec![(*time).into()];
        row.extend(radii.iter().map(|radii| radii[i].into()));
        for radii in &radii[..2] {
            row.push(if i == 0 {
                "".into()
            } else {
                let steps = (time - times[i - 1]) * HEAP.unit_of_time(n);
                ((radii[i] - radii[i - 1]) * n / steps * 1000.0).into()
            });
        }
        row.extend([exact[i].speed.into(), clamped[i].speed.into()]);
        table.push(row);
    }
    let plot = spread_plot(&times, &radii)?;
    let notes = vec![format!(
        "At N = {n} and this time step tau_max = 1.5 is an apparent viscosity of {most:.2} plastic ones; the bed of the heap \
         flows wherever it should stand."
    )];
    Ok(ExhibitData { tables: vec![table], plots: vec![plot], notes })
}
