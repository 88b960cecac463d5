//! Order of accuracy of the integrators: on smooth forces and across contacts.

use super::support::{POISSON, RADIUS, elastic, floor, head_on, mass, setup};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::grains::collision::{hertz_overlap, hertz_stiffness, hertz_time, visco_elastic_collision};
use lahar::dem::integrate::gear::{CORRECTOR, CORRECTOR_0_CONSERVATIVE, Gear};
use lahar::dem::{Dem, Grain, Integrator, NormalLaw, PairProperties, Setup, V3};
use lahar::solver::run::Backend;

/// End of the smooth oscillation, in units of 1/ω.
const END: f64 = 8.0;
/// Velocity at the start; the elongation is 1.
const START_SPEED: f64 = 0.3;

/// x and ẋ at time `t` of ẍ = −x − 2 b ẋ from x = 1, ẋ = 0.3.
fn oscillation(b: f64, t: f64) -> (f64, f64) {
    let w = (1.0 - b * b).sqrt();
    let (c, s, e) = (libm::cos(w * t), libm::sin(w * t), libm::exp(-b * t));
    let q = (START_SPEED + b) / w;
    (e * (c + q * s), e * ((q * w - b) * c - (w + b * q) * s))
}

/// Gear's scheme on it: distance in the phase plane at the end.
pub(super) fn gear_error(steps: f64, b: f64, c0: f64, exact_start: bool) -> f64 {
    let dt = END / steps;
    // Derivatives at the start by the equation itself.
    let mut d = [1.0, START_SPEED, 0.0, 0.0, 0.0, 0.0];
    for k in 2..6 {
        d[k] = -d[k - 2] - 2.0 * b * d[k - 1];
    }
    let mut g = Gear::start(V3::x() * d[0], V3::x() * d[1], V3::x() * d[2], dt);
    if exact_start {
        let mut scale = 0.5 * dt * dt;
        for k in 3..6 {
            scale *= dt / k as f64;
            g.0[k] = V3::x() * (d[k] * scale);
        }
    }
    for _ in 0..steps as u64 {
        g.predict();
        let a = -g.0[0] - g.0[1] * (2.0 * b / dt);
        g.correct(&a, dt, c0);
    }
    let (x, v) = oscillation(b, END);
    libm::hypot(g.0[0].x - x, g.0[1].x / dt - v)
}

fn gear_sample(steps: f64, b: f64, c0: f64, exact_start: bool) -> Sample {
    let (x, v) = oscillation(b, END);
    let size = libm::hypot(x, v);
    let error = gear_error(steps, b, c0, exact_start);
    Sample { error, ..Sample::absolute(steps, size + error, size) }
}

const SMOOTH: &[f64] = &[100.0, 200.0, 400.0, 800.0];
const SMOOTH_FULL: &[f64] = &[50.0, 100.0, 200.0, 400.0, 800.0, 1600.0];
const SMOOTH_STEPS: &str = "N (steps for 8/omega)";
const OSCILLATOR: &str =
    "x'' = -x - 2 b x' from x = 1, x' = 0.3, closed form; reference_values.json `gear6_observed_order`";

/// Fifth order.
pub const GEAR_DAMPED: Claim = Claim {
    id: "gear-fifth-order",
    title: "Gear's six values are of fifth order if the force is smooth and the start derivatives are exact",
    tags: &["D3", "000 Sec 2.1", "ERRATA 34"],
    measures: "Distance from the exact state of a damped oscillator (b = 0.1) at t = 8; c0 = 3/16, for forces that depend on \
               velocity",
    reference: Reference { source: OSCILLATOR, uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: SMOOTH_STEPS,
        short: SMOOTH,
        full: &[100.0, 141.0, 200.0, 283.0, 400.0, 566.0, 800.0],
    },
    order: Some(OrderBand { expected: 5.0, band: 0.15, at_least: false }),
    tolerance: Tolerance {
        value: 2e-11,
        at: Rung::At(800.0),
        basis: Basis::Derived,
        because: "The corrector drops the sixth derivative: errors of (3/160) dt^6/dt per unit of time, t dt^5 (3/160) = 1.5e-11 \
                  with dt = 0.01 and an amplitude of 1; the oscillation has decayed to 0.45 at the end",
    },
    kind: Kind::Verification,
    measure: |_, steps| Ok(gear_sample(steps, 0.1, CORRECTOR[0], true)),
};

