//! Flow of any law between turning coaxial cylinders.

use core::f64::consts::PI;

use super::ExactError;
use super::flow_curve::FlowCurve;
use super::quadrature::tanh_sinh;

/// Steady azimuthal flow between cylinders of radii R₁ < R₂ that turn at Ω₁ and Ω₂.
///
/// The torque per length T is the same on every ring: σ(r) = T/(2πr²) whatever the law, and r dω/dr = ∓γ̇(σ), so that
/// |ω(r) − Ω₂| = ½∫ γ̇(s)/s ds between σ(R₂) and σ(r). Beyond the radius where σ falls below the yield stress the material
/// turns with the outer cylinder.
///
/// # Source
/// Bird, Dai & Yarusso 1983, Rev. Chem. Eng. 1, 1-70, §3; Reiner & Riwlin 1927 for Bingham; Landau & Lifshitz §18 for
/// Newtonian.
#[derive(Clone, Debug, PartialEq)]
pub struct TurningCylinders<C> {
    law: C,
    inner: f64,
    outer: f64,
    inner_rate: f64,
    outer_rate: f64,
    /// σ at the inner cylinder.
    wall_stress: f64,
}

impl<C: FlowCurve> TurningCylinders<C> {
    /// Solves for the torque.
    ///
    /// # Arguments
    /// `inner` R₁, `outer` R₂ (length); `inner_rate` Ω₁, `outer_rate` Ω₂ (1/time).
    ///
    /// # Errors
    /// `Argument` if not 0 < R₁ < R₂ or the cylinders turn together.
    pub fn new(
        law: C,
        [inner, outer]: [f64; 2],
        [inner_rate, outer_rate]: [f64; 2],
    ) -> Result<Self, ExactError> {
        ExactError::positive("inner", inner)?;
        ExactError::positive("outer − inner", outer - inner)?;
        let turn = (inner_rate - outer_rate).abs();
        ExactError::positive("inner_rate − outer_rate", turn)?;
        let mut flow = Self { law, inner, outer, inner_rate, outer_rate, wall_stress: 0.0 };
        // γ̇ at the inner wall is at least what the whole gap would have at uniform ω′, and doubles until it suffices.
        let mut high = flow.law.stress(turn).max(f64::MIN_POSITIVE);
        while flow.turn(high, inner) < turn {
            high *= 2.0;
        }
        let mut low = flow.law.yield_stress();
        for _ in 0..2000 {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if flow.turn(middle, inner) < turn {
                low = middle;
            } else {
                high = middle;
            }
        }
        flow.wall_stress = high;
        Ok(flow)
    }

    /// The flow whose stress at the inner cylinder is `wall_stress`, inside a cylinder at rest.
    ///
    /// # Errors
    /// `Argument` if not 0 < R₁ < R₂ or the stress does not exceed the yield stress.
    pub fn of_stress(law: C, [inner, outer]: [f64; 2], wall_stress: f64) -> Result<Self, ExactError> {
        ExactError::positive("inner", inner)?;
        ExactError::positive("outer − inner", outer - inner)?;
        ExactError::positive("wall_stress − yield stress", wall_stress - law.yield_stress())?;
        let mut flow = Self { law, inner, outer, inner_rate: 0.0, outer_rate: 0.0, wall_stress };
        flow.inner_rate = flow.turn(wall_stress, inner);
        Ok(flow)
    }

    /// |ω(r) − Ω₂| when the stress at the inner cylinder is `wall`.
    fn turn(&self, wall: f64, r: f64) -> f64 {
        let at = |r: f64| wall * (self.inner / r) * (self.inner / r);
        let (from, to) = (at(self.outer).max(self.law.yield_stress()), at(r));
        if to > from { 0.5 * tanh_sinh(from, to, |s| self.law.rate(s) / s) } else { 0.0 }
    }

    /// Magnitude of the shear stress.
    pub fn stress(&self, r: f64) -> f64 {
        self.wall_stress * (self.inner / r) * (self.inner / r)
    }

    /// u_θ(r); inside the walls that of the walls.
    pub fn velocity(&self, r: f64) -> f64 {
        if r <= self.inner {
            return self.inner_rate * r;
        }
        if r >= self.outer {
            return self.outer_rate * r;
        }
        let turn = self.turn(self.wall_stress, r);
        r * if self.inner_rate < self.outer_rate { self.outer_rate - turn } else { self.outer_rate + turn }
    }

