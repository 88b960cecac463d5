//! Tables and figures of the dam breaks.

use super::newtonian::{self, COLUMN};
use super::slope::{follow, twin, twin_failed};
use super::thesis::{self, C, C_CLAMPED, Case, E, Grid, H};
use rayon::prelude::*;

use crate::claim::VerifyError;
use crate::exact::dam_break::Ritter;
use crate::exhibit::{Entry, Exhibit, ExhibitData, Table};
use lahar::output::plot::{Axis, Plot, Series};
use lahar::rheology::Law;
use lahar::setup::SurfaceForce;
use lahar::solver::run::Backend;

/// The thesis' runs: fronts, profiles, clamp.
pub const RUNS: Exhibit = Exhibit {
    id: "thesis-runs",
    caption: "Runs A, C (= G), E and H of 004 Table 5.1, and C with the papers' largest viscosity of 150 Pa s, each \
              against its own depth-averaged twin; spacing 6 mm, for C and E also 3 mm. The profiles show where \
              lubrication theory stops being the reference: at 1 s the flow is still inertial; later the two \
              differ at the rear wall, within about a depth of the tip and at the steps of the bed. The clamped \
              flow never stops.",
    timed: false,
    run: runs,
};

/// Name, case, spacing in mm.
fn cases(full: bool) -> Vec<(&'static str, Case, f64)> {
    let fine = [("C", C, 3.0), ("E", E, 3.0)].into_iter().filter(|_| full);
    let coarse =
        [("A", thesis::A), ("C", C), ("E", E), ("H", H), ("C, clamp 150 Pa s", C_CLAMPED)].into_iter();
    fine.chain(coarse.map(|(name, case)| (name, case, 6.0))).collect()
}

fn end(full: bool) -> f64 {
    if full { 60.0 } else { 6.0 }
}

/// Times at which fronts are listed, s.
fn times(full: bool) -> Vec<f64> {
    if full {
        vec![1.0, 2.0, 4.0, 6.0, 10.0, 15.0, 20.0, 30.0, 40.0, 50.0, 60.0]
    } else {
        vec![1.0, 3.0, 6.0]
    }
}

fn runs(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let times = times(full);
    let parts: Vec<Result<Part, VerifyError>> = cases(full)
        .into_par_iter()
        .map(|(name, case, spacing)| Part::new(backend, name, &case, spacing, &times))
        .collect();
    let mut table = Table::new(
        "Fronts",
        &[
            "run",
            "dx [mm]",
            "t [s]",
            "x_f [m]",
            "twin [m]",
            "difference [mm]",
            "dx_f/dt [mm/s]",
            "mean u [mm/s]",
            "largest u, liquid [mm/s]",
        ],
    );
    let mut fronts = Plot::new("Fronts on the slope", Axis::linear("t", "s"), Axis::linear("x_f", "m"));
    let mut plots = Vec::new();
    for part in parts {
        let part = part?;
        for row in part.rows {
            table.push(row);
        }
        for curve in part.curves {
            fronts = fronts.with(curve);
        }
        plots.extend(part.profiles);
    }
    plots.insert(0, fronts);
    Ok(ExhibitData { tables: vec![table], plots, ..ExhibitData::default() })
}

/// What one run adds to the exhibit.
struct Part {
    rows: Vec<Vec<Entry>>,
    curves: Vec<Series>,
    profiles: Vec<Plot>,
}