/// Between fifth and sixth.
pub const GEAR_CONSERVATIVE: Claim = Claim {
    id: "gear-conservative-order",
    title: "With c0 = 3/20 and a force without velocity, Gear's six values are at least of fifth order",
    tags: &["D3", "000 Sec 2.1", "ERRATA 34"],
    measures: "Distance from the exact state of an undamped oscillator at t = 8; c0 = 3/20",
    reference: Reference { source: OSCILLATOR, uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: SMOOTH_STEPS,
        short: SMOOTH,
        full: &[100.0, 141.0, 200.0, 283.0, 400.0, 566.0, 800.0],
    },
    order: Some(OrderBand { expected: 5.0, band: 0.1, at_least: true }),
    tolerance: Tolerance {
        value: 1.5e-12,
        at: Rung::At(800.0),
        basis: Basis::AfterSeeing,
        because: "1.46e-9 at N = 200 carried on with the fifth order that is asked for: 1.43e-12",
    },
    kind: Kind::Verification,
    measure: |_, steps| Ok(gear_sample(steps, 0.0, CORRECTOR_0_CONSERVATIVE, true)),
};

/// Second order without start derivatives.
pub const GEAR_ZERO_START: Claim = Claim {
    id: "gear-zero-start",
    title: "Started with zero higher derivatives, the same scheme is of second order",
    tags: &["D3", "000 Sec 2.1", "ERRATA 34"],
    measures: "As `gear-fifth-order`, with x''' = x'''' = x''''' = 0 at the start: how every grain starts a run",
    reference: Reference { source: OSCILLATOR, uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: SMOOTH_STEPS, short: SMOOTH, full: SMOOTH_FULL },
    order: Some(OrderBand { expected: 2.0, band: 0.1, at_least: false }),
    tolerance: Tolerance {
        value: 5e-7,
        at: Rung::At(800.0),
        basis: Basis::AfterSeeing,
        because: "0.21/N^2, the constant of the coarsest rung, gives 3.3e-7 at N = 800; half as much again. (A missing third \
                  derivative shifts the start by dt^2 x'''/6 at most, 1.7e-5; the corrector makes up for most of it.)",
    },
    kind: Kind::PredictedFailure,
    measure: |_, steps| Ok(gear_sample(steps, 0.1, CORRECTOR[0], false)),
};

/// A sphere on a linear spring and dashpot that it never leaves: a smooth force inside the whole code.
///
/// From the equilibrium overlap, δ₀ = m g/k, with a speed that changes the overlap by half.
fn on_a_spring(integrator: Integrator, restitution: f64, steps: f64) -> Result<Sample, VerifyError> {
    use lahar::dem::restitution::linear_damping_ratio;
    let stiffness_n_m = 1e3;
    let normal = NormalLaw::Linear { stiffness_n_m, restitution, tangential_ratio: 1.0 };
    let mut s = setup(7e6, PairProperties { normal, ..elastic() });
    let omega = (stiffness_n_m / mass(RADIUS)).sqrt();
    // Gravity that presses the sphere in by 1e-4 m.
    let depth = 1e-4;
    s.gravity = V3::z() * -(depth * omega * omega);
    s.walls = vec![floor()];
    s.start_overlap = 0.1;
    s.integrator = integrator;
    s.grains =
        vec![Grain::sphere(RADIUS, V3::z() * (RADIUS - depth), 0).moving(V3::z() * (0.5 * depth * omega))];
    s.time_step_s = Some(END / omega / steps);
    let mut d = Dem::new(&s)?;
    d.step(steps as u64)?;
    // z − r + depth = ½ depth e^{−bτ} sin(wτ)/w
    let b = linear_damping_ratio(restitution);
    let w = (1.0 - b * b).sqrt();
    let exact = 0.5 * libm::exp(-b * END) * libm::sin(w * END) / w;
    Ok(Sample::absolute(steps, (d.bodies().position[0].z - RADIUS) / depth + 1.0, exact))
}

const ON_A_SPRING: &str =
    "z = (1/2) exp(-b t) sin(w t)/w about the equilibrium of a linear spring and dashpot";

/// Verlet.
pub const VERLET: Claim = Claim {
    id: "verlet-second-order",
    title: "Velocity Verlet is of second order on a smooth force, velocity-dependent or not",
    tags: &["D3"],
    measures: "Height at t = 8/omega of a sphere that swings on a linear spring without leaving it, in units of the overlap at \
               rest; worst of e = 1 and e = 0.7",
    reference: Reference { source: ON_A_SPRING, uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: SMOOTH_STEPS, short: SMOOTH, full: SMOOTH_FULL },
    order: Some(OrderBand { expected: 2.0, band: 0.05, at_least: false }),
    tolerance: Tolerance {
        value: 1.7e-5,
        at: Rung::At(800.0),
        basis: Basis::Derived,
        because: "A phase error of omega t (omega dt)^2/24 = 3.3e-5 with omega dt = 0.01, times the amplitude 1/2",
    },
    kind: Kind::Verification,
    measure: |_, steps| {
        let (a, b) =
            (on_a_spring(Integrator::Verlet, 1.0, steps)?, on_a_spring(Integrator::Verlet, 0.7, steps)?);
        let (undamped, damped) = (a.error, b.error);
        let worse = if a.error > b.error { a } else { b };
        Ok(worse.with("error, e = 1", undamped).with("error, e = 0.7", damped))
    },
};

