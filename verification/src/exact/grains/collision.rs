//! One head-on collision: Hertz, and restitution under the damping laws.
//!
//! Two conventions of restitution are in use. With the force cut off below zero the contact ends when the force
//! would begin to attract; in textbooks it ends at zero overlap, attraction included. [`Restitution`] has both.

use super::V3;
use core::f64::consts::PI;

/// Restitution under the two conventions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Restitution {
    /// Force never negative.
    pub cut_off: f64,
    /// Contact until the overlap is zero again, attraction included.
    pub textbook: f64,
}

/// Largest overlap of an elastic Hertz collision with F = k δ^{3/2}: δ = (5 m v²/(4 k))^{2/5}.
///
/// From ½ m v² = (2/5) k δ^{5/2}.
///
/// # Arguments
/// `mass`: m* (kg); `stiffness`: k = (4/3) E* √R* (N/m^{3/2}); `speed`: v (m/s); all above zero.
pub fn hertz_overlap(mass: f64, stiffness: f64, speed: f64) -> f64 {
    libm::pow(1.25 * mass * speed * speed / stiffness, 0.4)
}

/// Duration of an elastic Hertz collision, t_c = (4/5) √π Γ(2/5)/Γ(9/10) δ_max/v.
///
/// The Beta integral 2 ∫₀¹ dy/√(1 − y^{5/2}).
///
/// # Arguments
/// As in [`hertz_overlap`].
/// # Source
/// Landau & Lifshitz, Theory of Elasticity, §9 problem 1.
pub fn hertz_time(mass: f64, stiffness: f64, speed: f64) -> f64 {
    let beta = 0.8 * PI.sqrt() * libm::tgamma(0.4) / libm::tgamma(0.9);
    beta * hertz_overlap(mass, stiffness, speed) / speed
}

/// Largest force of an elastic Hertz collision, N.
pub fn hertz_force(mass: f64, stiffness: f64, speed: f64) -> f64 {
    let depth = hertz_overlap(mass, stiffness, speed);
    stiffness * depth * depth.sqrt()
}

/// Stiffness k = (4/3) E* √R* of two spheres, or of a sphere and a plane (`radii.1` infinite), of one material.
pub fn hertz_stiffness(young: f64, poisson: f64, radii: (f64, f64)) -> f64 {
    let effective_young = young / (2.0 * (1.0 - poisson * poisson));
    let effective_radius = 1.0 / (1.0 / radii.0 + 1.0 / radii.1);
    4.0 / 3.0 * effective_young * effective_radius.sqrt()
}

/// Restitution of the damped linear oscillator ÿ + 2 b ẏ + y = 0 from y = 0, ẏ = 1, and of Tsuji's law, which is
/// the same oscillator in y = δ^{5/4} with b = α/√5.
///
/// The path is y = e^{−bs} sin(ws)/w, w² = 1 − b²; the contact ends where y + 2 b ẏ = 0, or at ws = π. Above
/// b = 1 the functions are hyperbolic, and the overlap never returns to zero.
///
/// # Source
/// Schwager & Pöschel 2007, Granul. Matter 9, 465; Tsuji, Tanaka & Ishida 1992, Powder Technol. 71, 239.
pub fn oscillator(b: f64) -> Restitution {
    if b == 0.0 {
        return Restitution { cut_off: 1.0, textbook: 1.0 };
    }
    let w = (1.0 - b * b).abs().sqrt();
    if b < 1.0 {
        let angle = PI - libm::atan2(2.0 * b * w, 1.0 - 2.0 * b * b);
        let speed = libm::exp(-b * angle / w) * (libm::cos(angle) - b / w * libm::sin(angle));
        Restitution { cut_off: -speed, textbook: libm::exp(-PI * b / w) }
    } else if b == 1.0 {
        // y = s e^{−s}; force zero at s = 2.
        Restitution { cut_off: libm::exp(-2.0), textbook: 0.0 }
    } else {
        let angle = libm::atanh(2.0 * b * w / (2.0 * b * b - 1.0));
        let speed = libm::exp(-b * angle / w) * (libm::cosh(angle) - b / w * libm::sinh(angle));
        Restitution { cut_off: -speed, textbook: 0.0 }
    }
}

/// Restitution of the visco-elastic law with dimensionless damping a = A (k/m)^{2/5} v^{1/5}.
///
/// ẍ = −x^{3/2} − (3/2) a √x ẋ from x = 0, ẋ = 1. With x = w² and dt = 2 w dσ this is the polynomial system
/// w′ = ẋ, ẋ′ = −w² (2 w² + 3 a ẋ), smooth everywhere, which the classical Runge–Kutta rule with step 1e-3
/// integrates to about 1e-13.
///
/// # Arguments
/// `a`: 0 ≤ a ≤ 1 (beyond, the overlap hardly returns to zero).
/// # Source
/// Brilliantov, Spahn, Hertzsch & Pöschel 1996, Phys. Rev. E 53, 5382; Schwager & Pöschel 2008, Phys. Rev. E 78,
/// 051304 (the force cut off).
pub fn visco_elastic(a: f64) -> Restitution {
    visco_elastic_collision(a).0
}

