//! Oblique impacts, chains of balls, and balls that lean on each other.

use super::support::{G, POISSON, RADIUS, elastic, floor, mass, plane, setup, worst};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::grains::collision::{hertz_overlap, hertz_stiffness};
use crate::exact::grains::rolling::{oblique_slip, oblique_stick};
use lahar::dem::{ContactEquations, Dem, Grain, NormalLaw, PairProperties, StandardContact, V3};
use lahar::solver::run::Backend;

/// Speed and surface speed of rotation after an impact of a sphere without spin on the floor.
fn strike(
    young: f64,
    pair: PairProperties,
    v: (f64, f64),
    steps: f64,
    equations: impl ContactEquations,
) -> Result<[f64; 3], VerifyError> {
    let mut s = setup(young, pair);
    s.walls = vec![floor()];
    s.steps_per_contact = steps;
    s.grains = vec![Grain::sphere(RADIUS, V3::z() * RADIUS, 0).moving(V3::new(v.1, 0.0, -v.0))];
    let mut d = Dem::with_equations(&s, equations)?;
    d.step_with(equations, 1)?;
    while d.wall_contacts().iter().any(|w| !w.contacts.is_empty()) {
        d.step_with(equations, 1)?;
    }
    let b = d.bodies();
    Ok([b.velocity[0].x, b.spin[0].y * RADIUS, b.velocity[0].z])
}

/// Slipping impact against the rigid body's.
pub(super) fn slipping(young: f64, equations: impl ContactEquations) -> Result<Sample, VerifyError> {
    let (mu, e, normal, tangential) = (0.1, 0.8, 1.0, 3.0);
    let law = NormalLaw::Tsuji { restitution: e };
    let pair = PairProperties { normal: law, friction: mu, rolling_friction: 0.0, tangential_damping: 0.0 };
    let [v, w, up] = strike(young, pair, (normal, tangential), 1000.0, equations)?;
    let nan = (f64::NAN, f64::NAN);
    let (exact_v, exact_w) = oblique_slip(normal, tangential, e, mu).unwrap_or(nan);
    let k = hertz_stiffness(young, POISSON, (RADIUS, f64::INFINITY));
    let depth = hertz_overlap(mass(RADIUS), k, normal) / RADIUS;
    let mut sample = Sample::relative(young, w, exact_w)
        .with("error of the speed", v / exact_v - 1.0)
        .with("restitution", up / normal)
        .with("largest overlap / r", depth);
    sample.error = worst(&[w / exact_w - 1.0, v / exact_v - 1.0]);
    Ok(sample)
}

/// In gross slip.
pub const SLIP: Claim = Claim {
    id: "oblique-impact-slip",
    title: "A grazing impact changes speed and spin as a rigid sphere's, and the stiffer the closer",
    tags: &["D1", "D2", "000 Sec 2.1", "004 Eq 3.38", "ERRATA 18"],
    measures: "Spin times radius and tangential speed after an impact at 3 m/s along and 1 m/s onto a plane, mu = 0.1, e = 0.8: \
               the worse of the two",
    reference: Reference {
        source: "v - mu (1 + e) v_n and (5/2) mu (1 + e) v_n, rigid sphere slipping throughout (v >= (7/2) mu (1 + e) v_n)",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "E (Pa)", short: &[7e8, 7e9, 7e10], full: &[7e7, 7e8, 7e9, 7e10, 7e11] },
    order: Some(OrderBand { expected: 0.4, band: 0.1, at_least: false }),
    tolerance: Tolerance {
        value: 2.4e-3,
        at: Rung::At(7e10),
        basis: Basis::Derived,
        because: "The arm is r less the overlap, whose mean weighted with the force is below the largest one, 2.40e-3 r, ~ E^(-2/5)",
    },
    kind: Kind::Verification,
    measure: |_, young| slipping(young, StandardContact),
};

