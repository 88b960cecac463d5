//! A heap comes to rest, stays at rest, and its books of energy close.

use super::refused;
use super::resting::{self, Rest, release};
use super::support::{Matter, R};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::output::plot::{Axis, Plot, Series};
use lahar::solver::run::Backend;

/// Friction of the spheres.
const FRICTION: f64 = 0.5;
/// Rolling friction: without any, single spheres roll to and fro in hollows for many seconds.
const ROLLING: f64 = 0.05;
/// Steps in the shortest contact: with 25 a heap of 2197 spheres was still moving after 10 s.
const STEPS: f64 = 40.0;

/// Rest.
pub const AT_REST: Claim = Claim {
    id: "piles-heap-at-rest",
    title: "A frictional heap of spheres comes to rest and stays at rest",
    tags: &["D1", "D2", "D3", "D6"],
    measures: "largest kinetic energy, as a share of its largest ever, in the 20000 steps after it has fallen below 1e-14 of it; \
               a cube of spheres is let go on a rough bed, friction 0.5, rolling friction 0.05",
    reference: Reference { source: "Coulomb friction: a static heap does not move", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "spheres along an edge", short: &[6.0], full: &[6.0, 13.0, 22.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-12,
        at: Rung::Every,
        basis: Basis::Reference,
        because: "the bound the design sets: at 1e-12 of the energy of the fall a grain moves by less than 1e-6 of its radius",
    },
    kind: Kind::Verification,
    measure: at_rest,
};

/// Books.
pub const BOOKS: Claim = Claim {
    id: "piles-heap-books",
    title: "The books of energy of a falling and settling heap close with second order in the time step",
    tags: &["D1", "D2", "D3"],
    measures: "kinetic + potential + elastic + lost energy less its start, as a share of the energy lost, 0.5 s after 125 spheres \
               were let go; friction 0.5, restitution 0.3",
    reference: Reference { source: "conservation of energy", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "steps in the shortest contact",
        short: &[25.0, 50.0, 100.0],
        full: &[25.0, 50.0, 100.0, 200.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.4, at_least: false }),
    tolerance: Tolerance {
        value: 2e-4,
        at: Rung::Last,
        basis: Basis::AfterSeeing,
        because: "velocity Verlet misses (omega dt)^2/8 of the energy that passes through an oscillation, 1.2e-4 at 100 steps in half \
                  a period; the contacts of a grain in parallel make its oscillations faster than that",
    },
    kind: Kind::Verification,
    measure: books,
};

/// Kinetic energy in time.
pub const HISTORY: Exhibit = Exhibit {
    id: "piles-heap-history",
    caption: "Kinetic energy of heaps that come to rest. The energy falls in beats of the slowest contacts; nothing but the \
              contacts damps it.",
    timed: false,
    run: history,
};

fn heap(edge: f64) -> Result<Rest, VerifyError> {
    release(edge as u32, &Matter { steps: STEPS, rolling: ROLLING, ..Matter::spheres(FRICTION) })
        .map_err(refused)
}

fn at_rest(_: &dyn Backend, edge: f64) -> Result<Sample, VerifyError> {
    let r = heap(edge)?;
    Ok(Sample::absolute(edge, r.after, 0.0)
        .with("spheres", r.grains as f64)
        .with("time of rest [s]", r.time)
        .with("steps to rest", r.steps as f64)
        .with("largest displacement in the 20000 steps after [m]", r.moved)
        .with("liveliest grain at the end [m g R]", r.liveliest)
        .with("lowest centre at the end [mean radii]", r.lowest / R)
        .with("contacts per sphere", r.contacts)
        .with("energy missing in the books, share of the lost", r.missing)
        .with("share of the loss due to friction", r.books.lost_friction / r.books.lost()))
}

fn books(_: &dyn Backend, steps: f64) -> Result<Sample, VerifyError> {
    let matter = Matter { steps, ..Matter::spheres(FRICTION) };
    let (missing, books) = resting::missing(5, &matter, 0.5).map_err(refused)?;
    Ok(Sample::absolute(steps, missing, 0.0)
        .with("share of the loss due to friction", books.lost_friction / books.lost())
        .with("lost energy [J]", books.lost()))
}

fn history(_: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let edges = if full { AT_REST.ladder.full } else { AT_REST.ladder.short };
    let mut plot = Plot::new(
        "Kinetic energy of heaps",
        Axis::linear("t", "s"),
        Axis::log("kinetic energy over its largest", ""),
    );
    let mut table = Table::new(
        "Heaps at rest",
        &[
            "spheres",
            "time of rest [s]",
            "contacts per sphere",
            "kinetic energy in the 20000 steps after, share of the largest",
            "largest displacement in them [m]",
            "energy missing in the books, share of the lost",
        ],
    );
    for &edge in edges {
        let r = heap(edge)?;
        table.push(vec![
            r.grains.into(),
            r.time.into(),
            r.contacts.into(),
            r.after.into(),
            r.moved.into(),
            r.missing.into(),
        ]);
        plot = plot.with(Series::line(format!("{} spheres", r.grains), r.history));
    }
    Ok(ExhibitData { tables: vec![table], plots: vec![plot], ..ExhibitData::default() })
}
