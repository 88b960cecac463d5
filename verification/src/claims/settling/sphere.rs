//! One sphere in Stokes flow: in a periodic box, before a wall, between walls.

use std::f64::consts::PI;

use super::arrays::{TRT, array, over_places};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::claims::immersed::{
    Array, OFFSETS, driven, exact, grains, immersed, periodic, plain_suspension, sphere,
};
use crate::exact::ExactError;
use crate::exact::suspension::{cubic_array, walls};
use lahar::coupling::GrainWall;
use lahar::rheology::Law;
use lahar::setup::{Face, Setup};
use lahar::solver::run::Backend;

/// τ = 2.
const MU: f64 = 0.5;
/// Cells per step: 0.01 cells in a whole run.
const SPEED: f64 = 1e-5;

fn hasimoto(backend: &dyn Backend, n: f64) -> Result<Sample, VerifyError> {
    let array = array(0.008, n as usize, GrainWall::CentralLinear);
    let (drag, scatter) = over_places(|offset| Array { offset, ..array }.fixed(backend))?;
    Ok(Sample::relative(n, drag, exact(cubic_array::hasimoto(array.c))?)
        .with("radius [cells]", array.radius())
        .with("largest deviation of a place", scatter))
}

/// Hasimoto.
pub const HASIMOTO: Claim = Claim {
    id: "hasimoto-periodic-box",
    title: "One sphere in a large periodic box has Hasimoto's drag",
    tags: &["C1", "C2"],
    measures: "drag K at c = 0.008 of a held sphere, interpolated surface, TRT 3/16, mean over three places",
    reference: Reference { source: "Hasimoto 1959, dilute series", uncertainty: 2e-5 },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "N (cells along an edge)", short: &[16.0], full: &[16.0, 20.0, 25.0, 32.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.05,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "second order: 0.12 s/R^2 at R = 2 cells, s = 1.5 the sensitivity of K a to the radius; and the scatter of three places",
    },
    kind: Kind::Verification,
    measure: hasimoto,
};

/// A slow sphere between two walls normal to z; force along its motion over 6πμRU, mean of the last half.
fn between(
    backend: &dyn Backend,
    radius: f64,
    extents: [usize; 3],
    (height, axis): (f64, usize),
) -> Result<f64, VerifyError> {
    let middle = |a: usize, d: f64| (extents[a] / 2) as f64 + d;
    let centre = [middle(0, OFFSETS[0][0]), middle(1, OFFSETS[0][1]), height];
    let velocity = std::array::from_fn(|a| if a == axis { -SPEED } else { 0.0 });
    let moving = driven(sphere(radius, centre), velocity, [0.0; 3]);
    let suspension = plain_suspension(grains(1.0, vec![moving]), GrainWall::CentralLinear);
    let mut setup: Setup = periodic(extents, suspension);
    setup.faces[2] = [Face::NoSlip; 2];
    if let Some(suspension) = setup.grains.as_mut().map(std::sync::Arc::make_mut) {
        suspension.dem.period.0[2] = None;
    }
    setup.fluids = vec![Law::Newtonian { mu: MU }];
    setup.collision = TRT;
    let mut run = backend.start(&setup)?;
    // The slowest mode across the box, and the sound that the sudden start makes, have died down after two of these.
    let h = extents[2] as f64;
    let time = (h * h / (PI * PI * MU)).ceil() as u64;
    run.advance(2 * time + extents[0] as u64)?;
    let mut sum = 0.0;
    for _ in 0..time {
        run.advance(1)?;
        sum += immersed(run.as_ref())?.loads()[0].total()[axis];
    }
    Ok(sum / time as f64 / (6.0 * PI * MU * radius * SPEED))
}

fn normal(backend: &dyn Backend, gap: f64) -> Result<Sample, VerifyError> {
    const RADIUS: f64 = 3.0;
    let factor = between(backend, RADIUS, [24, 24, 24], (RADIUS * (1.0 + gap), 2))?;
    Ok(Sample::relative(gap, factor, exact(walls::normal_to_wall(gap))?).with("gap [cells]", gap * RADIUS))
}

