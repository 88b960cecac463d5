//! Channel under an oscillating force against the exact complex amplitude.

use core::f64::consts::TAU;

use super::support::{central, column, from_middle, starting_profile};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::womersley::WomersleySlit;
use lahar::collision::{CollisionChoice, OddRate};
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Setup};
use lahar::solver::run::Backend;

const TRT: CollisionChoice = CollisionChoice::Trt(OddRate::fixed(3.0 / 16.0));
const CENTRAL: CollisionChoice = central(0.05);

/// Samples per period; ten resolve one harmonic exactly, and divide every period used.
const SAMPLES: u64 = 10;

/// A Womersley number and the period in steps at 16 cells, which makes ν ≈ 0.1, τ ≈ 0.8 on all
/// grids: the period grows as N² (diffusive refinement).
#[derive(Clone, Copy)]
struct Case {
    alpha: f64,
    period_at_16: f64,
}

const SLOW: Case = Case { alpha: 1.0, period_at_16: 4000.0 };
const MEDIUM: Case = Case { alpha: 4.0, period_at_16: 240.0 };
const FAST: Case = Case { alpha: 10.0, period_at_16: 40.0 };

/// Peak speed of the quasi-steady flow at 16 cells, lattice units; Ma² errors fall with N².
const SPEED_AT_16: f64 = 2e-3;

fn measure(
    backend: &dyn Backend,
    collision: CollisionChoice,
    case: Case,
    cells: f64,
) -> Result<Sample, VerifyError> {
    let n = cells as usize;
    let h = 0.5 * cells;
    let period = case.period_at_16 * (cells / 16.0) * (cells / 16.0);
    let frequency = TAU / period;
    let nu = h * h * frequency / (case.alpha * case.alpha);
    let speed = SPEED_AT_16 * 16.0 / cells;
    let scale = (0.5 * h * h / nu).min(1.0 / frequency);
    let exact = WomersleySlit { nu, half_width: h, acceleration: speed / scale, frequency };
    let mut setup = Setup::channel(n, Law::Newtonian { mu: nu }, 0.0);
    setup.collision = collision;
    setup.force = BodyForce::Oscillating {
        mean: [0.0; 3],
        amplitude: [exact.acceleration, 0.0, 0.0],
        frequency,
        phase: 0.0,
    };
    // From the exact flow at t = 0, so that no transient of the size of the flow has to decay.
    let slope = move |y: f64| (exact.velocity(y + 0.25, 0.0) - exact.velocity(y - 0.25, 0.0)) / 0.5;
    setup.initial = Some(starting_profile(n, move |y| exact.velocity(y, 0.0), slope));
    let mut run = backend.start(&setup)?;
    run.advance(period as u64)?;
    let mut amplitude = vec![(0.0, 0.0); n];
    for sample in 0..SAMPLES {
        let angle = TAU * sample as f64 / SAMPLES as f64;
        let (cosine, sine) = (libm::cos(angle), libm::sin(angle));
        for (sum, u) in amplitude.iter_mut().zip(column(run.as_ref())) {
            *sum = (sum.0 + u * cosine * 2.0 / SAMPLES as f64, sum.1 - u * sine * 2.0 / SAMPLES as f64);
        }
        run.advance(period as u64 / SAMPLES)?;
    }
    let reference: Vec<(f64, f64)> = (0..n).map(|j| exact.complex_amplitude(from_middle(j, n))).collect();
    let flat = |pairs: &[(f64, f64)]| pairs.iter().flat_map(|&(re, im)| [re, im]).collect::<Vec<_>>();
    let (re, im) = amplitude[n / 2];
    let y = from_middle(n / 2, n);
    Ok(Sample::l2(cells, &flat(&amplitude), &flat(&reference))
        .with("centre amplitude error [-]", (re * re + im * im).sqrt() / exact.amplitude(y) - 1.0)
        .with("centre phase error [rad]", libm::atan2(im, re) - exact.phase(y))
        .with("tau [-]", 0.5 + 3.0 * nu))
}

