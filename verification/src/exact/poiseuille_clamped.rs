//! The trilinear law that results from clamping the apparent viscosity, and its flows \[Y5\].

use super::ExactError;
use super::flow_curve::{FlowCurve, herschel_bulkley_form, herschel_bulkley_moment, herschel_bulkley_rate};
use lahar::rheology::Law;

/// σ = γ̇ · clamp(η(γ̇), μ_min, μ_max) with η = σ0/γ̇ + K γ̇^{n−1}.
///
/// For n ≤ 1 three branches: σ/μ_max below the critical stress s_c, the law itself between s_c and
/// s_l, σ/μ_min above s_l. For n > 1 with a yield stress η has a minimum and up to five branches.
/// Every flow follows by exact integration branch by branch; use it as the `law` of
/// [`super::poiseuille::Channel`], [`super::pipe::Pipe`], [`super::film::Film`] or
/// [`super::viscoplastic_1d::Flow1d`].
///
/// # Source
/// The clamp is 004 Sec 3.2.3; the exact solutions follow from γ̇(σ) by one integration.
#[derive(Clone, Debug, PartialEq)]
pub struct Trilinear {
    law: Law,
    sigma0: f64,
    k: f64,
    n: f64,
    branches: Vec<Branch>,
}

/// One branch of the clamped law, from the stress where the previous one ends.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Branch {
    from: f64,
    kind: BranchKind,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum BranchKind {
    /// σ = μ γ̇.
    Linear(f64),
    /// The law itself.
    Law,
}

impl Trilinear {
    /// The clamped form of a law.
    ///
    /// # Errors
    /// `Argument` for a law that is not σ0 + K γ̇ⁿ (Papanastasiou), for σ0 < 0, K ≤ 0, n ≤ 0 or
    /// unless 0 < μ_min ≤ μ_max.
    pub fn new(law: Law, mu_min: f64, mu_max: f64) -> Result<Self, ExactError> {
        let (sigma0, k, n) = herschel_bulkley_form(&law).ok_or(ExactError::Argument {
            what: "law",
            value: f64::NAN,
            allowed: "must be of the form sigma0 + K rate^n",
        })?;
        ExactError::positive("k", k)?;
        ExactError::positive("n", n)?;
        ExactError::positive("mu_min", mu_min)?;
        ExactError::positive("mu_max", mu_max)?;
        if sigma0.is_nan() || sigma0 < 0.0 {
            return Err(ExactError::Argument {
                what: "sigma0",
                value: sigma0,
                allowed: "must not be negative",
            });
        }
        if mu_min > mu_max {
            return Err(ExactError::Argument {
                what: "mu_min",
                value: mu_min,
                allowed: "must not exceed mu_max",
            });
        }
        let branches = branches(sigma0, k, n, mu_min, mu_max);
        Ok(Self { law, sigma0, k, n, branches })
    }

    /// The law that is clamped.
    pub fn law(&self) -> Law {
        self.law
    }

    /// s_c: the stress at which the first, most viscous branch ends. `None` if the law has only one
    /// branch or starts unclamped. G-normalised it is the apparent plug half width s_c/G.
    pub fn critical_stress(&self) -> Option<f64> {
        match (self.branches.first(), self.branches.get(1)) {
            (Some(Branch { kind: BranchKind::Linear(_), .. }), Some(second)) => Some(second.from),
            _ => None,
        }
    }

    /// s_l: the stress above which the last branch is linear. `None` if the law never ends clamped
    /// or has only one branch.
    pub fn limiting_stress(&self) -> Option<f64> {
        match self.branches.as_slice() {
            [_, .., Branch { kind: BranchKind::Linear(_), from }] => Some(*from),
            _ => None,
        }
    }

    fn branch(&self, stress: f64) -> BranchKind {
        self.branches.iter().rev().find(|b| stress >= b.from).map_or(BranchKind::Law, |b| b.kind)
    }

    fn branch_moment(&self, kind: BranchKind, power: u32, from: f64, to: f64) -> f64 {
        match kind {
            BranchKind::Linear(mu) => {
                let primitive = |s: f64| (0..power + 2).fold(1.0, |v, _| v * s);
                (primitive(to) - primitive(from)) / (f64::from(power + 2) * mu)
            }
            BranchKind::Law => {
                herschel_bulkley_moment(self.sigma0, self.k, self.n, power, to)
                    - herschel_bulkley_moment(self.sigma0, self.k, self.n, power, from)
            }
        }
    }
}

/// η(γ̇) = σ0/γ̇ + K γ̇^{n−1}.
fn apparent_viscosity(sigma0: f64, k: f64, n: f64, rate: f64) -> f64 {
    sigma0 / rate + k * libm::pow(rate, n - 1.0)
}

