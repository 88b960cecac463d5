//! Newtonian channels: the slip of half-way walls, and the three ways to be rid of it.

use super::channel::{Column, run_steady, steady_column};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::slip::slip_velocity;
use lahar::collision::{CollisionChoice, OddRate};
use lahar::setup::{BodyForce, Face, WallRule};
use lahar::solver::run::Backend;

/// Λ = 3/16 at every τ.
const MAGIC_RATE: OddRate = OddRate::fixed(3.0 / 16.0);

/// Velocity changes below this over a fifth of a relaxation time count as steady: what rounding leaves
/// moving at the least τ, which is 1.3e-14.
const STEADY: f64 = 3e-14;

const TAUS: Ladder = Ladder {
    parameter: "tau",
    short: &[0.55, 0.8, 1.0, 1.8],
    full: &[0.52, 0.55, 0.6, 0.7, 0.8, 1.0, 1.3, 1.8, 2.0, 3.0],
};
const RANGE: Ladder = Ladder {
    parameter: "tau",
    short: &[0.55, 0.8, 1.0, 2.0],
    full: &[0.55, 0.6, 0.7, 0.8, 1.0, 1.25, 1.5, 1.8, 2.0],
};
const PARABOLA: Reference = Reference {
    source: "u = G(h² − y²)/(2μ), wall half a cell outside the first centre",
    uncertainty: 0.0,
};

