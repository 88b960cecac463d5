//! Lubrication between two unequal spheres: the terms that grow without bound as the gap closes.
//!
//! Spheres of radii a and b, s = a + b, gap h between the surfaces, d the unit vector from 1 to 2. Lubrication holds for
//! h ≪ ab/s; what is dropped stays bounded, so relative errors are of order h (normal) and 1/ln (tangential).

use core::f64::consts::PI;

use super::super::ExactError;

/// Two spheres near contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    a: f64,
    b: f64,
    gap: f64,
}

/// Coefficients of the tangential terms, to be multiplied by πμ ln(s/2h).
///
/// With t the part across d: F₁ = −πμ L \[force (U₁ − U₂)_t + turn.0 ω₁×d + turn.1 ω₂×d\], F₂ = −F₁;
/// T₁ = −πμ L \[turn.0 d×(U₁ − U₂) + own.0 ω₁ₜ + cross ω₂ₜ\], T₂ = −πμ L \[turn.1 d×(U₁ − U₂) + cross ω₁ₜ + own.1 ω₂ₜ\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangential {
    /// (8/5) ab(2a² + ab + 2b²)/s³.
    pub force: f64,
    /// (4/5) a²b(4a + b)/s² and (4/5) ab²(a + 4b)/s².
    pub turn: (f64, f64),
    /// (16/5) a³b/s and (16/5) ab³/s.
    pub own: (f64, f64),
    /// (4/5) a²b²/s.
    pub cross: f64,
}

impl Pair {
    /// Radii and gap, one unit of length.
    ///
    /// # Errors
    /// `Argument` if one is not positive, or the gap exceeds half the smaller radius.
    pub fn new(a: f64, b: f64, gap: f64) -> Result<Self, ExactError> {
        ExactError::positive("a", a)?;
        ExactError::positive("b", b)?;
        ExactError::positive("gap", gap)?;
        super::within("gap", gap, 0.0, 0.5 * a.min(b), "must not exceed half the smaller radius")?;
        Ok(Self { a, b, gap })
    }

    /// Normal force of approach over μ times the speed of approach, leading term 6π (ab/s)²/h.
    ///
    /// # Source
    /// Reynolds 1886 (Taylor); Kim & Karrila, *Microhydrodynamics*, §9.2. For equal spheres (3/2)πa²/h.
    pub fn normal(&self) -> f64 {
        let reduced = self.a * self.b / (self.a + self.b);
        6.0 * PI * reduced * reduced / self.gap
    }

    /// The two terms that follow [`Self::normal`], from the same expansion: 6π \[ab(a² + 7ab + b²)/(5s³) ln(s/2h)
    /// + (a⁴ + 18a³b − 29a²b² + 18ab³ + b⁴)/(42s³) (2h/s) ln(s/2h)\].
    ///
    /// # Source
    /// Jeffrey & Onishi 1984, J. Fluid Mech. 139, 261-290, doi 10.1017/S0022112084000355, g₂ and g₃ of X11A (from
    /// memory; confirmed for equal spheres and for a wall by the exact series).
    pub fn normal_next(&self) -> f64 {
        let (a, b) = (self.a, self.b);
        let (s, xi) = (a + b, 2.0 * self.gap / (a + b));
        let log = libm::log(1.0 / xi);
        let second = a * b * (a * a + 7.0 * a * b + b * b) / 5.0;
        let (a2, b2) = (a * a, b * b);
        let third = (a2 * a2 + 18.0 * a2 * a * b - 29.0 * a2 * b2 + 18.0 * a * b2 * b + b2 * b2) / 42.0;
        6.0 * PI * (second + third * xi) * log / (s * s * s)
    }

    /// L = ln(s/2h) of the tangential terms.
    pub fn logarithm(&self) -> f64 {
        libm::log(0.5 * (self.a + self.b) / self.gap)
    }

    /// Coefficients of the tangential terms.
    ///
    /// # Source
    /// Jeffrey & Onishi 1984 (leading terms of YA, YB, YC; also Kim & Karrila, ch. 11, from memory); the tests check
    /// that a rigid motion of the pair is free of them and that the limit of a wall is that of Goldman, Cox & Brenner.
    pub fn tangential(&self) -> Tangential {
        let (a, b) = (self.a, self.b);
        let s = a + b;
        Tangential {
            force: 1.6 * a * b * (2.0 * a * a + a * b + 2.0 * b * b) / (s * s * s),
            turn: (0.8 * a * a * b * (4.0 * a + b) / (s * s), 0.8 * a * b * b * (a + 4.0 * b) / (s * s)),
            own: (3.2 * a * a * a * b / s, 3.2 * a * b * b * b / s),
            cross: 0.8 * a * a * b * b / s,
        }
    }
}