/// Brenner.
pub const NORMAL_TO_WALL: Claim = Claim {
    id: "sphere-normal-to-wall",
    title: "A sphere approaching a wall has the drag of Brenner's series",
    tags: &["C1", "C2"],
    measures: "drag over 6 pi mu R U, R = 3 cells, box of 8 R, interpolated surface, TRT 3/16",
    reference: Reference { source: "Brenner 1961, exact series", uncertainty: 1e-12 },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "gap over radius", short: &[1.0], full: &[0.25, 0.5, 0.75, 1.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.06,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "0.25/R^2 = 0.03 for the surface, as much for the gap, which has 0.75 to 3 cells; images of the periodic sides fall \
                  like a cube of the width (9 % at 6 R, 1 % at 8 R)",
    },
    kind: Kind::Verification,
    measure: normal,
};

/// Drag of a sphere that moves along two walls. `ratio`: radius over its distance from the nearer one; `share`: this
/// distance over that of the walls; `reference(ratio)`.
fn along(
    backend: &dyn Backend,
    ratio: f64,
    share: f64,
    reference: impl Fn(f64) -> Result<f64, ExactError>,
) -> Result<Sample, VerifyError> {
    const RADIUS: f64 = 3.0;
    let h = (RADIUS / (share * ratio)).round() as usize;
    let ratio = RADIUS / (share * h as f64);
    // The flow that the images of the sphere make between the walls falls like the area of the box.
    let boxes = [2 * h, 3 * h];
    let mut factors = [0.0; 2];
    for (factor, wide) in factors.iter_mut().zip(boxes) {
        *factor = between(backend, RADIUS, [wide, wide, h], (share * h as f64, 0))?;
    }
    let [near, far] = boxes.map(|w| (w * w) as f64);
    let limit = (factors[1] * far - factors[0] * near) / (far - near);
    Ok(Sample::relative(ratio, limit, exact(reference(ratio))?)
        .with("in a box of twice the distance", factors[0])
        .with("in a box of three times the distance", factors[1]))
}

/// Faxén.
pub const BETWEEN_WALLS: Claim = Claim {
    id: "sphere-between-walls",
    title: "A sphere moving midway between two walls, along them, has Faxen's drag",
    tags: &["C1", "C2"],
    measures: "drag over 6 pi mu R U, R = 3 cells, periodic boxes of 2 and 3 times the distance of the walls, \
               extrapolated in 1/area; interpolated surface, TRT 3/16",
    reference: Reference { source: "Faxen 1922; Happel & Brenner, eq. 7-4.27", uncertainty: 5e-3 },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "radius over half the distance", short: &[0.5], full: &[0.5, 0.375, 0.25] },
    order: None,
    tolerance: Tolerance {
        value: 0.06,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "0.25/R^2 = 0.03 for the surface; the same for what the extrapolation leaves of the images, 9 % in the larger box, a \
                  third of it",
    },
    kind: Kind::Verification,
    measure: |backend, ratio| along(backend, ratio, 0.5, walls::midway_between_walls),
};

/// Faxén, nearer to one wall.
pub const NEAR_A_WALL: Claim = Claim {
    id: "sphere-along-a-wall",
    title: "A sphere moving along a wall, with another three times as far away, has Faxen's drag",
    tags: &["C1", "C2"],
    measures: "as `sphere-between-walls`, at a quarter of the distance of the walls",
    reference: Reference { source: "Faxen 1922; Happel & Brenner, eq. 7-4.28", uncertainty: 5e-3 },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "radius over distance from the wall", short: &[0.5], full: &[0.5, 0.375] },
    order: None,
    tolerance: Tolerance {
        value: 0.06,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "as `sphere-between-walls`",
    },
    kind: Kind::Verification,
    measure: |backend, ratio| along(backend, ratio, 0.25, walls::quarter_between_walls),
};
