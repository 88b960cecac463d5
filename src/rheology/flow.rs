//! Laws read the other way round: the shear rate under a stress.

use crate::lane::Lane;

/// What a fluid does under a shear stress σ ≥ 0 once it flows steadily: the law γ̇(σ), its slope and its integral.
#[derive(Clone, Copy, Debug)]
pub struct Flow<L = f64> {
    /// γ̇(σ); zero up to the yield stress.
    pub rate: L,
    /// dγ̇/dσ.
    pub slope: L,
    /// Γ(σ) = ∫ γ̇ dσ from zero stress.
    pub integral: L,
}

impl<L: Lane> Flow<L> {
    /// γ̇ = σ/μ.
    #[inline(always)]
    pub(crate) fn newtonian(mu: L, sigma: L) -> Self {
        let slope = L::one() / mu;
        let rate = sigma * slope;
        Self { rate, slope, integral: L::splat(0.5) * (rate * sigma) }
    }

    /// γ̇ = (x/K)^(1/n) with the excess x of the stress over the yield stress.
    ///
    /// # Source
    /// docs/method.md \[B3\].
    #[inline(always)]
    pub(crate) fn power(k: f64, n: f64, excess: L) -> Self {
        let flowing = L::zero().less(excess);
        let x = L::select(flowing, excess, L::one());
        let rate = if n == 1.0 {
            x * L::splat(1.0 / k)
        } else {
            // An excess that is too small to be told from zero gives a rate of zero.
            let ratio = L::larger(x * L::splat(1.0 / k), L::splat(SMALLEST));
            (L::splat(1.0 / n) * ratio.ln()).exp()
        };
        let zero = L::zero();
        Self {
            rate: L::select(flowing, rate, zero),
            slope: L::select(flowing, L::splat(1.0 / n) * rate / x, zero),
            integral: L::select(flowing, L::splat(n / (n + 1.0)) * (rate * x), zero),
        }
    }

    /// Each part from `then` where the mask is true.
    #[inline(always)]
    pub(crate) fn select(mask: L::Mask, then: &Self, otherwise: &Self) -> Self {
        Self {
            rate: L::select(mask, then.rate, otherwise.rate),
            slope: L::select(mask, then.slope, otherwise.slope),
            integral: L::select(mask, then.integral, otherwise.integral),
        }
    }
}

/// Least argument of a logarithm: a normal number.
const SMALLEST: f64 = 1e-290;

/// Nodes and weights of Gauss and Legendre's rule of five points on \[0, 1\].
const GAUSS: [[f64; 2]; 5] = [
    [0.046_910_077_030_668_004, 0.118_463_442_528_094_54],
    [0.230_765_344_947_158_45, 0.239_314_335_249_683_24],
    [0.5, 0.284_444_444_444_444_44],
    [0.769_234_655_052_841_5, 0.239_314_335_249_683_24],
    [0.953_089_922_969_332, 0.118_463_442_528_094_54],
];

/// ∫ σ dγ̇ from rest to `rate`, by five points in √γ̇, in which the laws start smoothly.
#[inline(always)]
pub(super) fn work<L: Lane>(rate: L, stress: impl Fn(L) -> L) -> L {
    let mut sum = L::zero();
    for [node, weight] in GAUSS {
        sum = sum + L::splat(2.0 * weight * node) * stress(rate * L::splat(node * node));
    }
    rate * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_integral_and_slope_of_a_power() {
        let (k, n) = (0.3, 0.4);
        for excess in [1e-6, 0.02, 1.5] {
            let flow = Flow::power(k, n, excess);
            let rate = libm::pow(excess / k, 1.0 / n);
            assert!((flow.rate / rate - 1.0).abs() < 1e-13);
            assert!((flow.integral - work_by_parts(rate, excess, k, n)).abs() <= 1e-13 * flow.integral);
            let (a, b) =
                (Flow::power(k, n, excess * 1.000_01).rate, Flow::power(k, n, excess * 0.999_99).rate);
            assert!(((a - b) / (2e-5 * excess) / flow.slope - 1.0).abs() < 1e-8);
        }
        assert_eq!(Flow::power(k, n, -0.1).rate, 0.0);
        assert_eq!(Flow::power(k, n, 0.0).integral, 0.0);
    }

    /// xγ̇ − ∫ K γ̇ⁿ dγ̇.
    fn work_by_parts(rate: f64, excess: f64, k: f64, n: f64) -> f64 {
        excess * rate - k * libm::pow(rate, n + 1.0) / (n + 1.0)
    }

    #[test]
    fn work_of_a_yield_stress_law() {
        // ∫ (√s + √(mγ̇))² dγ̇ = sγ̇ + (4/3)√(sm) γ̇^1.5 + mγ̇²/2: a polynomial in √γ̇.
        let (s, m, rate) = (0.2_f64, 0.7_f64, 3.0_f64);
        let law = |g: f64| (s.sqrt() + (m * g).sqrt()) * (s.sqrt() + (m * g).sqrt());
        let exact = s * rate + 4.0 / 3.0 * (s * m).sqrt() * rate * rate.sqrt() + 0.5 * m * rate * rate;
        assert!((work(rate, law) / exact - 1.0).abs() < 1e-14);
    }
}
