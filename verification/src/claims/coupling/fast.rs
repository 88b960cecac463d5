//! A sphere that moves fast through fluid of low viscosity: hard on collision operators.

use super::moving::norm;
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::claims::immersed::{WALLS, driven, grains, periodic, plain_suspension, sphere};
use lahar::collision::{CollisionChoice, OddRate};
use lahar::coupling::GrainWall;
use lahar::rheology::Law;
use lahar::setup::Setup;
use lahar::solver::run::Backend;

/// Cells per step: what `plan` warns beyond, and a fifth more.
const SPEED: f64 = 0.12;
const RADIUS: f64 = 3.3;
const CELLS: usize = 20;
/// Eight diameters of way.
const STEPS: u64 = 440;

/// What scenes with grains take when nothing else is asked for: Newtonian, and with a yield stress.
const OPERATORS: [(&str, CollisionChoice); 2] = [
    ("two relaxation times", CollisionChoice::Trt(OddRate::STANDARD)),
    ("central moments", CollisionChoice::CentralMoment(OddRate::AMONG_GRAINS)),
];

fn setup(tau: f64, collision: CollisionChoice, wall: GrainWall) -> Setup {
    let middle = 0.5 * CELLS as f64;
    let way = [0.1, 0.05, -1.0];
    let velocity = way.map(|x| SPEED * x / norm(&way));
    let grain = driven(sphere(RADIUS, [middle + 0.1, middle - 0.1, middle + 0.2]), velocity, [0.0; 3]);
    let mut setup = periodic([CELLS; 3], plain_suspension(grains(1.0, vec![grain]), wall));
    setup.fluids = vec![Law::Newtonian { mu: (tau - 0.5) / 3.0 }];
    setup.collision = collision;
    setup
}

fn fast(backend: &dyn Backend, tau: f64) -> Result<Sample, VerifyError> {
    let mut largest = 0.0_f64;
    let mut named = Vec::new();
    for (operator, collision) in OPERATORS {
        for (surface, wall) in WALLS {
            let mut run = backend.start(&setup(tau, collision, wall))?;
            run.advance(STEPS)?;
            let speed = run.fields().velocity.iter().map(|u| norm(u)).fold(0.0, f64::max) / SPEED;
            named.push((format!("{operator}, {surface}"), speed));
            // NaN must not be lost.
            largest = if speed <= largest { largest } else { speed };
        }
    }
    let sample = Sample::absolute(tau, largest, 0.0);
    Ok(named.into_iter().fold(sample, |sample, (name, speed)| sample.with(&name, speed)))
}

/// Fast grains.
pub const FAST: Claim = Claim {
    id: "fast-sphere-is-stable",
    title: "A sphere moving at 0.12 cells per step leaves a calm flow at low viscosity",
    tags: &["C1", "K2", "K3", "H7"],
    measures: "largest speed of the fluid over that of the sphere after eight diameters of way, R = 3.3 in a periodic box of 20 cells; the \
               largest of both default operators and both kinds of surface",
    reference: Reference {
        source: "bounded flow: fluid pushed by a sphere moves at most at its speed at the poles, and flow without friction at half of it beside",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "tau", short: &[0.52], full: &[0.52, 0.55, 0.6, 0.8] },
    order: None,
    tolerance: Tolerance {
        value: 1.5,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "the speed of the sphere, and the half of it by which the corners of a staircase may exceed it; an operator that fails passes \
                  2 and the guard within 100 to 400 steps",
    },
    kind: Kind::Verification,
    measure: fast,
};
