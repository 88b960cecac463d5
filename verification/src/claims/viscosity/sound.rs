//! Sound: speed and damping of standing waves of small amplitude.

use std::sync::Arc;

use super::waves::{AMPLITUDE, skip};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::discrete_modes::{Relaxation, sound};
use crate::exact::shear_wave::{sound_decay_rate, sound_speed};
use lahar::collision::{CollisionChoice, OddRate};
use lahar::rheology::Law;
use lahar::setup::{FlowPoint, Setup};
use lahar::solver::run::{Backend, Run};

/// Speed and decay rate of a standing wave of length `n` along z.
///
/// After the kinetic modes have died the cosine part of the density is c λᵗ + its conjugate, so values
/// s steps apart obey a(t+2s) = p a(t+s) − r a(t) with r = |λ|²ˢ and p = 2 |λ|ˢ cos(ωs). Six values an
/// eighth of a period apart give four equations for p and r, far from parallel.
fn speed_and_decay(
    backend: &dyn Backend,
    collision: CollisionChoice,
    relaxation: Relaxation,
    n: usize,
) -> Result<(f64, f64), VerifyError> {
    let k = core::f64::consts::TAU / n as f64;
    let mut setup = Setup::periodic([1, 1, n], Law::Newtonian { mu: relaxation.viscosity() });
    setup.collision = collision;
    setup.initial = Some(Arc::new(move |[_, _, z]| FlowPoint {
        density: 1.0 + AMPLITUDE * libm::cos(k * (z as f64 + 0.5)),
        velocity: [0.0; 3],
        gradient: [[0.0; 3]; 3],
    }));
    let mut run = backend.start(&setup)?;
    let amplitude = |run: &dyn Run| -> f64 {
        let density = run.fields().density;
        density.iter().enumerate().map(|(z, rho)| (rho - 1.0) * libm::cos(k * (z as f64 + 0.5))).sum()
    };
    let period = core::f64::consts::TAU / (k * sound_speed());
    let stride = (period / 8.0).round().max(1.0) as u64;
    run.advance(skip(relaxation, relaxation.viscosity() * k * k))?;
    let mut a = [0.0; 6];
    for (index, value) in a.iter_mut().enumerate() {
        if index > 0 {
            run.advance(stride)?;
        }
        *value = amplitude(&*run);
    }
    let (p, r) = least_squares(&a)?;
    let size = 0.5 * libm::log(r);
    let angle = libm::acos(0.5 * p / r.sqrt());
    Ok((angle / (stride as f64 * k), -size / stride as f64))
}

/// p and r of a(t+2) = p a(t+1) − r a(t) over all triples.
fn least_squares(a: &[f64]) -> Result<(f64, f64), VerifyError> {
    let (mut m11, mut m12, mut m22, mut b1, mut b2) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for triple in a.windows(3) {
        let (x, y, z) = (triple[1], -triple[0], triple[2]);
        m11 += x * x;
        m12 += x * y;
        m22 += y * y;
        b1 += x * z;
        b2 += y * z;
    }
    let determinant = m11 * m22 - m12 * m12;
    if determinant.abs() <= 1e-6 * m11 * m22 {
        return Err(VerifyError::Numerics { what: "the fit of a standing wave", detail: format!("{a:?}") });
    }
    Ok(((b1 * m22 - b2 * m12) / determinant, (m11 * b2 - m12 * b1) / determinant))
}

const DAMPING_N: usize = 256;

fn measure_damping(backend: &dyn Backend, tau: f64) -> Result<Sample, VerifyError> {
    let trt = CollisionChoice::Trt(OddRate::fixed(3.0 / 16.0));
    let k = core::f64::consts::TAU / DAMPING_N as f64;
    let mut worst: Option<Sample> = None;
    for (collision, relaxation) in
        [(CollisionChoice::Bgk, Relaxation::bgk(tau)), (trt, Relaxation::trt(tau, 3.0 / 16.0))]
    {
        let (speed, decay) = speed_and_decay(backend, collision, relaxation, DAMPING_N)?;
        let (exact_speed, exact_ratio) = sound(relaxation, DAMPING_N as f64)?;
        let ratio = decay / (relaxation.viscosity() * k * k);
        let by_decay = Sample::relative(tau, ratio, exact_ratio);
        let by_speed = Sample::relative(tau, speed, exact_speed);
        let here = if by_speed.error <= by_decay.error { by_decay } else { by_speed };
        let better = worst.as_ref().is_some_and(|w| here.error <= w.error);
        worst = if better {
            worst
        } else {
            Some(here.with("decay/(nu k^2) [-]", ratio).with("c/c_s [-]", speed / sound_speed()))
        };
    }
    worst.ok_or(VerifyError::Numerics { what: "sound", detail: String::new() })
}

