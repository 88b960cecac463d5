//! Steady axial flow of any law between coaxial cylinders at rest.

use core::f64::consts::PI;

use super::ExactError;
use super::flow_curve::FlowCurve;
use super::quadrature::tanh_sinh;

/// Flow along the axis between cylinders of radii R₁ < R₂, driven by a force per volume G.
///
/// The balance of a ring gives σ(r) = (G/2)(c/r − r) whatever the law, with the sign of du/dr; c is the root of
/// ∫γ̇ dr = 0, so that both walls rest. A plug lies where |σ| ≤ σ0, between r² ± (2σ0/G) r − c = 0.
///
/// # Source
/// Fredrickson & Bird 1958, Ind. Eng. Chem. 50, 347-352 (Bingham and power law); Hanks 1979, Ind. Eng. Chem. Process Des.
/// Dev. 18, 488-493 (Herschel-Bulkley).
#[derive(Clone, Debug, PartialEq)]
pub struct Annulus<C> {
    law: C,
    inner: f64,
    outer: f64,
    force: f64,
    /// c; the stress vanishes at its root.
    c: f64,
}

impl<C: FlowCurve> Annulus<C> {
    /// Solves for the radius without stress.
    ///
    /// # Arguments
    /// `inner` R₁, `outer` R₂ (length), `force` G > 0 (force per volume).
    ///
    /// # Errors
    /// `Argument` if not 0 < R₁ < R₂ or G is not positive.
    pub fn new(law: C, inner: f64, outer: f64, force: f64) -> Result<Self, ExactError> {
        ExactError::positive("inner", inner)?;
        ExactError::positive("outer − inner", outer - inner)?;
        ExactError::positive("force", force)?;
        let mut flow = Self { law, inner, outer, force, c: 0.0 };
        let (mut low, mut high) = (inner * inner, outer * outer);
        // To the last bit: the velocity at the outer wall rises with c.
        for _ in 0..200 {
            flow.c = 0.5 * (low + high);
            if flow.c <= low || flow.c >= high {
                break;
            }
            let [inside, outside] = flow.plug();
            if flow.rise(flow.inner, inside) < flow.fall(outside, flow.outer) {
                low = flow.c;
            } else {
                high = flow.c;
            }
        }
        Ok(flow)
    }

    /// Shear stress with the sign of du/dr.
    pub fn stress(&self, r: f64) -> f64 {
        0.5 * self.force * (self.c / r - r)
    }

    /// du/dr.
    pub fn slope(&self, r: f64) -> f64 {
        let stress = self.stress(r);
        if stress < 0.0 { -self.law.rate(-stress) } else { self.law.rate(stress) }
    }

    /// Radii between which the material is rigid; both the radius without stress if there is no yield stress.
    pub fn plug(&self) -> [f64; 2] {
        let half = self.law.yield_stress() / self.force;
        let root = libm::sqrt(half * half + self.c);
        [(root - half).max(self.inner), (root + half).min(self.outer)]
    }

    /// u(r); 0 on and outside the walls.
    pub fn velocity(&self, r: f64) -> f64 {
        let [inside, outside] = self.plug();
        if r <= self.inner || r >= self.outer {
            0.0
        } else if r <= inside {
            self.rise(self.inner, r)
        } else if r < outside {
            self.plug_velocity()
        } else {
            self.fall(r, self.outer)
        }
    }

    /// Largest velocity, that of the plug.
    pub fn plug_velocity(&self) -> f64 {
        self.rise(self.inner, self.plug()[0])
    }

    /// Volume per time, −π∫r² (du/dr) dr.
    pub fn flow_rate(&self) -> f64 {
        let [inside, outside] = self.plug();
        let part = |from: f64, to: f64| {
            if to > from { -PI * tanh_sinh(from, to, |r| r * r * self.slope(r)) } else { 0.0 }
        };
        part(self.inner, inside) + part(outside, self.outer)
    }

    /// ∫ du/dr dr.
    fn rise(&self, from: f64, to: f64) -> f64 {
        if to > from { tanh_sinh(from, to, |r| self.slope(r)) } else { 0.0 }
    }

