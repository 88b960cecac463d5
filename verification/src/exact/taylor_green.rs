//! Taylor-Green vortices: the exact two-dimensional one and the three-dimensional initial state.

/// The plane of a two-dimensional vortex: its first and second in-plane axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// x, y.
    Xy,
    /// y, z.
    Yz,
    /// z, x.
    Zx,
}

impl Plane {
    /// Indices of the in-plane axes.
    pub fn axes(self) -> (usize, usize) {
        match self {
            Self::Xy => (0, 1),
            Self::Yz => (1, 2),
            Self::Zx => (2, 0),
        }
    }
}

/// Two-dimensional Taylor-Green vortex carried by a uniform flow V: with ξ = x − Vt and axes a, b of
/// the plane
///
/// u_a = U sin(k_a ξ_a) cos(k_b ξ_b) e^{−ν(k_a²+k_b²)t} + V_a,
/// u_b = −U (k_a/k_b) cos(k_a ξ_a) sin(k_b ξ_b) e^{−ν(k_a²+k_b²)t} + V_b,
/// p = ρU²/4 \[cos 2k_aξ_a + (k_a/k_b)² cos 2k_bξ_b\] e^{−2ν(k_a²+k_b²)t}.
///
/// # Source
/// Taylor & Green 1937, Proc. R. Soc. A 158, 499-521; an exact solution of the Navier-Stokes equations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TaylorGreen2d {
    /// Its plane.
    pub plane: Plane,
    /// U.
    pub amplitude: f64,
    /// k_a, k_b, not 0.
    pub wave_numbers: [f64; 2],
    /// Kinematic viscosity ν.
    pub nu: f64,
    /// ρ.
    pub density: f64,
    /// V.
    pub mean_flow: [f64; 3],
}

impl TaylorGreen2d {
    /// ν(k_a² + k_b²), the decay rate of the velocity.
    pub fn decay_rate(&self) -> f64 {
        let [ka, kb] = self.wave_numbers;
        self.nu * (ka * ka + kb * kb)
    }

    fn phases(&self, x: [f64; 3], t: f64) -> (f64, f64) {
        let (a, b) = self.plane.axes();
        let xi = |axis: usize| x[axis] - self.mean_flow[axis] * t;
        (self.wave_numbers[0] * xi(a), self.wave_numbers[1] * xi(b))
    }

    /// u(x, t).
    pub fn velocity(&self, x: [f64; 3], t: f64) -> [f64; 3] {
        let (a, b) = self.plane.axes();
        let (alpha, beta) = self.phases(x, t);
        let size = self.amplitude * libm::exp(-self.decay_rate() * t);
        let ratio = self.wave_numbers[0] / self.wave_numbers[1];
        let mut u = self.mean_flow;
        u[a] += size * libm::sin(alpha) * libm::cos(beta);
        u[b] -= size * ratio * libm::cos(alpha) * libm::sin(beta);
        u
    }

    /// p(x, t) with mean 0.
    pub fn pressure(&self, x: [f64; 3], t: f64) -> f64 {
        let (alpha, beta) = self.phases(x, t);
        let size = self.amplitude * libm::exp(-self.decay_rate() * t);
        let ratio = self.wave_numbers[0] / self.wave_numbers[1];
        0.25 * self.density * size * size * (libm::cos(2.0 * alpha) + ratio * ratio * libm::cos(2.0 * beta))
    }
}

/// Initial state of the three-dimensional Taylor-Green vortex in a box of side 2π/k:
/// u = U (sin kx cos ky cos kz, −cos kx sin ky cos kz, 0),
/// p = (ρU²/16) (cos 2kx + cos 2ky)(cos 2kz + 2).
///
/// The later energies are in the reference values `tgv3d_E_Z` (mean of |u|²/2, E(0) = U²/8).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TaylorGreen3d {
    /// U.
    pub amplitude: f64,
    /// k.
    pub wave_number: f64,
    /// ρ.
    pub density: f64,
}

impl TaylorGreen3d {
    /// u(x, 0).
    pub fn velocity(&self, x: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = x.map(|x| self.wave_number * x);
        let u = self.amplitude * libm::cos(z);
        [u * libm::sin(x) * libm::cos(y), -u * libm::cos(x) * libm::sin(y), 0.0]
    }

    /// p(x, 0) with mean 0.
    pub fn pressure(&self, x: [f64; 3]) -> f64 {
        let [x, y, z] = x.map(|x| 2.0 * self.wave_number * x);
        let dynamic = self.density * self.amplitude * self.amplitude / 16.0;
        dynamic * (libm::cos(x) + libm::cos(y)) * (libm::cos(z) + 2.0)
    }