/// BGK and TRT: the exact discrete values.
pub const DAMPING: Claim = Claim {
    id: "sound-wave-damping",
    title: "Sound travels and decays as the linearised BGK and TRT schemes say: c_s and νk²",
    tags: &["K1", "K2", "L6"],
    measures: "phase speed and decay rate of a standing wave, 256 cells long, the worse of the two and of the two operators",
    reference: Reference {
        source: "verify::exact::discrete_modes::sound; at τ = 0.8 it equals the reference value 1.0000180718 for decay/(νk²)",
        uncertainty: 1e-9,
    },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "tau (relaxation time)",
        short: &[0.55, 0.8, 1.8],
        full: &[0.55, 0.6, 0.8, 1.0, 1.8],
    },
    order: None,
    tolerance: Tolerance {
        value: 1e-7,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "eigenvalues good to 1e-9; rounding 1e-14 of the amplitude over a decay of 1e-5 per step in 55 steps",
    },
    kind: Kind::Verification,
    measure: measure_damping,
};

fn measure_unit_trace(backend: &dyn Backend, n: f64) -> Result<Sample, VerifyError> {
    let odd = OddRate::default();
    let tau = 0.8;
    let relaxation = Relaxation { even: tau, odd: 1.0 / odd.odd_omega(1.0 / tau, 0.0) };
    let k = core::f64::consts::TAU / n;
    let predicted = sound_decay_rate(relaxation.viscosity(), 1.0 / 9.0, k);
    let (_, central) = speed_and_decay(backend, CollisionChoice::CentralMoment(odd), relaxation, n as usize)?;
    let (_, regular) = speed_and_decay(
        backend,
        CollisionChoice::Regularised,
        Relaxation { odd: 1.0, ..relaxation },
        n as usize,
    )?;
    let (a, b) = (Sample::relative(n, central, predicted), Sample::relative(n, regular, predicted));
    Ok(if a.error <= b.error { b } else { a }
        .with("central moment / predicted [-]", central / predicted)
        .with("regularised / predicted [-]", regular / predicted))
}

/// Central-moment and regularised operators: the bulk viscosity of a trace relaxed at rate 1.
pub const UNIT_TRACE: Claim = Claim {
    id: "sound-wave-damping-unit-trace",
    title: "Operators that relax the trace at rate 1 damp sound with the bulk viscosity 1/9",
    tags: &["K3", "K4"],
    measures: "decay rate of a standing wave at τ = 0.8, the worse of the two operators",
    reference: Reference {
        source: "½ (4ν/3 + ν_b) k² with ν_b = (2/3)(1 − ½)/3 = 1/9 (Dellar 2001)",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "N (cells per wave)",
        short: &[32.0, 64.0, 128.0],
        full: &[32.0, 64.0, 128.0, 256.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.1, at_least: false }),
    tolerance: Tolerance {
        value: 1.0e-2,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "error of the scheme: at most k²/4 at the coarsest wave, k = 2π/32",
    },
    kind: Kind::Verification,
    measure: measure_unit_trace,
};

fn measure_speed(backend: &dyn Backend, n: f64) -> Result<Sample, VerifyError> {
    let odd = OddRate::default();
    let tau = 0.8;
    let tau_odd = 1.0 / odd.odd_omega(1.0 / tau, 0.0);
    let mut worst: Option<Sample> = None;
    for (collision, odd_time) in [
        (CollisionChoice::Bgk, tau),
        (CollisionChoice::Trt(odd), tau_odd),
        (CollisionChoice::CentralMoment(odd), tau_odd),
        (CollisionChoice::Regularised, 1.0),
    ] {
        let relaxation = Relaxation { even: tau, odd: odd_time };
        let (speed, _) = speed_and_decay(backend, collision, relaxation, n as usize)?;
        let here = Sample::relative(n, speed, sound_speed());
        let better = worst.as_ref().is_some_and(|w| here.error <= w.error);
        worst = if better { worst } else { Some(here) };
    }
    worst.ok_or(VerifyError::Numerics { what: "sound", detail: String::new() })
}

/// c_s.
pub const SPEED: Claim = Claim {
    id: "sound-wave-speed",
    title: "The speed of sound converges to 1/√3 with order 2, all operators",
    tags: &["L1", "L3"],
    measures: "phase speed of a standing wave at τ = 0.8, the worst of the four operators",
    reference: Reference { source: "c_s = 1/√3", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "N (cells per wave)",
        short: &[32.0, 64.0, 128.0],
        full: &[32.0, 64.0, 128.0, 256.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.1, at_least: false }),
    tolerance: Tolerance {
        value: 4e-3,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "error of the scheme: at most k²/10 at the coarsest wave, k = 2π/32",
    },
    kind: Kind::Verification,
    measure: measure_speed,
};
