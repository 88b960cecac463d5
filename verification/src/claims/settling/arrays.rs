//! Simple cubic arrays, held and falling.

use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::claims::immersed::{Array, OFFSETS, exact};
use crate::exact::suspension::cubic_array;
use crate::exact::suspension::settling::richardson_zaki;
use lahar::collision::{CollisionChoice, OddRate};
use lahar::coupling::GrainWall;
use lahar::solver::run::Backend;

/// Two relaxation times, Λ = 3/16.
pub const TRT: CollisionChoice = CollisionChoice::Trt(OddRate::fixed(3.0 / 16.0));

/// τ = 2: with a fixed Λ nothing but the number of steps depends on it.
const QUICK: f64 = 0.5;

/// Cells along an edge that give a sphere a radius of at least `radius` cells.
fn cells(c: f64, radius: f64) -> usize {
    (radius / crate::claims::immersed::radius_in_cube(c, 1.0)).ceil() as usize
}

/// The array of the claims.
pub fn array(c: f64, cells: usize, wall: GrainWall) -> Array {
    Array { collision: TRT, mu: QUICK, ..Array::new(c, cells, wall) }
}

/// Mean of a coefficient over the places, and how far the places are apart.
pub fn over_places(
    measure: impl Fn([f64; 3]) -> Result<f64, VerifyError>,
) -> Result<(f64, f64), VerifyError> {
    let values = OFFSETS.iter().map(|&offset| measure(offset)).collect::<Result<Vec<f64>, _>>()?;
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let most = values.iter().fold(0.0_f64, |m, v| m.max((v - mean).abs()));
    Ok((mean, most / mean))
}

/// Radius of the sphere that has a force in the same cell, over the true one: K(c) c^{1/3} is the force over 6πμUL.
fn hydrodynamic_radius(c: f64, drag: f64) -> Result<f64, VerifyError> {
    let wanted = drag * libm::cbrt(c);
    let (mut low, mut high) = (0.0, cubic_array::MOST_DENSE);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if exact(cubic_array::drag(middle))? * libm::cbrt(middle) < wanted {
            low = middle
        } else {
            high = middle
        }
    }
    Ok(libm::cbrt(high / c))
}

/// Hydrodynamic radius over the true one, from the mean drag over the places.
fn radius(
    parameter: f64,
    array: &Array,
    measure: impl Fn(&Array) -> Result<f64, VerifyError>,
) -> Result<Sample, VerifyError> {
    let (drag, scatter) = over_places(|offset| measure(&Array { offset, ..*array }))?;
    Ok(Sample::relative(parameter, hydrodynamic_radius(array.c, drag)?, 1.0)
        .with("K", drag)
        .with("error of K", drag / exact(cubic_array::drag(array.c))? - 1.0)
        .with("largest deviation of a place", scatter)
        .with("radius [cells]", array.radius()))
}

fn fixed(backend: &dyn Backend, parameter: f64, array: &Array) -> Result<Sample, VerifyError> {
    radius(parameter, array, |array| array.fixed(backend))
}

/// The common reference.
const ZICK_HOMSY: Reference = Reference {
    source: "drag K(c) of simple cubic arrays in Stokes flow, boundary integrals (agrees with Zick & Homsy 1982)",
    uncertainty: 1e-9,
};

/// Fractions with a radius of 3.4 cells and more.
const FRACTIONS: Ladder = Ladder {
    parameter: "c",
    short: &[0.027, 0.1, 0.2, 0.343, 0.4],
    full: &[0.008, 0.027, 0.064, 0.1, 0.15, 0.2, 0.25, 0.3, 0.343, 0.4],
};

/// Why interpolated surfaces may be off by that much.
const SECOND_ORDER: &str =
    "second order: a sphere that is smaller by 0.12/R cells, 0.12/R^2 at R = 3.4; the same at all fractions";

