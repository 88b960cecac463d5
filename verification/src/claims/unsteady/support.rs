//! What the unsteady claims share: columns, plastic relaxation times, wave fits.

use std::sync::Arc;

use crate::claim::VerifyError;
use crate::exact::ExactError;
use lahar::collision::{CollisionChoice, OddRate};
use lahar::setup::{FlowPoint, InitialFlow};
use lahar::solver::run::Run;

/// A reference that could not be computed, as an error of the claim.
pub fn no_reference(error: ExactError) -> VerifyError {
    VerifyError::Numerics { what: "the reference", detail: error.to_string() }
}

/// u_x of a column along y.
pub fn column(run: &dyn Run) -> Vec<f64> {
    run.fields().velocity.iter().map(|u| u[0]).collect()
}

/// Distance of cell centre j of n from the mid-plane of the channel.
pub fn from_middle(j: usize, n: usize) -> f64 {
    j as f64 + 0.5 - 0.5 * n as f64
}

/// Initial flow u_x(y), gradient du_x/dy, y from the mid-plane of an n-cell channel.
pub fn starting_profile(
    n: usize,
    velocity: impl Fn(f64) -> f64 + Send + Sync + 'static,
    gradient: impl Fn(f64) -> f64 + Send + Sync + 'static,
) -> InitialFlow {
    Arc::new(move |[_, j, _]| {
        let y = from_middle(j, n);
        let mut rates = [[0.0; 3]; 3];
        rates[0][1] = gradient(y);
        FlowPoint { density: 1.0, velocity: [velocity(y), 0.0, 0.0], gradient: rates }
    })
}

/// The default collision with another floor θ.
pub const fn central(floor: f64) -> CollisionChoice {
    CollisionChoice::CentralMoment(OddRate { floor, ..OddRate::STANDARD })
}

/// Largest |x|; NaN if there is one.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |m: f64, x| if x.abs() <= m || m.is_nan() { m } else { x.abs() })
}

/// Angular frequency and decay rate per step of a damped oscillation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillation {
    /// ω, radians per step.
    pub frequency: f64,
    /// γ: the amplitude is e^{−γt}.
    pub decay: f64,
}

impl Oscillation {
    /// Least-squares fit of a(t+m) = c₁ a(t) + c₂ a(t−m), which a = e^{−γt} cos(ωt + φ) obeys with
    /// c₁ = 2 e^{−γm} cos ωm, c₂ = −e^{−2γm} (Prony's method). `lag` m should be near a quarter
    /// period or somewhat less, and must be below half a period.
    pub fn fit(samples: &[f64], lag: usize) -> Option<Self> {
        let (mut aa, mut ab, mut bb, mut ay, mut by) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for window in samples.windows(2 * lag + 1) {
            let (b, a, y) = (window[0], window[lag], window[2 * lag]);
            aa += a * a;
            ab += a * b;
            bb += b * b;
            ay += a * y;
            by += b * y;
        }
        let determinant = aa * bb - ab * ab;
        let first = (ay * bb - by * ab) / determinant;
        let second = (by * aa - ay * ab) / determinant;
        let m = lag as f64;
        let cosine = 0.5 * first / (-second).sqrt();
        let fitted = Self { frequency: libm::acos(cosine) / m, decay: -0.5 * libm::log(-second) / m };
        (fitted.frequency.is_finite() && fitted.decay.is_finite()).then_some(fitted)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_fit_of_a_damped_cosine() {
        let samples: Vec<f64> =
            (0..300).map(f64::from).map(|t| libm::exp(-2e-3 * t) * libm::cos(0.06 * t + 0.4)).collect();
        let fitted = Oscillation::fit(&samples, 20).unwrap();
        // Rounding of the normal equations, whose condition is of order one.
        assert!((fitted.frequency / 0.06 - 1.0).abs() < 1e-12, "{fitted:?}");
        assert!((fitted.decay / 2e-3 - 1.0).abs() < 1e-11, "{fitted:?}");
        assert_eq!(Oscillation::fit(&[0.0; 9], 2), None);
    }

    #[test]
    fn largest_lets_nan_through() {
        assert_eq!(largest([1.0, -3.0, 2.0]), 3.0);
        assert!(largest([1.0, f64::NAN, 2.0]).is_nan());
    }
}
