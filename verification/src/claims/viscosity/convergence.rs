//! Order of convergence of the viscosity, and its dependence on a mean flow.

use super::waves::Wave;
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::discrete_modes::{Relaxation, Shear, shear_viscosity_ratio};
use crate::exact::shear_wave::galilean_viscosity_ratio;
use crate::reference_values::{Input, find};
use lahar::collision::{CollisionChoice, OddRate};
use lahar::solver::run::Backend;

/// τ of all runs here.
const TAU: f64 = 0.8;

/// The operators by name, with the relaxation times they take at an even one.
pub fn schemes(tau: f64) -> [(&'static str, CollisionChoice, Relaxation); 4] {
    let odd = OddRate::default();
    let relaxation = Relaxation { even: tau, odd: 1.0 / odd.odd_omega(1.0 / tau, 0.0) };
    [
        ("BGK", CollisionChoice::Bgk, Relaxation::bgk(tau)),
        ("TRT", CollisionChoice::Trt(odd), relaxation),
        ("central moment", CollisionChoice::CentralMoment(odd), relaxation),
        ("regularised", CollisionChoice::Regularised, Relaxation { odd: 1.0, ..relaxation }),
    ]
}

/// |ν_eff/ν − 1|, the worse of a wave along an axis and one along (1,1,0).
fn measure_order(backend: &dyn Backend, n: f64, which: usize) -> Result<Sample, VerifyError> {
    let (_, collision, relaxation) = schemes(TAU)[which];
    let axis = Wave::axis(n as usize).viscosity_ratio(backend, collision, relaxation)?;
    let along =
        Wave::diagonal(n as usize, [0.0, 0.0, 1.0]).viscosity_ratio(backend, collision, relaxation)?;
    let (a, b) = (Sample::relative(n, axis, 1.0), Sample::relative(n, along, 1.0));
    Ok(if a.error <= b.error { b } else { a }.with("axis [-]", axis).with("diagonal [-]", along))
}

const fn order_claim(
    id: &'static str,
    title: &'static str,
    tags: &'static [&'static str],
    measure: fn(&dyn Backend, f64) -> Result<Sample, VerifyError>,
) -> Claim {
    Claim {
        id,
        title,
        tags,
        measures: "ν_eff/ν − 1 at τ = 0.8, the worse of a wave along an axis and one along (1,1,0)",
        reference: Reference { source: "ν = (τ − ½)/3 (004 Eq 3.69)", uncertainty: 0.0 },
        metric: Metric::Relative,
        ladder: Ladder {
            parameter: "N (cells per wave and axis)",
            short: &[16.0, 32.0, 64.0],
            full: &[16.0, 32.0, 64.0, 128.0],
        },
        order: Some(OrderBand { expected: 2.0, band: 0.1, at_least: false }),
        tolerance: Tolerance {
            value: 0.039,
            at: Rung::Every,
            basis: Basis::Derived,
            because: "error of the scheme: at most k²/4 per axis at the coarsest wave, k = 2π/16",
        },
        kind: Kind::Verification,
        measure,
    }
}

/// BGK.
pub const ORDER_BGK: Claim = order_claim(
    "shear-wave-order-bgk",
    "The viscosity of BGK converges with order 2",
    &["K1", "L6"],
    |backend, n| measure_order(backend, n, 0),
);
/// TRT.
pub const ORDER_TRT: Claim = order_claim(
    "shear-wave-order-trt",
    "The viscosity of TRT converges with order 2",
    &["K2", "L6"],
    |backend, n| measure_order(backend, n, 1),
);
/// Central moment.
pub const ORDER_CENTRAL: Claim = order_claim(
    "shear-wave-order-central-moment",
    "The viscosity of the central-moment operator converges with order 2",
    &["K3", "L6"],
    |backend, n| measure_order(backend, n, 2),
);
/// Regularised.
pub const ORDER_REGULARISED: Claim = order_claim(
    "shear-wave-order-regularised",
    "The viscosity of the recursive-regularised operator converges with order 2",
    &["K4", "L6"],
    |backend, n| measure_order(backend, n, 3),
);

/// Wave along y in a mean flow along y.
pub fn along(n: usize, speed: f64) -> Wave {
    Wave { mean: [0.0, speed, 0.0], ..Wave::axis(n) }
}

/// Wave along y in a mean flow along x, velocity along x.
fn across(n: usize, speed: f64) -> Wave {
    Wave { mean: [speed, 0.0, 0.0], ..Wave::axis(n) }
}

const LONG: usize = 256;

