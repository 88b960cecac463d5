//! The mudflow of 001 against its retaining wall, from the scene in `scenes/show`.

use std::path::Path;

use rayon::prelude::*;
use serde_json::{Value, json};

use crate::claim::VerifyError;
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::output::plot::{Axis, Plot, Series};
use lahar::plan::Plan;
use lahar::scene;
use lahar::solver::run::{Backend, Fields};
use lahar::units::Units;

/// Force on the wall on three grids.
pub const WALL: Exhibit = Exhibit {
    id: "mudflow-on-the-wall",
    caption: "Force of the 500 m3 mudflow of 001 on its retaining wall (whole wall, both halves of the mirror plane) \
              on three grids. The peak (a running mean over 0.5 s) is set against k A rho v^2 with the area wetted then and the \
              speed of the mud before the wall at impact: 001 quotes k = 2 to 5, and its 300-750 kN need 3 m2 \
              (ERRATA 43).",
    timed: false,
    run: wall,
};

const SCENE: &str = include_str!("../../../../scenes/show/mudflow_wall.json");

/// Interval between samples, s.
const SAMPLE: f64 = 0.05;
/// Window before the wall in which the speed of the mud is taken, m: x, then |y|, then z.
const WINDOW: [[f64; 2]; 3] = [[61.0, 64.0], [-1.0, 1.0], [0.0, 3.0]];

fn failed(what: &'static str, detail: impl ToString) -> VerifyError {
    VerifyError::Numerics { what, detail: detail.to_string() }
}

/// The scene at another spacing; the wall is at least one cell thick.
fn planned(spacing: f64) -> Result<Plan, VerifyError> {
    let broken = |e: serde_json::Error| failed("the mudflow scene", e);
    let mut value: Value = serde_json::from_str(SCENE).map_err(broken)?;
    let height = (10.5 / spacing).floor() * spacing;
    value["domain"]["spacing_m"] = json!(spacing);
    value["domain"]["size_m"][2] = json!(height);
    if let Some(solids) = value["solids"].as_array_mut() {
        for solid in solids.iter_mut().filter(|solid| solid["name"] == "wall") {
            let thick = if spacing > 0.25 { spacing } else { 0.25 };
            solid["shape"]["box"]["max_m"][0] = json!(64.0 + thick);
        }
    }
    let text = serde_json::to_string(&value).map_err(broken)?;
    let scene = scene::flow_from_json(&text, "mudflow_wall.json", Path::new("."))
        .map_err(|e| failed("the mudflow scene", e))?;
    Plan::new(&scene).map_err(|e| failed("the plan of the mudflow", e))
}

/// One sample of the history.
#[derive(Clone, Copy, Debug, Default)]
struct Moment {
    time: f64,
    /// Force on the whole wall along x, N.
    force: f64,
    /// Wetted area of its upstream face, m².
    area: f64,
    /// Mean speed of the mud in the window, m/s.
    speed: f64,
}

struct History {
    moments: Vec<Moment>,
    /// Impulse on the whole wall, N s.
    impulse: f64,
    mass_residual: f64,
    momentum_residual: f64,
}

fn window_speed(plan: &Plan, fields: &Fields) -> f64 {
    let dx = plan.units.dx_m;
    let (mut mass, mut moved) = (0.0, 0.0);
    for (cell, &fill) in fields.fill.iter().enumerate().filter(|(_, fill)| **fill > 0.0) {
        let at = plan.setup.coordinates(cell);
        let inside = (0..3).all(|a| {
            let x = (at[a] as f64 + 0.5) * dx;
            WINDOW[a][0] <= x && x < WINDOW[a][1]
        });
        if inside {
            let u = fields.velocity[cell];
            mass += fill;
            moved += fill * ((u[0] * u[0] + u[1] * u[1]) + u[2] * u[2]).sqrt();
        }
    }
    if mass > 0.0 { plan.units.velocity_to_si(moved / mass) } else { 0.0 }
}

fn newtons(units: &Units, lattice: f64) -> f64 {
    units.force_to_si(lattice) * units.dx_m * units.dx_m * units.dx_m
}