impl Part {
    fn new(
        backend: &dyn Backend,
        name: &str,
        case: &Case,
        spacing: f64,
        times: &[f64],
    ) -> Result<Self, VerifyError> {
        let prepared = case.prepare(Grid::millimetres(spacing));
        let seen = follow(backend, &prepared, times)?;
        let reference = twin(case, times)?;
        let expected: Vec<f64> =
            reference.iter().map(|s| s.front(thesis::THRESHOLD).unwrap_or(f64::NAN)).collect();
        let rows = (0..times.len()).map(|k| {
            let before = k.checked_sub(1).map_or((0.0, thesis::LENGTH), |b| (times[b], seen[b].front));
            let rate = (seen[k].front - before.1) / (times[k] - before.0);
            vec![
                name.into(),
                spacing.into(),
                times[k].into(),
                seen[k].front.into(),
                expected[k].into(),
                (1e3 * (seen[k].front - expected[k])).into(),
                (1e3 * rate).into(),
                (1e3 * seen[k].mean_velocity).into(),
                (1e3 * seen[k].liquid_speed).into(),
            ]
        });
        let curve = |x: &dyn Fn(usize) -> f64| (0..times.len()).map(|k| [times[k], x(k)]).collect();
        let mut curves =
            vec![Series::line_markers(format!("{name}, {spacing} mm"), curve(&|k| seen[k].front))];
        if spacing == 6.0 {
            curves.push(Series::reference(format!("twin {name}"), curve(&|k| expected[k])));
        }
        let x = prepared.positions();
        let profiles = (0..times.len()).filter(|&k| [1.0, 6.0, 60.0].contains(&times[k]) && name.len() == 1);
        let profiles = profiles.map(|k| {
            let points = |x: &[f64], h: &[f64]| {
                let all = x.iter().zip(h).map(|(x, h)| [*x, 1e3 * h]);
                all.filter(|[x, _]| *x < case.box_length).collect::<Vec<_>>()
            };
            let title = format!("Run {name}, {} s, {spacing} mm", times[k]);
            Plot::new(title, Axis::linear("x", "m"), Axis::linear("h", "mm"))
                .with(Series::line("lahar", points(&x, &seen[k].depths)))
                .with(Series::reference("depth-averaged twin", points(&reference[k].x, &reference[k].h)))
        });
        Ok(Self { rows: rows.collect(), curves, profiles: profiles.collect() })
    }
}

/// Run C against Δt and Δx.
pub const TIME_STEP: Exhibit = Exhibit {
    id: "thesis-time-step",
    caption: "Run C against the time step, on 6 mm. A reservoir at rest is compressed by its weight: with the surface as \
              drawn it holds more mass, half of 3 g H dt^2/dx^2 on average, and the thin flow that it becomes has that \
              much more volume. A settled reservoir starts lower, with the mass that was drawn. The twin's share \
              is not taken from these runs: it is how far the twin's front moves when its volume grows by that share.",
    timed: false,
    run: time_step,
};

fn time_step(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let time = end(full);
    let mut table = Table::new(
        format!("Run C: front at {time} s"),
        &[
            "dx [mm]",
            "3 g H dt2/dx2",
            "dt [ms]",
            "x_f as drawn [m]",
            "x_f settled [m]",
            "settled minus twin [mm]",
            "as drawn minus settled [mm]",
            "twin's share of the added mass [mm]",
            "Mach at 1 m/s",
            "plastic tau at 1/s",
            "dt over the papers' dt",
        ],
    );
    let steps: &[f64] = if full { &[0.005, 0.01, 0.02, 0.04, 0.08] } else { &[0.02, 0.08] };
    let law = Law::HerschelBulkley { sigma0: thesis::YIELD_STRESS, k: thesis::CONSISTENCY, n: thesis::INDEX };
    let expected = twin(&C, &[time])?[0].front(thesis::THRESHOLD).unwrap_or(f64::NAN);
    let grids: Vec<Grid> =
        steps.iter().map(|&compression| Grid { compression, ..Grid::millimetres(6.0) }).collect();
    let seen: Vec<Result<[f64; 2], VerifyError>> = grids
        .par_iter()
        .map(|&grid| {
            let front = |settled| -> Result<f64, VerifyError> {
                Ok(follow(backend, &C.prepare(Grid { settled, ..grid }), &[time])?[0].front)
            };
            Ok([front(false)?, front(true)?])
        })
        .collect();
    for (grid, fronts) in grids.into_iter().zip(seen) {
        let [drawn, settled] = fronts?;
        let volume = thesis::VOLUME * (1.0 + 0.5 * grid.compression * mean_depth_share());
        let swollen = C.twin_of_volume(law, &[time], volume).map_err(twin_failed)?;
        let share = swollen[0].front(thesis::THRESHOLD).unwrap_or(f64::NAN) - expected;
        let dt = C.time_step(grid);
        // The papers keep tau_max = 1.5 at 150 Pa s.
        let papers = thesis::DENSITY * grid.dx * grid.dx / (3.0 * 150.0);
        let viscosity = thesis::CONSISTENCY * thesis::INDEX;
        table.push(vec![
            (1e3 * grid.dx).into(),
            grid.compression.into(),
            (1e3 * dt).into(),
            drawn.into(),
            settled.into(),
            (1e3 * (settled - expected)).into(),
            (1e3 * (drawn - settled)).into(),
            (1e3 * share).into(),
            (3.0_f64.sqrt() * dt / grid.dx).into(),
            (0.5 + 3.0 * viscosity * dt / (thesis::DENSITY * grid.dx * grid.dx)).into(),
            (dt / papers).into(),
        ]);
    }
    Ok(ExhibitData { tables: vec![table], ..ExhibitData::default() })
}