/// Sticking throughout on linear springs.
pub const STICK: Claim = Claim {
    id: "oblique-impact-stick",
    title: "A steep impact on a sticking spring turns the spin over as the closed form says",
    tags: &["D1", "D2"],
    measures: "Tangential speed and spin times radius after an impact at 0.2 m/s along and 1 m/s onto a plane; linear undamped \
               springs, k_t/k_n = 0.1, 2/7, 0.8, mu = 1e4, 16000 steps: the worst, over 0.2 m/s",
    reference: Reference {
        source: "The contact point's velocity turns by the phase pi sqrt(7 k_t/(2 k_n)) while the normal spring swings once",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "k (N/m)",
        short: &[1e6, 4e6, 1.6e7],
        full: &[2.5e5, 1e6, 4e6, 1.6e7, 6.4e7],
    },
    order: Some(OrderBand { expected: 0.5, band: 0.1, at_least: false }),
    tolerance: Tolerance {
        value: 8e-3,
        at: Rung::At(1.6e7),
        basis: Basis::Derived,
        because: "The arm is r less the overlap delta, at most v sqrt(m/k) = 1.9e-3 r. It makes the phase (up to 5.26 at 0.8) smaller \
                  by (5/7) delta/r of itself, a velocity of up to (5/7) 3.7 delta/r = 5.0e-3, and the spin by up to \
                  (10/7) delta/r = 2.7e-3",
    },
    kind: Kind::Verification,
    measure: stick,
};

fn stick(_: &dyn Backend, stiffness_n_m: f64) -> Result<Sample, VerifyError> {
    let (normal, tangential) = (1.0, 0.2);
    let mut errors = Vec::new();
    let (mut first, mut first_exact) = (0.0, 0.0);
    for ratio in [0.1, 2.0 / 7.0, 0.8] {
        let law = NormalLaw::Linear { stiffness_n_m, restitution: 1.0, tangential_ratio: ratio };
        let pair = PairProperties { normal: law, friction: 1e4, ..elastic() };
        let [v, w, _] = strike(7e9, pair, (normal, tangential), 16_000.0, StandardContact)?;
        let (exact_v, exact_w) = oblique_stick(tangential, ratio);
        errors.extend([(v - exact_v) / tangential, (w - exact_w) / tangential]);
        if ratio == 0.1 {
            (first, first_exact) = (w, exact_w);
        }
    }
    let mut sample = Sample::absolute(stiffness_n_m, first, first_exact);
    sample.error = worst(&errors);
    Ok(sample)
}

/// Speeds of a row of equal balls after the first, at 1 m/s, has struck the rest.
fn cradle(balls: usize, gap: f64) -> Result<Vec<f64>, VerifyError> {
    let mut s = setup(70e9, elastic());
    s.grains =
        (0..balls).map(|i| Grain::sphere(RADIUS, V3::x() * ((2.0 * RADIUS + gap) * i as f64), 0)).collect();
    s.grains[0].velocity = V3::x();
    s.steps_per_contact = 200.0;
    let mut d = Dem::new(&s)?;
    // Every contact lasts 31 µs, every gap takes gap/v.
    let until = balls as f64 * (4e-5 + gap);
    while d.time() < until {
        d.step(1)?;
    }
    Ok(d.bodies().velocity.iter().map(|v| v.x).collect())
}

/// Newton's cradle.
pub const CRADLE: Claim = Claim {
    id: "newtons-cradle",
    title: "Newton's cradle: the last ball leaves with the speed of the first",
    tags: &["D1", "D6"],
    measures: "Largest difference of any ball's speed from what it should be, over the first ball's; glass balls 20 um apart, \
               200 steps per contact. Further column: last ball of a row that touches",
    reference: Reference {
        source: "Equal balls exchange velocities in elastic collisions one after the other",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "n (balls)", short: &[3.0, 5.0, 9.0], full: &[2.0, 3.0, 5.0, 9.0, 17.0] },
    order: None,
    tolerance: Tolerance {
        value: 2.7e-5,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "Where a contact begins and ends the force starts like time^(3/2): the trapezoidal rule errs by zeta(-3/2) = -0.0255 \
                  of dt^2.5 at either end, 1.7e-6 of the speed in all with dt = 3.22/200; 16 collisions in a row at most",
    },
    kind: Kind::Verification,
    measure: |_, balls| {
        let n = balls as usize;
        let apart = cradle(n, 2e-5)?;
        let errors: Vec<f64> =
            apart.iter().enumerate().map(|(i, v)| if i + 1 == n { v - 1.0 } else { *v }).collect();
        let touching = cradle(n, 0.0)?;
        let mut sample = Sample::absolute(balls, apart[n - 1], 1.0)
            .with("momentum - 1", apart.iter().sum::<f64>() - 1.0)
            .with("last ball of a touching row", touching[n - 1]);
        sample.error = worst(&errors);
        Ok(sample)
    },
};

/// Two balls in a slot of width 3.5 r between upright walls.
struct Corner {
    /// Force of a ball on the left wall over its weight.
    side: f64,
    /// Vertical force on floor and walls over the weight of both.
    carried: f64,
    /// Largest net force over a weight, net torque over weight times radius, kinetic energy over weight times radius.
    rest: [f64; 3],
}

