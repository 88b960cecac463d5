//! Waves of pressure in a duct.

use std::sync::Arc;

use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::exact::duct::RectangularDuct;
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, FlowPoint, Setup};
use lahar::solver::run::Backend;

/// τ⁺, where a slip that answers the gradient of the pressure drives waves faster than a cell per step.
const TAU: f64 = 0.511;

/// Largest speed of the duct, cells per step.
const SPEED: f64 = 0.02;

/// Cells along the duct: one wave, of the length at which central differences see the steepest slope.
const LENGTH: usize = 4;

/// Waves in a duct die.
pub const WAVES: Claim = Claim {
    id: "duct-waves-die",
    title: "Waves of pressure in a square duct die at a small relaxation time",
    tags: &["B3", "K3"],
    measures: "largest change of a velocity component in the step after the time a²/ν, over the largest speed; edge a, \
               default scheme at τ = 0.511, from the exact flow with a wave of 1e-3 of the density along the duct",
    reference: Reference {
        source: "Stokes modes of the square duct: at least exp(−2π²νt/a²)",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "N (cells across)", short: &[8.0, 12.0], full: &[8.0, 12.0, 16.0, 24.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-9,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "ten times the 9.5e-11 seen. Of the slowest mode exp(−2π²) = 2.7e-9 is left, of which a step takes 1e-3; what \
                  is seen are momenta that alternate from cell to cell and from step to step, which walls damp slowly. With a \
                  slip that answers the pressure the run stops",
    },
    kind: Kind::Verification,
    measure: |backend, n| waves(backend, n),
};

/// The set-up on N cells across, and its exact steady flow.
fn duct(n: f64) -> (Setup, RectangularDuct) {
    let mu = (TAU - 0.5) / 3.0;
    let unit = RectangularDuct { mu, half_width: 0.5 * n, half_height: 0.5 * n, force: 1.0 };
    let exact = RectangularDuct { force: SPEED / unit.velocity(0.0, 0.0), ..unit };
    let cells = n as usize;
    let mut setup = Setup::periodic([LENGTH, cells, cells], Law::Newtonian { mu });
    setup.faces[1] = [Face::NoSlip; 2];
    setup.faces[2] = [Face::NoSlip; 2];
    setup.force = BodyForce::Constant([exact.force, 0.0, 0.0]);
    setup.initial = Some(Arc::new(move |[i, j, k]| {
        let place = |x: usize| x as f64 + 0.5 - 0.5 * n;
        let wave = libm::sin(std::f64::consts::TAU * i as f64 / LENGTH as f64);
        FlowPoint {
            density: 1.0 + 1e-3 * wave,
            velocity: [exact.velocity(place(j), place(k)), 0.0, 0.0],
            gradient: [[0.0; 3]; 3],
        }
    }));
    (setup, exact)
}

/// One rung.
fn waves(backend: &dyn Backend, n: f64) -> Result<Sample, VerifyError> {
    let (setup, exact) = duct(n);
    let mut run = backend.start(&setup)?;
    run.advance((n * n / exact.mu).ceil() as u64)?;
    let before = run.fields().velocity;
    run.advance(1)?;
    let after = run.fields().velocity;
    let change = before.iter().flatten().zip(after.iter().flatten()).map(|(a, b)| (a - b).abs());
    let largest = |a: f64, b: f64| if b > a || b.is_nan() { b } else { a };
    let fastest = after.iter().map(|u| u[0]).fold(0.0, largest);
    let sample = Sample::absolute(n, change.fold(0.0, largest) / SPEED, 0.0);
    Ok(sample.with("largest velocity / exact at the axis", fastest / exact.velocity(0.0, 0.0)))
}
