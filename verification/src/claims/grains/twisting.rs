//! A sphere that spins about the normal of its only contact.

use super::support::{G, RADIUS, rest_on_floor, run_until, setup};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::dem::{Dem, PairProperties, V3};
use lahar::solver::run::Backend;

/// Slowing down by rolling friction while twisting.
pub const RESISTANCE: Claim = Claim {
    id: "twisting-resistance",
    title: "Rolling friction stops a sphere that spins upright on a floor",
    tags: &["D2"],
    measures: "Deceleration of a sphere spinning at 10 rad/s about the vertical, E = 7 MPa; further column: spin over 10 rad/s after \
               it should have stopped",
    reference: Reference {
        source: "torque mu_r r m g against the moment (2/5) m r^2: (5/2) mu_r g/r",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "mu_r", short: &[0.02, 0.1, 0.3], full: &[0.02, 0.05, 0.1, 0.2, 0.3] },
    order: None,
    tolerance: Tolerance {
        value: 2e-12,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "A constant torque once the spring has found its elongation: rounding of 1e-16 in each of 1e4 steps, 1e-12, and as much \
                  for the weight, which rests on the floor to 1e-12",
    },
    kind: Kind::Verification,
    measure: resistance,
};

fn resistance(_: &dyn Backend, rolling_friction: f64) -> Result<Sample, VerifyError> {
    let (young, first) = (7e6, 10.0);
    let pair = PairProperties { friction: 0.8, rolling_friction, ..PairProperties::default() };
    let mut s = setup(young, pair);
    rest_on_floor(&mut s, young, V3::z() * -G);
    s.design_speed_m_s = 0.1;
    s.grains[0].spin = V3::z() * first;
    let exact = 2.5 * rolling_friction * G / RADIUS;
    let stop = first / exact;
    let mut d = Dem::new(&s)?;
    let until = |d: &mut Dem, t: f64| -> Result<(f64, f64), VerifyError> {
        run_until(d, t)?;
        Ok((d.bodies().spin[0].z, d.time()))
    };
    let (w, t) = until(&mut d, 0.5 * stop)?;
    let (w1, t1) = until(&mut d, 0.9 * stop)?;
    let (rest, _) = until(&mut d, stop + 0.5)?;
    Ok(Sample::relative(rolling_friction, (w - w1) / (t1 - t), exact).with("spin left / first", rest / first))
}
