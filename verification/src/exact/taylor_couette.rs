//! Newtonian flow between rotating coaxial cylinders.

/// Steady azimuthal flow between cylinders: u_θ = A r + B/r.
///
/// A = (Ω₂R₂² − Ω₁R₁²)/(R₂² − R₁²), B = (Ω₁ − Ω₂) R₁²R₂²/(R₂² − R₁²).
///
/// # Source
/// Landau & Lifshitz, *Fluid Mechanics*, §18.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TaylorCouette {
    /// R₁ > 0.
    pub inner_radius: f64,
    /// R₂ > R₁.
    pub outer_radius: f64,
    /// Ω₁.
    pub inner_rate: f64,
    /// Ω₂.
    pub outer_rate: f64,
}

impl TaylorCouette {
    fn coefficients(&self) -> (f64, f64) {
        let inner = self.inner_radius * self.inner_radius;
        let outer = self.outer_radius * self.outer_radius;
        let a = (self.outer_rate * outer - self.inner_rate * inner) / (outer - inner);
        let b = (self.inner_rate - self.outer_rate) * inner * outer / (outer - inner);
        (a, b)
    }

    /// u_θ(r).
    pub fn velocity(&self, r: f64) -> f64 {
        let (a, b) = self.coefficients();
        a * r + b / r
    }

    /// Signed shear rate r d(u_θ/r)/dr = −2B/r².
    pub fn shear_rate(&self, r: f64) -> f64 {
        -2.0 * self.coefficients().1 / (r * r)
    }

    /// Torque per length that the fluid exerts on the outer cylinder, 4πμB.
    pub fn torque_per_length(&self, mu: f64) -> f64 {
        4.0 * core::f64::consts::PI * mu * self.coefficients().1
    }

    /// (p(r) − p(R₁))/ρ = ∫ u_θ²/r dr = A²(r² − R₁²)/2 + 2AB ln(r/R₁) + B²(1/R₁² − 1/r²)/2.
    pub fn pressure_over_density(&self, r: f64) -> f64 {
        let (a, b) = self.coefficients();
        let r1 = self.inner_radius;
        0.5 * a * a * (r * r - r1 * r1)
            + 2.0 * a * b * libm::log(r / r1)
            + 0.5 * b * b * (1.0 / (r1 * r1) - 1.0 / (r * r))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::quadrature::tanh_sinh;

    const FLOW: TaylorCouette =
        TaylorCouette { inner_radius: 1.0, outer_radius: 2.5, inner_rate: 0.7, outer_rate: -0.2 };

    #[test]
    fn exact_on_both_walls_and_in_between() {
        // Rounding of a handful of operations on numbers of order one.
        let tolerance = 1e-14;
        assert!((FLOW.velocity(1.0) - 0.7).abs() < tolerance);
        assert!((FLOW.velocity(2.5) + 0.5).abs() < tolerance);
        let pressure = tanh_sinh(1.0, 1.8, |r| FLOW.velocity(r) * FLOW.velocity(r) / r);
        // The quadrature's own 1e-13.
        assert!((FLOW.pressure_over_density(1.8) - pressure).abs() < 1e-12);
        let h = 1e-4;
        let difference =
            1.8 * (FLOW.velocity(1.8 + h) / (1.8 + h) - FLOW.velocity(1.8 - h) / (1.8 - h)) / (2.0 * h);
        // Truncation h²/6 of the third derivative, of order one.
        assert!((FLOW.shear_rate(1.8) - difference).abs() < 1e-8);
        let balance = 2.0 * core::f64::consts::PI * 1.8 * 1.8 * -FLOW.shear_rate(1.8);
        // The torque on every cylinder is the same; rounding only.
        assert!((FLOW.torque_per_length(1.0) / balance - 1.0).abs() < tolerance);
    }

    #[test]
    fn limit_rigid_rotation() {
        let rigid = TaylorCouette { outer_rate: 0.7, ..FLOW };
        assert_eq!(rigid.shear_rate(1.3), 0.0);
        // Rounding of A.
        assert!((rigid.velocity(1.3) - 0.7 * 1.3).abs() < 1e-15);
    }
}
