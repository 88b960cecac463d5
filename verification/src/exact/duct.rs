//! Newtonian flow through a rectangular duct.

use core::f64::consts::PI;

/// Steady flow through |y| ≤ a, |z| ≤ b under a force per volume G.
///
/// u = (G/2μ) \[a² − y²\] − (16a²G/μπ³) Σ_{i odd} (−1)^{(i−1)/2} cosh(iπz/2a)/cosh(iπb/2a) cos(iπy/2a)/i³,
/// or the same with the axes exchanged, whichever converges faster at the point.
///
/// # Source
/// White, *Viscous Fluid Flow*, Sec. 3-3.3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RectangularDuct {
    /// Dynamic viscosity μ.
    pub mu: f64,
    /// a.
    pub half_width: f64,
    /// b.
    pub half_height: f64,
    /// G.
    pub force: f64,
}

impl RectangularDuct {
    /// u(y, z), both from the axis; 0 on and outside the walls.
    ///
    /// Rounding accuracy one thousandth of the half width away from the walls; in the corners, where
    /// u vanishes, absolute accuracy 1e-9 of the largest velocity.
    pub fn velocity(&self, y: f64, z: f64) -> f64 {
        let (a, b, y, z) = (self.half_width, self.half_height, y.abs(), z.abs());
        if y >= a || z >= b {
            return 0.0;
        }
        let scale = self.force / self.mu;
        // Exponential decay of the terms: iπ(b − z)/2a one way, iπ(a − y)/2b the other.
        if (b - z) * b >= (a - y) * a {
            scale * unit_velocity(a, b, y, z)
        } else {
            scale * unit_velocity(b, a, z, y)
        }
    }

    /// Mean over the cross-section: (G a²/3μ) \[1 − (192 a/π⁵b) Σ tanh(iπb/2a)/i⁵\].
    pub fn mean_velocity(&self) -> f64 {
        let (short, long) = if self.half_width < self.half_height {
            (self.half_width, self.half_height)
        } else {
            (self.half_height, self.half_width)
        };
        let mut sum = 0.0;
        // Smallest terms first; the tail beyond 2·4000 is below 1/(8·8000⁴) ~ 3e-17.
        for j in (0..4000_u32).rev() {
            let i = f64::from(2 * j + 1);
            sum += libm::tanh(0.5 * i * PI * long / short) / (i * i * i * i * i);
        }
        let pi5 = PI * PI * PI * PI * PI;
        self.force * short * short / (3.0 * self.mu) * (1.0 - 192.0 * short / (pi5 * long) * sum)
    }
}

/// u for G = μ = 1, the series running along the `z` direction; 0 ≤ y < a, 0 ≤ z < b.
fn unit_velocity(a: f64, b: f64, y: f64, z: f64) -> f64 {
    let mut sum = 0.0;
    let mut sign = 1.0;
    for j in 0..20_000_u32 {
        let i = f64::from(2 * j + 1);
        let wave = 0.5 * i * PI / a;
        // cosh(wz)/cosh(wb) without overflow.
        let decay = libm::exp(wave * (z - b)) * (1.0 + libm::exp(-2.0 * wave * z))
            / (1.0 + libm::exp(-2.0 * wave * b));
        let term = decay / (i * i * i);
        sum += sign * term * libm::cos(wave * y);
        sign = -sign;
        if term < 1e-18 {
            break;
        }
    }
    0.5 * (a * a - y * y) - 16.0 * a * a / (PI * PI * PI) * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    const DUCT: RectangularDuct = RectangularDuct { mu: 0.3, half_width: 1.0, half_height: 1.6, force: 2.0 };

    #[test]
    fn both_series_agree() {
        for (y, z) in [(0.0, 0.0), (0.5, 0.3), (0.9, 1.2), (0.2, 1.55), (0.95, 0.1)] {
            let one = unit_velocity(1.0, 1.6, y, z);
            let other = unit_velocity(1.6, 1.0, z, y);
            // Rounding of sums of order one.
            assert!((one - other).abs() < 1e-14, "{y} {z}: {one} {other}");
        }
    }

    #[test]
    fn exact_poisson_residual() {
        let h = 1e-3;
        let u = |y, z| DUCT.velocity(y, z);
        let laplacian = |y: f64, z: f64| {
            (u(y + h, z) + u(y - h, z) + u(y, z + h) + u(y, z - h) - 4.0 * u(y, z)) / (h * h)
        };
        for (y, z) in [(0.0, 0.0), (0.4, 0.7), (0.7, 1.2)] {
            // Truncation h²/12 of fourth derivatives (order G/μ) and rounding 4 ulp/h².
            assert!((laplacian(y, z) * 0.3 / 2.0 + 1.0).abs() < 1e-5, "{}", laplacian(y, z));
        }
    }

    #[test]
    fn mean_equals_the_double_fourier_series() {
        let mut sum = 0.0;
        for i in (1..1000_u32).step_by(2) {
            for j in (1..1000_u32).step_by(2) {
                let (i2, j2) = (f64::from(i * i), f64::from(j * j));
                sum += 1.0 / (i2 * j2 * (i2 + j2 / (1.6 * 1.6)));
            }
        }
        let pi6 = PI * PI * PI * PI * PI * PI;
        let mean = 2.0 / 0.3 * 256.0 / pi6 * sum;
        // The tail of the double series, of order 1/1000³.
        assert!((mean / DUCT.mean_velocity() - 1.0).abs() < 1e-8, "{mean} {}", DUCT.mean_velocity());
    }

    #[test]
    fn limit_wide_duct_is_a_channel_and_square_constant() {
        let wide = RectangularDuct { half_height: 400.0, ..DUCT };
        // G a²/(2μ) at the centre, the ends decay as exp(−200π).
        assert!((wide.velocity(0.0, 0.0) / (2.0 / 0.6) - 1.0).abs() < 1e-15);
        // 1 − 0.63 a/b: Boussinesq's end correction; its constant is 192/π⁵ Σ 1/i⁵ = 0.630249.
        assert!((wide.mean_velocity() / (2.0 / 0.9) - 1.0 + 0.630249 / 400.0).abs() < 1e-8);
        let square = RectangularDuct { half_height: 1.0, ..DUCT };
        // f·Re = 2 G (2a)²/(μ ū) = 56.908 for the square (White, table 3-1), five digits.
        assert!((square.mean_velocity() * 0.3 * 56.908 / (2.0 * 8.0) - 1.0).abs() < 1e-5);
        assert_eq!(DUCT.velocity(1.0, 0.2), 0.0);
    }
}