/// All γ̇ > 0 with η(γ̇) = μ.
fn crossings(sigma0: f64, k: f64, n: f64, mu: f64) -> Vec<f64> {
    if n == 1.0 {
        // σ0/γ̇ + K = μ.
        return if sigma0 > 0.0 && mu > k { vec![sigma0 / (mu - k)] } else { Vec::new() };
    }
    if sigma0 == 0.0 {
        return vec![libm::pow(mu / k, 1.0 / (n - 1.0))];
    }
    let excess = |rate: f64| apparent_viscosity(sigma0, k, n, rate) - mu;
    // Each part of η alone stays below μ only beyond σ0/μ.
    let first = sigma0 / mu;
    if n < 1.0 {
        // η falls from ∞ to 0; twice the larger single-part root is beyond the crossing.
        let alone = libm::pow(2.0 * k / mu, 1.0 / (1.0 - n));
        return vec![bisect(first, (2.0 * first).max(alone), excess)];
    }
    let lowest = libm::pow(sigma0 / (k * (n - 1.0)), 1.0 / n);
    if excess(lowest) >= 0.0 {
        return Vec::new();
    }
    let last = libm::pow(mu / k, 1.0 / (n - 1.0));
    vec![bisect(first, lowest, excess), bisect(lowest, last, excess)]
}

/// The sign change of f between a and b, to the last bit.
fn bisect(a: f64, b: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut a, mut b) = (a, b);
    let rising = f(a) < 0.0;
    for _ in 0..200 {
        let middle = 0.5 * (a + b);
        if middle == a || middle == b {
            break;
        }
        if (f(middle) < 0.0) == rising {
            a = middle;
        } else {
            b = middle;
        }
    }
    0.5 * (a + b)
}

fn branches(sigma0: f64, k: f64, n: f64, mu_min: f64, mu_max: f64) -> Vec<Branch> {
    let mut ends: Vec<(f64, f64)> = Vec::new();
    for mu in [mu_min, mu_max] {
        ends.extend(crossings(sigma0, k, n, mu).into_iter().map(|rate| (rate, mu * rate)));
    }
    ends.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut branches: Vec<Branch> = Vec::new();
    for i in 0..=ends.len() {
        let inside = match (i.checked_sub(1).and_then(|j| ends.get(j)), ends.get(i)) {
            (None, None) => 1.0,
            (None, Some(end)) => 0.5 * end.0,
            (Some(start), None) => 2.0 * start.0,
            (Some(start), Some(end)) => (start.0 * end.0).sqrt(),
        };
        let viscosity = apparent_viscosity(sigma0, k, n, inside);
        let kind = if viscosity > mu_max {
            BranchKind::Linear(mu_max)
        } else if viscosity < mu_min {
            BranchKind::Linear(mu_min)
        } else {
            BranchKind::Law
        };
        let from = i.checked_sub(1).and_then(|j| ends.get(j)).map_or(0.0, |end| end.1);
        // Two ends may coincide (μ_min = μ_max): an empty branch changes nothing.
        if branches.last().is_none_or(|last| last.kind != kind) {
            branches.push(Branch { from, kind });
        }
    }
    branches
}

impl FlowCurve for Trilinear {
    fn rate(&self, stress: f64) -> f64 {
        match self.branch(stress) {
            BranchKind::Linear(mu) => stress / mu,
            BranchKind::Law => herschel_bulkley_rate(self.sigma0, self.k, self.n, stress),
        }
    }

    fn rate_slope(&self, stress: f64) -> f64 {
        match self.branch(stress) {
            BranchKind::Linear(mu) => 1.0 / mu,
            BranchKind::Law => self.law.rate_slope(stress),
        }
    }

    fn stress(&self, rate: f64) -> f64 {
        for (i, branch) in self.branches.iter().enumerate() {
            let stress = match branch.kind {
                BranchKind::Linear(mu) => mu * rate,
                BranchKind::Law => self.law.stress(rate),
            };
            if self.branches.get(i + 1).is_none_or(|next| stress < next.from) {
                return stress;
            }
        }
        self.law.stress(rate)
    }

    /// 0: a clamped law flows at any stress.
    fn yield_stress(&self) -> f64 {
        0.0
    }

    fn moment(&self, power: u32, stress: f64) -> f64 {
        let mut total = 0.0;
        for (i, branch) in self.branches.iter().enumerate() {
            let end = self.branches.get(i + 1).map_or(stress, |next| next.from.min(stress));
            if end > branch.from {
                total += self.branch_moment(branch.kind, power, branch.from, end);
            }
        }
        total
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::poiseuille::Channel;
    use crate::exact::quadrature::tanh_sinh;
    use crate::reference_values::find;

    const HB: Law = Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 0.33 };
    /// ρ Δx²/(3Δt) of the thesis' channel in Pa s.
    const UNIT: f64 = 80.0 / 3.0;

    fn thesis(law: Law, tau_max: f64) -> Channel<Trilinear> {
        let law = Trilinear::new(law, UNIT * 0.001, UNIT * (tau_max - 0.5)).unwrap();
        Channel { law, half_width: 1.0, force: 1.0 }
    }

    fn close(computed: f64, reference: f64, tolerance: f64) {
        assert!((computed - reference).abs() <= tolerance * reference.abs(), "{computed} {reference}");
    }

