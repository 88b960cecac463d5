//! Newtonian start-up in a channel and between walls (series), and a bound on the stopping time of a
//! Bingham channel. Start-up with a yield stress: [`super::viscoplastic_1d`].

use core::f64::consts::PI;

use super::ExactError;

/// Terms until the exponential has decayed below rounding; at t → 0 the series converges as 1/j³.
const MOST_TERMS: u32 = 20_000;

/// Channel |y| ≤ h of a Newtonian fluid at rest, force per volume G switched on at t = 0:
/// u = G(h² − y²)/2μ − (16Gh²/μπ³) Σ_{i odd} (−1)^{(i−1)/2} cos(iπy/2h) e^{−i²π²νt/4h²}/i³.
///
/// # Source
/// Batchelor, *An Introduction to Fluid Dynamics*, §4.3 (the slit instead of the pipe).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonianStartUp {
    /// Dynamic viscosity μ.
    pub mu: f64,
    /// ρ.
    pub density: f64,
    /// h.
    pub half_width: f64,
    /// G.
    pub force: f64,
}

impl NewtonianStartUp {
    /// u(y, t); 0 before t = 0 and on the walls.
    pub fn velocity(&self, y: f64, t: f64) -> f64 {
        let h = self.half_width;
        if t <= 0.0 || y.abs() >= h {
            return 0.0;
        }
        let decay = 0.25 * PI * PI * self.mu / (self.density * h * h);
        let mut sum = 0.0;
        for j in 0..MOST_TERMS {
            let i = f64::from(2 * j + 1);
            let size = libm::exp(-i * i * decay * t) / (i * i * i);
            let wave = libm::cos(0.5 * i * PI * y / h);
            sum += if j % 2 == 0 { size * wave } else { -size * wave };
            if size < 1e-18 {
                break;
            }
        }
        self.force * (0.5 * (h * h - y * y) - 16.0 * h * h / (PI * PI * PI) * sum) / self.mu
    }
}

/// Newtonian fluid at rest between walls, the one at y = H set in motion at U at t = 0:
/// u = Uy/H + (2U/π) Σ_j (−1)^j sin(jπy/H) e^{−j²π²νt/H²}/j.
///
/// # Source
/// Schlichting & Gersten, *Boundary-Layer Theory*, §5.2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CouetteStartUp {
    /// Kinematic viscosity ν.
    pub nu: f64,
    /// H.
    pub gap: f64,
    /// U.
    pub wall_speed: f64,
}

impl CouetteStartUp {
    /// u(y, t) for 0 ≤ y ≤ H, t > 0; rounding accuracy for νt/H² > 1e-7.
    pub fn velocity(&self, y: f64, t: f64) -> f64 {
        let decay = PI * PI * self.nu * t / (self.gap * self.gap);
        let mut sum = 0.0;
        for j in 1..=MOST_TERMS {
            let i = f64::from(j);
            let size = libm::exp(-i * i * decay) / i;
            let wave = libm::sin(i * PI * y / self.gap);
            sum += if j % 2 == 0 { size * wave } else { -size * wave };
            if size < 1e-18 {
                break;
            }
        }
        self.wall_speed * (y / self.gap + 2.0 / PI * sum)
    }
}

/// Upper bound on the time in which a Bingham channel comes to rest under a force G with Gh < σ0:
/// T ≤ (ρ/μλ) ln(1 + μλ‖u₀‖/β), λ = (π/2h)², β = (σ0 − Gh)/√h, ‖u₀‖ = (∫₀^h u₀² dy)^{½}.
///
/// The energy balance ½ρ d‖u‖²/dt = −μ‖u_y‖² − σ0∫|u_y| + G∫u, with λ‖u‖² ≤ ‖u_y‖², |u| ≤ ∫|u_y| and
/// ‖u‖ ≤ √h ∫|u_y|, gives ρ d‖u‖/dt ≤ −μλ‖u‖ − β, which reaches 0 at T.
///
/// # Source
/// The argument of Glowinski, *Numerical Methods for Nonlinear Variational Problems*, ch. II and
/// Huilgol, Mena & Piau 2002, J. Non-Newtonian Fluid Mech. 102, 97-107, with the constants as derived here.
///
/// # Errors
/// `Argument` if Gh ≥ σ0: the fluid need not stop.
pub fn bingham_stopping_bound(
    sigma0: f64,
    mu: f64,
    density: f64,
    half_width: f64,
    force: f64,
    initial_norm: f64,
) -> Result<f64, ExactError> {
    let excess = sigma0 - force.abs() * half_width;
    ExactError::positive("sigma0 - |G| h", excess)?;
    let lambda = 0.25 * PI * PI / (half_width * half_width);
    let beta = excess / half_width.sqrt();
    Ok(density / (mu * lambda) * libm::log1p(mu * lambda * initial_norm / beta))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ode_residual_and_limits() {
        let flow = NewtonianStartUp { mu: 0.3, density: 1.5, half_width: 1.2, force: 0.8 };
        let (y, t, h) = (0.5, 0.4, 1e-3);
        let u = |y, t| flow.velocity(y, t);
        let rate = 1.5 * (u(y, t + h) - u(y, t - h)) / (2.0 * h);
        let bend: f64 = 0.3 * (u(y + h, t) - 2.0 * u(y, t) + u(y - h, t)) / (h * h);
        // Truncation h²/12 of derivatives of order one.
        assert!((rate - 0.8 - bend).abs() < 1e-5);
        // Long after: the parabola. The slowest mode has decayed as e^{−340}.
        assert!((u(0.0, 1000.0) / (0.8 * 1.44 / 0.6) - 1.0).abs() < 1e-15);
        // Long before the walls are felt: Gt/ρ; what they do is of order erfc(h/2√(νt)) < 1e-15.
        assert!((u(0.0, 0.02) / (0.8 * 0.02 / 1.5) - 1.0).abs() < 1e-12);
        assert_eq!(u(0.3, 0.0), 0.0);
    }

    #[test]
    fn couette_ode_residual_and_limits() {
        let flow = CouetteStartUp { nu: 0.2, gap: 1.1, wall_speed: 0.7 };
        let (y, t, h) = (0.5, 0.4, 1e-3);
        let u = |y, t| flow.velocity(y, t);
        let rate = (u(y, t + h) - u(y, t - h)) / (2.0 * h);
        let bend: f64 = 0.2 * (u(y + h, t) - 2.0 * u(y, t) + u(y - h, t)) / (h * h);
        // Truncation h²/12 of derivatives of order ten.
        assert!((rate - bend).abs() < 1e-5);
        // Early: half-space solution U erfc((H − y)/2√(νt)); the far wall's image is below 1e-15.
        let early = 0.7 * libm::erfc((1.1 - 0.9) / (2.0 * libm::sqrt(0.2 * 0.01)));
        assert!((u(0.9, 0.01) / early - 1.0).abs() < 1e-12);
        assert!((u(0.5, 100.0) - 0.7 * 0.5 / 1.1).abs() < 1e-15);
    }

    #[test]
    fn refuses_a_bound_where_nothing_need_stop() {
        assert!(bingham_stopping_bound(0.5, 0.2, 1.0, 1.0, 0.5, 1.0).is_err());
    }
}
