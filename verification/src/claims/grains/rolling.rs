//! Spheres that slide and roll: on a floor, on a slope, in a trough.

use super::support::{G, RADIUS, mass, rest_on_floor, resting_overlap, run_until, setup, trough, wall};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::grains::rolling::{
    arm_ratio, incline_acceleration, rolling_deceleration, rolling_pendulum, rolling_speed, rolling_time,
    slip_slope,
};
use crate::reference_values::find;
use lahar::dem::{ContactEquations, Dem, Grain, PairProperties, StandardContact, V3};
use lahar::solver::run::Backend;

pub(super) const STIFFNESS: &str = "E (Pa)";
pub(super) const OVERLAP_ORDER: OrderBand = OrderBand { expected: 2.0 / 3.0, band: 0.1, at_least: false };

pub(super) fn sticky(friction: f64) -> PairProperties {
    PairProperties { friction, ..PairProperties::default() }
}

/// A sphere thrown along the floor.
struct Throw {
    /// Final over first speed.
    speed: f64,
    /// Time (s) and place (m) when slip ends.
    time: f64,
    place: f64,
    /// Arm of friction over the radius.
    arm: f64,
}

/// Thrown at `v0` with friction `mu`, until it should roll and a while longer.
fn throw(young: f64, mu: f64, v0: f64, equations: impl ContactEquations) -> Result<Throw, VerifyError> {
    let mut s = setup(young, sticky(mu));
    let arm = rest_on_floor(&mut s, young, V3::z() * -G);
    s.grains[0].velocity = V3::x() * v0;
    // The sphere lies still: only slow contacts have to be resolved.
    s.design_speed_m_s = 0.1;
    let mut d = Dem::with_equations(&s, equations)?;
    let slip = |d: &Dem| d.bodies().velocity[0].x - d.bodies().spin[0].y * arm * RADIUS;
    let (mut time, mut place) = (f64::NAN, f64::NAN);
    let mut before = slip(&d);
    // Slip, and 0.04 s in which the tangential dashpot brings what is left to rest.
    while d.time() < rolling_time(2.5, v0, mu, G) + 0.04 {
        d.step_with(equations, 1)?;
        let now = slip(&d);
        if time.is_nan() && now <= 0.0 {
            // Back to where the slip, linear in time, was zero.
            let back = d.time_step() * now / (now - before);
            time = d.time() - back;
            place = d.bodies().position[0].x - back * d.bodies().velocity[0].x;
        }
        before = now;
    }
    Ok(Throw { speed: d.bodies().velocity[0].x / v0, time, place, arm })
}

/// Rigid limit.
pub const SLIDING: Claim = Claim {
    id: "sliding-to-rolling",
    title: "A sphere thrown without spin ends rolling at 5/7 of its speed, and the stiffer the closer",
    tags: &["D2", "000 Sec 2.1"],
    measures: "Final speed; further columns: relative errors of the time and the place at which it rolls",
    reference: Reference {
        source: "reference_values.json `sliding_to_rolling`: 5/7 v0 at 2 v0/(7 mu g), 12 v0^2/(49 mu g); rigid sphere, mu = 0.3, \
                 v0 = 1 m/s",
        uncertainty: 1e-10,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: STIFFNESS, short: &[7e6, 7e7, 7e8], full: &[7e5, 7e6, 7e7, 7e8, 7e9] },
    order: Some(OVERLAP_ORDER),
    tolerance: Tolerance {
        value: 7e-5,
        at: Rung::At(7e8),
        basis: Basis::Derived,
        because: "Friction acts at r - delta: (4/7) delta/r = 6.1e-5 with the overlap of the sphere's weight, ~ E^(-2/3)",
    },
    kind: Kind::Verification,
    measure: |_, young| {
        let entry = find("sliding_to_rolling", &[])?;
        let (mu, v0) = (entry.input("mu")?, entry.input("v0")?);
        let t = throw(young, mu, v0, StandardContact)?;
        Ok(Sample::relative(young, t.speed, entry.field("v_final_over_v0")?)
            .with("error of the time", t.time / entry.field("t_roll")? - 1.0)
            .with("error of the place", t.place / entry.field("x_roll")? - 1.0))
    },
};

