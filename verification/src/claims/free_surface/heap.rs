//! A heap of yield-stress fluid on a slope that it can bear.

use super::support::{ledger, speed, tank};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::claims::columns;
use crate::exact::slump::{Edge, InclineRest};
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::output::plot::{Axis, Plot, Series};
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Setup};
use lahar::solver::run::{Backend, Run};
use lahar::units::Units;

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

/// The heap on cells of `dx` metres, and its units; Δt from 3 g H Δt²/Δx² = 0.02, H = 6 cm.
fn heap(dx: f64) -> Result<(Setup, Units), VerifyError> {
    let shape = InclineRest::new(SIGMA0 / MARGIN, RHO, G, SLOPE)
        .map_err(|e| VerifyError::Numerics { what: "the shape at rest", detail: e.to_string() })?;
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
            (shape.depth(Edge::Downhill, LENGTH - x) / dx - k as f64).clamp(0.0, 1.0)
        };
        (0..8).map(part).sum::<f64>() / 8.0
    };
    let weight = units.force_to_lattice(RHO * G);
    let mut setup = tank(extents, law, weight, fill);
    setup.force = BodyForce::Constant([weight * libm::sin(SLOPE), 0.0, -weight * libm::cos(SLOPE)]);
    Ok((setup, units))
}

/// Where the depth falls below [`FRONT`], m; linear between columns.
fn front(run: &dyn Run, dx: f64) -> f64 {
    let depths: Vec<f64> = columns::depths(run.setup(), &run.fields(), 0).iter().map(|d| d * dx).collect();
    dx * columns::front(&depths, FRONT)
}

/// Mass-weighted mean of |u|, m/s.
fn mean_speed(run: &dyn Run, units: &Units) -> f64 {
    let fields = run.fields();
    let (mut mass, mut moment) = (0.0, 0.0);
    for (cell, u) in fields.velocity.iter().enumerate() {
        let own = fields.fill[cell] * fields.density[cell];
        mass += own;
        moment += own * ((u[0] * u[0] + u[1] * u[1]) + u[2] * u[2]).sqrt();
    }
    units.velocity_to_si(moment / mass)
}

/// Mass-weighted mean of u along the slope, m/s.
fn mean_velocity(run: &dyn Run, units: &Units) -> f64 {
    units.velocity_to_si(run.totals().momentum[0] / ledger(run).mass)
}