fn corner(young: f64, friction: f64, steps: u64) -> Result<Corner, VerifyError> {
    let normal = NormalLaw::Tsuji { restitution: 0.3 };
    let mut s = setup(young, PairProperties { normal, friction, ..PairProperties::default() });
    let r = RADIUS;
    s.walls =
        vec![floor(), plane("left", V3::zeros(), V3::x()), plane("right", V3::x() * (3.5 * r), -V3::x())];
    s.gravity = V3::z() * -G;
    // The drop is a hundredth of a radius.
    s.design_speed_m_s = 0.1;
    s.grains = vec![
        Grain::sphere(r, V3::new(1.001 * r, 0.0, 1.001 * r), 0),
        Grain::sphere(r, V3::new(2.498 * r, 0.0, 2.34 * r), 0),
    ];
    let mut d = Dem::new(&s)?;
    d.step(steps)?;
    let weight = mass(r) * G;
    let largest = |f: &dyn Fn(usize) -> f64| (0..2).map(f).fold(0.0, f64::max);
    let b = d.bodies();
    Ok(Corner {
        side: -d.force_on_wall(1).0.x / weight,
        carried: -(0..3).map(|k| d.force_on_wall(k).0.z).sum::<f64>() / (2.0 * weight),
        rest: [
            largest(&|i| (b.force[i] - V3::z() * weight).norm() / weight),
            largest(&|i| b.torque[i].norm() / (weight * r)),
            d.kinetic_energy() / (weight * r),
        ],
    })
}

const CORNER_STEPS: u64 = 60_000;

/// Known forces.
pub const CORNER: Claim = Claim {
    id: "corner-forces",
    title: "Two smooth balls wedged in a slot push on its sides as statics says, and the stiffer the closer",
    tags: &["D1", "D5"],
    measures: "Force on a side wall over a ball's weight; slot 3.5 r wide, no friction",
    reference: Reference {
        source: "tan(phi) with sin(phi) = (3.5 r - 2 r)/(2 r): the line of centres carries the upper ball; rigid balls",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "E (Pa)", short: &[7e6, 7e7, 7e8], full: &[7e6, 7e7, 7e8, 7e9] },
    order: Some(OrderBand { expected: 2.0 / 3.0, band: 0.1, at_least: false }),
    tolerance: Tolerance {
        value: 6e-4,
        at: Rung::At(7e8),
        basis: Basis::Derived,
        because: "Overlaps turn the line of centres: 1.09 delta on either side and 1.66 delta between the balls (delta: the \
                  overlap of one weight on a plane, 1.07e-4 r) make sin(phi) 1.71 delta/r and tan(phi) \
                  1.71/(0.75 0.4375) delta/r = 5.6e-4 larger",
    },
    kind: Kind::Verification,
    measure: |_, young| {
        let sin = 0.75;
        let tan = sin / (1.0f64 - sin * sin).sqrt();
        let c = corner(young, 0.0, CORNER_STEPS)?;
        Ok(Sample::relative(young, c.side, tan)
            .with("carried / weight - 1", c.carried - 1.0)
            .with("kinetic energy / (m g r)", c.rest[2]))
    },
};

/// Balance with friction.
pub const BALANCE: Claim = Claim {
    id: "corner-balance",
    title: "With friction the same balls are statically indeterminate, but balanced and at rest",
    tags: &["D1", "D2", "D5"],
    measures: "Largest of net force over weight, net torque over weight times radius, and weight not carried; further columns: \
               side force, which friction leaves open, and kinetic energy over weight times radius",
    reference: Reference { source: "Zero: Newton's first law", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "mu", short: &[0.1, 0.4, 0.8], full: &[0.05, 0.1, 0.2, 0.4, 0.6, 0.8] },
    order: None,
    tolerance: Tolerance {
        value: 2e-12,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "Places are rounded to 1e-18 m, forces follow overlaps of 2.5e-6 m or more to the power 3/2: 6e-13; a few contacts",
    },
    kind: Kind::Verification,
    measure: |_, mu| {
        let c = corner(7e7, mu, 2 * CORNER_STEPS)?;
        let error = worst(&[c.rest[0], c.rest[1], c.carried - 1.0, c.rest[2]]);
        Ok(Sample::absolute(mu, error, 0.0)
            .with("side force / weight", c.side)
            .with("kinetic energy / (m g r)", c.rest[2]))
    },
};