/// Order.
pub const ORDER: Claim = Claim {
    id: "cubic-array-drag-order",
    title: "Drag sees a sphere of the right radius; with an interpolated surface the error falls at least at second order",
    tags: &["C1", "C2"],
    measures: "hydrodynamic radius over the true one, from the drag K of held spheres at c = 0.1 (mean over three places of the centre, \
               fluid driven by a force); TRT 3/16, tau = 2",
    reference: ZICK_HOMSY,
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "N (cells along an edge)",
        short: &[8.0, 12.0, 16.0],
        full: &[8.0, 12.0, 16.0, 24.0, 32.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.5, at_least: true }),
    tolerance: Tolerance {
        value: 0.006,
        at: Rung::At(16.0),
        basis: Basis::AfterSeeing,
        because: "0.12/R^2 at R = 4.6 cells; three places leave a scatter, hence the band of the order",
    },
    kind: Kind::Verification,
    measure: |backend, n| fixed(backend, n, &array(0.1, n as usize, GrainWall::CentralLinear)),
};

/// All fractions.
pub const DRAG: Claim = Claim {
    id: "cubic-array-drag",
    title: "Drag sees spheres in a cubic array with their true radius to 1 % at every solid fraction",
    tags: &["C1", "C2"],
    measures: "hydrodynamic radius over the true one, from K, whose own error is up to 4.8 %; R >= 3.4 cells, interpolated surface, mean over three places",
    reference: ZICK_HOMSY,
    metric: Metric::Relative,
    ladder: FRACTIONS,
    order: None,
    tolerance: Tolerance { value: 0.0105, at: Rung::Every, basis: Basis::AfterSeeing, because: SECOND_ORDER },
    kind: Kind::Verification,
    measure: |backend, c| fixed(backend, c, &array(c, cells(c, 3.4), GrainWall::CentralLinear)),
};

/// Half-way.
pub const HALF_WAY: Claim = Claim {
    id: "cubic-array-drag-half-way",
    title: "With half-way links the hydrodynamic radius is off by at most a tenth of a cell",
    tags: &["C1", "C2", "B1"],
    measures: "hydrodynamic radius over the true one, as in `cubic-array-drag`, with half-way links",
    reference: ZICK_HOMSY,
    metric: Metric::Relative,
    ladder: FRACTIONS,
    order: None,
    tolerance: Tolerance {
        value: 0.03,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "first order: the staircase is a sphere of another radius, by 0.1 cell: 0.1/R at R = 3.4",
    },
    kind: Kind::Verification,
    measure: |backend, c| fixed(backend, c, &array(c, cells(c, 3.4), GrainWall::HalfWay)),
};

/// Default operator.
pub const DEFAULT: Claim = Claim {
    id: "cubic-array-drag-default",
    title: "The default operator sees the same radius to 1 %, at a relaxation time of 1",
    tags: &["C1", "C2", "K3"],
    measures: "hydrodynamic radius over the true one, as in `cubic-array-drag`, with central moments and tau = 1",
    reference: ZICK_HOMSY,
    metric: Metric::Relative,
    ladder: Ladder { parameter: "c", short: &[0.1, 0.343], full: &[0.027, 0.1, 0.2, 0.343, 0.4] },
    order: None,
    tolerance: Tolerance { value: 0.0105, at: Rung::Every, basis: Basis::AfterSeeing, because: SECOND_ORDER },
    kind: Kind::Verification,
    measure: |backend, c| fixed(backend, c, &Array::new(c, cells(c, 3.4), GrainWall::CentralLinear)),
};

fn viscosity(backend: &dyn Backend, tau: f64) -> Result<Sample, VerifyError> {
    let mut worst = 0.0_f64;
    for (_, wall) in crate::claims::immersed::WALLS {
        let at = |mu: f64| Array { mu, ..array(0.1, 10, wall) }.fixed(backend);
        let change = at((tau - 0.5) / 3.0)? / at(QUICK)? - 1.0;
        worst = if change.abs() <= worst { worst } else { change.abs() };
    }
    Ok(Sample::absolute(tau, worst, 0.0))
}

