//! A sphere in a Bingham fluid.

use std::f64::consts::PI;
use std::sync::Arc;

use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::claims::immersed::{UNITS, exact, grains, immersed, plain_suspension, sphere, volume};
use crate::exact::suspension::bingham_sphere;
use lahar::collision::{CollisionChoice, OddRate};
use lahar::coupling::GrainWall;
use lahar::dem::V3;
use lahar::rheology::Law;
use lahar::setup::{Face, Setup};
use lahar::solver::run::Backend;

const RADIUS: f64 = 3.0;
/// Low: where the fluid has just yielded its apparent viscosity is ten times that, and with the default operator drag
/// depends on the relaxation time.
const MU: f64 = 0.03;
const CELLS: usize = 18;

/// A sphere pulled by its weight at a yield number in a closed box of Bingham fluid, and that weight, less buoyancy.
fn pulled(mu: f64, yield_number: f64) -> (Setup, f64) {
    // Newtonian Re of 0.05.
    let force = 6.0 * PI * mu * RADIUS * 0.05 * mu / (2.0 * RADIUS);
    let stress = yield_number * force / (2.0 * PI * RADIUS * RADIUS);
    let gravity = force / volume(RADIUS);
    let middle = (CELLS / 2) as f64;
    let mut ball = grains(2.0, vec![sphere(RADIUS, [middle + 0.12, middle + 0.37, middle + 0.29])]);
    ball.gravity = V3::new(0.0, 0.0, -gravity);
    let mut suspension = plain_suspension(ball, GrainWall::CentralLinear);
    suspension.units = UNITS;
    suspension.pressure_gradient = [0.0, 0.0, gravity];
    let mut setup = Setup::periodic([CELLS; 3], Law::Bingham { sigma0: stress, mu });
    setup.faces = [[Face::NoSlip; 2]; 3];
    setup.grains = Some(Arc::new(suspension));
    (setup, force)
}

/// Its speed over that in a Newtonian fluid without walls, and the Bingham number.
fn speed(backend: &dyn Backend, yield_number: f64) -> Result<(f64, f64), VerifyError> {
    let (setup, force) = pulled(MU, yield_number);
    let mut run = backend.start(&setup)?;
    // Three times R²/ν, the time of the yielded zone.
    run.advance(900)?;
    let mut sum = 0.0;
    for _ in 0..100 {
        run.advance(1)?;
        sum -= immersed(run.as_ref())?.motion(0)[2];
    }
    let u = sum / 100.0;
    let stress = yield_number * force / (2.0 * PI * RADIUS * RADIUS);
    Ok((u * 6.0 * PI * MU * RADIUS / force, 2.0 * RADIUS * stress / (MU * u)))
}

fn held(backend: &dyn Backend, yield_number: f64) -> Result<Sample, VerifyError> {
    let (ratio, _) = speed(backend, yield_number)?;
    Ok(Sample::absolute(yield_number, ratio, 0.0))
}

/// Held.
pub const HELD: Claim = Claim {
    id: "bingham-sphere-held",
    title: "A yield stress above the critical one holds a sphere",
    tags: &["C2", "Y1"],
    measures: "speed over the Newtonian one, R = 3 cells",
    reference: Reference { source: "Beris et al. 1985: at rest above 0.143", uncertainty: 0.007 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "yield number", short: &[0.2], full: &[0.16, 0.2, 0.4] },
    order: None,
    tolerance: Tolerance {
        value: 5e-3,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "less than a tenth of the speed at a yield number of 0.08, 0.07; a creep remains (see \
                  the limits), and the bound was set after seeing it",
    },
    kind: Kind::Verification,
    measure: held,
};

/// Speed over the Newtonian one once more, with two relaxation times and after a longer time.
fn resting(backend: &dyn Backend, yield_number: f64) -> Result<Sample, VerifyError> {
    const MU: f64 = 0.1;
    let (mut setup, force) = pulled(MU, yield_number);
    setup.collision = CollisionChoice::Trt(OddRate::STANDARD);
    let mut run = backend.start(&setup)?;
    let mut ratios = [0.0; 5];
    let mut height = immersed(run.as_ref())?.centre(0)[2];
    for ratio in &mut ratios {
        run.advance(1000)?;
        let now = immersed(run.as_ref())?.centre(0)[2];
        *ratio = (height - now) / 1000.0 * 6.0 * PI * MU * RADIUS / force;
        height = now;
    }
    Ok(Sample::absolute(yield_number, ratios[4], 0.0)
        .with("in steps 1000 to 2000", ratios[1])
        .with("in steps 2000 to 3000", ratios[2]))
}

/// Held, with two relaxation times.
pub const RESTING: Claim = Claim {
    id: "bingham-sphere-comes-to-rest",
    title: "With two relaxation times a held sphere hardly creeps",
    tags: &["C2", "Y1", "K2"],
    measures: "speed over the Newtonian one, R = 3 cells, plastic viscosity 0.1, mean from step 4000 to 5000",
    reference: Reference { source: "Beris et al. 1985: at rest above 0.143", uncertainty: 0.007 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "yield number", short: &[0.2], full: &[0.16, 0.2, 0.4] },
    order: None,
    tolerance: Tolerance {
        value: 1e-3,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "a hundredth of the speed at half the critical yield number, 0.10; set after seeing 5e-4. The creep does not depend on \
                  the plastic viscosity and its ratio does: at 0.5 it is 2.6e-3 at a yield number of 0.16 and 1.1e-3 at 0.2",
    },
    kind: Kind::Verification,
    measure: resting,
};

fn moving(backend: &dyn Backend, yield_number: f64) -> Result<Sample, VerifyError> {
    let (ratio, bingham) = speed(backend, yield_number)?;
    Ok(Sample::relative(yield_number, 1.0 / ratio, exact(bingham_sphere::drag_fit(bingham))?)
        .with("Bingham number", bingham)
        .with("least drag possible", exact(bingham_sphere::least_drag(bingham))?))
}

/// Moving.
pub const MOVING: Claim = Claim {
    id: "bingham-sphere-drag",
    title: "Below the critical yield stress the drag of a moving sphere is within 8 % of the Bingham fluid's at the speed it has",
    tags: &["C2", "Y1"],
    measures: "drag over 6 pi mu R V against the fit at the Bingham number found; the speed V that was found stands on both \
               sides, and 6 and 7 % of the drag are 30 and 42 % of the speed",
    reference: Reference {
        source: "Blackery & Mitsoulis 1997: 1 + 2.93 Bn^0.83 (coefficients from memory)",
        uncertainty: 0.05,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "yield number", short: &[0.08], full: &[0.07, 0.08, 0.1] },
    order: None,
    tolerance: Tolerance {
        value: 0.08,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "5 % of the fit; 3 % of the surface, 2 (0.12/R^2), for the drag of a plastic fluid goes like R^2",
    },
    kind: Kind::Validation,
    measure: moving,
};
