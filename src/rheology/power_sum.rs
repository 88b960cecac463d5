//! The root g of K gⁿ + a g = s: one table look-up and one step of third order.
//!
//! With g = (s/a) eʸ and c = ln s − n ln(s/a) − ln K the equation is eⁿʸ⁻ᶜ + eʸ = 1: for a given n, y
//! is a function Y of the single number d = c/n, increasing and concave, between min(d, 0) − ln 2/min(n, 1)
//! and min(d, 0). It is tabulated once; a step of third order (Newton's with the curvature of the sum)
//! turns an error δ of the table into one of the size of δ³.

use std::fmt;
use std::sync::Arc;

use crate::lane::powers::{self, ln_of_positive, nearest};
use crate::lane::{Lane, OfTwo};

/// The table ends where Y differs from its asymptotes by e⁻¹² = 6e-6.
const REACH: f64 = 12.0;

/// Interval for n = 1. There |Y⁗| ≤ 1/8, so cubic Hermite interpolation is off by at most
/// h⁴/384 · 1/8 = 1.3e-6. For n > 1 the scale of d shrinks by n, for n < 1 the steep end keeps it.
const FINE: f64 = 0.25;

/// For n < 1 and d beyond a few units Y follows −ln(1 + 1/(n d)) …: |Y⁗| ≤ 6/d⁴. Intervals of an
/// eighth of d are then off by at most 6/(8⁴ · 384) = 4e-6.
const COARSE_SHARE: f64 = 0.125;

/// Least s: its logarithm and that of s/a are those of normal numbers.
const LEAST: f64 = 1e-290;

/// Rounds after which Newton's method has converged from min(d, 0): quadratic, from within
/// ln 2/min(n, 1) of the root of a convex function.
const MAX_ROUNDS: usize = 60;

/// Solves K gⁿ + a g = s for given K and n.
#[derive(Clone, PartialEq)]
pub struct PowerSum {
    n: f64,
    ln_k: f64,
    inverse_n: f64,
    /// First d of the table.
    start: f64,
    /// d from which the intervals are long.
    knee: f64,
    /// Intervals per unit of d below and above the knee.
    density: [f64; 2],
    /// Number of intervals below the knee.
    fine: f64,
    /// Coefficients of the cubic in the position 0…1 within the interval; the last row is zero, the
    /// asymptote.
    rows: Arc<[[f64; 4]]>,
}

impl fmt::Debug for PowerSum {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("PowerSum")
            .field("n", &self.n)
            .field("ln_k", &self.ln_k)
            .field("rows", &self.rows.len())
            .finish_non_exhaustive()
    }
}

impl PowerSum {
    /// For a consistency K > 0 and a flow index n > 0.
    ///
    /// The table has about (48 + 17/√n) rows of 32 bytes for n ≤ 1 and (48 n + 48) above: 4 kB at
    /// n = 0.33, 8 kB at n = 0.05, 6 kB at n = 3.
    #[must_use]
    pub fn new(k: f64, n: f64) -> Self {
        let step = FINE * (1.0 / n).min(1.0);
        let (start, end) = (libm::log(n).min(0.0) - REACH, REACH / n);
        let knee = if n < 1.0 { (REACH / n).sqrt() } else { end };
        let stride = COARSE_SHARE * knee;
        let fine = ((knee - start) / step).ceil();
        let knee = start + fine * step;
        let coarse = ((end - knee) / stride).ceil().max(0.0);
        let below = (0..=fine as usize).map(|i| start + i as f64 * step);
        let above = (1..=coarse as usize).map(|i| knee + i as f64 * stride);
        let nodes: Vec<(f64, [f64; 2])> = below.chain(above).map(|d| (d, value_and_slope(n, d))).collect();
        let cubics = nodes.windows(2).map(|ends| {
            let ((from, [y0, m0]), (to, [y1, m1])) = (ends[0], ends[1]);
            let (m0, m1, rise) = ((to - from) * m0, (to - from) * m1, y1 - y0);
            [y0, m0, 3.0 * rise - 2.0 * m0 - m1, m0 + m1 - 2.0 * rise]
        });
        let rows = cubics.chain([[0.0; 4]]).collect();
        let density = [1.0 / step, 1.0 / stride];
        Self { n, ln_k: powers::ln(k), inverse_n: 1.0 / n, start, knee, density, fine, rows }
    }

