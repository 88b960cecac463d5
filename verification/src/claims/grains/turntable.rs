//! A sphere that rolls on a turntable.

use super::rolling::{OVERLAP_ORDER, STIFFNESS, sticky};
use super::support::{G, RADIUS, rest_on_floor, setup, worst};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::exact::grains::rolling::{arm_ratio, turntable_rate};
use lahar::dem::{Dem, V3};

/// Rate at which the velocity of a sphere on a turntable turns, over the table's, measured over a quarter circle.
fn turntable(young: f64) -> Result<(f64, f64), VerifyError> {
    let omega = 8.0;
    let mut s = setup(young, sticky(0.8));
    let arm = rest_on_floor(&mut s, young, V3::z() * -G);
    s.walls[0].motion.spin = V3::z() * omega;
    // Rolling without slip at the start: v + ω × (−arm z) = Ω × x.
    let (x, v) = (V3::x() * 0.05, V3::y() * 0.04);
    s.grains[0].position += x;
    s.grains[0].velocity = v;
    s.grains[0].spin = (V3::z().cross(&x) * omega - v).cross(&V3::z()) * (1.0 / (arm * RADIUS));
    s.design_speed_m_s = 0.1;
    let mut d = Dem::new(&s)?;
    let direction = |d: &Dem| libm::atan2(-d.bodies().velocity[0].x, d.bodies().velocity[0].y);
    // The tangential spring finds its elongation within the first twentieth of the turn.
    let whole = std::f64::consts::FRAC_PI_2 / (2.0 / 7.0 * omega);
    d.step((0.1 * whole / d.time_step()) as u64)?;
    let (from, start) = (direction(&d), d.time());
    d.step((0.9 * whole / d.time_step()) as u64)?;
    Ok(((direction(&d) - from) / (d.time() - start) / omega, arm))
}

/// Turntable.
pub const TURNTABLE: Claim = Claim {
    id: "sphere-on-turntable",
    title: "On a turntable a rolling sphere circles at 2/7 of the table's rate",
    tags: &["D2", "D5"],
    measures: "Rate at which the velocity turns over the table's rate of 8 rad/s",
    reference: Reference {
        source: "2/7, rigid sphere (Weltner 1979, Am. J. Phys. 47, 984)",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: STIFFNESS,
        short: &[2e6, 7e6, 2e7, 7e7],
        full: &[2e6, 7e6, 2e7, 7e7, 2e8, 7e8],
    },
    order: Some(OVERLAP_ORDER),
    tolerance: Tolerance {
        value: 7.5e-4,
        at: Rung::At(7e7),
        basis: Basis::Derived,
        because: "Friction's arm r - delta: 1/(1 + q) is (10/7) delta/r = 7.1e-4 too large with delta/r = 4.98e-4",
    },
    kind: Kind::Verification,
    measure: |_, young| {
        let (rate, arm) = turntable(young)?;
        let with_arm = turntable_rate(arm_ratio(arm));
        Ok(Sample::relative(young, rate, 2.0 / 7.0)
            .with("error with the arm r - delta", worst(&[rate / with_arm - 1.0])))
    },
};