/// What is known of a heap after some time.
struct Rest {
    /// Mass-weighted mean of |u|, mm/s.
    speed: f64,
    /// How far the front has come since the start, mm.
    front: f64,
    /// Largest ratio of kinetic energy between one eighth of the time and the one before, from the third on.
    growth: f64,
    /// Further columns.
    extra: Vec<(&'static str, f64)>,
}

fn rest(backend: &dyn Backend, dx: f64, end: f64) -> Result<Rest, VerifyError> {
    let (setup, units) = heap(dx)?;
    let dt = dx * (0.02 / (3.0 * G * 0.06)).sqrt();
    let mut run = backend.start(&setup)?;
    let start = front(run.as_ref(), dx);
    let (mut energy, mut growth) = (f64::NAN, 0.0_f64);
    for eighth in 1..=8 {
        run.advance((end * f64::from(eighth) / (8.0 * dt)).round() as u64 - run.step())?;
        let now = run.totals().kinetic_energy;
        if eighth > 2 {
            let ratio = now / energy;
            growth = if ratio <= growth { growth } else { ratio };
        }
        energy = now;
    }
    let last = ledger(run.as_ref());
    let in_mm = |u: f64| 1e3 * units.velocity_to_si(u);
    let moved = 1e3 * (front(run.as_ref(), dx) - start);
    Ok(Rest {
        speed: 1e3 * mean_speed(run.as_ref(), &units),
        front: moved,
        growth,
        extra: vec![
            ("net velocity along the slope [mm/s]", 1e3 * mean_velocity(run.as_ref(), &units)),
            ("largest speed [mm/s]", in_mm(speed(run.as_ref()))),
            ("conversions", last.conversions as f64),
            ("front displacement [mm]", moved),
            ("front displacement/time [mm/s]", moved / end),
            ("mass residual", last.mass_residual.abs()),
        ],
    })
}

fn with_extra(sample: Sample, rest: &Rest) -> Sample {
    rest.extra.iter().fold(sample, |sample, (name, value)| sample.with(name, *value))
}

fn creep(backend: &dyn Backend, spacing: f64) -> Result<Sample, VerifyError> {
    let rest = rest(backend, 1e-3 * spacing, 10.0)?;
    Ok(with_extra(Sample::absolute(spacing, rest.speed, 0.0), &rest))
}

/// Heap at rest.
pub const HEAP: Claim = Claim {
    id: "heap-at-rest",
    title: "A heap on 16 degrees whose yield stress is 30 % above need rests",
    tags: &["F1", "F3", "F4", "Y3", "B3"],
    measures: "mass-weighted mean of |u| after 10 s, mm/s; thesis fluid, shape of Liu and Mei",
    reference: Reference { source: "a fluid below yield does not move (Liu & Mei 1989)", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "spacing (mm)", short: &[6.0], full: &[6.0, 4.0, 3.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.02,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "1.2 mm in a minute, a fifth of a 6 mm cell",
    },
    kind: Kind::Verification,
    measure: creep,
};

fn advance(backend: &dyn Backend, end: f64) -> Result<Sample, VerifyError> {
    let rest = rest(backend, 6e-3, end)?;
    Ok(with_extra(Sample::absolute(end, rest.front / 6.0, 0.0), &rest))
}

/// The front stays in its cell.
pub const ADVANCE: Claim = Claim {
    id: "heap-front",
    title: "The front of the heap settles into the grid by a fraction of a cell",
    tags: &["F1", "F4", "Y3"],
    measures: "displacement of the point where the depth is 3 mm since the start, over the spacing of 6 mm",
    reference: Reference { source: "a fluid below yield does not move", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "time (s)", short: &[10.0], full: &[10.0, 60.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.25,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "the foot of the heap is thinner than a cell, where the links that carry mass do not know the slope of \
                  the surface: it settles by a quarter of a cell at most, 0.02 mm/s over a minute",
    },
    kind: Kind::Verification,
    measure: advance,
};

fn ringing(backend: &dyn Backend, end: f64) -> Result<Sample, VerifyError> {
    let rest = rest(backend, 6e-3, end)?;
    Ok(with_extra(Sample::absolute(end, f64::max(rest.growth - 1.0, 0.0), 0.0), &rest))
}

/// No growing oscillation.
pub const QUIET: Claim = Claim {
    id: "heap-does-not-ring",
    title: "The kinetic energy of the resting heap does not grow",
    tags: &["F3", "Y3", "K3"],
    measures: "largest growth of the kinetic energy from one eighth of the time to the next, from the third on",
    reference: Reference { source: "dissipation", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "time (s)", short: &[5.0], full: &[5.0, 60.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.05,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "what is left of the ringing beats, and a conversion stirs single cells",
    },
    kind: Kind::Verification,
    measure: ringing,
};

/// A minute.
pub const MINUTE: Exhibit = Exhibit {
    id: "heap-for-a-minute",
    caption: "The same heap over 40 s (60 s at full size): front, speeds, kinetic energy and conversions.",
    timed: false,
    run: minute,
};

fn minute(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let (spacings, marks): (&[f64], u32) = if full { (&[6.0, 3.0], 24) } else { (&[6.0], 16) };
    let mut table = Table::new(
        "A heap at rest",
        &[
            "spacing [mm]",
            "t [s]",
            "front [mm]",
            "mean u [mm/s]",
            "largest u [mm/s]",
            "kinetic energy",
            "conversions",
        ],
    );
    let mut plot = Plot::new(
        "Front of a heap that should rest",
        Axis::linear("t", "s"),
        Axis::linear("front displacement", "mm"),
    );
    for &spacing in spacings {
        let dx = 1e-3 * spacing;
        let (setup, units) = heap(dx)?;
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
