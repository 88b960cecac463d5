//! The thesis' figures 4.2 to 4.4, drawn again with the papers' scheme and with exact yield.

use super::channel::{Column, Plug, Steady, THESIS, run_steady};
use super::clamped::{implicit, lagged, over_yielded, tau};
use crate::claim::{Sample, VerifyError};
use crate::exhibit::{Entry, Exhibit, ExhibitData, Table};
use lahar::collision::CollisionChoice;
use lahar::output::plot::{Axis, Plot, Series};
use lahar::setup::{WallRule, YieldTreatment};
use lahar::solver::run::Backend;

/// Lattice velocity of the plug.
const SPEED: f64 = 1e-3;
/// Δt/Δx² of the papers' scheme here; the thesis has 1/80.
const LAGGED_STEP: f64 = 0.1;
/// Δt/Δx² of the other schemes.
const STEP: f64 = 1.0;
/// u_plug of the ideal fluid in units of half-width and wall stress.
const PLUG_VELOCITY: f64 = 1.993017524;

/// The three figures.
pub const FIGURES: Exhibit = Exhibit {
    id: "thesis-figures",
    caption: "The thesis' channel (figures 4.2-4.4) with the papers' lagged and clamped scheme, with the implicit clamp and \
              with exact yield: profile, largest velocity, root mean square error and plug against τ_max, and the \
              over-yielded channel.",
    timed: false,
    run: figures,
};

fn steady(backend: &dyn Backend, column: &Column) -> Result<Steady, VerifyError> {
    let interval = (0.05 * column.relaxation_steps()?).clamp(50.0, 2e5);
    run_steady(backend, &column.developed()?, 1e-6, interval as u64, (400.0 * interval) as u64)
}

fn exact_yield(n: usize) -> Column {
    Column { wall: WallRule::HalfWay, ..Column::unit(n, &THESIS, STEP, SPEED) }
}

fn figures(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let n = if full { 32 } else { 16 };
    let limits: &[f64] = if full { &[0.6, 0.7, 0.8, 1.0, 1.2, 1.5, 1.8] } else { &[0.6, 1.5] };
    let mut data = ExhibitData::default();
    profiles(backend, n, &mut data)?;
    against_limit(backend, n, limits, &mut data)?;
    over_yield(backend, n, &mut data)?;
    data.notes.push(format!(
        "N = {n} cells across; viscosity limits in Pa s as in the thesis, 80/3·(0.001, τ_max − ½); Δt/Δx² = {LAGGED_STEP} \
         for the papers' scheme and {STEP} for the others (thesis: 1/80), so that τ_max = 1.5 stands for τ = {} here.",
        tau(1.5, LAGGED_STEP)
    ));
    Ok(data)
}

/// Points (y, u/u_plug) of a velocity column.
fn points(column: &Column, u: &[f64], speed: f64) -> Vec<[f64; 2]> {
    let half = 0.5 * column.n as f64;
    u.iter().enumerate().map(|(j, u)| [column.height(j) / half, u / speed]).collect()
}

fn profiles(backend: &dyn Backend, n: usize, data: &mut ExhibitData) -> Result<(), VerifyError> {
    let (ours, papers) = (exact_yield(n), lagged(n, &THESIS, 1.5, LAGGED_STEP, SPEED));
    let fine = exact_yield(400);
    let exact = points(&fine, &fine.reference()?, SPEED);
    let computed = points(&ours, &steady(backend, &ours)?.velocity(0), SPEED);
    let clamped = points(&papers, &steady(backend, &papers)?.velocity(0), SPEED);
    let axis = || (Axis::linear("y/h", ""), Axis::linear("u/u_plug", ""));
    for (title, lowest) in [("Velocity across the channel", -1.0), ("The same near the plug", 0.97)] {
        let (x, y) = axis();
        let near = |p: &[[f64; 2]]| p.iter().copied().filter(|p| p[1] >= lowest).collect::<Vec<_>>();
        data.plots.push(
            Plot::new(title, x, y)
                .with(Series::reference("exact", near(&exact)))
                .with(Series::markers("exact yield", near(&computed)))
                .with(Series::markers("papers' scheme, τ_max = 1.5", near(&clamped))),
        );
    }
    Ok(())
}

/// Largest velocity, RMS error against the ideal law, apparent half-width of the plug.
struct Row {
    ratio: f64,
    rms: f64,
    plug: f64,
}

fn row(backend: &dyn Backend, column: &Column) -> Result<Row, VerifyError> {
    let steady = steady(backend, column)?;
    let u = steady.velocity(0);
    let ideal = Column { yielding: YieldTreatment::Exact, ..*column };
    let largest = u.iter().fold(0.0, |a: f64, b| if *b <= a { a } else { *b });
    let cells = match column.yielding {
        YieldTreatment::Exact => Plug::of(column, &steady.fields)?.cells,
        YieldTreatment::ImplicitClamped { tau_max, .. } | YieldTreatment::LaggedClamped { tau_max, .. } => {
            // Cells at the limit, to the rounding of 1/τ.
            steady.fields.omega.iter().filter(|w| **w <= (1.0 + 1e-12) / tau_max).count()
        }
    };
    Ok(Row {
        ratio: largest / SPEED,
        rms: Sample::l2(0.0, &u, &ideal.reference()?).error,
        plug: cells as f64 / column.n as f64,
    })
}

