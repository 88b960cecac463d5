//! A wall that oscillates in its plane: Stokes' second problem in a gap.

use core::f64::consts::TAU;

use super::support::{column, from_middle, starting_profile};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::oscillating_wall::OscillatingWall;
use lahar::collision::{CollisionChoice, OddRate};
use lahar::rheology::Law;
use lahar::setup::{Course, Face, Setup};
use lahar::solver::run::Backend;

/// Samples per period; ten resolve one harmonic exactly.
const SAMPLES: u64 = 10;
/// Period at 16 cells; it grows as N², so that ν stays the same on all grids.
const PERIOD_AT_16: f64 = 400.0;
/// kH: the wave has fallen to 5 % at the other wall, and is more than a fifth of a turn behind.
const DEPTH: f64 = 3.0;
/// Wall speed at 16 cells; Ma² errors fall with N².
const SPEED_AT_16: f64 = 0.01;

fn measure(backend: &dyn Backend, cells: f64) -> Result<Sample, VerifyError> {
    let n = cells as usize;
    let period = PERIOD_AT_16 * (cells / 16.0) * (cells / 16.0);
    let frequency = TAU / period;
    let nu = 0.5 * frequency * (cells / DEPTH) * (cells / DEPTH);
    let exact = OscillatingWall { nu, gap: cells, speed: SPEED_AT_16 * 16.0 / cells, frequency };
    let mut setup = Setup::channel(n, Law::Newtonian { mu: nu }, 0.0);
    setup.collision = CollisionChoice::Trt(OddRate::fixed(3.0 / 16.0));
    setup.faces[1][0] = Face::Moving([exact.speed, 0.0, 0.0]);
    setup.courses.faces[1][0] = Course::Oscillating { mean: 0.0, amplitude: 1.0, frequency, phase: 0.0 };
    let height = move |y: f64| y + 0.5 * cells;
    // From the exact flow at t = 0, so that no transient of the size of the flow has to decay.
    let slope =
        move |y: f64| (exact.velocity(height(y) + 0.25, 0.0) - exact.velocity(height(y) - 0.25, 0.0)) / 0.5;
    setup.initial = Some(starting_profile(n, move |y| exact.velocity(height(y), 0.0), slope));
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
    let reference: Vec<(f64, f64)> =
        (0..n).map(|j| exact.complex_amplitude(height(from_middle(j, n)))).collect();
    let flat = |pairs: &[(f64, f64)]| pairs.iter().flat_map(|&(re, im)| [re, im]).collect::<Vec<_>>();
    Ok(Sample::l2(cells, &flat(&amplitude), &flat(&reference)).with("tau [-]", 0.5 + 3.0 * nu))
}

/// Stokes' second problem.
pub const WALL: Claim = Claim {
    id: "oscillating-wall",
    title: "Beside a wall that oscillates the fluid moves as in Stokes' second problem, to second order",
    tags: &["B1", "K2"],
    measures: "complex amplitude of u over the cells (one period, after one), relative L2; wall U cos ωt, the other at \
               rest at H = 3 √(2ν/ω)",
    reference: Reference {
        source: "sinh(λ(H − y))/sinh(λH), λ = √(iω/ν); Stokes 1851 for H → ∞",
        uncertainty: 0.0,
    },
    metric: Metric::L2,
    ladder: Ladder {
        parameter: "N (cells across)",
        short: &[16.0, 32.0, 64.0],
        full: &[16.0, 32.0, 64.0, 128.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.15, at_least: false }),
    tolerance: Tolerance {
        value: 2e-3,
        at: Rung::Last,
        basis: Basis::Derived,
        because: "the scheme's error in a wave of wave number k is (kΔx)² times a constant of order one half: k = 3/64 \
                  makes it 1.1e-3, and a wall that moves half a step early or late would add ωΔt/2 = 5e-4",
    },
    kind: Kind::Verification,
    measure,
};
