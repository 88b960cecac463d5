//! σ = σ0 (1 − exp(−m γ̇)) + K γ̇ⁿ.

use super::curve::{FlowCurve, PowerCurve};
use super::{Flow, Rheology, VANISHING};
use crate::lane::{Lane, OfTwo};

/// Herschel-Bulkley fluid regularised after Papanastasiou: no yield surface, a steep viscous start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Papanastasiou {
    /// Yield stress, lattice units, ≥ 0.
    pub sigma0: f64,
    /// Consistency, lattice units, > 0.
    pub k: f64,
    /// Flow index, > 0.
    pub n: f64,
    /// Growth rate m, in steps, > 0.
    pub m: f64,
}

/// Halving the bracket of ln γ̇ this often resolves it below rounding from any start.
const MAX_ROUNDS: usize = 80;

/// See `herschel_bulkley`: the square of the last step is below rounding.
const LAST_STEP: f64 = 1e-8;

impl Papanastasiou {
    /// The law with a yield stress that it stands in for.
    fn sharp(&self) -> PowerCurve {
        PowerCurve { sigma0: self.sigma0, k: self.k, n: self.n }
    }

    /// Stress and its slope d/d(ln γ̇), both including the term (ρ/6) γ̇, at x = ln γ̇.
    #[inline(always)]
    fn total<L: Lane>(&self, a: L, x: L) -> (L, L) {
        let gamma_dot = x.exp();
        let decay = -(L::splat(self.m) * gamma_dot);
        let plastic = -(L::splat(self.sigma0) * decay.exp_m1());
        let plastic_slope = L::splat(self.sigma0) * (-decay) * decay.exp();
        let power = L::splat(self.k) * (L::splat(self.n) * x).exp();
        let linear = a * gamma_dot;
        ((plastic + power) + linear, (plastic_slope + L::splat(self.n) * power) + linear)
    }
}

impl OfTwo for Papanastasiou {
    /// Newton's method in ln γ̇, kept inside a shrinking bracket because the law is not convex there.
    ///
    /// The bracket: no single term may exceed q (upper end), each term at most q/3 (lower end).
    ///
    /// # Source
    /// docs/method.md \[Y3\], \[Y4\].
    /// # Verified by
    /// Claim `couette-all-laws`; property `solve_is_monotone_and_unique`.
    #[inline(always)]
    fn at<L: Lane>(&self, rho: L, q: L) -> L {
        let flowing = L::zero().less(q);
        let q = L::select(flowing, q, L::one());
        let a = rho * L::splat(1.0 / 6.0);
        let power_root = |s: L| (s / L::splat(self.k)).ln() / L::splat(self.n);
        let third = q * L::splat(1.0 / 3.0);
        let mut high = L::smaller((q / a).ln(), power_root(q));
        let mut low = L::smaller((third / a).ln(), power_root(third));
        if self.sigma0 > 0.0 {
            low = L::smaller(low, (third / L::splat(self.sigma0 * self.m)).ln());
        }
        let mut x = high;
        let mut moving = flowing;
        for _ in 0..MAX_ROUNDS {
            let (sum, slope) = self.total(a, x);
            let above = q.less(sum);
            high = L::select(above, x, high);
            low = L::select(above, low, x);
            let newton = x - (sum / q).ln() * sum / slope;
            let inside = L::and(low.less_equal(newton), newton.less_equal(high));
            let next = L::select(inside, newton, L::splat(0.5) * (low + high));
            let step = next - x;
            x = L::select(moving, next, x);
            moving = L::and(moving, L::splat(LAST_STEP).less(step.abs()));
            if !L::any(moving) {
                break;
            }
        }
        L::select(flowing, x.exp(), L::zero())
    }
}

impl Rheology for Papanastasiou {
    #[inline(always)]
    fn stress<L: Lane>(&self, gamma_dot: L) -> L {
        let plastic = -(L::splat(self.sigma0) * (-(L::splat(self.m) * gamma_dot)).exp_m1());
        plastic + L::splat(self.k) * (L::splat(self.n) * gamma_dot.ln()).exp()
    }

    #[inline(always)]
    fn shear_rate<L: Lane>(&self, rho: L, q: L) -> L {
        L::in_double(self, rho, q)
    }

    #[inline(always)]
    fn tangent_viscosity<L: Lane>(&self, gamma_dot: L) -> L {
        let plastic = L::splat(self.sigma0 * self.m) * (-(L::splat(self.m) * gamma_dot)).exp();
        plastic + L::splat(self.n * self.k) * (L::splat(self.n - 1.0) * gamma_dot.ln()).exp()
    }

    /// Γ = σγ̇ − σ0 (γ̇ − (1 − exp(−mγ̇))/m) − K γ̇ⁿ⁺¹/(n + 1).
    #[inline(always)]
    fn flow<L: Lane>(&self, sigma: L) -> Flow<L> {
        let rate = self.shear_rate(L::splat(VANISHING), sigma);
        let flowing = L::zero().less(rate);
        let safe = L::select(flowing, rate, L::one());
        let decayed = (-(L::splat(self.m) * safe)).exp_m1();
        let plastic = L::splat(self.sigma0) * (safe + decayed * L::splat(1.0 / self.m));
        let power = L::splat(self.k / (self.n + 1.0)) * (L::splat(self.n + 1.0) * safe.ln()).exp();
        let zero = L::zero();
        Flow {
            rate,
            slope: L::select(flowing, L::one() / self.tangent_viscosity(safe), zero),
            integral: L::select(flowing, sigma * safe - (plastic + power), zero),
        }
    }