    #[test]
    fn reference_clamped_thesis_channel() {
        for (tau_max, key) in [(0.6, "0.6"), (1.5, "1.5"), (1.8, "1.8")] {
            let flow = thesis(HB, tau_max);
            let entry = find(&format!("poiseuille_HB_thesis_clamped_taumax_{key}"), &[]).unwrap();
            let s_c = flow.law.critical_stress().unwrap();
            for (computed, field) in [
                (flow.velocity(0.0), "u0"),
                (0.5 * flow.flux(), "q_half"),
                (s_c, "plug_halfwidth_apparent"),
                (flow.law.rate(s_c), "gdot_c"),
            ] {
                close(computed, entry.field(field).unwrap(), entry.tolerance());
            }
            let entry = find(&format!("poiseuille_HB_thesis_clamped_profile_taumax_{key}"), &[]).unwrap();
            for (y, u) in entry.input_list("y").unwrap().iter().zip(entry.list().unwrap()) {
                close(flow.velocity(*y), u, entry.tolerance());
            }
        }
    }

    #[test]
    fn reference_over_yielded_and_bingham() {
        let entry = find("poiseuille_HB_overyield_clamped", &[]).unwrap();
        let over = thesis(Law::HerschelBulkley { sigma0: 5.0, k: 0.2, n: 0.33 }, 1.5);
        close(over.velocity(0.0), entry.field("u0").unwrap(), entry.tolerance());
        let entry = find("poiseuille_Bingham_clamped_taumax_1.8", &[]).unwrap();
        let bingham = thesis(Law::Bingham { sigma0: 0.5, mu: 0.2 }, 1.8);
        close(bingham.velocity(0.0), entry.field("u0").unwrap(), entry.tolerance());
        close(0.5 * bingham.flux(), entry.field("q_half").unwrap(), entry.tolerance());
        close(bingham.law.critical_stress().unwrap(), entry.field("y_c").unwrap(), entry.tolerance());
    }

    #[test]
    fn clamped_viscosity_over_twelve_decades() {
        for (law, mu_min, mu_max) in [
            (HB, 0.02, 3.0),
            (Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 2.0 }, 0.9, 5.0),
            (Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 2.0 }, 0.1, 0.6),
            (Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 2.0 }, 0.1, 5.0),
            (Law::Bingham { sigma0: 0.5, mu: 0.2 }, 0.3, 5.0),
            (Law::Bingham { sigma0: 0.5, mu: 0.2 }, 0.01, 0.1),
            (Law::PowerLaw { k: 0.2, n: 0.4 }, 0.02, 3.0),
            (Law::PowerLaw { k: 0.2, n: 1.6 }, 0.02, 3.0),
            (Law::Newtonian { mu: 0.2 }, 0.02, 3.0),
            (HB, 0.7, 0.7),
        ] {
            let clamped = Trilinear::new(law, mu_min, mu_max).unwrap();
            let mut rate = 1e-6;
            while rate < 1e6 {
                let stress = clamped.stress(rate);
                // η from its definition; rounding of two powers, ~20 ulp.
                let viscosity = (law.stress(rate) / rate).clamp(mu_min, mu_max);
                close(stress / rate, viscosity, 1e-14);
                // The inverse loses σ/(σ − σ0)/n ulp, and 1e-10 also covers points on an end.
                close(clamped.rate(stress), rate, 1e-10);
                rate *= 2.3;
            }
        }
    }

    #[test]
    fn moments_equal_quadrature_of_the_rate() {
        let law = Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 2.0 };
        let clamped = Trilinear::new(law, 0.65, 2.0).unwrap();
        assert_eq!(clamped.branches.len(), 5);
        let mut ends: Vec<f64> = clamped.branches.iter().map(|b| b.from).collect();
        ends.push(2.0 * ends.last().unwrap());
        for power in 0..3 {
            let integrand = |s: f64| (0..power).fold(clamped.rate(s), |v, _| v * s);
            let sum: f64 = ends.windows(2).map(|e| tanh_sinh(e[0], e[1], integrand)).sum();
            // 1e-13 of the quadrature per branch, ten times that for the differences of primitives.
            close(clamped.moment(power, *ends.last().unwrap()), sum, 5e-12);
        }
    }

    #[test]
    fn limit_wide_clamp_is_the_ideal_law() {
        let clamped = Trilinear::new(HB, 1e-12, 1e12).unwrap();
        let u = |y| Channel { law: clamped.clone(), half_width: 1.0, force: 1.0 }.velocity(y);
        let ideal = Channel { law: HB, half_width: 1.0, force: 1.0 };
        // What the clamp adds: σ0²/(2 μ_max G) ~ 1e-13, and rounding.
        close(u(0.0), ideal.velocity(0.0), 1e-12);
        close(u(0.8), ideal.velocity(0.8), 1e-12);
    }

    #[test]
    fn refuses_bad_clamps() {
        assert!(Trilinear::new(HB, 1.0, 0.5).is_err());
        assert!(Trilinear::new(HB, 0.0, 0.5).is_err());
        assert!(
            Trilinear::new(Law::Papanastasiou { sigma0: 1.0, k: 1.0, n: 1.0, m: 1.0 }, 0.1, 1.0).is_err()
        );
    }
}
