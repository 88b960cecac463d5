//! Single cells: isolated ones, parked mass, a pattern carried along.

use super::support::{ledger, speed, tank};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::rheology::Law;
use lahar::setup::{Face, FlowPoint, FreeSurface, Setup, SolidMotion};
use lahar::solver::run::{Backend, Run};

const LAW: Law = Law::Newtonian { mu: 0.1 };

/// 1: one interface cell; 2: with force; 3: a liquid and an interface cell; 4: with force; 5: one
/// that touches the edge of a pillar, with force.
fn isolated(backend: &dyn Backend, case: f64) -> Result<Sample, VerifyError> {
    let number = case as u32;
    let gravity = match number {
        2 | 4 => 1e-5,
        // On a cell filled to 0.4 it acts in that proportion: 1/16 is reached after 391 steps.
        5 => 4e-4,
        _ => 0.0,
    };
    let pair = matches!(number, 3 | 4);
    let mut setup = tank([8, 8, 8], LAW, gravity, |at| match at {
        [4, 4, 4] => 0.4,
        [4, 4, 5] if pair => 1.0,
        _ => 0.0,
    });
    if number == 5 {
        // One link of the cell meets the edge of a pillar; gravity runs along the pillar.
        setup.solids =
            (0..setup.cells()).map(|cell| u8::from(setup.coordinates(cell)[..2] == [3, 3])).collect();
        setup.solid_motion = vec![SolidMotion::default()];
    }
    let mut run = backend.start(&setup)?;
    run.advance(1000)?;
    let end = ledger(run.as_ref());
    let fluid = (end.liquid_cells + end.interface_cells) as f64;
    let worst = end.mass_residual.abs() + fluid + speed(run.as_ref());
    Ok(Sample::absolute(case, worst, 0.0)
        .with("parked", end.parked)
        .with("mass", end.mass)
        .with("fluid cells", fluid))
}

/// H5.
pub const ISOLATED: Claim = Claim {
    id: "isolated-cell",
    title: "A cell or a pair of cells alone in the gas becomes parked mass: all of it, and nothing else",
    tags: &["F4", "F5", "F6"],
    measures: "|mass residual| + fluid cells left + largest speed after 1000 steps; 8³ cells",
    reference: Reference {
        source: "rule [F6]: without liquid or wall within two links, or without liquid and faster than parked mass in a direction that \
                 its links do not hold, a cell empties and its mass is parked",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "case: 1 one cell of fill 0.4; 2 with gravity; 3 a full cell above it; 4 with gravity; \
                    5 one cell at the edge of a pillar, with gravity",
        short: &[1.0, 2.0, 3.0, 4.0, 5.0],
        full: &[1.0, 2.0, 3.0, 4.0, 5.0],
    },
    order: None,
    tolerance: Tolerance { value: 1e-13, at: Rung::Every, basis: Basis::Reference, because: "HARD_CASES H5" },
    kind: Kind::Verification,
    measure: isolated,
};

/// Steps until parked mass reaches the pool below.
fn arrival(backend: &dyn Backend, gap: f64) -> Result<Sample, VerifyError> {
    let top = 4 + gap as usize;
    let setup = tank([5, 5, top + 3], LAW, 1e-5, |[i, j, k]| match (i, j, k) {
        (_, _, 0..=3) => 1.0,
        (2, 2, k) if k == top => 0.4,
        _ => 0.0,
    });
    let mut run = backend.start(&setup)?;
    run.advance(1)?;
    let caught = ledger(run.as_ref()).parked;
    let mut steps = 1;
    while ledger(run.as_ref()).parked != 0.0 && steps < 10_000 {
        run.advance(1)?;
        steps += 1;
    }
    let end = ledger(run.as_ref());
    Ok(Sample::absolute(gap, steps as f64, 16.0 * (gap - 1.0) + 1.0)
        .with("parked after one step", caught)
        .with("mass residual", end.mass_residual.abs()))
}

