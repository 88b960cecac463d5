//! Gravity switched on in a closed box: standing sound wave, its damping, and hydrostatic rest
//! (docs/hard-cases.md H11).

use core::f64::consts::PI;
use std::sync::Arc;

use super::support::{Oscillation, central, largest};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::exact::shear_wave::{sound_decay_rate, standing_wave_frequency};
use lahar::collision::CollisionChoice;
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, FlowPoint, Setup};
use lahar::solver::run::{Backend, Run};

/// Force per volume ρ0 g of H11.
const GRAVITY: f64 = 1e-4;

/// Cells of the column, H.
const HEIGHT: usize = 32;

/// Bulk viscosity where the trace relaxes at rate 1.
const TRACE_AT_ONCE: f64 = 1.0 / 9.0;

const CENTRAL: CollisionChoice = central(0.05);

/// Closed box of Newtonian fluid under a force.
fn closed(extents: [usize; 3], tau: f64, collision: CollisionChoice, force: [f64; 3]) -> Setup {
    let mut setup = Setup::periodic(extents, Law::Newtonian { mu: (tau - 0.5) / 3.0 });
    setup.faces = extents.map(|n| if n > 1 { [Face::FreeSlip; 2] } else { [Face::Periodic; 2] });
    setup.collision = collision;
    setup.force = BodyForce::Constant(force);
    setup
}

/// ∫ u_a sin(πx_a/H_a) of the lowest standing wave along an axis.
fn lowest_mode(run: &dyn Run, axis: usize) -> f64 {
    let setup = run.setup();
    let fields = run.fields();
    let height = setup.extents[axis] as f64;
    let part = |(cell, u): (usize, &[f64; 3])| {
        let at = setup.coordinates(cell)[axis] as f64 + 0.5;
        u[axis] * libm::sin(PI * at / height)
    };
    fields.velocity.iter().enumerate().map(part).sum()
}

/// Fits the lowest modes of all axes with a force, from the end of the longest first period on, over
/// `periods` periods.
fn fit(backend: &dyn Backend, setup: &Setup, periods: f64) -> Result<[Option<Oscillation>; 3], VerifyError> {
    let BodyForce::Constant(force) = setup.force else {
        return Err(VerifyError::Numerics { what: "ringing", detail: "needs a constant force".into() });
    };
    let tallest = (0..3).filter(|&a| force[a] != 0.0).map(|a| setup.extents[a]).max().unwrap_or(1);
    let period = 1.0 / standing_wave_frequency(tallest as f64);
    let mut run = backend.start(setup)?;
    run.advance(period as u64)?;
    let mut samples = [const { Vec::new() }; 3];
    for _ in 0..(periods * period) as usize {
        for axis in (0..3).filter(|&a| force[a] != 0.0) {
            samples[axis].push(lowest_mode(run.as_ref(), axis));
        }
        run.advance(1)?;
    }
    Ok(std::array::from_fn(|a| {
        let lag = (0.125 / standing_wave_frequency(setup.extents[a] as f64)) as usize;
        if samples[a].is_empty() { None } else { Oscillation::fit(&samples[a], lag.max(1)) }
    }))
}

fn no_fit() -> VerifyError {
    VerifyError::Numerics { what: "the fit of the standing wave", detail: "no damped oscillation".into() }
}

/// Column: frequency or decay of the wave.
fn column(backend: &dyn Backend, collision: CollisionChoice, tau: f64) -> Result<Oscillation, VerifyError> {
    let setup = closed([1, HEIGHT, 1], tau, collision, [0.0, -GRAVITY, 0.0]);
    fit(backend, &setup, 5.0)?[1].ok_or_else(no_fit)
}

fn frequency(backend: &dyn Backend, collision: CollisionChoice, tau: f64) -> Result<Sample, VerifyError> {
    let wave = column(backend, collision, tau)?;
    Ok(Sample::relative(tau, wave.frequency / (2.0 * PI), standing_wave_frequency(HEIGHT as f64)))
}

fn decay(
    backend: &dyn Backend,
    collision: CollisionChoice,
    bulk: fn(f64) -> f64,
    tau: f64,
) -> Result<Sample, VerifyError> {
    let wave = column(backend, collision, tau)?;
    let nu = (tau - 0.5) / 3.0;
    let k = PI / HEIGHT as f64;
    Ok(Sample::relative(tau, wave.decay, sound_decay_rate(nu, bulk(nu), k))
        .with("decay / nu k2 [-]", wave.decay / (nu * k * k)))
}

/// A cube with a force oblique to its axes: three standing waves at once.
fn cube(backend: &dyn Backend, height: f64) -> Result<Sample, VerifyError> {
    let n = height as usize;
    let setup = closed([n, n, n], 0.8, CollisionChoice::Bgk, [0.5 * GRAVITY, -GRAVITY, 0.25 * GRAVITY]);
    let expected = standing_wave_frequency(height);
    let nu = 0.1;
    let k = PI / height;
    let mut worst = Sample::relative(height, expected, expected);
    for (axis, wave) in ["x", "y", "z"].iter().zip(fit(backend, &setup, 4.0)?) {
        let wave = wave.ok_or_else(no_fit)?;
        let sample = Sample::relative(height, wave.frequency / (2.0 * PI), expected);
        let extra = std::mem::take(&mut worst.extra);
        if sample.error > worst.error {
            worst = sample;
        }
        worst.extra = extra;
        worst = worst.with(&format!("decay along {axis} / nu k2 [-]"), wave.decay / (nu * k * k));
    }
    Ok(worst)
}

