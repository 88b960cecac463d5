//! Oscillating flow in a plane channel.

use super::complex::Complex;

/// Newtonian channel |y| ≤ h under the acceleration A cos ωt (force per volume over density), after
/// the transient: u = Re{ (A/iω) \[1 − cosh(λy)/cosh(λh)\] e^{iωt} }, λ = √(iω/ν).
///
/// # Source
/// Womersley 1955, J. Physiol. 127, 553-563 (pipe); Landau & Lifshitz §24 problem 6 (slit).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WomersleySlit {
    /// Kinematic viscosity ν.
    pub nu: f64,
    /// h.
    pub half_width: f64,
    /// A.
    pub acceleration: f64,
    /// ω > 0.
    pub frequency: f64,
}

impl WomersleySlit {
    /// α = h √(ω/ν).
    pub fn womersley_number(&self) -> f64 {
        self.half_width * (self.frequency / self.nu).sqrt()
    }

    /// Real and imaginary part of the complex amplitude û(y), u = Re{û e^{iωt}}.
    pub fn complex_amplitude(&self, y: f64) -> (f64, f64) {
        let y = y.abs();
        if y >= self.half_width {
            return (0.0, 0.0);
        }
        let root = (0.5 * self.frequency / self.nu).sqrt();
        let lambda = Complex { re: root, im: root };
        // cosh(λy)/cosh(λh) = e^{−λ(h−y)} (1 + e^{−2λy})/(1 + e^{−2λh}) never overflows.
        let fall = lambda.scale(y - self.half_width).exp();
        let above = lambda.scale(-2.0 * y).exp().plus_one();
        let below = lambda.scale(-2.0 * self.half_width).exp().plus_one();
        let ratio = fall.times(above).over(below);
        let size = self.acceleration / self.frequency;
        // (1 − ratio)/i = −i + i ratio.
        (-size * ratio.im, -size * (1.0 - ratio.re))
    }

    /// u(y, t).
    pub fn velocity(&self, y: f64, t: f64) -> f64 {
        let (re, im) = self.complex_amplitude(y);
        re * libm::cos(self.frequency * t) - im * libm::sin(self.frequency * t)
    }

    /// |û(y)|.
    pub fn amplitude(&self, y: f64) -> f64 {
        let (re, im) = self.complex_amplitude(y);
        (re * re + im * im).sqrt()
    }

    /// Phase of û(y) in radians, relative to the force; −π/2 for a free fluid, 0 when quasi-steady.
    pub fn phase(&self, y: f64) -> f64 {
        let (re, im) = self.complex_amplitude(y);
        libm::atan2(im, re)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference_values::find;

    #[test]
    fn reference_centre_at_alpha_one() {
        let flow = WomersleySlit { nu: 1.0, half_width: 1.0, acceleration: 1.0, frequency: 1.0 };
        let entry = find("womersley_plane_centre_alpha1", &[]).unwrap();
        let quasi_steady = 1.0 / 2.0;
        for (computed, key) in [
            (flow.amplitude(0.0), "amp"),
            (flow.phase(0.0), "phase_rad"),
            (flow.amplitude(0.0) / quasi_steady, "amp_over_quasisteady"),
        ] {
            assert!((computed / entry.field(key).unwrap() - 1.0).abs() < entry.tolerance(), "{computed}");
        }
    }

    #[test]
    fn ode_residual() {
        let flow = WomersleySlit { nu: 0.3, half_width: 1.2, acceleration: 0.7, frequency: 2.0 };
        let (y, t, h) = (0.5, 0.8, 1e-3);
        let u = |y, t| flow.velocity(y, t);
        let rate = (u(y, t + h) - u(y, t - h)) / (2.0 * h);
        let bend = (u(y + h, t) - 2.0 * u(y, t) + u(y - h, t)) / (h * h);
        let residual: f64 = rate - 0.7 * libm::cos(2.0 * t) - 0.3 * bend;
        // Truncation h²/6 ω³ A and h²/12 of the fourth derivative.
        assert!(residual.abs() < 1e-5, "{residual}");
        assert_eq!(u(1.2, t), 0.0);
        assert_eq!(flow.womersley_number(), 1.2 * (2.0_f64 / 0.3).sqrt());
    }

    #[test]
    fn limit_of_large_frequency_is_a_free_fluid() {
        let flow = WomersleySlit { nu: 1e-6, half_width: 1.0, acceleration: 1.0, frequency: 1.0 };
        // The wall layer has decayed as e^{−700}.
        assert_eq!(flow.amplitude(0.0), 1.0);
        assert_eq!(flow.phase(0.0), -core::f64::consts::FRAC_PI_2);
    }
}