    /// Y(d) from the table, off by at most 1.3e-5.
    #[inline(always)]
    fn tabulated<L: Lane>(&self, d: L) -> L {
        let below = (d - L::splat(self.start)) * L::splat(self.density[0]);
        let above = L::splat(self.fine) + (d - L::splat(self.knee)) * L::splat(self.density[1]);
        let position = L::select(d.less(L::splat(self.knee)), below, above);
        let row = nearest(position - L::splat(0.5));
        let t = position - row;
        let [c0, c1, c2, c3] = row.lookup(&self.rows);
        let y = (c0 + c1 * t) + (t * t) * (c2 + c3 * t);
        L::select(d.less(L::splat(self.start)), d, y)
    }

    /// The root g of K gⁿ + a g = s, for a, s > 0 and finite; s below 1e-290 counts as 1e-290.
    ///
    /// # Exactness
    /// Bit-stable; no iteration, no branch. For lanes of `f64` only, see [`Lane::in_double`]. |K gⁿ + a g − s| ≤ 1e-13 s as long as g is a normal number:
    /// at most (n²+1)/6 δ³ < 1e-14 (n ≤ 5) is left of the error δ ≤ 1.3e-5 of the table, and c carries
    /// the half-units of rounding of four numbers below 100.
    /// # Source
    /// docs/method.md \[Y3\].
    /// # Verified by
    /// Tests `residual_over_all_decades`, `table_error_is_below_its_bound`; property
    /// `solve_is_monotone_and_unique`.
    #[inline(always)]
    pub(crate) fn root<L: Lane>(&self, a: L, s: L) -> L {
        let (one, n) = (L::one(), L::splat(self.n));
        let s = L::larger(s, L::splat(LEAST));
        let ratio = s / a;
        let c = (ln_of_positive(s) - n * ln_of_positive(ratio)) - L::splat(self.ln_k);
        let y = self.tabulated(c * L::splat(self.inverse_n));
        // K gⁿ/s and a g/s at g = ratio eʸ; their sum is to become 1.
        let power = (n * y - c).exp();
        let linear = y.exp();
        let n_power = n * power;
        let inverse_slope = one / (n_power + linear);
        let curvature = (n * n_power + linear) * inverse_slope;
        let step = (one - (power + linear)) * inverse_slope;
        // e^δ to second order, with δ = step − ½ curvature step².
        ratio * linear * (one + step * (one + L::splat(0.5) * step * (one - curvature)))
    }
}

impl OfTwo for PowerSum {
    #[inline(always)]
    fn at<L: Lane>(&self, a: L, s: L) -> L {
        self.root(a, s)
    }
}

/// Y and dY/dd at d, by Newton's method for ln(eⁿ⁽ʸ⁻ᵈ⁾ + eʸ) = 0, which is convex and increasing in y.
fn value_and_slope(n: f64, d: f64) -> [f64; 2] {
    let mut y = d.min(0.0);
    for _ in 0..MAX_ROUNDS {
        let (power, linear) = (powers::exp(n * (y - d)), powers::exp(y));
        let sum = power + linear;
        let step = powers::ln(sum) * sum / (n * power + linear);
        y -= step;
        // The square of this step, the error left, is far below what the table needs.
        if step.abs() < 1e-9 {
            break;
        }
    }
    let (power, linear) = (powers::exp(n * (y - d)), powers::exp(y));
    [y, n * power / (n * power + linear)]
}

#[cfg(test)]
mod tests {
    use super::*;

    const INDICES: [f64; 10] = [0.05, 0.1, 0.2, 0.33, 0.5, 0.9, 1.0, 1.7, 3.0, 5.0];

