//! A heap of yield-stress fluid on a slope that it can bear.

use super::support::{ledger, speed, tank};
use crate::output::plot::{Axis, Plot, Series};
use crate::rheology::Law;
use crate::solver::run::{Backend, Run};
use crate::solver::setup::{BodyForce, Setup};
use crate::units::Units;
use crate::verify::claim::{Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::verify::exhibit::{Exhibit, ExhibitData, Table};

const RHO: f64 = 997.45;
const G: f64 = 9.81;
const SIGMA0: f64 = 58.0;
const SLOPE: f64 = 16.0 * core::f64::consts::PI / 180.0;
/// The shape is that of a fluid with a yield stress smaller by this factor.
const MARGIN: f64 = 1.3;
/// Length of the heap along the slope, m.
const LENGTH: f64 = 0.6;
/// Depth that marks the front, m.
const FRONT: f64 = 3e-3;

/// Depth at distance `d` behind the front of a heap at the limit of rest, m:
/// d = −cot θ (h + h_c ln(1 − h/h_c)).
///
/// # Source
/// Liu & Mei 1989, J. Fluid Mech. 207, 505-529.
fn depth(d: f64) -> f64 {
    let critical = SIGMA0 / MARGIN / (RHO * G * libm::sin(SLOPE));
    if d <= 0.0 {
        return 0.0;
    }
    let (mut low, mut high) = (0.0, critical * (1.0 - 1e-12));
    for _ in 0..100 {
        let h = 0.5 * (low + high);
        let reach = -(h + critical * libm::log(1.0 - h / critical)) / libm::tan(SLOPE);
        if reach < d {
            low = h;
        } else {
            high = h;
        }
    }
    low
}

/// The heap on cells of `dx` metres, and its units; Δt from 3 g H Δt²/Δx² = 0.02, H = 6 cm.
fn heap(dx: f64) -> (Setup, Units) {
    let dt = dx * (0.02 / (3.0 * G * 0.06)).sqrt();
    let units = Units::new(dx, dt, RHO);
    let law = Law::HerschelBulkley {
        sigma0: units.stress_to_lattice(SIGMA0),
        k: units.consistency_to_lattice(35.0, 0.33),
        n: 0.33,
    };
    let extents = [(0.75 / dx).round() as usize, 1, libm::ceil(0.03 / dx) as usize + 2];
    let fill = |[i, _, k]: [usize; 3]| {
        let part = |s: usize| {
            let x = (i as f64 + (s as f64 + 0.5) / 8.0) * dx;
            (depth(LENGTH - x) / dx - k as f64).clamp(0.0, 1.0)
        };
        (0..8).map(part).sum::<f64>() / 8.0
    };
    let weight = units.force_to_lattice(RHO * G);
    let mut setup = tank(extents, law, weight, fill);
    setup.force = BodyForce::Constant([weight * libm::sin(SLOPE), 0.0, -weight * libm::cos(SLOPE)]);
    (setup, units)
}

/// Where the depth falls below [`FRONT`], m; linear between columns.
fn front(run: &dyn Run, dx: f64) -> f64 {
    let fields = run.fields();
    let [nx, _, nz] = run.setup().extents;
    let depth = |i: usize| (0..nz).map(|k| fields.fill[i + nx * k]).sum::<f64>() * dx;
    let last = (0..nx - 1).rev().find(|&i| depth(i) > FRONT).unwrap_or(0);
    let (a, b) = (depth(last), depth(last + 1));
    (last as f64 + 0.5 + (a - FRONT) / (a - b)) * dx
}

/// Mass-weighted mean of u along the slope, m/s.
fn mean_velocity(run: &dyn Run, units: &Units) -> f64 {
    units.velocity_to_si(run.totals().momentum[0] / ledger(run).mass)
}

/// From 5 s to 10 s or 60 s.
fn creep(backend: &dyn Backend, dx: f64, end: f64) -> Result<Sample, VerifyError> {
    let (setup, units) = heap(dx);
    let dt = dx * (0.02 / (3.0 * G * 0.06)).sqrt();
    let mut run = backend.start(&setup)?;
    let at = |seconds: f64| (seconds / dt).round() as u64;
    run.advance(at(2.5))?;
    let early = run.totals().kinetic_energy;
    let born = ledger(run.as_ref()).conversions;
    run.advance(at(5.0) - run.step())?;
    let (x5, e5, c5) = (front(run.as_ref(), dx), run.totals().kinetic_energy, ledger(run.as_ref()).conversions);
    run.advance(at(end) - run.step())?;
    let last = ledger(run.as_ref());
    let crept = (front(run.as_ref(), dx) - x5) / (end - 5.0);
    Ok(Sample::absolute(1e3 * dx, 1e3 * crept, 0.0)
        .with("mean velocity [mm/s]", 1e3 * mean_velocity(run.as_ref(), &units))
        .with("largest speed [mm/s]", 1e3 * units.velocity_to_si(speed(run.as_ref())))
        .with("kinetic energy at 5 s/at 2.5 s", e5 / early)
        .with("kinetic energy at the end/at 5 s", run.totals().kinetic_energy / e5)
        .with("conversions before 2.5 s", born as f64)
        .with("conversions from 5 s", (last.conversions - c5) as f64)
        .with("front at 5 s [mm]", 1e3 * x5)
        .with("mass residual", last.mass_residual.abs()))
}

/// Heap at rest.
pub const HEAP: Claim = Claim {
    id: "heap-at-rest",
    title: "A heap on 16 degrees whose yield stress is 30 % above need rests",
    tags: &["F1", "F3", "F4", "Y3", "B3"],
    measures: "front speed between 5 s and 10 s, mm/s; front where the depth is 3 mm; thesis fluid",
    reference: Reference { source: "a fluid below yield does not move (Liu & Mei 1989)", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "spacing (mm)", short: &[6.0], full: &[6.0, 3.0] },
    order: None,
    tolerance: Tolerance { value: 0.02, at: Rung::Every, because: "the bound of the task: 1.2 mm in a minute" },
    kind: Kind::Verification,
    measure: |backend, spacing| creep(backend, 1e-3 * spacing, 10.0),
};

/// A minute.
pub const MINUTE: Exhibit = Exhibit {
    id: "heap-for-a-minute",
    caption: "The same heap over 10 s (60 s at full size): front, speeds, kinetic energy and conversions.",
    timed: false,
    run: minute,
};

fn minute(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let (spacings, marks): (&[f64], u32) = if full { (&[6.0, 3.0], 24) } else { (&[6.0], 4) };
    let mut table = Table::new(
        "A heap at rest",
        &["spacing [mm]", "t [s]", "front [mm]", "mean u [mm/s]", "largest u [mm/s]", "kinetic energy", "conversions"],
    );
    let mut plot = Plot::new(
        "Front of a heap that should rest",
        Axis::linear("t", "s"),
        Axis::linear("front displacement", "mm"),
    );
    for &spacing in spacings {
        let dx = 1e-3 * spacing;
        let (setup, units) = heap(dx);
        let dt = dx * (0.02 / (3.0 * G * 0.06)).sqrt();
        let mut run = backend.start(&setup)?;
        let start = front(run.as_ref(), dx);
        let mut points = vec![[0.0, 0.0]];
        for mark in 1..=marks {
            let t = 2.5 * f64::from(mark);
            run.advance((t / dt).round() as u64 - run.step())?;
            let x = front(run.as_ref(), dx);
            points.push([t, 1e3 * (x - start)]);
            table.push(vec![
                spacing.into(),
                t.into(),
                (1e3 * x).into(),
                (1e3 * mean_velocity(run.as_ref(), &units)).into(),
                (1e3 * units.velocity_to_si(speed(run.as_ref()))).into(),
                run.totals().kinetic_energy.into(),
                ledger(run.as_ref()).conversions.into(),
            ]);
        }
        plot = plot.with(Series::line_markers(format!("{spacing} mm"), points));
    }
    Ok(ExhibitData { tables: vec![table], plots: vec![plot], notes: Vec::new() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limit_of_a_short_heap_is_a_wedge_at_yield() {
        // Far from h_c: σ0' = ρ g h h', so h² = 2 σ0' d/(ρ g cos θ) to first order in h/h_c (1 % at 0.1 mm).
        let d: f64 = 1e-6;
        let wedge = (2.0 * SIGMA0 / MARGIN * d / (RHO * G * libm::cos(SLOPE))).sqrt();
        assert!((depth(d) / wedge - 1.0).abs() < 0.01);
    }
}