    #[inline(always)]
    fn thickens(&self) -> bool {
        self.n > 1.0
    }
}

/// Estimates take it for the law with a yield stress that it stands in for, but for its viscosities.
impl FlowCurve for Papanastasiou {
    fn plastic_stress(&self) -> f64 {
        self.sigma0
    }

    fn viscous_stress(&self, gamma_dot: f64) -> f64 {
        self.sharp().viscous_stress(gamma_dot)
    }

    /// σ0 m + K γ̇ⁿ⁻¹ at γ̇ = 0.
    fn viscosity_at_rest(&self) -> f64 {
        if self.n >= 1.0 { self.sigma0 * self.m + self.plastic_viscosity(0.0) } else { f64::INFINITY }
    }

    fn has_plug(&self) -> bool {
        false
    }

    fn constant_plastic_viscosity(&self) -> Option<f64> {
        self.sharp().constant_plastic_viscosity()
    }

    fn plastic_viscosity(&self, gamma_dot: f64) -> f64 {
        self.sharp().plastic_viscosity(gamma_dot)
    }

    /// σ0 (1 − exp(−m γ̇))/γ̇ + K γ̇ⁿ⁻¹.
    fn apparent_viscosity(&self, gamma_dot: f64) -> f64 {
        let yielded = -self.sigma0 * libm::expm1(-self.m * gamma_dot);
        yielded / gamma_dot + self.plastic_viscosity(gamma_dot)
    }

    fn shear_rate_at(&self, sigma: f64) -> f64 {
        self.sharp().shear_rate_at(sigma)
    }

    fn channel_velocity(&self, force: f64, half_gap: f64) -> f64 {
        self.sharp().channel_velocity(force, half_gap)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rheology::flow::work;

    /// Laws that thin, keep and thicken, at rates below, at and above 1/m.
    #[test]
    fn tangent_slope_and_integral_follow_the_stress() {
        for n in [0.5, 1.0, 1.7] {
            let law = Papanastasiou { sigma0: 0.3, k: 0.2, n, m: 5.0 };
            assert_eq!(law.thickens(), n > 1.0);
            for rate in [0.02_f64, 0.2, 3.0] {
                // Central differences of relative step 1e-5: rounding 1e-11, truncation 1e-10 of the slope.
                let step = 1e-5 * rate;
                let slope = (law.stress(rate + step) - law.stress(rate - step)) / (2.0 * step);
                let tangent: f64 = law.tangent_viscosity(rate);
                assert!((tangent / slope - 1.0).abs() < 1e-8, "n = {n}, rate {rate}: {tangent} {slope}");
                let flow: Flow<f64> = law.flow(law.stress(rate));
                assert!((flow.rate / rate - 1.0).abs() < 1e-9, "n = {n}: {} {rate}", flow.rate);
                assert!(
                    (flow.slope * slope - 1.0).abs() < 1e-8,
                    "n = {n}, rate {rate}: {} {slope}",
                    flow.slope
                );
                // Γ = σγ̇ − ∫ σ dγ̇, by two hundred pieces of Simpson's rule but for the first, which starts like γ̇ⁿ:
                // below 1e-6 of the whole.
                let pieces = (0..200).map(|k| {
                    let low = rate * k as f64 / 200.0;
                    if k == 0 {
                        work(rate / 200.0, |g: f64| law.stress(g))
                    } else {
                        between(&law, low, low + rate / 200.0)
                    }
                });
                let integral = law.stress(rate) * rate - pieces.sum::<f64>();
                assert!(
                    (flow.integral / integral - 1.0).abs() < 1e-6,
                    "n = {n}, rate {rate}: {} {integral}",
                    flow.integral
                );
            }
        }
    }

    #[test]
    fn apparent_viscosity_is_stress_over_rate() {
        for n in [0.5, 1.0, 1.7] {
            let law = Papanastasiou { sigma0: 0.3, k: 0.2, n, m: 5.0 };
            for rate in [0.02_f64, 0.2, 3.0] {
                let (found, stress): (f64, f64) = (law.apparent_viscosity(rate), law.stress(rate));
                // Some roundings of each.
                assert!(
                    (found * rate / stress - 1.0).abs() < 1e-14,
                    "n = {n}, rate {rate}: {found} {stress}"
                );
            }
        }
    }

    /// ∫ σ dγ̇ by Simpson's rule.
    fn between(law: &Papanastasiou, low: f64, high: f64) -> f64 {
        let at = |rate: f64| -> f64 { law.stress(rate) };
        (high - low) / 6.0 * (at(low) + 4.0 * at(0.5 * (low + high)) + at(high))
    }
}
