//! The inverse γ̇(σ) of a constitutive law and its moments, from which every steady unidirectional
//! flow with a known stress field follows by integration.

use lahar::rheology::Law;

use super::quadrature::tanh_sinh;

/// A monotone law read as shear rate over stress.
pub trait FlowCurve {
    /// γ̇(σ) for σ ≥ 0; 0 up to the yield stress. Unit: 1/time.
    fn rate(&self, stress: f64) -> f64;

    /// dγ̇/dσ at σ ≥ 0; 0 up to the yield stress. Unit: 1/(stress · time).
    fn rate_slope(&self, stress: f64) -> f64;

    /// σ(γ̇) for γ̇ > 0. At γ̇ = 0 the limit from above: the yield stress.
    fn stress(&self, rate: f64) -> f64;

    /// The stress below which the material is rigid; 0 if it has none.
    fn yield_stress(&self) -> f64;

    /// Whether γ̇(σ) leaves the yield stress with infinite slope (shear-thickening laws, n > 1), so that
    /// an iteration does better to count in rates than in stresses.
    fn steep_at_yield(&self) -> bool {
        false
    }

    /// ∫₀^σ sᵖ γ̇(s) ds for p = 0 (velocities), 1 (plane flux), 2 (pipe flux).
    fn moment(&self, power: u32, stress: f64) -> f64;
}

/// σ0, K, n of the laws that are σ0 + K γ̇ⁿ.
pub(crate) fn herschel_bulkley_form(law: &Law) -> Option<(f64, f64, f64)> {
    match *law {
        Law::Newtonian { mu } => Some((0.0, mu, 1.0)),
        Law::Bingham { sigma0, mu } => Some((sigma0, mu, 1.0)),
        Law::HerschelBulkley { sigma0, k, n } => Some((sigma0, k, n)),
        Law::PowerLaw { k, n } => Some((0.0, k, n)),
        Law::Papanastasiou { .. } => None,
    }
}

/// γ̇ = ((σ − σ0)/K)^{1/n} above yield.
pub(crate) fn herschel_bulkley_rate(sigma0: f64, k: f64, n: f64, stress: f64) -> f64 {
    let excess = stress - sigma0;
    if excess <= 0.0 {
        0.0
    } else if n == 1.0 {
        excess / k
    } else {
        libm::pow(excess / k, 1.0 / n)
    }
}

/// ∫_{σ0}^σ sᵖ γ̇ ds = γ̇(σ) Σⱼ C(p,j) σ0^{p−j} x^{j+1}/(1/n + j + 1), x = σ − σ0.
///
/// All terms are positive, so the sum loses no digits.
pub(crate) fn herschel_bulkley_moment(sigma0: f64, k: f64, n: f64, power: u32, stress: f64) -> f64 {
    let x = stress - sigma0;
    if x <= 0.0 {
        return 0.0;
    }
    let a = 1.0 / n + 1.0;
    let sum = match power {
        0 => x / a,
        1 => x * (sigma0 / a + x / (a + 1.0)),
        2 => x * (sigma0 * sigma0 / a + 2.0 * sigma0 * x / (a + 1.0) + x * x / (a + 2.0)),
        _ => f64::NAN,
    };
    herschel_bulkley_rate(sigma0, k, n, stress) * sum
}

impl FlowCurve for Law {
    fn rate(&self, stress: f64) -> f64 {
        match (*self, herschel_bulkley_form(self)) {
            (_, Some((sigma0, k, n))) => herschel_bulkley_rate(sigma0, k, n, stress),
            (Law::Papanastasiou { sigma0, k, n, m }, _) => papanastasiou_rate(sigma0, k, n, m, stress),
            _ => f64::NAN,
        }
    }

    fn rate_slope(&self, stress: f64) -> f64 {
        match (*self, herschel_bulkley_form(self)) {
            (_, Some((sigma0, k, n))) => {
                let excess = stress - sigma0;
                if n == 1.0 {
                    if excess > 0.0 || (sigma0 == 0.0 && excess == 0.0) { 1.0 / k } else { 0.0 }
                } else if excess <= 0.0 {
                    0.0
                } else {
                    herschel_bulkley_rate(sigma0, k, n, stress) / (n * excess)
                }
            }
            (Law::Papanastasiou { sigma0, k, n, m }, _) => {
                let rate = papanastasiou_rate(sigma0, k, n, m, stress);
                if rate > 0.0 || n == 1.0 {
                    1.0 / (sigma0 * m * libm::exp(-m * rate) + n * k * libm::pow(rate, n - 1.0))
                } else if n < 1.0 {
                    0.0
                } else {
                    1.0 / (sigma0 * m)
                }
            }
            _ => f64::NAN,
        }
    }

    fn stress(&self, rate: f64) -> f64 {
        match (*self, herschel_bulkley_form(self)) {
            (_, Some((sigma0, k, n))) => sigma0 + k * if n == 1.0 { rate } else { libm::pow(rate, n) },
            (Law::Papanastasiou { sigma0, k, n, m }, _) => papanastasiou_stress(sigma0, k, n, m, rate),
            _ => f64::NAN,
        }
    }

    fn yield_stress(&self) -> f64 {
        herschel_bulkley_form(self).map_or(0.0, |(sigma0, ..)| sigma0)
    }

    fn steep_at_yield(&self) -> bool {
        herschel_bulkley_form(self).is_some_and(|(.., n)| n > 1.0)
    }

