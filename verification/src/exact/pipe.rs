//! Steady flow of any law through a round pipe.

use super::flow_curve::FlowCurve;

/// Pipe of radius R driven by a force per volume G: σ = Gr/2 whatever the law.
///
/// With M_p(σ) = ∫₀^σ sᵖ γ̇ ds: u(r) = (2/G)(M₀(GR/2) − M₀(Gr/2)), Q = (8π/G³) M₂(GR/2).
///
/// # Source
/// Rabinowitsch 1929, Z. Phys. Chem. A 145, 1-26; Buckingham 1921 and Reiner 1926 for Bingham.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pipe<C> {
    /// The law, ideal or clamped.
    pub law: C,
    /// R > 0.
    pub radius: f64,
    /// G; its sign is the sign of the flow.
    pub force: f64,
}

impl<C: FlowCurve> Pipe<C> {
    /// u(r); 0 on and outside the wall.
    pub fn velocity(&self, r: f64) -> f64 {
        if self.force == 0.0 || r.abs() >= self.radius {
            return 0.0;
        }
        2.0 * (self.law.moment(0, self.wall_stress()) - self.law.moment(0, self.stress(r))) / self.force
    }

    /// Magnitude of the shear stress, G|r|/2.
    pub fn stress(&self, r: f64) -> f64 {
        0.5 * self.force.abs() * r.abs()
    }

    /// GR/2.
    pub fn wall_stress(&self) -> f64 {
        self.stress(self.radius)
    }

    /// γ̇ at the wall.
    pub fn wall_shear_rate(&self) -> f64 {
        self.law.rate(self.wall_stress())
    }

    /// min(2σ0/G, R): radius of the rigid core; R if nothing flows.
    pub fn plug_radius(&self) -> f64 {
        let yield_stress = self.law.yield_stress();
        if yield_stress >= self.wall_stress() { self.radius } else { 2.0 * yield_stress / self.force.abs() }
    }

    /// u(0).
    pub fn plug_velocity(&self) -> f64 {
        self.velocity(0.0)
    }

    /// Volume per time.
    pub fn flow_rate(&self) -> f64 {
        if self.force == 0.0 {
            return 0.0;
        }
        8.0 * core::f64::consts::PI * self.law.moment(2, self.wall_stress())
            / (self.force * self.force * self.force)
    }

    /// Flow rate over the cross-section πR².
    pub fn mean_velocity(&self) -> f64 {
        self.flow_rate() / (core::f64::consts::PI * self.radius * self.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::poiseuille_clamped::Trilinear;
    use crate::exact::quadrature::tanh_sinh;
    use core::f64::consts::PI;
    use lahar::rheology::Law;

    fn close(computed: f64, reference: f64, tolerance: f64) {
        assert!((computed - reference).abs() <= tolerance * reference.abs(), "{computed} {reference}");
    }

    /// Rounding of some twenty operations.
    const ROUNDING: f64 = 1e-14;

    #[test]
    fn exact_hagen_poiseuille_and_power_law() {
        let (radius, force) = (1.3, 2.1);
        let newtonian = Pipe { law: Law::Newtonian { mu: 0.4 }, radius, force };
        close(newtonian.flow_rate(), PI * force * radius * radius * radius * radius / (8.0 * 0.4), ROUNDING);
        close(newtonian.velocity(0.5), force * (radius * radius - 0.25) / (4.0 * 0.4), ROUNDING);
        for n in [0.1, 0.5, 2.0] {
            let law = Pipe { law: Law::PowerLaw { k: 0.7, n }, radius, force };
            let expected =
                PI * n / (3.0 * n + 1.0) * libm::pow(force / 1.4, 1.0 / n) * libm::pow(radius, 3.0 + 1.0 / n);
            // The power 1/n multiplies the rounding of its base.
            close(law.flow_rate(), expected, ROUNDING / n);
        }
    }

    #[test]
    fn exact_buckingham_reiner() {
        let (sigma0, mu, radius, force) = (0.3, 0.4, 1.3, 2.1);
        let pipe = Pipe { law: Law::Bingham { sigma0, mu }, radius, force };
        let x = sigma0 / pipe.wall_stress();
        let factor = 1.0 - 4.0 / 3.0 * x + x * x * x * x / 3.0;
        let r4 = radius * radius * radius * radius;
        close(pipe.flow_rate(), PI * force * r4 / (8.0 * mu) * factor, ROUNDING);
        close(pipe.plug_radius(), 2.0 * sigma0 / force, ROUNDING);
        assert_eq!(pipe.velocity(0.0), pipe.velocity(0.99 * pipe.plug_radius()));
    }

    #[test]
    fn flow_rate_is_the_integral_of_the_velocity() {
        let law = Law::HerschelBulkley { sigma0: 0.3, k: 0.4, n: 0.33 };
        let ideal = Pipe { law, radius: 1.3, force: 2.1 };
        let clamped = Pipe { law: Trilinear::new(law, 0.3, 2.0).unwrap(), radius: 1.3, force: 2.1 };
        let kinks = [0.0, 0.25, 0.5, 0.75, 1.0].map(|x| x * 1.3);
        let s_c = clamped.law.critical_stress().unwrap() * 2.0 / 2.1;
        let s_l = clamped.law.limiting_stress().unwrap() * 2.0 / 2.1;
        let integral = |u: &dyn Fn(f64) -> f64, kinks: &[f64]| -> f64 {
            kinks.windows(2).map(|k| tanh_sinh(k[0], k[1], |r| 2.0 * PI * r * u(r))).sum()
        };
        let plug = [0.0, ideal.plug_radius(), 1.3];
        // The quadrature's 1e-13 per panel, and differences of primitives.
        close(ideal.flow_rate(), integral(&|r| ideal.velocity(r), &plug), 1e-12);
        let mut ends: Vec<f64> =
            kinks.into_iter().chain([s_c, s_l].into_iter().filter(|s| *s < 1.3)).collect();
        ends.sort_by(f64::total_cmp);
        close(clamped.flow_rate(), integral(&|r| clamped.velocity(r), &ends), 1e-11);
    }

    #[test]
    fn limit_unyielded() {
        let rigid = Pipe { law: Law::Bingham { sigma0: 3.0, mu: 1.0 }, radius: 1.0, force: 2.0 };
        assert_eq!((rigid.velocity(0.1), rigid.flow_rate(), rigid.plug_radius()), (0.0, 0.0, 1.0));
    }
}
