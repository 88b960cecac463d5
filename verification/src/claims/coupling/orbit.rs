//! A rigid pair of spheres tumbling through half of Jeffery's orbit.

use std::f64::consts::PI;

use super::free::{middle, sheared};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::claims::immersed::{exact, immersed, numerics};
use crate::exact::suspension::rotation::{self, JefferyOrbit};
use lahar::coupling::StandardCoupling;
use lahar::dem::{Clump, Grain, Orientation, Sphere, V3};
use lahar::solver::run::Backend;

/// γ̇(2R)²/ν.
const REYNOLDS: f64 = 0.1;
/// ν of [`sheared`].
const VISCOSITY: f64 = 0.5;

fn half_turn(backend: &dyn Backend, radius: f64) -> Result<Sample, VerifyError> {
    let ball = |x: f64| Sphere { centre: V3::new(x, 0.0, 0.0), radius };
    let clump = Clump::new("pair", &[ball(-radius), ball(radius)])?;
    let (cells, centre) = middle(radius, [0.1, 0.2, -0.1]);
    // The axis starts along the gradient.
    let turn = Orientation::from_axis_angle(&nalgebra::Vector3::z_axis(), 0.5 * PI) * clump.frame;
    let grain = Grain::clump(0, clump.equivalent_radius(), V3::from(centre), turn, 0);
    let rate = REYNOLDS * VISCOSITY / (4.0 * radius * radius);
    let setup = sheared(grain, vec![clump], cells, 0.5 * rate * cells as f64, StandardCoupling);
    let orbit = exact(JefferyOrbit::new(exact(rotation::chain(2, 2.0))?, rate))?;
    let mut run = backend.start(&setup)?;
    let (mut angle, mut before, mut off) = (0.0, 0.0, 0.0_f64);
    let most = 2 * orbit.period() as u64;
    while angle < PI {
        if run.step() > most {
            return Err(numerics("orbit", format!("turned by {angle:.3} radians in {most} steps")));
        }
        run.advance(1)?;
        before = angle;
        angle -= immersed(run.as_ref())?.motion(0)[5];
        off = off.max((angle - orbit.phi(run.step() as f64, 0.0)).abs());
    }
    let time = run.step() as f64 - (angle - PI) / (angle - before);
    let tilt = immersed(run.as_ref())?.motion(0);
    Ok(Sample::relative(radius, time, 0.5 * orbit.period())
        .with("largest deviation of the angle [rad]", off)
        .with("spin out of the plane of shear over the shear rate", libm::hypot(tilt[3], tilt[4]) / rate))
}

/// Jeffery's orbit.
pub const ORBIT: Claim = Claim {
    id: "pair-tumbles-through-jeffery-orbit",
    title: "A rigid pair of touching spheres tumbles in shear in the time of Jeffery's orbit",
    tags: &["C1", "C2", "D4"],
    measures: "time of half a turn in the plane of shear over (pi/rate)(r + 1/r), r = 1.98; walls 10 R apart, interpolated surface, rate (2R)^2/nu = 0.1",
    reference: Reference {
        source: "Jeffery 1922 with the aspect ratio of Nir & Acrivos 1973",
        uncertainty: 5e-5,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "R (cells)", short: &[2.0], full: &[2.0, 2.5, 3.0, 4.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.045,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "the aspect ratio to 5 % as in `pair-effective-aspect-ratio`, of which (r - 1/r)/(r + 1/r) = 0.6 goes into the time; fluid \
                  inertia: a tenth of Re = 0.1 and the start from rest, R^2/nu over the time of a turn: 0.002",
    },
    kind: Kind::Verification,
    measure: half_turn,
};