/// Force of lubrication between two spheres as a solver should *add* it: leading normal term less its value at the
/// cut-off h_c, zero beyond: 6πμ (ab/s)² (1/h − 1/h_c).
///
/// # Arguments
/// `pair`; `cut_off`: h_c, positive. Returns force over μ times the speed of approach.
/// # Errors
/// `Argument` if the cut-off is not positive.
/// # Source
/// The law of the coupled method with its missing π restored (Nguyen & Ladd 2002, Phys. Rev. E 66, 046708).
pub fn added_normal(pair: &Pair, cut_off: f64) -> Result<f64, ExactError> {
    ExactError::positive("cut_off", cut_off)?;
    Ok(if pair.gap < cut_off { pair.normal() * (1.0 - pair.gap / cut_off) } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::super::two_spheres::approaching;
    use super::super::walls::{normal_to_wall, parallel_to_wall_contact};
    use super::*;

    #[test]
    fn exact_reynolds_equation() {
        // Squeeze film H = h + ρ²/2R between paraboloids: the flux πρ²U gives dp/dρ = −6μUρ/H³, the force is
        // ∫ πρ² (−dp/dρ) dρ. With ρ = √(2Rh) tan θ the midpoint rule sees a smooth function.
        let (a, b, h) = (1.0, 2.0, 0.01);
        let reduced = a * b / (a + b);
        let length = libm::sqrt(2.0 * reduced * h);
        let steps = 2000;
        let step = 0.5 * PI / f64::from(steps);
        let mut force = 0.0;
        for i in 0..steps {
            let theta = (f64::from(i) + 0.5) * step;
            let (cos, tan) = (libm::cos(theta), libm::tan(theta));
            let rho = length * tan;
            let height = h + 0.5 * rho * rho / reduced;
            let slope = 6.0 * rho / (height * height * height);
            force += PI * rho * rho * slope * length / (cos * cos) * step;
        }
        // Midpoint rule: step²/24 times the difference of the end slopes, below 1e-6.
        assert!((Pair::new(a, b, h).unwrap().normal() / force - 1.0).abs() < 1e-6);
    }

    #[test]
    fn limit_of_the_exact_series() {
        for h in [1e-3, 1e-4] {
            let pair = Pair::new(1.0, 1.0, h).unwrap();
            // Each sphere moves with half the speed of approach.
            let exact = approaching(h).unwrap() * 6.0 * PI * 0.5;
            let known = pair.normal() + pair.normal_next();
            // What is left is the constant 1.34558.
            assert!(((exact - known) / (3.0 * PI) - 1.34558).abs() < 5.0 * h, "{h}");
            // A wall is a sphere of radius 1e9.
            let wall = Pair::new(1.0, 1e9, h).unwrap();
            let left = normal_to_wall(h).unwrap() - (wall.normal() + wall.normal_next()) / (6.0 * PI);
            // Constant 0.971280, and the logarithm of s/2h = 5e8/h where the series has 1/h: the coefficients differ.
            let shift = 0.2 * libm::log(5e8) + 2e-9 * h;
            assert!((left + shift - 0.971_28).abs() < 5.0 * h + 1e-4, "{h} {left}");
        }
    }

    #[test]
    fn limit_wall_tangential() {
        let t = Pair::new(1.0, 1e8, 0.01).unwrap().tangential();
        let per_log = |gap: f64| parallel_to_wall_contact(gap).unwrap();
        let (one, two) = (per_log(1e-3), per_log(1e-4));
        let log = libm::log(10.0);
        assert!((PI * t.force / (6.0 * PI) - (two.force - one.force) / log).abs() < 1e-7);
        assert!((t.turn.0 / 8.0 - (two.coupling - one.coupling) / log).abs() < 1e-7);
        assert!((t.own.0 / 8.0 - (two.torque - one.torque) / log).abs() < 1e-7);
    }

    #[test]
    fn conserves_nothing_to_resist_in_rigid_motion() {
        for (a, b) in [(1.0, 1.0), (1.0, 3.0), (2.0, 0.3)] {
            let t = Pair::new(a, b, 0.01).unwrap().tangential();
            // U₁ − U₂ = −s ω×d, both turning with ω: forces and torques cancel, to roundings.
            let s = a + b;
            assert!((t.force * s - t.turn.0 - t.turn.1).abs() < 1e-14 * t.force * s);
            assert!((t.turn.0 * s - t.own.0 - t.cross).abs() < 1e-14 * t.own.0.max(t.cross) * 4.0);
            assert!((t.turn.1 * s - t.own.1 - t.cross).abs() < 1e-14 * t.own.1.max(t.cross) * 4.0);
        }
    }

    #[test]
    fn cut_off_is_continuous() {
        let at = |h| added_normal(&Pair::new(1.0, 1.0, h).unwrap(), 0.1).unwrap();
        assert!(at(0.1) == 0.0 && at(0.2) == 0.0 && at(0.099_999_9) < 1e-4);
        assert!((at(0.05) - 1.5 * PI * (20.0 - 10.0)).abs() < 1e-12);
        assert!(Pair::new(1.0, 1.0, 0.6).is_err() && Pair::new(-1.0, 1.0, 0.1).is_err());
    }
}
