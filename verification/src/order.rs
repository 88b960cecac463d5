//! Observed order of convergence: error ∝ parameter^(−order).

use faer::Mat;
use faer::linalg::solvers::SolveLstsq;
use serde::{Deserialize, Serialize};

use lahar::output::number;

/// A fitted order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FittedOrder {
    /// Slope of the least-squares line through (ln parameter, −ln error).
    #[serde(with = "number")]
    pub order: f64,
    /// Standard error of the slope; none with two rungs.
    #[serde(default, with = "number::option", skip_serializing_if = "Option::is_none")]
    pub standard_error: Option<f64>,
    /// Slopes between neighbouring rungs, in ladder order.
    #[serde(with = "number::list")]
    pub pairwise: Vec<f64>,
}

/// Richardson extrapolation of one number, with the grid convergence index.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Richardson {
    /// Extrapolated value.
    #[serde(with = "number")]
    pub value: f64,
    /// Roache's index of the finest rung, 1.25 |f₁ − f₂| / (|f₁| (r^p − 1)): relative error estimate.
    #[serde(with = "number")]
    pub grid_convergence_index: f64,
}

/// Why there is no observed order.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum FitError {
    /// A line needs two points.
    #[error("{0} rungs are too few to fit an order")]
    TooFew(usize),
    /// A logarithm needs a positive number.
    #[error("rung {parameter}: an error of {error:e} has no logarithm")]
    NoLogarithm { parameter: f64, error: f64 },
    /// All rungs at the same place.
    #[error("the rungs do not differ")]
    Degenerate,
}

/// Least-squares fit of ln error = a − p ln parameter.
///
/// # Arguments
/// `points`: (parameter, error), both positive and finite, at least two different parameters.
///
/// # Errors
/// [`FitError`] when that is not so.
///
/// # Exactness
/// Solved by faer, whose kernels depend on the processor: equal to about 1e-14 between machines,
/// not bit for bit.
pub fn fit(points: &[(f64, f64)]) -> Result<FittedOrder, FitError> {
    if points.len() < 2 {
        return Err(FitError::TooFew(points.len()));
    }
    let positive = |x: f64| x > 0.0 && x.is_finite();
    if let Some(&(parameter, error)) = points.iter().find(|(h, e)| !positive(*h) || !positive(*e)) {
        return Err(FitError::NoLogarithm { parameter, error });
    }
    let logs: Vec<(f64, f64)> = points.iter().map(|(h, e)| (libm::log(*h), libm::log(*e))).collect();
    let mean = logs.iter().map(|l| l.0).sum::<f64>() / logs.len() as f64;
    let spread = logs.iter().map(|l| (l.0 - mean) * (l.0 - mean)).sum::<f64>();
    if spread <= 0.0 {
        return Err(FitError::Degenerate);
    }
    // Centred abscissae make the two columns orthogonal: the slope's variance is s²/spread.
    let a = Mat::from_fn(logs.len(), 2, |i, j| if j == 0 { 1.0 } else { logs[i].0 - mean });
    let b = Mat::from_fn(logs.len(), 1, |i, _| logs[i].1);
    let line = a.qr().solve_lstsq(&b);
    let (level, slope) = (line[(0, 0)], line[(1, 0)]);
    let residual = |l: &(f64, f64)| l.1 - level - slope * (l.0 - mean);
    let squares = logs.iter().map(|l| residual(l) * residual(l)).sum::<f64>();
    let freedom = logs.len() - 2;
    let standard_error = (freedom > 0).then(|| (squares / freedom as f64 / spread).sqrt());
    let pairwise = logs.windows(2).map(|w| (w[0].1 - w[1].1) / (w[1].0 - w[0].0)).collect();
    Ok(FittedOrder { order: -slope, standard_error, pairwise })
}

/// Richardson extrapolation from the last two of at least three rungs with a constant ratio.
///
/// # Arguments
/// `points`: (parameter, computed) with growing parameter; `order` > 0.
///
/// # Returns
/// `None` when the ladder has no constant ratio or the order is not positive.
#[must_use]
pub fn richardson(points: &[(f64, f64)], order: f64) -> Option<Richardson> {
    let [(n0, _), (n1, coarse), (n2, fine)] = *points.last_chunk::<3>()?;
    let ratio = n2 / n1;
    let constant = (ratio - n1 / n0).abs() <= 1e-9 * ratio;
    if !(constant && ratio > 1.0 && order > 0.0) {
        return None;
    }
    let gain = libm::pow(ratio, order) - 1.0;
    let value = fine + (fine - coarse) / gain;
    let grid_convergence_index = 1.25 * (fine - coarse).abs() / (fine.abs() * gain);
    Some(Richardson { value, grid_convergence_index })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const LADDER: [f64; 4] = [16.0, 32.0, 64.0, 128.0];

    proptest! {
        #[test]
        fn exact_power_law_is_recovered(p in 0.1_f64..6.0, c in 1e-6_f64..1e6) {
            let points = LADDER.map(|n| (n, c * libm::pow(n, -p)));
            let fitted = fit(&points).unwrap();
            // Logarithms of magnitude < 50 carry 50 ulp ~ 6e-15 over a span of ln 8.
            prop_assert!((fitted.order - p).abs() < 1e-13);
            prop_assert!(fitted.standard_error.unwrap() < 1e-13);
            prop_assert!(fitted.pairwise.iter().all(|q| (q - p).abs() < 1e-13));
        }
    }

    #[test]
    fn exact_standard_error_of_a_textbook_line() {
        // x = 0, 1, 2, y = 0, 1, 1 (natural logarithms): slope ½, residuals −1/6, 1/3, −1/6, so
        // s² = 1/6 with one degree of freedom and Σ(x − x̄)² = 2: s.e. = √(1/12).
        let e = libm::exp(1.0);
        let fitted = fit(&[(1.0, 1.0), (e, e), (e * e, e)]).unwrap();
        assert!((fitted.order + 0.5).abs() < 1e-14);
        assert!((fitted.standard_error.unwrap() - (1.0_f64 / 12.0).sqrt()).abs() < 1e-14);
    }

    #[test]
    fn unusable_points_are_refused() {
        assert_eq!(fit(&[(1.0, 1.0)]), Err(FitError::TooFew(1)));
        assert!(matches!(fit(&[(1.0, 1.0), (2.0, 0.0)]), Err(FitError::NoLogarithm { .. })));
        assert!(matches!(fit(&[(1.0, f64::NAN), (2.0, 1.0)]), Err(FitError::NoLogarithm { .. })));
        assert_eq!(fit(&[(2.0, 1.0), (2.0, 3.0)]), Err(FitError::Degenerate));
    }

    #[test]
    fn exact_richardson_of_a_quadratic_error() {
        let points = LADDER.map(|n| (n, 3.0 + 5.0 / (n * n)));
        let r = richardson(&points, 2.0).unwrap();
        assert!((r.value - 3.0).abs() < 1e-14);
        let true_error = 5.0 / (128.0 * 128.0) / points[3].1;
        assert!((r.grid_convergence_index / true_error - 1.25).abs() < 1e-9);
        assert!(richardson(&[(1.0, 1.0), (2.0, 1.0), (5.0, 1.0)], 2.0).is_none());
    }
}
