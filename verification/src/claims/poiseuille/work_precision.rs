//! What an error costs: schemes × resolutions × time steps for three fluids.

use std::time::Instant;

use super::channel::{BINGHAM, Column, THESIS};
use super::clamped::lagged;
use crate::claim::{Sample, VerifyError};
use crate::exhibit::{Entry, Exhibit, ExhibitData, Table};
use lahar::collision::{CollisionChoice, OddRate};
use lahar::output::plot::{Axis, Plot, Series};
use lahar::rheology::Law;
use lahar::setup::WallRule;
use lahar::solver::run::Backend;

/// Error and work, the same bits on every machine.
pub const WORK: Exhibit = Exhibit {
    id: "work-precision",
    caption: "Channel flow from rest: relative L2 error against the updates of cells it takes to come within a tenth of it.",
    timed: false,
    run: |backend, full| exhibit(backend, full, false),
};

/// Error and seconds.
pub const SECONDS: Exhibit = Exhibit {
    id: "work-precision-seconds",
    caption: "Channel flow from rest: relative L2 error against computing time on one core.",
    timed: true,
    run: |backend, full| exhibit(backend, full, true),
};

/// Lattice velocity of the flow.
const SPEED: f64 = 1e-3;
/// Cell updates that a single run may use.
const BUDGET: [f64; 2] = [3e6, 2e7];

const FLUIDS: [(&str, Law); 3] =
    [("Newtonian", Law::Newtonian { mu: 0.2 }), ("Bingham", BINGHAM), ("Herschel-Bulkley n = 0.33", THESIS)];

#[derive(Clone, Copy, PartialEq)]
enum Scheme {
    /// BGK, lagged, clamped at τ_max = 1.5 (a plain BGK for the Newtonian fluid).
    Papers,
    /// BGK with viscosity-independent walls (Newtonian only).
    BgkB3,
    /// TRT Λ = 3/16 with the floor θ.
    Trt,
    /// Central moments, half-way walls.
    Central,
    /// Central moments, viscosity-independent walls.
    CentralB3,
}

const SCHEMES: [(Scheme, &str); 5] = [
    (Scheme::Papers, "papers' scheme (BGK, lagged clamp)"),
    (Scheme::BgkB3, "BGK, [B3]"),
    (Scheme::Trt, "TRT, exact yield"),
    (Scheme::Central, "central moments, exact yield"),
    (Scheme::CentralB3, "central moments, exact yield, [B3]"),
];

impl Scheme {
    /// Δt/Δx² to try. The clamp of the papers' scheme is at a fixed viscosity, so large steps give
    /// large τ and a large slip.
    fn steps(self) -> &'static [f64] {
        match self {
            Self::Papers => &[0.0125, 0.05, 0.2, 1.0],
            _ => &[0.25, 1.0, 4.0],
        }
    }

    fn column(self, n: usize, law: &Law, step: f64) -> Option<Column> {
        let newtonian = matches!(law, Law::Newtonian { .. });
        let free = Column::unit(n, law, step, SPEED);
        let half_way = Column { wall: WallRule::HalfWay, ..free };
        match self {
            Self::Papers if newtonian => Some(Column { collision: CollisionChoice::Bgk, ..half_way }),
            Self::Papers => Some(lagged(n, law, 1.5, step, SPEED)),
            Self::BgkB3 => newtonian.then_some(Column { collision: CollisionChoice::Bgk, ..free }),
            Self::Trt => {
                let odd = OddRate { floor: 0.05, ..OddRate::fixed(3.0 / 16.0) };
                Some(Column { collision: CollisionChoice::Trt(odd), ..half_way })
            }
            Self::Central => Some(half_way),
            Self::CentralB3 => Some(free),
        }
    }
}

/// One run.
struct Point {
    error: f64,
    steps: u64,
    updates: f64,
    seconds: f64,
}

/// From rest until the profile stays within a tenth of the scheme's own error of the scheme's steady
/// state, or within 1e-6 where that error is smaller; the error counted is against the ideal law.
fn measure(backend: &dyn Backend, column: &Column, budget: f64) -> Result<Option<Point>, VerifyError> {
    let mut ideal = *column;
    ideal.yielding = lahar::setup::YieldTreatment::Exact;
    let (reference, goal) = (ideal.reference()?, column.scheme()?);
    let own = Sample::l2(0.0, &goal, &reference).error;
    let wanted = (0.1 * own).max(1e-6);
    let cells = column.n as f64;
    let interval = ((0.01 * column.relaxation_steps()?).ceil()).max(10.0);
    let mut run = backend.start(&column.setup())?;
    let mut seconds = 0.0;
    let mut reached: Option<Point> = None;
    while (run.step() as f64 + interval) * cells <= budget {
        let start = Instant::now();
        if run.advance(interval as u64).is_err() {
            return Ok(None);
        }
        seconds += start.elapsed().as_secs_f64();
        let u: Vec<f64> = run.fields().velocity.iter().map(|u| u[0]).collect();
        if Sample::l2(0.0, &u, &goal).error > wanted {
            reached = None;
            continue;
        }
        let steps = run.step();
        match &reached {
            None => {
                let error = Sample::l2(0.0, &u, &reference).error;
                reached = Some(Point { error, steps, updates: steps as f64 * cells, seconds });
            }
            // Not a passing swing: it has stayed there for half as long again.
            Some(point) if 2 * steps >= 3 * point.steps => return Ok(reached),
            Some(_) => {}
        }
    }
    Ok(None)
}