/// One plot per quantity, one curve per scheme.
fn limit_plots(curves: &[[Vec<[f64; 2]>; 3]; 3]) -> Vec<Plot> {
    let mut plots = Vec::new();
    let labels = ["u_max/u_plug", "relative RMS error", "plug half-width / h"];
    for (k, label) in labels.into_iter().enumerate() {
        let y = if k == 1 { Axis::log(label, "") } else { Axis::linear(label, "") };
        let mut plot = Plot::new(format!("{label} against τ_max"), Axis::linear("τ_max", ""), y);
        for (series, name) in curves.iter().zip(["papers' scheme", "implicit clamp", "exact yield"]) {
            plot = plot.with(Series::line_markers(name, series[k].clone()));
        }
        plots.push(plot);
    }
    plots
}

fn against_limit(
    backend: &dyn Backend,
    n: usize,
    limits: &[f64],
    data: &mut ExhibitData,
) -> Result<(), VerifyError> {
    let columns = [
        "scheme",
        "τ_max",
        "u_max/u_plug",
        "clamp alone",
        "relative RMS error",
        "plug half-width / h",
        "clamp alone",
    ];
    let mut table = Table::new(
        "Against the ideal Herschel-Bulkley channel (u_plug = 1.993018, plug half-width 0.5)",
        &columns,
    );
    let ours = row(backend, &exact_yield(n))?;
    let none: Entry = "–".into();
    let entries =
        vec![none.clone(), ours.ratio.into(), 1.0.into(), ours.rms.into(), ours.plug.into(), 0.5.into()];
    table.push([vec!["exact yield".into()], entries].concat());
    let mut curves: [[Vec<[f64; 2]>; 3]; 3] = Default::default();
    for &limit in limits {
        let columns =
            [lagged(n, &THESIS, limit, LAGGED_STEP, SPEED), implicit(n, &THESIS, limit, STEP, SPEED)];
        for (k, (name, column)) in ["papers' scheme", "implicit clamp"].into_iter().zip(columns).enumerate() {
            let Row { ratio, rms, plug } = row(backend, &column)?;
            let clamped = column.exact()?;
            let model = clamped.velocity(0.0) / SPEED;
            let core = match &clamped.law {
                super::channel::Curve::Clamped(law) => law.critical_stress().unwrap_or(f64::NAN),
                super::channel::Curve::Ideal(_) => f64::NAN,
            };
            let core = core / clamped.wall_stress();
            table.push(vec![
                name.into(),
                limit.into(),
                ratio.into(),
                model.into(),
                rms.into(),
                plug.into(),
                core.into(),
            ]);
            for (curve, value) in curves[k].iter_mut().zip([ratio, rms, plug]) {
                curve.push([limit, value]);
            }
        }
        for (curve, value) in curves[2].iter_mut().zip([ours.ratio, ours.rms, ours.plug]) {
            curve.push([limit, value]);
        }
    }
    data.tables.push(table);
    data.plots.extend(limit_plots(&curves));
    Ok(())
}

fn over_yield(backend: &dyn Backend, n: usize, data: &mut ExhibitData) -> Result<(), VerifyError> {
    let creep = 1e-4;
    let half_way = WallRule::HalfWay;
    let base = over_yielded(n);
    let yielding = YieldTreatment::LaggedClamped { tau_min: 0.501, tau_max: 1.5 };
    let papers = Column { yielding, collision: CollisionChoice::Bgk, wall: half_way, ..base };
    let mut table = Table::new(
        "Over-yielded channel (σ0 = 5 times the wall stress): u(0) in units of u_plug of σ0 = ½",
        &["scheme", "u(0)/u_plug", "over the papers' scheme"],
    );
    let mut plot = Plot::new("Over-yielded channel", Axis::linear("y/h", ""), Axis::linear("u/u_plug", ""));
    let mut first = f64::NAN;
    let cases = [
        ("papers' scheme, τ_max = 1.5", papers),
        ("exact yield, half-way walls", Column { wall: half_way, ..base }),
        ("exact yield, viscosity-independent walls", base),
    ];
    for (name, column) in cases {
        let mut run = backend.start(&column.setup())?;
        run.advance(160 * (n * n) as u64)?;
        let u: Vec<f64> = run.fields().velocity.iter().map(|u| u[0]).collect();
        let unit = creep * PLUG_VELOCITY / 0.01875;
        let middle = u[n / 2] / unit;
        if first.is_nan() {
            first = middle;
        }
        table.push(vec![name.into(), middle.into(), (middle / first).into()]);
        plot = plot.with(Series::line_markers(name, points(&column, &u, unit)));
    }
    data.tables.push(table);
    data.plots.push(plot);
    Ok(())
}