    /// Radius beyond which the material is rigid; R₂ if it is sheared throughout.
    pub fn yield_radius(&self) -> f64 {
        let yield_stress = self.law.yield_stress();
        if yield_stress <= self.stress(self.outer) {
            self.outer
        } else {
            self.inner * libm::sqrt(self.wall_stress / yield_stress)
        }
    }

    /// Magnitude of the torque per length, 2πr²σ.
    pub fn torque_per_length(&self) -> f64 {
        2.0 * PI * self.inner * self.inner * self.wall_stress
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::taylor_couette::TaylorCouette;
    use lahar::rheology::Law;

    fn close(computed: f64, reference: f64, tolerance: f64) {
        assert!((computed - reference).abs() <= tolerance * reference.abs(), "{computed} {reference}");
    }

    /// The quadrature's 1e-13 and the last bits of the root.
    const TOLERANCE: f64 = 1e-12;

    #[test]
    fn exact_newtonian() {
        for [inner_rate, outer_rate] in [[0.7, 0.0], [0.7, -0.2], [0.1, 0.5]] {
            let mu = 0.3;
            let flow =
                TurningCylinders::new(Law::Newtonian { mu }, [1.0, 2.5], [inner_rate, outer_rate]).unwrap();
            let closed = TaylorCouette { inner_radius: 1.0, outer_radius: 2.5, inner_rate, outer_rate };
            for r in [1.0, 1.3, 2.2] {
                close(flow.velocity(r), closed.velocity(r), 1e-11);
                assert_eq!(flow.velocity(2.6), 2.6 * outer_rate);
            }
            close(flow.torque_per_length(), closed.torque_per_length(mu).abs(), TOLERANCE);
        }
    }

    /// Reiner & Riwlin: Ω = (1/2μ)\[σ₁ − σ₂ − σ0 ln(σ₁/σ₂)\], σ₂ = σ0 when the outer part is rigid.
    #[test]
    fn exact_bingham() {
        let (mu, sigma0) = (0.3, 0.4);
        let law = Law::Bingham { sigma0, mu };
        for rate in [0.05, 0.5, 8.0] {
            let flow = TurningCylinders::new(law, [1.0, 2.0], [rate, 0.0]).unwrap();
            let (first, second) = (flow.stress(1.0), flow.stress(2.0).max(sigma0));
            let turn = 0.5 / mu * (first - second - sigma0 * libm::log(first / second));
            close(turn, rate, 1e-11);
            let edge = flow.yield_radius();
            assert_eq!(edge < 2.0, rate < 1.0, "{edge}");
            let same = TurningCylinders::of_stress(law, [1.0, 2.0], first).unwrap();
            close(same.velocity(1.2), flow.velocity(1.2), 1e-11);
            if edge < 2.0 {
                close(flow.stress(edge), sigma0, 1e-14);
                assert_eq!(flow.velocity(1.01 * edge), 0.0);
            }
        }
    }

    /// Power law: ω ∝ r^(−2/n) (Bird, Armstrong & Hassager, ex. 4.2-5).
    #[test]
    fn exact_power_law() {
        for n in [0.25, 0.6, 1.5] {
            let flow = TurningCylinders::new(Law::PowerLaw { k: 0.3, n }, [1.0, 2.0], [0.4, 0.0]).unwrap();
            let fall = |r: f64| libm::pow(r, -2.0 / n);
            for r in [1.2, 1.7] {
                close(flow.velocity(r), 0.4 * r * (fall(r) - fall(2.0)) / (1.0 - fall(2.0)), 1e-10);
            }
        }
    }

    #[test]
    fn ode_residual_of_herschel_bulkley() {
        let law = Law::HerschelBulkley { sigma0: 0.4, k: 0.3, n: 0.5 };
        let flow = TurningCylinders::new(law, [1.0, 2.0], [0.8, 0.1]).unwrap();
        close(flow.velocity(1.0 + 1e-12), 0.8, 1e-10);
        let h = 1e-4;
        for r in [1.05, 1.15] {
            let slope = (flow.velocity(r + h) / (r + h) - flow.velocity(r - h) / (r - h)) / (2.0 * h);
            // h²/6 of the third derivative, some hundred times the first.
            close(-r * slope, law.rate(flow.stress(r)), 1e-6);
        }
        assert!(TurningCylinders::new(law, [1.0, 2.0], [0.8, 0.8]).is_err());
    }
}