const fn claim(
    id: &'static str,
    title: &'static str,
    ladder: Ladder,
    tolerance: Tolerance,
    measure: fn(&dyn Backend, f64) -> Result<Sample, VerifyError>,
) -> Claim {
    Claim {
        id,
        title,
        tags: &["L4", "L5", "K2", "K3", "B1"],
        measures: "complex amplitude of u over the cells (one period, after one), relative L2",
        reference: Reference {
            source: "exact oscillating slit flow (Landau & Lifshitz, Fluid Mechanics, §24)",
            uncertainty: 0.0,
        },
        metric: Metric::L2,
        ladder,
        order: Some(OrderBand { expected: 2.0, band: 0.15, at_least: false }),
        tolerance,
        kind: Kind::Verification,
        measure,
    }
}

const COARSE: Ladder = Ladder {
    parameter: "N (cells across)",
    short: &[8.0, 16.0, 32.0],
    full: &[8.0, 16.0, 32.0, 64.0, 128.0],
};
const MIDDLING: Ladder =
    Ladder { parameter: "N (cells across)", short: &[16.0, 32.0, 64.0], full: &[16.0, 32.0, 64.0, 128.0] };
const FINE: Ladder =
    Ladder { parameter: "N (cells across)", short: &[32.0, 64.0, 128.0], full: &[32.0, 64.0, 128.0, 256.0] };

const fn within(value: f64, because: &'static str) -> Tolerance {
    Tolerance { value, at: Rung::Last, basis: Basis::AfterSeeing, because }
}

/// α = 1, TRT.
pub const ALPHA_1_TRT: Claim = claim(
    "womersley-alpha-1-trt",
    "Oscillating channel flow at alpha = 1 (TRT, magic 3/16) converges at second order.",
    COARSE,
    within(5e-5, "0.05/N^2 at N = 32: 1.2 times the scheme constant 0.042 seen on 8 and 16 cells"),
    |backend, n| measure(backend, TRT, SLOW, n),
);
/// α = 4, TRT.
pub const ALPHA_4_TRT: Claim = claim(
    "womersley-alpha-4-trt",
    "Oscillating channel flow at alpha = 4 (TRT, magic 3/16) converges at second order.",
    MIDDLING,
    within(4e-5, "0.16/N^2 at N = 64: 1.2 times the scheme constant 0.14 seen on 16 cells"),
    |backend, n| measure(backend, TRT, MEDIUM, n),
);
/// α = 10, TRT.
pub const ALPHA_10_TRT: Claim = claim(
    "womersley-alpha-10-trt",
    "Oscillating channel flow at alpha = 10 (TRT, magic 3/16) converges at second order.",
    FINE,
    within(
        5e-5,
        "0.8/N^2 at N = 128: 1.1 times the scheme constant 0.72 seen on 32 cells, where the wall layer is 2.3 cells thick",
    ),
    |backend, n| measure(backend, TRT, FAST, n),
);
/// α = 1, central moment.
pub const ALPHA_1_CENTRAL: Claim = claim(
    "womersley-alpha-1-central",
    "Oscillating channel flow at alpha = 1 (central moments) converges at second order.",
    COARSE,
    within(5e-5, "0.05/N^2 at N = 32: 1.2 times the scheme constant 0.042 seen on 8 and 16 cells"),
    |backend, n| measure(backend, CENTRAL, SLOW, n),
);
/// α = 4, central moment.
pub const ALPHA_4_CENTRAL: Claim = claim(
    "womersley-alpha-4-central",
    "Oscillating channel flow at alpha = 4 (central moments) converges at second order.",
    MIDDLING,
    within(4e-5, "0.16/N^2 at N = 64: 1.2 times the scheme constant 0.14 seen on 16 cells"),
    |backend, n| measure(backend, CENTRAL, MEDIUM, n),
);
/// α = 10, central moment.
pub const ALPHA_10_CENTRAL: Claim = claim(
    "womersley-alpha-10-central",
    "Oscillating channel flow at alpha = 10 (central moments) converges at second order.",
    FINE,
    within(
        5e-5,
        "0.8/N^2 at N = 128: 1.1 times the scheme constant 0.72 seen on 32 cells, where the wall layer is 2.3 cells thick",
    ),
    |backend, n| measure(backend, CENTRAL, FAST, n),
);