/// Restitution of [`visco_elastic`] and the time, in units of (m/k)^{2/5} v^{−1/5}, from first touch until the overlap is zero
/// again under the first convention (free flight once the force is zero).
pub fn visco_elastic_collision(a: f64) -> (Restitution, f64) {
    /// Step in σ.
    const STEP: f64 = 1e-3;
    let rate = |[w, v, _]: V3| [v, -w * w * (2.0 * w * w + 3.0 * a * v), 2.0 * w];
    let step = |y: V3, h: f64| {
        let along = |k: V3, s: f64| [0, 1, 2].map(|i| y[i] + s * k[i]);
        let k1 = rate(y);
        let k2 = rate(along(k1, 0.5 * h));
        let k3 = rate(along(k2, 0.5 * h));
        let k4 = rate(along(k3, h));
        [0, 1, 2].map(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
    };
    // The place inside a step where `sign` turns negative, by bisection.
    let locate = |y: V3, sign: &dyn Fn(V3) -> f64| {
        let (mut low, mut high) = (0.0, STEP);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if sign(step(y, middle)) > 0.0 { low = middle } else { high = middle }
        }
        step(y, low)
    };
    let force = |[w, v, _]: V3| 2.0 * w * w + 3.0 * a * v;
    let overlap = |[w, _, _]: V3| w;
    let mut y = step([0.0, 1.0, 0.0], STEP);
    let mut cut_off = None;
    loop {
        let next = step(y, STEP);
        if cut_off.is_none() && next[1] < 0.0 && force(next) <= 0.0 {
            let [w, v, t] = locate(y, &force);
            cut_off = Some((-v, t - w * w / v));
        }
        if overlap(next) <= 0.0 {
            let [_, v, t] = locate(y, &overlap);
            let (e, duration) = cut_off.unwrap_or((-v, t));
            return (Restitution { cut_off: e, textbook: -v }, duration);
        }
        y = next;
    }
}

/// Speed of the last ball and of the first after an elastic head-on collision of masses `m` (moving at `v`) and
/// `n` (at rest): ((m − n) v/(m + n), 2 m v/(m + n)).
pub fn elastic_speeds(m: f64, n: f64, v: f64) -> (f64, f64) {
    ((m - n) * v / (m + n), 2.0 * m * v / (m + n))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::quadrature::tanh_sinh;
    use crate::reference_values::find;

    /// The printed digits of the table.
    #[test]
    fn reference_hertz() {
        let (r, young, poisson) = (5e-3, 70e9, 0.22);
        let mass = 0.5 * 2650.0 * 4.0 / 3.0 * PI * r * r * r;
        let k = hertz_stiffness(young, poisson, (r, r));
        let entry = find("hertz_example_glass_5mm", &[]).unwrap();
        for (key, value) in [
            ("delta_max", hertz_overlap(mass, k, 1.0)),
            ("tc", hertz_time(mass, k, 1.0)),
            ("Fmax", hertz_force(mass, k, 1.0)),
        ] {
            assert!((value / entry.field(key).unwrap() - 1.0).abs() < entry.tolerance(), "{key} {value}");
        }
        let coefficient = find("hertz_tc_coeff", &[]).unwrap();
        let (t, depth) = (hertz_time(mass, k, 3.0), hertz_overlap(mass, k, 3.0));
        assert!((t * 3.0 / depth / coefficient.number().unwrap() - 1.0).abs() < coefficient.tolerance());
    }

    /// The Beta integral by quadrature, 1e-12 its own accuracy with the singular end.
    #[test]
    fn exact_hertz_time_integral() {
        // y = 1 - z²: the end singularity 1/√(1−y) goes into the substitution.
        let integral = tanh_sinh(0.0, 1.0, |z| 2.0 * z / (-libm::expm1(2.5 * libm::log1p(-z * z))).sqrt());
        assert!((2.0 * integral / hertz_time(1.0, 1.25, 1.0) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn reference_restitution() {
        for (name, a) in
            [("restitution_viscoelastic_F0_A0.05", 0.05), ("restitution_viscoelastic_F0_A0.2", 0.2)]
        {
            let (entry, e) = (find(name, &[]).unwrap(), visco_elastic(a));
            assert!((e.cut_off - entry.field("e_F0").unwrap()).abs() < 2.0 * entry.tolerance(), "{e:?}");
            assert!((e.textbook - entry.field("e_x0").unwrap()).abs() < 2.0 * entry.tolerance(), "{e:?}");
        }
        for (name, alpha) in [("restitution_tsuji_alpha0.1", 0.1), ("restitution_tsuji_alpha0.6", 0.6)] {
            let (entry, e) = (find(name, &[]).unwrap(), oscillator(alpha / 5f64.sqrt()));
            assert!((e.cut_off - entry.field("e_F0").unwrap()).abs() < entry.tolerance(), "{e:?}");
            assert!((e.textbook - entry.field("e_closed").unwrap()).abs() < entry.tolerance(), "{e:?}");
        }
    }

    /// Without damping the duration is Hertz's.
    #[test]
    fn limit_duration_without_damping() {
        let (e, duration) = visco_elastic_collision(0.0);
        assert!(
            (e.cut_off - 1.0).abs() < 1e-12 && (duration / hertz_time(1.0, 1.0, 1.0) - 1.0).abs() < 1e-12
        );
    }

    /// Weak damping: e = 1 − C₁ (3a/2) …, C₁ = 1.15344 (Schwager & Pöschel); quadratic term left out.
    #[test]
    fn limit_weak_damping() {
        let a = 1e-4;
        let slope = (1.0 - visco_elastic(a).cut_off) / (1.5 * a);
        assert!((slope / 1.15344 - 1.0).abs() < 5e-4, "{slope}");
        let close = |b: f64| oscillator(b).cut_off;
        // Continuous through critical damping.
        assert!(
            (close(1.0 - 1e-7) - close(1.0)).abs() < 1e-6 && (close(1.0 + 1e-7) - close(1.0)).abs() < 1e-6
        );
    }
}