/// Parked mass falls.
pub const FALLS: Claim = Claim {
    id: "parked-mass-falls",
    title: "Parked mass falls one cell every 16 steps and joins the fluid it meets",
    tags: &["F6"],
    measures: "steps until nothing is parked",
    reference: Reference {
        source: "rule [F6]: it moves in the first step and every 16 steps after; the last move ends beside the surface, \
                 which takes it in the same step",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "cells of gas in between", short: &[3.0, 6.0], full: &[3.0, 6.0, 12.0] },
    order: None,
    tolerance: Tolerance { value: 0.0, at: Rung::Every, basis: Basis::Derived, because: "a count of steps" },
    kind: Kind::Verification,
    measure: arrival,
};

const LENGTH: usize = 32;
const SPEED: f64 = 0.05;

/// Amplitude of the pattern: terms quadratic in its slope, (2π/32 · 1e-3)², are left out of the reference.
const AMPLITUDE: f64 = 1e-3;

/// A liquid layer on a mirror plane, an interface layer, and gas: no force, uniform flow.
fn carried_setup(fill: f64) -> Setup {
    let mut setup = Setup::periodic([LENGTH, 1, 3], LAW);
    setup.faces[2] = [Face::FreeSlip; 2];
    let wave = |i: usize| libm::sin(2.0 * core::f64::consts::PI * (i as f64 + 0.5) / LENGTH as f64);
    let fills = (0..3 * LENGTH).map(|cell| match cell / LENGTH {
        0 => 1.0,
        1 => fill + AMPLITUDE * wave(cell - LENGTH),
        _ => 0.0,
    });
    setup.free_surface = Some(FreeSurface::new(fills.collect()));
    let point = FlowPoint { density: 1.0, velocity: [SPEED, 0.0, 0.0], gradient: [[0.0; 3]; 3] };
    setup.initial = Some(std::sync::Arc::new(move |_| point));
    setup
}

/// Phase of the first mode of the fill of the upper layer.
fn phase(run: &dyn Run) -> f64 {
    let fields = run.fields();
    let (mut a, mut b) = (0.0, 0.0);
    for i in 0..LENGTH {
        let x = 2.0 * core::f64::consts::PI * (i as f64 + 0.5) / LENGTH as f64;
        a += fields.fill[LENGTH + i] * libm::sin(x);
        b += fields.fill[LENGTH + i] * libm::cos(x);
    }
    libm::atan2(-b, a)
}

/// Speed of the pattern over that of the fluid.
fn carried(backend: &dyn Backend, fill: f64) -> Result<Sample, VerifyError> {
    let mut run = backend.start(&carried_setup(fill))?;
    let start = phase(run.as_ref());
    // A fifth of the box.
    let steps = 128;
    run.advance(steps)?;
    let turned = phase(run.as_ref()) - start;
    let k = 2.0 * core::f64::consts::PI / LENGTH as f64;
    let exact = steps as f64 * libm::atan(SPEED * libm::sin(k));
    Ok(Sample::relative(fill, turned / exact, 1.0)
        .with("conversions", ledger(run.as_ref()).conversions as f64))
}

/// Pattern speed.
pub const CARRIED: Claim = Claim {
    id: "surface-pattern-carried",
    title: "A pattern of fills on a uniform flow is carried with the flow, whatever the fill",
    tags: &["F1", "000 Eq 12", "001 Eq 12"],
    measures: "phase speed of the first mode over 128 steps, over the flow speed and the central difference's own lag",
    reference: Reference { source: "what lies on a uniform flow moves with it", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "mean fill of the layer",
        short: &[0.1, 0.5],
        full: &[0.1, 0.3, 0.5, 0.7, 0.9],
    },
    order: None,
    tolerance: Tolerance {
        value: 1e-4,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "a linear equation with a known factor per step, but for the lean of the surface (2e-4 over half a cell)² and \
                  for what the wave does to the flow; 2.6e-5 seen, shares that are mean fills give 0.2",
    },
    kind: Kind::Verification,
    measure: carried,
};