/// Adds what errors cost on the best runs of either side.
fn savings_of(savings: &mut Table, fluid: &str, fronts: &[Vec<[f64; 2]>; 2]) {
    for wanted in [2e-2, 1e-2, 5e-3, 2e-3] {
        if let (Some(papers), Some(ours)) = (cost_at(&fronts[0], wanted), cost_at(&fronts[1], wanted)) {
            savings.push(vec![
                fluid.into(),
                wanted.into(),
                papers.into(),
                ours.into(),
                (papers / ours).into(),
            ]);
        }
    }
}

fn exhibit(backend: &dyn Backend, full: bool, timed: bool) -> Result<ExhibitData, VerifyError> {
    let sizes: &[usize] = if full { &[16, 32, 64, 128] } else { &[16, 32] };
    let budget = BUDGET[usize::from(full)];
    let mut data = ExhibitData::default();
    let mut head = vec!["fluid", "scheme", "N", "Δt/Δx²", "L2 error", "steps", "million updates"];
    if timed {
        head.extend(["seconds", "MLUPS"]);
    }
    let mut table = Table::new("Error and cost", &head);
    let unit = if timed { "s" } else { "million cell updates" };
    let cost_head = format!("papers' scheme [{unit}]");
    let own_head = format!("exact yield [{unit}]");
    let mut savings = Table::new(
        "Cost at equal error, interpolated on each side's best runs",
        &["fluid", "L2 error", &cost_head, &own_head, "saving"],
    );
    for (fluid, law) in &FLUIDS {
        let mut fronts: [Vec<[f64; 2]>; 2] = Default::default();
        let label = if timed { "computing time" } else { "work" };
        let mut plot = Plot::new(*fluid, Axis::log(label, unit), Axis::log("relative L2 error", ""));
        for (scheme, name) in SCHEMES {
            let mut points = Vec::new();
            for &n in sizes {
                for &step in scheme.steps() {
                    let Some(column) = scheme.column(n, law, step) else { continue };
                    let mut row: Vec<Entry> = vec![(*fluid).into(), name.into(), n.into(), step.into()];
                    match measure(backend, &column, budget)? {
                        Some(p) => {
                            row.extend([p.error.into(), p.steps.into(), (1e-6 * p.updates).into()]);
                            if timed {
                                row.extend([p.seconds.into(), (1e-6 * p.updates / p.seconds).into()]);
                            }
                            points.push([if timed { p.seconds } else { 1e-6 * p.updates }, p.error]);
                        }
                        None => row.push(format!("not steady within {budget:.1e} updates").into()),
                    }
                    table.push(row);
                }
            }
            fronts[usize::from(scheme != Scheme::Papers)].extend(&points);
            if !points.is_empty() {
                plot = plot.with(Series::markers(name, points));
            }
        }
        data.plots.push(plot);
        savings_of(&mut savings, fluid, &fronts);
    }
    data.tables.extend([savings, table]);
    data.notes.push(
        "The error is against the ideal law: for the papers' scheme it holds the error of the clamp (τ_max = 1.5) as \
         well. Runs start from rest and end when the profile is within a tenth of its own error of the steady state \
         that the scheme has in closed form."
            .to_owned(),
    );
    Ok(data)
}

/// Least cost of an error, interpolated between the best points on logarithmic axes; `None` outside.
fn cost_at(points: &[[f64; 2]], wanted: f64) -> Option<f64> {
    let mut best: Vec<[f64; 2]> = points
        .iter()
        .copied()
        .filter(|p| points.iter().all(|q| q == p || !(q[0] <= p[0] && q[1] <= p[1])))
        .collect();
    best.sort_by(|a, b| a[0].total_cmp(&b[0]));
    if let Some(first) = best.first().filter(|p| p[1] <= wanted) {
        return Some(first[0]);
    }
    best.windows(2).find(|w| w[0][1] >= wanted && wanted >= w[1][1]).map(|w| {
        let share = libm::log(w[0][1] / wanted) / libm::log(w[0][1] / w[1][1]);
        w[0][0] * libm::exp(share * libm::log(w[1][0] / w[0][0]))
    })
}