    /// |K gⁿ + a g − s|/s, with the power from `libm`.
    fn residual(k: f64, n: f64, a: f64, s: f64, g: f64) -> f64 {
        ((k * libm::pow(g, n) - s) + a * g).abs() / s
    }

    /// The bound that the step of third order relies on: between, at and beyond the nodes.
    #[test]
    fn table_error_is_below_its_bound() {
        for n in INDICES {
            let sum = PowerSum::new(1.0, n);
            // Whichever is larger: e⁻¹² where the table ends, or the cubic.
            let bound = 1.3e-5;
            let (from, to) = (sum.start - 3.0, 1.3 * REACH / n);
            let mut worst = 0.0_f64;
            for i in 0..=20_000 {
                let d = from + (to - from) * f64::from(i) / 20_000.0;
                worst = worst.max((sum.tabulated(d) - value_and_slope(n, d)[0]).abs());
            }
            assert!(worst <= bound, "{n}: {worst:e}");
            // Not so far below it that the table could be half as long.
            assert!(worst >= bound / 16.0, "{n}: {worst:e}");
            assert!(sum.rows.len() <= 400, "{n}: {}", sum.rows.len());
        }
    }

    /// Twelve decades of s, eight of K, every index, ρ from ½ to 2.
    #[test]
    fn residual_over_all_decades() {
        let ten_to = |x: f64| libm::exp(core::f64::consts::LN_10 * x);
        let (mut worst, mut tried) = ((0.0, [0.0; 4]), 0);
        for n in INDICES {
            for k in -7..=1 {
                let k = ten_to(f64::from(k));
                let sum = PowerSum::new(k, n);
                for rho in [0.5, 0.97, 1.0, 1.03, 2.0] {
                    for step in 0..=480 {
                        let s = ten_to(-11.0 + f64::from(step) / 40.0);
                        let a = rho / 6.0;
                        let g: f64 = sum.root(a, s);
                        assert!(g >= 0.0 && g.is_finite());
                        // Below the normal numbers g has fewer digits.
                        if g >= f64::MIN_POSITIVE {
                            tried += 1;
                            let found = residual(k, n, a, s, g);
                            if found > worst.0 {
                                worst = (found, [n, k, rho, s]);
                            }
                        }
                    }
                }
            }
        }
        assert!(tried > 150_000, "{tried}");
        assert!(worst.0 <= 1e-13, "{worst:?}");
    }

    /// Limits: one term only, and n = 1, where the root is s/(K + a).
    #[test]
    fn limit_one_term_and_linear() {
        let linear = PowerSum::new(0.25, 1.0);
        for s in [1e-9, 1e-3, 2.0] {
            let g: f64 = linear.root(0.5, s);
            // Ten roundings of logarithms below 21.
            assert!((g - s / 0.75).abs() <= 10.0 * 21.0 * f64::EPSILON * g);
        }
        // K = 1e-300: a g = s. a = 1e-300: g = (s/K)^(1/n) = 4.
        let g: f64 = PowerSum::new(1e-300, 0.5).root(0.25, 3.0);
        assert_eq!(g, 12.0);
        let g: f64 = PowerSum::new(1.0, 0.5).root(1e-300, 2.0);
        // Logarithms below 700 in c, halved n: relative error of g up to 1/n times theirs.
        assert!((g - 4.0).abs() <= 4.0 * 700.0 * 4.0 * f64::EPSILON, "{g}");
    }

    #[test]
    fn exact_parity_of_dual_value() {
        let sum = PowerSum::new(0.01, 0.33);
        for s in [1e-9, 1e-5, 1e-2] {
            let plain: f64 = sum.root(0.17, s);
            let dual = sum.root(crate::lane::Dual::constant(0.17), crate::lane::Dual::variable(s));
            assert_eq!(dual.value, plain);
            // dg/ds = 1/(n K gⁿ⁻¹ + a); the step of third order leaves the square of the table's error.
            let exact = 1.0 / (0.33 * 0.01 * libm::pow(plain, -0.67) + 0.17);
            assert!((dual.slope / exact - 1.0).abs() <= 1e-9, "{s:e}: {} {exact}", dual.slope);
        }
    }
}