/// Gear inside the code.
pub const GEAR_IN_RUN: Claim = Claim {
    id: "gear-in-a-run",
    title: "In a run, Gear's scheme is of second order: its start derivatives are zero",
    tags: &["D3", "000 Sec 2.1", "ERRATA 34"],
    measures: "As `verlet-second-order`, with integrator `gear`",
    reference: Reference { source: ON_A_SPRING, uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: SMOOTH_STEPS, short: SMOOTH, full: SMOOTH_FULL },
    order: Some(OrderBand { expected: 2.0, band: 0.1, at_least: false }),
    tolerance: Tolerance {
        value: 6e-6,
        at: Rung::At(800.0),
        basis: Basis::AfterSeeing,
        because: "2.6/N^2, the constant of the coarsest rung, gives 4.1e-6 at N = 800; half as much again",
    },
    kind: Kind::PredictedFailure,
    measure: |_, steps| {
        let (a, b) = (on_a_spring(Integrator::Gear, 1.0, steps)?, on_a_spring(Integrator::Gear, 0.7, steps)?);
        Ok(if a.error > b.error { a } else { b })
    },
};

/// Young's modulus (Pa) and speed (m/s) of the collisions below.
const YOUNG: f64 = 7e8;
const SPEED: f64 = 1.0;

/// Time and depth of an elastic collision.
fn scales() -> (f64, f64) {
    let (m, k) = (0.5 * mass(RADIUS), hertz_stiffness(YOUNG, POISSON, (RADIUS, RADIUS)));
    (hertz_time(m, k, SPEED), hertz_overlap(m, k, SPEED))
}

/// The law of dimensionless damping `a`.
pub(super) fn damped(a: f64) -> PairProperties {
    let (m, k) = (0.5 * mass(RADIUS), hertz_stiffness(YOUNG, POISSON, (RADIUS, RADIUS)));
    let time_s = a / (libm::pow(k / m, 0.4) * libm::pow(SPEED, 0.2));
    PairProperties { normal: NormalLaw::ViscoElastic { time_s }, ..elastic() }
}

/// Distance of two spheres after a collision, over the largest overlap, from a start `gap` apart, two contact times
/// later.
fn separation(
    pair: PairProperties,
    integrator: Integrator,
    steps: f64,
    gap: f64,
) -> Result<f64, VerifyError> {
    let (time, depth) = scales();
    let mut s: Setup = head_on(setup(YOUNG, pair), (RADIUS, RADIUS), SPEED, gap);
    s.integrator = integrator;
    s.time_step_s = Some(time / steps);
    let mut d = Dem::new(&s)?;
    d.step((2.0 * steps) as u64)?;
    Ok(((d.bodies().position[1] - d.bodies().position[0]).x - 2.0 * RADIUS) / depth)
}

/// Mean error of the separation over eight gaps, so that the first touch falls anywhere in a step.
///
/// Against free flight, the collision's duration and restitution by Hertz or by the integral of the damped law, free
/// flight.
pub(super) fn contact_error(a: f64, integrator: Integrator, steps: f64) -> Result<f64, VerifyError> {
    let (time, depth) = scales();
    let (e, units) = visco_elastic_collision(a);
    // Hertz's time is `time` in the same units.
    let (restitution, duration) = (e.cut_off, units * time / hertz_time(1.0, 1.0, 1.0));
    let mut sum = 0.0;
    for i in 0..8 {
        let gap = depth * (0.05 + 0.11 * f64::from(i));
        let exact = restitution * (2.0 * time - gap / SPEED - duration) * SPEED / depth;
        sum += (separation(damped(a), integrator, steps, gap)? - exact).abs();
    }
    Ok(sum / 8.0)
}

/// Verlet across a contact.
pub const CONTACT: Claim = Claim {
    id: "verlet-across-contact",
    title: "Across elastic contacts velocity Verlet keeps its second order",
    tags: &["D1", "D3", "000 Sec 2.1"],
    measures: "Distance of two spheres one contact time after an elastic collision, in units of the largest overlap; mean \
               error over eight starts, so that first touch falls anywhere within a step",
    reference: Reference { source: "Free flight, Hertz's contact time, free flight", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "N (steps per contact)",
        short: &[25.0, 50.0, 100.0, 200.0],
        full: &[12.5, 25.0, 50.0, 100.0, 200.0, 400.0, 800.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.2, at_least: false }),
    tolerance: Tolerance {
        value: 6e-5,
        at: Rung::At(200.0),
        basis: Basis::Derived,
        because: "The error of the contact time, at most 2e-5 at N = 200 (see `hertz-contact-time`), times t_c v/delta_max = 2.94",
    },
    kind: Kind::Verification,
    measure: contact,
};

fn contact(_: &dyn Backend, steps: f64) -> Result<Sample, VerifyError> {
    let (error, gear) =
        (contact_error(0.0, Integrator::Verlet, steps)?, contact_error(0.0, Integrator::Gear, steps)?);
    Ok(Sample::absolute(steps, error, 0.0).with("Gear", gear))
}
