//! Arnold-Beltrami-Childress flow: an exact three-dimensional Navier-Stokes solution.

/// u = (A sin kz + C cos ky, B sin kx + A cos kz, C sin ky + B cos kx) e^{−νk²t}.
///
/// curl u = k u, so the advection term is the gradient of |u|²/2 and the pressure balances it.
///
/// # Source
/// Dombre et al. 1986, J. Fluid Mech. 167, 353-391.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Abc {
    /// A, B, C.
    pub amplitudes: [f64; 3],
    /// k.
    pub wave_number: f64,
    /// Kinematic viscosity ν.
    pub nu: f64,
    /// ρ.
    pub density: f64,
}

impl Abc {
    /// νk².
    pub fn decay_rate(&self) -> f64 {
        self.nu * self.wave_number * self.wave_number
    }

    /// u(x, t).
    pub fn velocity(&self, x: [f64; 3], t: f64) -> [f64; 3] {
        let [a, b, c] = self.amplitudes.map(|a| a * libm::exp(-self.decay_rate() * t));
        let sin = x.map(|x| libm::sin(self.wave_number * x));
        let cos = x.map(|x| libm::cos(self.wave_number * x));
        [a * sin[2] + c * cos[1], b * sin[0] + a * cos[2], c * sin[1] + b * cos[0]]
    }

    /// ∂u_i/∂x_j as `[i][j]`.
    pub fn gradient(&self, x: [f64; 3], t: f64) -> [[f64; 3]; 3] {
        let [a, b, c] = self.amplitudes.map(|a| a * self.wave_number * libm::exp(-self.decay_rate() * t));
        let sin = x.map(|x| libm::sin(self.wave_number * x));
        let cos = x.map(|x| libm::cos(self.wave_number * x));
        [[0.0, -c * sin[1], a * cos[2]], [b * cos[0], 0.0, -a * sin[2]], [-b * sin[0], c * cos[1], 0.0]]
    }

    /// p = ρ(⟨|u|²⟩ − |u|²)/2, with mean 0.
    pub fn pressure(&self, x: [f64; 3], t: f64) -> f64 {
        let u = self.velocity(x, t);
        let mean: f64 =
            self.amplitudes.iter().map(|a| a * a).sum::<f64>() * libm::exp(-2.0 * self.decay_rate() * t);
        0.5 * self.density * (mean - (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]))
    }
}

#[cfg(test)]
mod tests {
    use super::super::taylor_green::navier_stokes_residual;
    use super::*;

    const FLOW: Abc = Abc { amplitudes: [0.7, -0.4, 0.9], wave_number: 1.3, nu: 0.2, density: 1.1 };
    const X: [f64; 3] = [0.4, 1.1, -0.6];

    #[test]
    fn ode_residual() {
        let (residual, divergence) = navier_stokes_residual(
            |x, t| FLOW.velocity(x, t),
            |x, t| FLOW.pressure(x, t),
            FLOW.nu,
            FLOW.density,
            X,
            0.3,
        );
        // Truncation h²/6 of third derivatives, all below 10.
        assert!(residual.iter().all(|r| r.abs() < 1e-5) && divergence.abs() < 1e-5, "{residual:?}");
    }

    #[test]
    fn gradient_is_beltrami() {
        let g = FLOW.gradient(X, 0.3);
        let u = FLOW.velocity(X, 0.3);
        let curl = [g[2][1] - g[1][2], g[0][2] - g[2][0], g[1][0] - g[0][1]];
        for axis in 0..3 {
            // Rounding of a few operations of order one.
            assert!((curl[axis] - FLOW.wave_number * u[axis]).abs() < 1e-14);
        }
    }
}