fn measure_defect(backend: &dyn Backend, speed: f64) -> Result<Sample, VerifyError> {
    let relaxation = Relaxation::bgk(TAU);
    let ratio = along(LONG, speed).viscosity_ratio(backend, CollisionChoice::Bgk, relaxation)?;
    let inputs =
        [("U", Input::Number(speed)), ("tau", Input::Number(TAU)), ("wavelength", Input::Number(256.0))];
    let reference = match find("galilean_shear_nu_ratio_k_par_U", &inputs) {
        Ok(entry) => entry.number()?,
        Err(_) => shear_viscosity_ratio(Shear::Axis, relaxation, LONG as f64, speed)?,
    };
    Ok(Sample::relative(speed, ratio, reference).with("1 - 3U^2 [-]", galilean_viscosity_ratio(speed)))
}

/// 1 − 3U².
pub const DEFECT: Claim = Claim {
    id: "galilean-defect-bgk",
    title: "A mean flow U along the wave lowers the viscosity of BGK to ν(1 − 3U²)",
    tags: &["L2", "L3", "K1"],
    measures: "ν_eff/ν of a shear wave 256 cells long, τ = 0.8, in a mean flow along its wave vector",
    reference: Reference {
        source: "reference values galilean_shear_nu_ratio_k_par_U (0.1, 0.173), else the linearised scheme; 1 − 3U² up to k² (Qian & Orszag 1993)",
        uncertainty: 1e-8,
    },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "U (mean flow)",
        short: &[0.0, 0.05, 0.1, 0.173],
        full: &[0.0, 0.02, 0.05, 0.1, 0.15, 0.173],
    },
    order: None,
    tolerance: Tolerance {
        value: 1e-7,
        at: Rung::Every,
        basis: Basis::Reference,
        because: "the reference values state eight digits",
    },
    kind: Kind::PredictedFailure,
    measure: measure_defect,
};

fn measure_across(backend: &dyn Backend, speed: f64) -> Result<Sample, VerifyError> {
    let mut worst = Sample::relative(speed, 1.0, 1.0);
    for (name, collision, relaxation) in schemes(TAU) {
        let ratio = across(LONG, speed).viscosity_ratio(backend, collision, relaxation)?;
        let here = Sample::relative(speed, ratio, 1.0);
        let extra = worst.extra.clone();
        worst = if here.error <= worst.error { worst } else { here };
        worst.extra = extra;
        worst = worst.with(&format!("{name} [-]"), ratio);
    }
    Ok(worst)
}

/// No defect across the mean flow.
pub const ACROSS: Claim = Claim {
    id: "galilean-across",
    title: "A mean flow across the wave leaves the viscosity alone, all operators",
    tags: &["L3", "K1", "K2", "K3", "K4"],
    measures: "ν_eff/ν of a shear wave 256 cells long, τ = 0.8, in a mean flow across its wave vector, worst operator",
    reference: Reference { source: "1 (HARD_CASES H10)", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "U (mean flow)",
        short: &[0.05, 0.1, 0.173],
        full: &[0.02, 0.05, 0.1, 0.15, 0.173],
    },
    order: None,
    tolerance: Tolerance {
        value: 1.5e-4,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "error of the scheme: k²/4 with k = 2π/256, as for a wave at rest",
    },
    kind: Kind::Verification,
    measure: measure_across,
};

/// Mean flow of the central-moment claim.
const SPEED: f64 = 0.1;

fn measure_central(backend: &dyn Backend, n: f64) -> Result<Sample, VerifyError> {
    let (_, collision, relaxation) = schemes(TAU)[2];
    let ratio = along(n as usize, SPEED).viscosity_ratio(backend, collision, relaxation)?;
    let at_rest = Wave::axis(n as usize).viscosity_ratio(backend, collision, relaxation)?;
    Ok(Sample::relative(n, ratio, 1.0)
        .with("at rest [-]", at_rest)
        .with("1 - 3U^2 [-]", galilean_viscosity_ratio(SPEED)))
}

/// The third moments of \[K3\] remove the defect.
pub const CENTRAL: Claim = Claim {
    id: "central-moment-galilean-order",
    title: "The central-moment operator has no Galilean defect in shear: ν_eff/ν converges to 1 in a mean flow along the wave",
    tags: &["K3"],
    measures: "ν_eff/ν − 1 of a shear wave at τ = 0.8 in a mean flow 0.1 along its wave vector (BGK would stay at −0.03)",
    reference: Reference { source: "Galilean invariance: 1", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "N (cells per wave)",
        short: &[32.0, 64.0, 128.0],
        full: &[32.0, 64.0, 128.0, 256.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.1, at_least: false }),
    tolerance: Tolerance {
        value: 0.01,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "error of the scheme: at most k²/4 at the coarsest wave, k = 2π/32",
    },
    kind: Kind::Verification,
    measure: measure_central,
};