/// ∫ h² dx/(H ∫ h dx) of the reservoir: its mean pressure over that of its deepest column.
fn mean_depth_share() -> f64 {
    let gate = C.gate_depth();
    let rear = gate - thesis::LENGTH * libm::tan(C.slope_deg.to_radians());
    let cubes = gate * gate * gate - rear * rear * rear;
    cubes / (3.0 * (gate - rear)) / (gate * thesis::VOLUME / thesis::LENGTH)
}

/// Ritter's dam and the collapsing column.
pub const NEWTONIAN_HISTORY: Exhibit = Exhibit {
    id: "newtonian-dam-breaks",
    caption: "Inviscid dam break against Ritter and a collapsing column against the experiment of Martin and Moyce, \
              by resolution and by the force rule in interface cells.",
    timed: false,
    run: newtonian_history,
};

fn newtonian_history(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let rules = [
        ("full", SurfaceForce::Full),
        ("by fill", SurfaceForce::ByFill),
        ("by fill and inertia", SurfaceForce::ByFillAndInertia),
    ];
    let times = [0.5, 1.0, 2.0, 3.0, 4.0, 6.0];
    let exact = Ritter { depth: 1.0, gravity: 1.0 };
    let mut ritter = Table::new(
        "Dam break on a slippery floor: depth at the dam and front at depth 0.02 h0",
        &["h0/dx", "force", "t / sqrt(h0/g)", "h(0)/h0 (Ritter 0.4444)", "front/h0", "Ritter"],
    );
    let heights: &[usize] = if full { &[12, 24, 48] } else { &[12, 24] };
    for &height in heights {
        for (name, rule) in rules {
            let block = newtonian::inviscid(height, rule);
            let seen = newtonian::ritter_view(backend, &block, &times)?;
            for (time, [depth, front]) in times.iter().zip(seen) {
                let expected = exact.front(*time) * (1.0 - 1.5 * 0.02_f64.sqrt());
                ritter.push(vec![
                    height.into(),
                    name.into(),
                    (*time).into(),
                    depth.into(),
                    front.into(),
                    expected.into(),
                ]);
            }
        }
    }
    let mut plot =
        Plot::new("Collapsing column", Axis::linear("T = t sqrt(2g/a)", ""), Axis::linear("Z = x/a", ""))
            .with(Series::markers("Martin and Moyce 1952", COLUMN.to_vec()));
    let widths: &[usize] = if full { &[16, 32, 64] } else { &[16, 32] };
    let mut column = Table::new(
        "Collapsing column: Z at the times of the experiment",
        &["a/dx", "force", "T 0.849", "1.212", "1.602", "2.283", "2.950", "3.598"],
    );
    column.push(
        ["", "experiment"]
            .map(Into::into)
            .into_iter()
            .chain(COLUMN.iter().map(|[_, z]| (*z).into()))
            .collect(),
    );
    for &width in widths {
        for (name, rule) in rules {
            let fronts = newtonian::column_fronts(backend, &newtonian::column(width, rule))?;
            let points = COLUMN.iter().zip(&fronts).map(|([t, _], z)| [*t, *z]).collect();
            plot = plot.with(Series::line(format!("a = {width}, {name}"), points));
            column.push(
                [width.into(), name.into()].into_iter().chain(fronts.iter().map(|z| (*z).into())).collect(),
            );
        }
    }
    Ok(ExhibitData { tables: vec![ritter, column], plots: vec![plot], ..ExhibitData::default() })
}