    /// Mean of |u|²/2 at t = 0, U²/8.
    pub fn initial_energy(&self) -> f64 {
        self.amplitude * self.amplitude / 8.0
    }
}

/// Central differences of a flow, for the tests of this folder: residuals of the Navier-Stokes
/// equations without force, and the divergence.
#[cfg(test)]
pub(crate) fn navier_stokes_residual(
    u: impl Fn([f64; 3], f64) -> [f64; 3],
    p: impl Fn([f64; 3], f64) -> f64,
    nu: f64,
    density: f64,
    x: [f64; 3],
    t: f64,
) -> ([f64; 3], f64) {
    let h = 1e-3;
    let shift = |axis: usize, by: f64| {
        let mut y = x;
        y[axis] += by;
        y
    };
    let here = u(x, t);
    let mut residual = [0.0; 3];
    let mut divergence = 0.0;
    for a in 0..3 {
        residual[a] = (u(x, t + h)[a] - u(x, t - h)[a]) / (2.0 * h);
        residual[a] += (p(shift(a, h), t) - p(shift(a, -h), t)) / (2.0 * h * density);
        divergence += (u(shift(a, h), t)[a] - u(shift(a, -h), t)[a]) / (2.0 * h);
        for b in 0..3 {
            let (plus, minus) = (u(shift(b, h), t)[a], u(shift(b, -h), t)[a]);
            residual[a] +=
                here[b] * (plus - minus) / (2.0 * h) - nu * (plus - 2.0 * here[a] + minus) / (h * h);
        }
    }
    (residual, divergence)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference_values::{Input, find};

    #[test]
    fn ode_residual_in_three_planes_with_mean_flow() {
        for plane in [Plane::Xy, Plane::Yz, Plane::Zx] {
            let flow = TaylorGreen2d {
                plane,
                amplitude: 0.7,
                wave_numbers: [1.0, 1.5],
                nu: 0.2,
                density: 1.3,
                mean_flow: [0.3, -0.2, 0.1],
            };
            let (residual, divergence) = navier_stokes_residual(
                |x, t| flow.velocity(x, t),
                |x, t| flow.pressure(x, t),
                flow.nu,
                flow.density,
                [0.4, 1.1, -0.6],
                0.3,
            );
            // Truncation h²/6 of third derivatives, all below 10.
            assert!(residual.iter().all(|r| r.abs() < 1e-5) && divergence.abs() < 1e-5, "{residual:?}");
        }
    }

    #[test]
    fn three_dimensional_pressure_solves_its_poisson_equation() {
        let flow = TaylorGreen3d { amplitude: 0.7, wave_number: 1.2, density: 1.3 };
        let (x, h) = ([0.4, 1.1, -0.6], 1e-3);
        let shift = |axis: usize, by: f64| {
            let mut y = x;
            y[axis] += by;
            y
        };
        let (mut laplacian, mut source) = (0.0, 0.0);
        let gradient =
            |a: usize, b: usize| (flow.velocity(shift(b, h))[a] - flow.velocity(shift(b, -h))[a]) / (2.0 * h);
        for a in 0..3 {
            laplacian +=
                (flow.pressure(shift(a, h)) - 2.0 * flow.pressure(x) + flow.pressure(shift(a, -h))) / (h * h);
            for b in 0..3 {
                source -= flow.density * gradient(a, b) * gradient(b, a);
            }
        }
        // Truncation h²/12 of fourth derivatives, below 30, and 4 ulp/h² of rounding.
        assert!((laplacian - source).abs() < 1e-5, "{laplacian} {source}");
    }

    #[test]
    fn reference_initial_energy() {
        let entry = find("tgv3d_E_Z", &[("Re", Input::Number(20.0)), ("t", Input::Number(0.0))]).unwrap();
        let flow = TaylorGreen3d { amplitude: 1.0, wave_number: 1.0, density: 1.0 };
        assert!((flow.initial_energy() / entry.field("E").unwrap() - 1.0).abs() < entry.tolerance());
        let n = 8;
        let at = |i: usize| core::f64::consts::TAU * i as f64 / n as f64;
        let mut mean = 0.0;
        for i in 0..n * n * n {
            let u = flow.velocity([at(i % n), at(i / n % n), at(i / (n * n))]);
            mean += 0.5 * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]) / (n * n * n) as f64;
        }
        // The rectangle rule is exact for these waves; 512 roundings.
        assert!((mean - flow.initial_energy()).abs() < 1e-14);
    }
}