/// Largest speed over `steps` steps from hydrostatic equilibrium.
fn hydrostatic(backend: &dyn Backend, collision: CollisionChoice, tau: f64) -> Result<Sample, VerifyError> {
    let mut setup = closed([1, HEIGHT, 1], tau, collision, [0.0, -GRAVITY, 0.0]);
    setup.initial = Some(Arc::new(|[_, j, _]| {
        let depth = 0.5 * HEIGHT as f64 - (j as f64 + 0.5);
        FlowPoint { density: 1.0 + 3.0 * GRAVITY * depth, velocity: [0.0; 3], gradient: [[0.0; 3]; 3] }
    }));
    let mut run = backend.start(&setup)?;
    let mut speed = 0.0_f64;
    for _ in 0..40 {
        speed = largest([speed, largest(run.fields().velocity.iter().map(|u| u[1]))]);
        run.advance(50)?;
    }
    Ok(Sample::absolute(tau, speed, 0.0))
}

const TAUS: Ladder = Ladder { parameter: "tau", short: &[0.6, 0.8, 1.0], full: &[0.55, 0.6, 0.8, 1.0, 1.5] };

/// Id, title, what is measured, reference.
struct Words {
    id: &'static str,
    title: &'static str,
    measures: &'static str,
    source: &'static str,
}

const fn claim(
    Words { id, title, measures, source }: Words,
    metric: Metric,
    ladder: Ladder,
    tolerance: Tolerance,
    measure: fn(&dyn Backend, f64) -> Result<Sample, VerifyError>,
) -> Claim {
    Claim {
        id,
        title,
        tags: &["L3", "L5", "L6", "B2"],
        measures,
        reference: Reference { source, uncertainty: 0.0 },
        metric,
        ladder,
        order: None,
        tolerance,
        kind: Kind::Verification,
        measure,
    }
}

const FREQUENCY: Tolerance = Tolerance {
    value: 1e-2,
    at: Rung::Every,
    basis: Basis::Reference,
    because: "H11. Damping lowers the frequency by (gamma/omega)^2/2, the lattice by (kH/H)^2/24 and \
              the density change g H/c_s^2 = 1e-2 by a fraction of itself",
};
const DECAY: Tolerance = Tolerance {
    value: 5e-2,
    at: Rung::Every,
    basis: Basis::Reference,
    because: "H11. Density changes by 1e-2 over the height, and the wave steepens in proportion to u/c_s = 4e-3",
};

/// BGK frequency.
pub const BGK_FREQUENCY: Claim = claim(
    Words {
        id: "ringing-frequency-bgk",
        title: "Gravity switched on in a closed column rings at c_s/2H (BGK).",
        measures: "frequency of the lowest standing wave after its first period, relative",
        source: "c_s/(2H)",
    },
    Metric::Relative,
    TAUS,
    FREQUENCY,
    |backend, tau| frequency(backend, CollisionChoice::Bgk, tau),
);
/// Central-moment frequency.
pub const CENTRAL_FREQUENCY: Claim = claim(
    Words {
        id: "ringing-frequency-central",
        title: "Gravity switched on in a closed column rings at c_s/2H (central moments).",
        measures: "frequency of the lowest standing wave after its first period, relative",
        source: "c_s/(2H)",
    },
    Metric::Relative,
    TAUS,
    FREQUENCY,
    |backend, tau| frequency(backend, CENTRAL, tau),
);
/// BGK decay.
pub const BGK_DECAY: Claim = claim(
    Words {
        id: "ringing-decay-bgk",
        title: "The ringing decays at nu k^2 (BGK: bulk viscosity 2 nu/3).",
        measures: "decay rate of the lowest standing wave after its first period, relative",
        source: "nu k^2, k = pi/H (Landau & Lifshitz §79 with bulk viscosity 2 nu/3)",
    },
    Metric::Relative,
    TAUS,
    DECAY,
    |backend, tau| decay(backend, CollisionChoice::Bgk, |nu| 2.0 * nu / 3.0, tau),
);
/// Central-moment decay.
pub const CENTRAL_DECAY: Claim = claim(
    Words {
        id: "ringing-decay-central",
        title: "The ringing decays at (2 nu/3 + 1/18) k^2 (central moments: the trace relaxes at rate 1).",
        measures: "decay rate of the lowest standing wave after its first period, relative",
        source: "(4 nu/3 + 1/9) k^2/2, k = pi/H (Landau & Lifshitz §79 with bulk viscosity 1/9)",
    },
    Metric::Relative,
    TAUS,
    DECAY,
    |backend, tau| decay(backend, CENTRAL, |_| TRACE_AT_ONCE, tau),
);
/// Three dimensions.
pub const CUBE: Claim = claim(
    Words {
        id: "ringing-cube",
        title: "A force oblique to a closed cube rings along all three axes at c_s/2H (BGK, free-slip walls).",
        measures: "worst frequency of the three lowest standing waves, relative",
        source: "c_s/(2H)",
    },
    Metric::Relative,
    Ladder { parameter: "H (cells)", short: &[12.0], full: &[12.0, 16.0, 32.0] },
    FREQUENCY,
    cube,
);
/// Rest.
pub const HYDROSTATIC: Claim = claim(
    Words {
        id: "hydrostatic-rest",
        title: "A column that starts in hydrostatic equilibrium under the constant force stays at rest.",
        measures: "largest speed in 2000 steps, lattice units",
        source: "rest: the force does not depend on the density, so a linear pressure balances it exactly",
    },
    Metric::Absolute,
    TAUS,
    Tolerance {
        value: 1e-15,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding of populations of the size of the pressure, 1e-3, over a thousand steps; H11 itself allows 1e-6",
    },
    |backend, tau| hydrostatic(backend, CENTRAL, tau),
);
