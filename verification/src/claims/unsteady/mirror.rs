//! Mirror planes \[B2\] and walls set in motion.

use super::support::{column, largest};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::start_up::CouetteStartUp;
use lahar::collision::{CollisionChoice, OddRate};
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, Setup};
use lahar::solver::run::{Backend, Run};

const BINGHAM: Law = Law::Bingham { sigma0: 4e-4, mu: 0.1 };

/// Largest difference between the cells of a part and the same cells of the whole, over the largest
/// speed of the whole.
fn difference(part: &dyn Run, whole: &dyn Run, parameter: f64) -> Sample {
    let (small, large) = (part.fields(), whole.fields());
    let apart = small.velocity.iter().enumerate().flat_map(|(cell, u)| {
        let at = part.setup().coordinates(cell);
        let v = large.velocity[whole.setup().index(at)];
        [u[0] - v[0], u[1] - v[1], u[2] - v[2]]
    });
    let speed = largest(large.velocity.iter().map(|u| u[0]));
    Sample::absolute(parameter, largest(apart) / speed, 0.0).with("largest speed [lattice units]", speed)
}

/// Start-up of a channel (duct: both transverse axes) and of its half (quarter).
fn parts(backend: &dyn Backend, axes: &[usize], n: f64, steps: u64) -> Result<Sample, VerifyError> {
    let full = n as usize;
    let mut whole = Setup::periodic([1, 1, 1], BINGHAM);
    whole.force = BodyForce::Constant([1e-4, 0.0, 0.0]);
    let mut part = whole.clone();
    for &axis in axes {
        whole.extents[axis] = full;
        whole.faces[axis] = [Face::NoSlip; 2];
        part.extents[axis] = full / 2;
        part.faces[axis] = [Face::NoSlip, Face::FreeSlip];
    }
    let (mut whole, mut part) = (backend.start(&whole)?, backend.start(&part)?);
    whole.advance(steps)?;
    part.advance(steps)?;
    Ok(difference(part.as_ref(), whole.as_ref(), n))
}

/// Half channel.
pub const HALF_CHANNEL: Claim = Claim {
    id: "mirror-half-channel",
    title: "Half a channel with a mirror plane equals the full channel.",
    tags: &["B2"],
    measures: "largest difference of velocity after 500 steps of Bingham start-up, over the largest speed",
    reference: Reference { source: "symmetry", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "N (cells across)", short: &[16.0, 32.0], full: &[16.0, 32.0, 64.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.0,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the mirrored cell does the same sums in the same order: equal to the last bit",
    },
    kind: Kind::Verification,
    measure: |backend, n| parts(backend, &[1], n, 500),
};

/// Quarter duct.
pub const QUARTER_DUCT: Claim = Claim {
    id: "mirror-quarter-duct",
    title: "A quarter of a square duct with two mirror planes equals the full duct.",
    tags: &["B2"],
    measures: "largest difference of velocity after 500 steps of Bingham start-up, over the largest speed",
    reference: Reference { source: "symmetry", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "N (cells across)", short: &[8.0, 16.0], full: &[8.0, 16.0, 32.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.0,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the mirrored cell does the same sums in the same order: equal to the last bit",
    },
    kind: Kind::Verification,
    measure: |backend, n| parts(backend, &[1, 2], n, 500),
};

/// Fluid at rest, upper wall set in motion at t = 0.
fn moving_wall(backend: &dyn Backend, n: f64) -> Result<Sample, VerifyError> {
    let nu = 0.1;
    let flow = CouetteStartUp { nu, gap: n, wall_speed: 0.16 / n };
    let mut setup = Setup::channel(n as usize, Law::Newtonian { mu: nu }, 0.0);
    setup.collision = CollisionChoice::Trt(OddRate::fixed(3.0 / 16.0));
    setup.faces[1][1] = Face::Moving([flow.wall_speed, 0.0, 0.0]);
    let mut run = backend.start(&setup)?;
    let (mut computed, mut exact) = (Vec::new(), Vec::new());
    for time in [0.025, 0.05, 0.1, 0.2] {
        run.advance((time * n * n / nu).round() as u64 - run.step())?;
        computed.extend(column(run.as_ref()));
        exact.extend((0..n as usize).map(|j| flow.velocity(j as f64 + 0.5, run.step() as f64)));
    }
    Ok(Sample::l2(n, &computed, &exact))
}

/// Stokes' first problem between walls.
pub const WALL_SET_IN_MOTION: Claim = Claim {
    id: "couette-start-up",
    title: "A wall set in motion drags the fluid along at second order (TRT).",
    tags: &["B1", "L6", "K2"],
    measures: "u over cells at nu t/H2 = 0.025, 0.05, 0.1, 0.2, relative L2",
    reference: Reference { source: "series (Schlichting & Gersten, §5.2)", uncertainty: 0.0 },
    metric: Metric::L2,
    ladder: Ladder {
        parameter: "N (cells across)",
        short: &[8.0, 16.0, 32.0],
        full: &[8.0, 16.0, 32.0, 64.0, 128.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.15, at_least: false }),
    tolerance: Tolerance {
        value: 6e-5,
        at: Rung::Last,
        basis: Basis::AfterSeeing,
        because: "0.06/N^2 at N = 32: 1.1 times the scheme constant 0.054 seen on 16 cells",
    },
    kind: Kind::Verification,
    measure: moving_wall,
};