/// Viscosity.
pub const VISCOSITY: Claim = Claim {
    id: "cubic-array-viscosity",
    title: "With a fixed Lambda the drag coefficient does not depend on the viscosity, on either kind of surface",
    tags: &["C1", "K2"],
    measures: "largest |K(tau)/K(2) - 1|, c = 0.1, R = 2.9 cells, TRT 3/16, half-way and interpolated",
    reference: Reference {
        source: "steady Stokes solutions of the two-relaxation-time operator depend on Lambda alone",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "tau", short: &[0.8, 1.0, 4.0], full: &[0.55, 0.6, 0.8, 1.0, 4.0, 8.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-3,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "steadiness is extrapolated to 1e-4 in each of the two, twice; inertia at Re = 0.002 adds 1e-6",
    },
    kind: Kind::Verification,
    measure: viscosity,
};

fn settling(backend: &dyn Backend, c: f64) -> Result<Sample, VerifyError> {
    let array = array(c, cells(c, 3.4), GrainWall::CentralLinear);
    let sample = radius(c, &array, |array| array.falling(backend, 2.0))?;
    let k = sample.extra.get("K").copied().unwrap_or(f64::NAN);
    Ok(sample.with("u/u0", 1.0 / k).with("1/K", exact(cubic_array::settling_ratio(c))?))
}

/// Fractions that fall.
const FALLING: Ladder = Ladder {
    parameter: "c",
    short: &[0.1, 0.2, 0.343],
    full: &[0.001, 0.008, 0.027, 0.064, 0.1, 0.15, 0.2, 0.25, 0.3, 0.343, 0.4],
};

/// Settling.
pub const SETTLING: Claim = Claim {
    id: "cubic-array-settling",
    title: "A cubic array without net flux falls as one whose spheres have the true radius to 1 %",
    tags: &["C2", "C6", "000 Fig 3"],
    measures: "hydrodynamic radius over the true one, from u/u0 of free spheres twice as heavy as the fluid in a balanced periodic box (u/u0 itself is off by up to 6.9 %), \
               interpolated surface, R >= 3.4 cells, mean over three places",
    reference: ZICK_HOMSY,
    metric: Metric::Relative,
    ladder: FALLING,
    order: None,
    tolerance: Tolerance { value: 0.0105, at: Rung::Every, basis: Basis::AfterSeeing, because: SECOND_ORDER },
    kind: Kind::Verification,
    measure: settling,
};

/// (1 − c)^4.65 over the settling ratio. `fraction`: c as it is written down.
pub fn excess(backend: &dyn Backend, c: f64, fraction: fn(f64) -> f64) -> Result<Sample, VerifyError> {
    let array = array(c, cells(c, 5.5), GrainWall::CentralLinear);
    let (k, scatter) = over_places(|offset| Array { offset, ..array }.falling(backend, 2.0))?;
    let law = exact(richardson_zaki(fraction(c), 4.65))?;
    Ok(Sample::relative(c, law * k, exact(cubic_array::richardson_zaki_excess(c, 4.65))?)
        .with("u/u0", 1.0 / k)
        .with("(1 - c)^4.65", law)
        .with("largest deviation of a place", scatter))
}

/// Richardson and Zaki missed.
pub const RICHARDSON_ZAKI: Claim = Claim {
    id: "regular-array-misses-richardson-zaki",
    title: "A regular array misses (1 - c)^4.65, by the factor that its drag prescribes",
    tags: &["C2", "000 Fig 3"],
    measures: "(1 - c)^4.65 over u/u0 of the falling array, R >= 5.5 cells",
    reference: ZICK_HOMSY,
    metric: Metric::Relative,
    ladder: Ladder { parameter: "c", short: &[0.1, 0.343], full: &[0.027, 0.1, 0.2, 0.343] },
    order: None,
    tolerance: Tolerance {
        value: 0.026,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "0.12/R^2 of the radius at R = 5.5 cells, times 6.5, the sensitivity of K at c = 0.343 to the radius",
    },
    kind: Kind::PredictedFailure,
    measure: |backend, c| excess(backend, c, |c| c),
};