/// BGK slip.
pub const BGK_SLIP: Claim = Claim {
    id: "poiseuille-newtonian-bgk-slip",
    title: "BGK with half-way walls slips by exactly G(16Λ − 3)/(24ρν)",
    tags: &["K1", "B1", "L5", "L6", "ERRATA 15", "ERRATA 75"],
    measures: "u − u_exact at the node where it is furthest from the formula, over the formula; N = 16",
    reference: Reference {
        source: "G(16Λ − 3)/(24ρν), Λ = (τ − ½)² (Ginzburg & d'Humières 2003)",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: TAUS,
    order: None,
    tolerance: Tolerance {
        value: 1e-8,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the slip is 1/1000 of the velocity or more, which is steady to 1.5e-13 (five times the \
                  last change), so nine digits are left of which eight are asked for",
    },
    kind: Kind::Verification,
    measure: |backend, tau| slip(backend, tau, CollisionChoice::Bgk, tau),
};

/// Regularised slip.
pub const REGULARISED: Claim = Claim {
    id: "poiseuille-newtonian-regularised-slip",
    title: "The regularised operator slips like one with τ⁻ = 1",
    tags: &["K4", "B1", "L5"],
    measures: "u − u_exact at the node where it is furthest from the formula, over the formula; N = 16",
    reference: Reference {
        source: "(G/ρ)[2(τ⁻ − ½) − 3/(8(τ⁺ − ½))] with τ⁻ = 1: third moments carry no memory",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "tau",
        short: &[0.55, 0.8, 1.0, 1.8],
        full: &[0.55, 0.6, 0.7, 0.8, 1.0, 1.3, 1.8, 2.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 1e-5,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the recursion adds terms of the order of the squared lattice shear, (4u/N)² = 6e-10 of the \
                  velocity at u = 1e-4, and the slip is 1/1000 of the velocity or more",
    },
    kind: Kind::Verification,
    measure: |backend, tau| slip(backend, tau, CollisionChoice::Regularised, 1.0),
};

fn slip(
    backend: &dyn Backend,
    tau: f64,
    collision: CollisionChoice,
    tau_odd: f64,
) -> Result<Sample, VerifyError> {
    let column = Column::newtonian(16, tau, 1e-4, collision, WallRule::HalfWay);
    let u = steady_column(backend, &column, STEADY)?.velocity(0);
    let expected = slip_velocity(column.force, 1.0, tau, tau_odd);
    let slips = u.iter().zip(column.reference()?).map(|(u, exact)| u - exact);
    let furthest =
        |a: f64, b: f64| if (b - expected).abs() > (a - expected).abs() || b.is_nan() { b } else { a };
    let worst = slips.fold(expected, furthest);
    Ok(Sample::relative(tau, worst, expected).with("slip / u_max", expected / 1e-4))
}

fn profile(backend: &dyn Backend, parameter: f64, column: &Column) -> Result<Sample, VerifyError> {
    let steady = steady_column(backend, column, STEADY)?;
    Ok(Sample::linf(parameter, &steady.velocity(0), &column.reference()?).with("steps", steady.steps as f64))
}

/// TRT with the magic product.
pub const MAGIC: Claim = Claim {
    id: "poiseuille-newtonian-magic",
    title: "TRT with Λ = 3/16 gives the parabola to rounding at every τ",
    tags: &["K2", "B1", "L5", "L6", "ERRATA 75"],
    measures: "max |u − u_exact| / u_max, N = 32, u_max = 1e-3",
    reference: PARABOLA,
    metric: Metric::LInf,
    ladder: RANGE,
    order: None,
    tolerance: Tolerance {
        value: 1e-11,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding: a force error of one unit in the last place of the populations (1e-17) in each of N \
                  cells, amplified by N²/(8ν) ≤ 8e3 and divided by u_max = 1e-3, is 3e-9·1e-3 = 3e-12",
    },
    kind: Kind::Verification,
    measure: |backend, tau| {
        let collision = CollisionChoice::Trt(MAGIC_RATE);
        profile(backend, tau, &Column::newtonian(32, tau, 1e-3, collision, WallRule::HalfWay))
    },
};

/// Central moments with the magic product.
pub const CENTRAL: Claim = Claim {
    id: "poiseuille-newtonian-central",
    title: "The central-moment operator with Λ = 3/16 gives the parabola at every τ",
    tags: &["K3", "B1", "L5", "L6"],
    measures: "max |u − u_exact| / u_max, N = 32, u_max = 2e-5",
    reference: PARABOLA,
    metric: Metric::LInf,
    ladder: RANGE,
    order: None,
    tolerance: Tolerance {
        value: 1e-11,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding as for TRT, and the term in the squared velocity that `poiseuille-central-mach` \
                  measures: a third of the squared wall shear rate, (4u_max/N)²/3 = 2e-12 at the largest τ",
    },
    kind: Kind::Verification,
    measure: |backend, tau| {
        let collision = CollisionChoice::CentralMoment(MAGIC_RATE);
        profile(backend, tau, &Column::newtonian(32, tau, 2e-5, collision, WallRule::HalfWay))
    },
};

/// Its error in the squared Mach number.
pub const CENTRAL_MACH: Claim = Claim {
    id: "poiseuille-central-mach",
    title: "The central-moment operator has an error proportional to the squared velocity",
    tags: &["K3"],
    measures: "max |u − u_exact| / u_max, N = 32, τ = 0.55; the order is that in 1/u_max",
    reference: PARABOLA,
    metric: Metric::LInf,
    ladder: Ladder {
        parameter: "1/u_max (lattice units)",
        short: &[25.0, 50.0, 100.0],
        full: &[12.5, 25.0, 50.0, 100.0, 200.0, 400.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.1, at_least: false }),
    tolerance: Tolerance {
        value: 1e-6,
        at: Rung::Last,
        basis: Basis::Derived,
        because: "the recursion acts on the lattice shear rate: (4 u_max/N)² = 1.6e-6 at u_max = 0.01, N = 32, \
                  with a coefficient below one",
    },
    kind: Kind::Verification,
    measure: |backend, inverse| {
        let (speed, n) = (1.0 / inverse, 32);
        let collision = CollisionChoice::CentralMoment(MAGIC_RATE);
        let sample =
            profile(backend, inverse, &Column::newtonian(n, 0.55, speed, collision, WallRule::HalfWay))?;
        let shear = 4.0 * speed / n as f64;
        let coefficient = sample.error / (shear * shear);
        Ok(sample.with("error / (wall shear rate)²", coefficient))
    },
};

/// \[B3\] with BGK.
pub const B3: Claim = Claim {
    id: "poiseuille-newtonian-b3",
    title: "BGK between viscosity-independent walls gives the parabola at every τ",
    tags: &["K1", "B3", "L5", "L6"],
    measures: "max |u − u_exact| / u_max, N = 32, u_max = 1e-3",
    reference: PARABOLA,
    metric: Metric::LInf,
    ladder: Ladder {
        parameter: "tau",
        short: &[0.55, 0.8, 1.0, 2.0],
        full: &[0.55, 0.6, 0.7, 0.8, 1.0, 1.25, 1.5, 1.8, 2.0, 3.0, 5.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 1e-10,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding as for TRT, 3e-12, times the slip to be cancelled, up to 3/16 of u_max·100/N at τ = 5",
    },
    kind: Kind::Verification,
    measure: |backend, tau| {
        let wall = WallRule::ViscosityIndependent;
        profile(backend, tau, &Column::newtonian(32, tau, 1e-3, CollisionChoice::Bgk, wall))
    },
};

/// \[B3\] far from ordinary relaxation times.
pub const B3_LARGE_TAU: Claim = Claim {
    id: "poiseuille-newtonian-b3-large-tau",
    title: "The viscosity-independent wall holds at τ⁺ = 1000, τ⁻ = 0.55",
    tags: &["K2", "B3"],
    measures: "max |u − u_exact| / u_max, N = 32, u_max = 1e-3, τ⁻ = 0.55",
    reference: PARABOLA,
    metric: Metric::LInf,
    ladder: Ladder { parameter: "tau (even)", short: &[3.0, 1000.0], full: &[3.0, 10.0, 100.0, 1000.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-10,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding: populations of size one lose 1e-16 against a velocity of 1e-3 in each of N = 32 \
                  cells, 3e-12, and as much again in the slip, which reaches the size of u_max",
    },
    kind: Kind::Verification,
    measure: |backend, tau| {
        let odd = OddRate { magic: 0.0, lowered_below: 0.0, ..OddRate::STANDARD };
        let column =
            Column::newtonian(32, tau, 1e-3, CollisionChoice::Trt(odd), WallRule::ViscosityIndependent);
        let half_way = Column { wall: WallRule::HalfWay, ..column };
        let without = Sample::linf(tau, &half_way.scheme()?, &column.reference()?).error;
        // Stress relaxes in τ⁺ steps here, which is slower than viscosity.
        let steady = run_steady(backend, &column.developed()?, 1e-13, 2000, 400_000)?;
        let sample = Sample::linf(tau, &steady.velocity(0), &column.reference()?);
        Ok(sample
            .with("steps", steady.steps as f64)
            .with("error of the half-way wall, by its formula", without))
    },
};

/// The six pairs of wall normal and flow direction.
const ORIENTATIONS: [(usize, usize); 6] = [(1, 0), (1, 2), (0, 1), (0, 2), (2, 0), (2, 1)];

/// Cubic symmetry of the channel.
pub const ORIENTATION: Claim = Claim {
    id: "poiseuille-orientation",
    title: "A channel is the same along every axis",
    tags: &["L1", "K3", "B1", "B3"],
    measures: "max |u − u_first| / u_max against walls normal to y, flow along x; exact-yield HB, N = 16, from rest, 2000 steps",
    reference: Reference {
        source: "the cube's symmetry: orientation 1 of the same backend",
        uncertainty: 0.0,
    },
    metric: Metric::LInf,
    ladder: Ladder { parameter: "orientation", short: &[2.0, 3.0, 6.0], full: &[2.0, 3.0, 4.0, 5.0, 6.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-13,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "only the order of additions differs between axes: some 2000 steps of 1e-17 on velocities of 0.01 \
                  that forget older errors at the viscous rate",
    },
    kind: Kind::Verification,
    measure: |backend, number| {
        let first = oriented(backend, ORIENTATIONS[0])?;
        let index = (number as usize).clamp(1, ORIENTATIONS.len()) - 1;
        Ok(Sample::linf(number, &oriented(backend, ORIENTATIONS[index])?, &first))
    },
};

fn oriented(backend: &dyn Backend, (normal, flow): (usize, usize)) -> Result<Vec<f64>, VerifyError> {
    let column = Column::unit(16, &super::channel::THESIS, 0.25, 0.01);
    let mut setup = column.setup();
    setup.extents = [1; 3];
    setup.extents[normal] = column.n;
    setup.faces = [[Face::Periodic; 2]; 3];
    setup.faces[normal] = [Face::NoSlip; 2];
    let mut force = [0.0; 3];
    force[flow] = column.force;
    setup.force = BodyForce::Constant(force);
    // Not run to a steady state: the transient has to agree as well.
    let mut run = backend.start(&setup)?;
    run.advance(2000)?;
    Ok(run.fields().velocity.iter().map(|u| u[flow]).collect())
}