fn follow(backend: &dyn Backend, plan: &Plan, end: f64) -> Result<History, VerifyError> {
    let units = &plan.units;
    let wall = plan.setup.solid_motion.len() - 1;
    let mut run = backend.start(&plan.setup)?;
    let mut moments = Vec::new();
    let mut impulse_before = 0.0;
    let count = (end / SAMPLE).round() as usize;
    for k in 1..=count {
        let time = k as f64 * SAMPLE;
        let due = units.time_to_lattice(time).round() as u64;
        let steps = due - run.step();
        run.advance(steps)?;
        let load = run.loads().get(wall).copied().unwrap_or_default();
        // Mean over the interval: a single step carries the noise of cells that fill.
        let mean = (load.impulse[0] - impulse_before) / steps as f64;
        impulse_before = load.impulse[0];
        let touched = load.wetted[0][0] > 0.0;
        moments.push(Moment {
            time,
            force: 2.0 * newtons(units, mean),
            area: 2.0 * load.wetted[0][0] * units.dx_m * units.dx_m,
            speed: if touched || time > 4.0 { window_speed(plan, &run.fields()) } else { 0.0 },
        });
    }
    let ledger = run.ledger().unwrap_or_default();
    let brought = ledger.from_force[2].abs();
    Ok(History {
        moments,
        impulse: 2.0 * newtons(units, impulse_before) * units.dt_s,
        mass_residual: ledger.mass_residual,
        momentum_residual: ledger.momentum_residual / brought,
    })
}

/// Samples in half a second.
const SMOOTHED: usize = 10;

/// Running means over half a second. Single samples hold shocks: a tongue that hits the wall compresses
/// at the lattice's speed of sound, which is some 60 m/s here and not the mud's.
fn smoothed(moments: &[Moment]) -> Vec<Moment> {
    let mean =
        |part: &[Moment], of: &dyn Fn(&Moment) -> f64| part.iter().map(of).sum::<f64>() / part.len() as f64;
    let windows = moments.windows(SMOOTHED);
    windows
        .map(|part| Moment {
            time: mean(part, &|m| m.time),
            force: mean(part, &|m| m.force),
            area: mean(part, &|m| m.area),
            speed: mean(part, &|m| m.speed),
        })
        .collect()
}

fn wall(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let spacings: &[f64] = if full { &[1.0 / 3.0, 0.25, 0.2] } else { &[1.0 / 3.0] };
    let end = 20.0;
    let mut table = Table::new(
        "Impact on the wall",
        &[
            "spacing [m]",
            "impact [s]",
            "speed at impact [m/s]",
            "first contact, 0.05 s mean [kN]",
            "peak, 0.5 s mean [kN]",
            "at [s]",
            "area then [m2]",
            "k = F/(A rho v2)",
            "force at 20 s [kN]",
            "impulse [kN s]",
            "mass residual",
            "momentum residual / weight impulse",
        ],
    );
    let mut plot = Plot::new("Force on the wall", Axis::linear("t", "s"), Axis::linear("F_x", "kN"));
    let histories: Vec<Result<History, VerifyError>> =
        spacings.par_iter().map(|&spacing| follow(backend, &planned(spacing)?, end)).collect();
    for (&spacing, history) in spacings.iter().zip(histories) {
        let history = history?;
        let greater = |a: Moment, b: &Moment| if b.force > a.force { *b } else { a };
        let shock = history.moments.iter().fold(Moment::default(), greater);
        let peak = smoothed(&history.moments).iter().fold(Moment::default(), greater);
        let impact = history.moments.iter().position(|m| m.force > 0.02 * peak.force).unwrap_or(0);
        // Mud comes to rest at the wall: the speed of arrival is the largest in the second around impact.
        let around = &history.moments[impact.saturating_sub(10)..(impact + 10).min(history.moments.len())];
        let speed = around.iter().map(|m| m.speed).fold(0.0, |a, b| if b > a { b } else { a });
        let last = history.moments.last().copied().unwrap_or_default();
        table.push(vec![
            spacing.into(),
            history.moments[impact].time.into(),
            speed.into(),
            (1e-3 * shock.force).into(),
            (1e-3 * peak.force).into(),
            peak.time.into(),
            peak.area.into(),
            (peak.force / (peak.area * 2000.0 * speed * speed)).into(),
            (1e-3 * last.force).into(),
            (1e-3 * history.impulse).into(),
            history.mass_residual.into(),
            history.momentum_residual.into(),
        ]);
        let points = history.moments.iter().map(|m| [m.time, 1e-3 * m.force]).collect();
        plot = plot.with(Series::line(format!("spacing {spacing:.3} m"), points));
    }
    Ok(ExhibitData { tables: vec![table], plots: vec![plot], ..ExhibitData::default() })
}