    fn moment(&self, power: u32, stress: f64) -> f64 {
        match (*self, herschel_bulkley_form(self)) {
            (_, Some((sigma0, k, n))) => herschel_bulkley_moment(sigma0, k, n, power, stress),
            (Law::Papanastasiou { sigma0, k, n, m }, _) => {
                papanastasiou_moment(sigma0, k, n, m, power, papanastasiou_rate(sigma0, k, n, m, stress))
            }
            _ => f64::NAN,
        }
    }
}

/// σ = σ0 (1 − e^{−m γ̇}) + K γ̇ⁿ.
fn papanastasiou_stress(sigma0: f64, k: f64, n: f64, m: f64, rate: f64) -> f64 {
    -sigma0 * libm::expm1(-m * rate) + k * libm::pow(rate, n)
}

/// The root γ̇ of σ(γ̇) = σ, by Newton steps on ln γ̇ kept inside a shrinking bracket.
fn papanastasiou_rate(sigma0: f64, k: f64, n: f64, m: f64, stress: f64) -> f64 {
    if stress <= 0.0 {
        return 0.0;
    }
    // K γ̇ⁿ ≤ σ bounds the rate from above, K γ̇ⁿ ≥ σ − σ0 and halving from below.
    let mut high = libm::log(stress / k) / n;
    let mut low = high - 1.0;
    let stress_at = |log_rate: f64| papanastasiou_stress(sigma0, k, n, m, libm::exp(log_rate));
    for doubling in 0..60 {
        if stress_at(low) <= stress {
            break;
        }
        low -= f64::from(1 << doubling.min(8));
    }
    let mut x = 0.5 * (low + high);
    for _ in 0..200 {
        let rate = libm::exp(x);
        let residual = papanastasiou_stress(sigma0, k, n, m, rate) - stress;
        if residual > 0.0 {
            high = x;
        } else {
            low = x;
        }
        let slope = rate * sigma0 * m * libm::exp(-m * rate) + n * k * libm::pow(rate, n);
        let newton = x - residual / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        let moved = (next - x).abs();
        x = next;
        if moved <= 4.0 * f64::EPSILON * x.abs().max(1.0) {
            break;
        }
    }
    libm::exp(x)
}

/// ∫₀^{σ(γ̇)} sᵖ γ̇ ds = ∫₀^γ̇ σᵖ(r) r σ′(r) dr, in panels that resolve the knee at r ~ 1/m.
fn papanastasiou_moment(sigma0: f64, k: f64, n: f64, m: f64, power: u32, rate: f64) -> f64 {
    let integrand = |r: f64| {
        let stress = papanastasiou_stress(sigma0, k, n, m, r);
        let weight = (0..power).fold(1.0, |w, _| w * stress);
        weight * (sigma0 * m * r * libm::exp(-m * r) + n * k * libm::pow(r, n))
    };
    let mut total = 0.0;
    let mut from = 0.0;
    for knee in [1.0, 4.0, 12.0, 40.0, f64::INFINITY] {
        let to = (knee / m).min(rate);
        if to > from {
            total += tanh_sinh(from, to, integrand);
            from = to;
        }
    }
    total
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAWS: [Law; 9] = [
        Law::Newtonian { mu: 0.2 },
        Law::Bingham { sigma0: 0.5, mu: 0.2 },
        Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 0.33 },
        Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 0.1 },
        Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 2.0 },
        Law::PowerLaw { k: 0.7, n: 0.5 },
        Law::PowerLaw { k: 0.7, n: 1.7 },
        Law::Papanastasiou { sigma0: 0.5, k: 0.2, n: 0.33, m: 300.0 },
        Law::Papanastasiou { sigma0: 0.5, k: 0.2, n: 1.0, m: 10.0 },
    ];

    #[test]
    fn exact_inverse_over_ten_decades() {
        for law in LAWS {
            let mut rate = 1e-5;
            while rate < 1e5 {
                let stress = law.stress(rate);
                let back = law.stress(law.rate(stress));
                // Rounding of σ → γ̇ → σ: the two powers and the subtraction of σ0.
                assert!((back / stress - 1.0).abs() < 1e-13, "{law:?} {rate} {back} {stress}");
                rate *= 3.7;
            }
        }
    }

    #[test]
    fn slope_is_the_derivative_of_the_rate() {
        for law in LAWS {
            for stress in [0.1, 0.45, 0.7, 1.3] {
                let h = 1e-5 * stress;
                let difference = (law.rate(stress + h) - law.rate(stress - h)) / (2.0 * h);
                let scale = law.rate_slope(1.3);
                // Truncation h² γ̇‴/6 with γ̇‴ up to 1e4 slopes per unit² for n = 0.1.
                assert!((difference - law.rate_slope(stress)).abs() < 1e-5 * scale, "{law:?} {stress}");
            }
        }
    }

    #[test]
    fn moments_equal_quadrature_of_the_rate() {
        for law in LAWS {
            for power in 0..3 {
                let stress = 0.9;
                let integrand = |s: f64| (0..power).fold(law.rate(s), |v, _| v * s);
                let mut sum = 0.0;
                // Splits at the yield stress or knee, where the rate is not analytic.
                for (a, b) in [(0.0, 0.25), (0.25, 0.45), (0.45, 0.5), (0.5, 0.55), (0.55, stress)] {
                    sum += tanh_sinh(a, b, integrand);
                }
                let moment = law.moment(power, stress);
                // The quadrature's 1e-13 per panel, with a margin for the knee inside the panels.
                assert!((moment / sum - 1.0).abs() < 1e-11, "{law:?} {power}: {moment} {sum}");
            }
        }
    }

    #[test]
    fn limit_rigid_up_to_yield() {
        let law = Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 2.0 };
        assert_eq!((law.rate(0.5), law.rate_slope(0.5), law.moment(0, 0.5)), (0.0, 0.0, 0.0));
    }
}