    fn fall(&self, from: f64, to: f64) -> f64 {
        -self.rise(from, to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::poiseuille::Channel;
    use lahar::rheology::Law;

    const HB: Law = Law::HerschelBulkley { sigma0: 0.2, k: 0.3, n: 0.4 };

    fn close(computed: f64, reference: f64, tolerance: f64) {
        assert!((computed - reference).abs() <= tolerance * reference.abs(), "{computed} {reference}");
    }

    /// The quadrature's 1e-13 and the last bits of c, which the differences of two layers enlarge.
    const TOLERANCE: f64 = 1e-11;

    #[test]
    fn exact_newtonian() {
        let (a, b, g, mu) = (0.4, 1.3, 2.1, 0.3);
        let flow = Annulus::new(Law::Newtonian { mu }, a, b, g).unwrap();
        let ln = libm::log(b / a);
        for r in [0.5, 0.8, 1.2] {
            let u = g / (4.0 * mu) * (a * a - r * r + (b * b - a * a) * libm::log(r / a) / ln);
            close(flow.velocity(r), u, TOLERANCE);
        }
        let square = b * b - a * a;
        let q = PI * g / (8.0 * mu) * (b * b * b * b - a * a * a * a - square * square / ln);
        close(flow.flow_rate(), q, TOLERANCE);
    }

    /// The closed form of Fredrickson & Bird for a Bingham fluid: T₀ = 2σ0/(GR), κ = R₁/R, λ₊ from their equation, and
    /// 8μQ/(πGR⁴) = 1 − κ⁴ − 2λ₊(λ₊ − T₀)(1 − κ²) − (4/3)(1 + κ³)T₀ + (1/3)(2λ₊ − T₀)³T₀.
    #[test]
    fn exact_bingham_of_fredrickson_and_bird() {
        for (kappa, t0) in [(0.2, 0.1), (0.2, 0.4), (0.5, 0.2), (0.8, 0.05)] {
            let of = |x: f64| {
                let t = t0 + kappa;
                2.0 * x * (x - t0) * libm::log((x - t0) / (x * kappa)) - 1.0 + t * t + 2.0 * t0 * (1.0 - x)
            };
            let (mut low, mut high) = (t0 + kappa, 1.0);
            assert!(of(low) < 0.0 && of(high) > 0.0);
            for _ in 0..100 {
                let middle = 0.5 * (low + high);
                if of(middle) < 0.0 { low = middle } else { high = middle }
            }
            let outside = 0.5 * (low + high);
            let cube = 2.0 * outside - t0;
            let q = 1.0
                - kappa * kappa * kappa * kappa
                - 2.0 * outside * (outside - t0) * (1.0 - kappa * kappa)
                - 4.0 / 3.0 * (1.0 + kappa * kappa * kappa) * t0
                + cube * cube * cube * t0 / 3.0;
            let (mu, g) = (0.7, 1.0);
            let flow = Annulus::new(Law::Bingham { sigma0: 0.5 * t0 * g, mu }, kappa, 1.0, g).unwrap();
            // The closed form loses digits to differences of numbers of order one.
            close(flow.plug()[1], outside, 1e-9);
            close(flow.flow_rate(), q * PI * g / (8.0 * mu), 1e-8);
        }
    }

    /// The walls carry all of the force, and the flow rate is the integral of the velocity.
    #[test]
    fn balance_and_flux_of_herschel_bulkley() {
        let (a, b, g) = (0.5, 1.5, 1.7);
        let flow = Annulus::new(HB, a, b, g).unwrap();
        let walls = 2.0 * PI * (a * flow.stress(a) - b * flow.stress(b));
        close(walls, g * PI * (b * b - a * a), 1e-14);
        let [p, q] = flow.plug();
        assert!(a < p && p < q && q < b);
        let panel = |from, to| tanh_sinh(from, to, |r| 2.0 * PI * r * flow.velocity(r));
        close(flow.flow_rate(), panel(a, p) + panel(p, q) + panel(q, b), 1e-10);
        assert_eq!(flow.velocity(0.5 * (p + q)), flow.plug_velocity());
    }

    /// A narrow annulus is a channel, up to its curvature, the square of gap over radius.
    #[test]
    fn limit_narrow_annulus_is_a_channel() {
        let flow = Annulus::new(HB, 1000.0, 1002.0, 1.0).unwrap();
        let channel = Channel { law: HB, half_width: 1.0, force: 1.0 };
        close(flow.plug_velocity(), channel.plug_velocity(), 1e-5);
        close(flow.flow_rate() / (2.0 * PI * 1001.0), channel.flux(), 1e-5);
    }

    #[test]
    fn limit_unyielded() {
        let flow = Annulus::new(Law::Bingham { sigma0: 3.0, mu: 1.0 }, 1.0, 2.0, 2.0).unwrap();
        assert_eq!((flow.velocity(1.5), flow.flow_rate()), (0.0, 0.0));
        assert!(Annulus::new(HB, 1.0, 1.0, 1.0).is_err());
    }
}