/// With the arm r − δ.
pub(super) fn with_arm(mu: f64, equations: impl ContactEquations) -> Result<Sample, VerifyError> {
    let t = throw(7e6, mu, 0.5, equations)?;
    let q = arm_ratio(t.arm);
    Ok(Sample::relative(mu, t.speed, rolling_speed(q)).with("arm/r", t.arm))
}

/// Exact speed.
pub const SLIDING_ARM: Claim = Claim {
    id: "sliding-to-rolling-speed",
    title: "The final speed is exact for the arm r - delta that friction has",
    tags: &["D2", "004 Eq 3.38", "ERRATA 18"],
    measures: "Final speed of a soft sphere (E = 7 MPa, delta/r = 2.3e-3) thrown at 0.5 m/s",
    reference: Reference {
        source: "v = q/(1 + q) v0, q = (5/2)(1 - delta/r)^2: angular momentum about the contact",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "mu", short: &[0.1, 0.3, 0.6], full: &[0.05, 0.1, 0.2, 0.3, 0.6, 1.0] },
    order: None,
    tolerance: Tolerance {
        value: 2e-12,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "Force and torque of friction are in exact proportion: rounding of 1e-16 in each of 1e4 steps, 1e-12, and as much \
                  for what is left of the damped oscillation of the tangential spring",
    },
    kind: Kind::Verification,
    measure: |_, mu| with_arm(mu, StandardContact),
};

/// Time of the end of slip.
pub(super) fn slip_time(young: f64, equations: impl ContactEquations) -> Result<Sample, VerifyError> {
    let t = throw(young, 0.3, 1.0, equations)?;
    Ok(Sample::relative(young, t.time, rolling_time(arm_ratio(t.arm), 1.0, 0.3, G)))
}

/// Exact time.
pub const SLIDING_TIME: Claim = Claim {
    id: "sliding-to-rolling-time",
    title: "Slip lasts as long as Coulomb's law says",
    tags: &["D2", "000 Sec 2.1"],
    measures: "Time until the contact point stands still, mu = 0.3, 1 m/s",
    reference: Reference {
        source: "t = v0/(mu g (1 + q)), q = (5/2)(1 - delta/r)^2; 2 v0/(7 mu g) when rigid",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: STIFFNESS, short: &[7e6, 7e7, 7e8], full: &[7e6, 7e7, 7e8, 7e9] },
    order: None,
    tolerance: Tolerance {
        value: 1e-11,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "While it slips all forces are constant, which the scheme integrates exactly, and the moment is found by a line \
                  through two steps: rounding of 1e-16 in each of up to 1e5 steps. (From 7 MPa on the spring reaches its cap \
                  within the first step.)",
    },
    kind: Kind::Verification,
    measure: |_, young| slip_time(young, StandardContact),
};

/// A sphere released on a slope, watched between two times.
struct Descent {
    acceleration: f64,
    /// Of the surface, r dω/dt.
    angular: f64,
    /// Over the speed, at the end.
    slip: f64,
    /// Whether slip is there to stay: it grows. (Released on a steep slope a sphere slips at first, until the
    /// tangential spring has found its elongation; below the threshold that slip dies out.)
    slips: bool,
    arm: f64,
}

fn descend(young: f64, mu: f64, theta: f64, steps: u64) -> Result<Descent, VerifyError> {
    let (sin, cos) = (libm::sin(theta), libm::cos(theta));
    let mut s = setup(young, sticky(mu));
    let arm = rest_on_floor(&mut s, young, V3::new(G * sin, 0.0, -G * cos));
    s.design_speed_m_s = 0.1;
    let mut d = Dem::new(&s)?;
    d.step(steps / 2)?;
    let (v, w, t) = (d.bodies().velocity[0].x, d.bodies().spin[0].y, d.time());
    d.step(steps)?;
    let (v1, w1, passed) = (d.bodies().velocity[0].x, d.bodies().spin[0].y, d.time() - t);
    let slip = [v - w * arm * RADIUS, v1 - w1 * arm * RADIUS];
    Ok(Descent {
        acceleration: (v1 - v) / passed,
        angular: (w1 - w) / passed * RADIUS,
        slip: slip[1] / v1,
        slips: slip[1] > 1e-9 * v1 && slip[1] > slip[0],
        arm,
    })
}

