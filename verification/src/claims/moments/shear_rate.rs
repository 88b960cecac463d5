//! The shear rate read from the non-equilibrium tensor \[Y1\] \[Y2\].

use std::sync::Arc;

use super::conservation::OPERATORS;
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::collision::CollisionChoice;
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, FlowPoint, Setup, WallRule};
use lahar::solver::run::{Backend, Run};

/// Newtonian fluid of a relaxation time.
fn newtonian(tau: f64) -> Law {
    Law::Newtonian { mu: (tau - 0.5) / 3.0 }
}

const FORCE: [f64; 3] = [1e-4, -7e-5, 3e-5];
const STEPS: u64 = 200;

fn measure_acceleration(backend: &dyn Backend, tau: f64) -> Result<Sample, VerifyError> {
    let (mut shear, mut velocity) = (0.0_f64, 0.0_f64);
    for collision in OPERATORS {
        let mut setup = Setup::periodic([2, 2, 2], newtonian(tau));
        setup.collision = collision;
        setup.force = BodyForce::Constant(FORCE);
        let mut run = backend.start(&setup)?;
        run.advance(STEPS)?;
        let fields = run.fields();
        for cell in 0..setup.cells() {
            let gamma_dot = fields.shear_rate[cell];
            shear = if gamma_dot <= shear { shear } else { gamma_dot };
            for (u, force) in fields.velocity[cell].iter().zip(FORCE) {
                let error = (u - force * STEPS as f64).abs();
                velocity = if error <= velocity { velocity } else { error };
            }
        }
    }
    let error = if velocity <= shear { shear } else { velocity };
    Ok(Sample::absolute(tau, error, 0.0)
        .with("shear rate [1/step]", shear)
        .with("velocity error [-]", velocity))
}

/// A uniformly accelerating fluid.
pub const ACCELERATION: Claim = Claim {
    id: "acceleration-without-shear",
    title: "A uniformly accelerating fluid has no shear rate and the velocity F t",
    tags: &["L4", "L5", "Y1", "Y2", "004 Eq 3.28"],
    measures: "the larger of γ̇ and |u − F t|, all four operators, after 200 steps (u = 0.025)",
    reference: Reference { source: "rigid translation: S = 0, u = F t", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "tau (relaxation time)",
        short: &[0.55, 0.8, 1.8],
        full: &[0.51, 0.55, 0.8, 1.0, 1.8],
    },
    order: None,
    tolerance: Tolerance {
        value: 200.0 * 10.0 * 0.5 * f64::EPSILON * 0.025,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding: 200 steps, each about ten half-units of the momentum 0.025",
    },
    kind: Kind::Verification,
    measure: measure_acceleration,
};

const HEIGHT: usize = 8;
/// Slow, because the error of the magnitude grows with its square.
const WALL_SPEED: f64 = 1e-5;
/// Shear rate of the exact flow, 1.25e-6.
pub const EXACT: f64 = WALL_SPEED / HEIGHT as f64;

/// Steady Couette flow of a relaxation time, BGK.
///
/// # Errors
/// As the backend's.
pub fn couette(backend: &dyn Backend, tau: f64) -> Result<Box<dyn Run>, VerifyError> {
    let mut setup = Setup::channel(HEIGHT, newtonian(tau), 0.0);
    setup.faces[1][1] = Face::Moving([WALL_SPEED, 0.0, 0.0]);
    setup.collision = CollisionChoice::Bgk;
    setup.wall_rule = WallRule::HalfWay;
    setup.initial = Some(Arc::new(|[_, j, _]| FlowPoint {
        density: 1.0,
        velocity: [EXACT * (j as f64 + 0.5), 0.0, 0.0],
        gradient: [[0.0, EXACT, 0.0], [0.0; 3], [0.0; 3]],
    }));
    let mut run = backend.start(&setup)?;
    // Twenty diffusion times H²/(π²ν): what is left of the start is e⁻²⁰ of the error of the start.
    let nu = (tau - 0.5) / 3.0;
    run.advance((2.0 * (HEIGHT * HEIGHT) as f64 / nu).ceil() as u64)?;
    Ok(run)
}

/// The worse of the stress's and the magnitude's relative error.
pub fn couette_sample(tau: f64, signed: f64, magnitude: f64) -> Sample {
    let a = Sample::relative(tau, signed, EXACT);
    let b = Sample::relative(tau, magnitude, EXACT);
    if a.error <= b.error { b } else { a }
        .with("2 S_xy [1/step]", signed)
        .with("shear rate [1/step]", magnitude)
}

fn measure_couette(backend: &dyn Backend, tau: f64) -> Result<Sample, VerifyError> {
    let run = couette(backend, tau)?;
    let (fields, mu) = (run.fields(), (tau - 0.5) / 3.0);
    let mut worst = couette_sample(tau, fields.stress[0][3] / mu, fields.shear_rate[0]);
    for cell in 1..HEIGHT {
        let here = couette_sample(tau, fields.stress[cell][3] / mu, fields.shear_rate[cell]);
        worst = if here.error <= worst.error { worst } else { here };
    }
    Ok(worst)
}

/// Couette flow: sign and size.
pub const COUETTE: Claim = Claim {
    id: "strain-tensor-couette",
    title: "In Couette flow the shear stress has the right sign and γ̇ = √(2 S:S) is U/H",
    tags: &["Y1", "Y2", "B1", "001 Eq 9", "001 Eq 10", "004 Eq 3.27", "000 Eq 13"],
    measures: "2 S_xy = σ_xy/μ and γ̇ against U/H, the worst cell and the worse of the two",
    reference: Reference { source: "plane Couette flow; ERRATA 1–4", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "tau (relaxation time)",
        short: &[0.55, 0.8, 1.8],
        full: &[0.55, 0.8, 1.0, 1.8],
    },
    order: None,
    tolerance: Tolerance {
        value: WALL_SPEED * WALL_SPEED,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "error of the scheme: normal stresses of second order in U make the magnitude too large by \
up to 0.4 U² at τ = 1.8 (measured at U = 0.01 and 1e-5); rounding is below 1e-12",
    },
    kind: Kind::Verification,
    measure: measure_couette,
};
