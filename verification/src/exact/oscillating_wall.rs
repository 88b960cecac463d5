//! Flow beside a wall that oscillates in its plane.

use super::complex::Complex;

/// Newtonian fluid between a wall at y = 0 that moves with U cos ωt and one at rest at y = H, after the transient:
/// u = U Re{ sinh(λ(H − y))/sinh(λH) e^{iωt} }, λ = √(iω/ν). Far from the second wall that is Stokes' second problem,
/// u = U e^{−ky} cos(ωt − ky), k = √(ω/2ν).
///
/// # Source
/// G. G. Stokes, Trans. Camb. Phil. Soc. 9, 8 (1851); H. Schlichting, *Boundary-Layer Theory*, chapter V, for both walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OscillatingWall {
    /// Kinematic viscosity ν.
    pub nu: f64,
    /// H.
    pub gap: f64,
    /// U.
    pub speed: f64,
    /// ω > 0.
    pub frequency: f64,
}

impl OscillatingWall {
    /// k = √(ω/2ν): the wave falls by e over 1/k.
    pub fn wave_number(&self) -> f64 {
        (0.5 * self.frequency / self.nu).sqrt()
    }

    /// Real and imaginary part of the complex amplitude û(y), u = Re{û e^{iωt}}.
    pub fn complex_amplitude(&self, y: f64) -> (f64, f64) {
        let root = self.wave_number();
        let lambda = Complex { re: root, im: root };
        // 1 − e^{−2λx} never overflows.
        let short = |x: f64| lambda.scale(-2.0 * x).exp().scale(-1.0).plus_one();
        let ratio = lambda.scale(-y).exp().times(short(self.gap - y)).over(short(self.gap));
        (self.speed * ratio.re, self.speed * ratio.im)
    }

    /// u(y, t).
    pub fn velocity(&self, y: f64, t: f64) -> f64 {
        let (re, im) = self.complex_amplitude(y);
        re * libm::cos(self.frequency * t) - im * libm::sin(self.frequency * t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ode_residual_and_walls() {
        let flow = OscillatingWall { nu: 0.3, gap: 1.7, speed: 0.6, frequency: 2.0 };
        let (y, t, h) = (0.5, 0.8, 1e-3);
        let u = |y, t| flow.velocity(y, t);
        let rate: f64 = (u(y, t + h) - u(y, t - h)) / (2.0 * h);
        let bend = (u(y + h, t) - 2.0 * u(y, t) + u(y - h, t)) / (h * h);
        // Truncation h²/6 ω³ U and h²/12 of the fourth derivative.
        assert!((rate - 0.3 * bend).abs() < 1e-5);
        // cos to a rounding.
        assert!((u(0.0, t) - 0.6 * libm::cos(2.0 * t)).abs() < 1e-15);
        assert_eq!(u(1.7, t), 0.0);
    }

    #[test]
    fn limit_of_a_wide_gap_is_stokes_second_problem() {
        let flow = OscillatingWall { nu: 0.1, gap: 100.0, speed: 1.0, frequency: 0.2 };
        // The other wall is e^{−100} away.
        assert_eq!(flow.wave_number(), 1.0);
        for (y, t) in [(0.3, 0.0), (1.0, 7.0), (2.5, -3.0)] {
            let exact = libm::exp(-y) * libm::cos(0.2 * t - y);
            assert!((flow.velocity(y, t) - exact).abs() < 1e-14);
        }
    }
}