/// Acceleration down a slope below and above the threshold of slip.
pub const INCLINE: Claim = Claim {
    id: "incline-acceleration",
    title: "Down a slope a sphere rolls or slips with the right acceleration",
    tags: &["D2", "000 Sec 2.1"],
    measures: "Acceleration for mu = 0.3 (threshold 46.397 deg), E = 70 MPa; further columns: slip over speed, spin-up",
    reference: Reference {
        source: "(5/7) g sin(theta) rolling, g (sin(theta) - mu cos(theta)) slipping (reference_values.json `incline_roll`)",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "theta (deg)",
        short: &[30.0, 45.0, 48.0, 60.0],
        full: &[5.0, 15.0, 30.0, 45.0, 46.0, 46.8, 48.0, 60.0, 75.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 3e-4,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "Rolling: friction's arm r - delta, (4/7) delta/r = 2.8e-4 with delta/r = 4.97e-4 at 5 degrees; slipping: rounding",
    },
    kind: Kind::Verification,
    measure: |_, degrees| {
        let theta = degrees.to_radians();
        let d = descend(7e7, 0.3, theta, 6000)?;
        Ok(Sample::relative(degrees, d.acceleration, incline_acceleration(2.5, 0.3, G, theta))
            .with("slip / speed", d.slip)
            .with("spin-up times r (m/s2)", d.angular))
    },
};

/// The threshold.
pub const THRESHOLD: Claim = Claim {
    id: "incline-threshold",
    title: "A sphere begins to slip at tan(theta) = 3.5 mu",
    tags: &["D2", "000 Sec 2.1"],
    measures: "Tangent of the slope beyond which slip grows instead of dying out, over mu, by bisection; E = 700 MPa",
    reference: Reference { source: "7/2, rigid sphere", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "mu", short: &[0.1, 0.3, 0.6], full: &[0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 1.0] },
    order: None,
    tolerance: Tolerance {
        value: 2e-4,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "Friction's arm: (1 + q)/(7/2) = 1 - (10/7) delta/r, delta/r = 1.07e-4 at most: 1.5e-4; the bisection stops at 1e-5",
    },
    kind: Kind::Verification,
    measure: threshold,
};

fn threshold(_: &dyn Backend, mu: f64) -> Result<Sample, VerifyError> {
    let young = 7e8;
    let (mut low, mut high) = (2.5 * mu, 4.5 * mu);
    let mut arm = 1.0;
    while high - low > 1e-5 * mu {
        let middle = 0.5 * (low + high);
        let d = descend(young, mu, libm::atan(middle), 3000)?;
        arm = d.arm;
        if d.slips { high = middle } else { low = middle }
    }
    let found = 0.5 * (low + high) / mu;
    Ok(Sample::relative(mu, found, 3.5).with("with the arm r - delta", slip_slope(arm_ratio(arm), mu) / mu))
}

/// Half a swing of a sphere that rolls to and fro in a trough: time over the closed form's, height on the far side
/// over the start's.
pub(super) fn pendulum(young: f64) -> Result<Sample, VerifyError> {
    let (big, start) = (0.05, 1.0f64);
    let mut s = setup(young, sticky(5.0));
    s.walls = vec![wall("trough", trough(big))];
    s.gravity = V3::z() * -G;
    s.design_speed_m_s = 0.1;
    s.start_overlap = 0.02;
    // At the overlap that carries the load there.
    let l = big - RADIUS + resting_overlap(young, RADIUS, mass(RADIUS) * G * libm::cos(start));
    s.grains =
        vec![Grain::sphere(RADIUS, V3::new(-l * libm::sin(start), 0.0, big - l * libm::cos(start)), 0)];
    let mut d = Dem::new(&s)?;
    let half = rolling_pendulum(big - RADIUS, G, start) / 2.0;
    let (mut moving, mut before) = (false, 0.0);
    while d.time() < 3.0 * half {
        d.step(1)?;
        let v = d.bodies().velocity[0].x;
        moving |= v > 0.1;
        if moving && v < 0.0 {
            let x = d.bodies().position[0] - V3::z() * big;
            let time = d.time() - d.time_step() * v / (v - before);
            return Ok(Sample::relative(young, time, half)
                .with("angle on the far side / at the start", libm::atan2(x.x, -x.z) / start));
        }
        before = v;
    }
    Err(VerifyError::Numerics { what: "pendulum", detail: "no return within three half swings".into() })
}

/// The contact tilts all the way.
pub const PENDULUM: Claim = Claim {
    id: "rolling-pendulum",
    title: "A sphere rolling in a trough swings with the period of the rolling pendulum",
    tags: &["D2", "D5", "004 Eq 3.38", "ERRATA 18"],
    measures: "Time of half a swing from 1 rad in a trough of ten radii; further column: angle reached",
    reference: Reference {
        source: "T = 4 sqrt(7 (R - r)/(5 g)) K(sin^2(theta/2)), rigid sphere rolling without slip",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: STIFFNESS, short: &[7e6, 7e7, 7e8], full: &[7e6, 7e7, 7e8, 7e9] },
    order: Some(OVERLAP_ORDER),
    tolerance: Tolerance {
        value: 5.2e-5,
        at: Rung::At(7e8),
        basis: Basis::Derived,
        because: "Arm r - delta and centre's circle R - r + delta: (2/7 + 1/18) delta/r; delta is that of up to 1.66 weights, 1.4 times \
                  1.07e-4 r: 5.1e-5",
    },
    kind: Kind::Verification,
    measure: |_, young| pendulum(young),
};

/// Slowing down by rolling friction.
pub const RESISTANCE: Claim = Claim {
    id: "rolling-resistance",
    title: "Rolling friction slows a sphere down as its torque demands, and it stops for good",
    tags: &["D2"],
    measures: "Deceleration of a sphere rolling at 0.2 m/s, E = 7 MPa; further columns: speed over 0.2 m/s after it should have \
               stopped",
    reference: Reference {
        source: "mu_r g (r/arm) q/(1 + q), q = (5/2)(arm/r)^2, arm = r - delta; (5/7) mu_r g when rigid",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "mu_r", short: &[0.02, 0.1, 0.3], full: &[0.02, 0.05, 0.1, 0.2, 0.3] },
    order: None,
    tolerance: Tolerance {
        value: 2e-12,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "Constant forces after the springs have found their elongation: rounding of 1e-16 in each of 1e4 steps, 1e-12, and as \
                  much for what is left of the damped oscillation",
    },
    kind: Kind::Verification,
    measure: resistance,
};

fn resistance(_: &dyn Backend, rolling_friction: f64) -> Result<Sample, VerifyError> {
    let (young, v0) = (7e6, 0.2);
    let mut s = setup(young, PairProperties { rolling_friction, ..sticky(0.8) });
    let arm = rest_on_floor(&mut s, young, V3::z() * -G);
    s.design_speed_m_s = 0.1;
    s.grains[0].velocity = V3::x() * v0;
    s.grains[0].spin = V3::y() * (v0 / (arm * RADIUS));
    let exact = rolling_deceleration(arm_ratio(arm), arm, rolling_friction, G);
    let stop = v0 / exact;
    let mut d = Dem::new(&s)?;
    let until = |d: &mut Dem, t: f64| -> Result<(f64, f64), VerifyError> {
        run_until(d, t)?;
        Ok((d.bodies().velocity[0].x, d.time()))
    };
    let (v, t) = until(&mut d, 0.5 * stop)?;
    let (v1, t1) = until(&mut d, 0.9 * stop)?;
    let (rest, _) = until(&mut d, stop + 0.5)?;
    Ok(Sample::relative(rolling_friction, (v - v1) / (t1 - t), exact).with("speed left / first", rest / v0))
}
