//! Closed forms of a head-on collision, for choosing parameters and for checking runs.
//!
//! Two conventions are in use: the contact ends when the force would become attractive (`cut_off`, what this
//! code does), or when the overlap returns to zero (`textbook`, attraction included).

const PI: f64 = std::f64::consts::PI;

/// Hertz: t_c = this × (m*² / (E*² R* v))^{1/5}.
pub(crate) const CONTACT_TIME_MASS: f64 = 2.868_265_699_2;

/// Duration of an elastic Hertz collision, s.
pub(crate) fn hertz_contact_time(mass: f64, young: f64, radius: f64, speed: f64) -> f64 {
    CONTACT_TIME_MASS * libm::pow(mass * mass / (young * young * radius * speed), 0.2)
}

/// Largest overlap of an elastic Hertz collision, (15 m* v² / (16 E* √R*))^{2/5}, m.
pub(crate) fn hertz_largest_overlap(mass: f64, young: f64, radius: f64, speed: f64) -> f64 {
    libm::pow(15.0 * mass * speed * speed / (16.0 * young * radius.sqrt()), 0.4)
}

/// Restitution of a linear oscillator with damping ratio `b`, contact ending at zero overlap.
pub fn textbook(b: f64) -> f64 {
    if b >= 1.0 { 0.0 } else { libm::exp(-PI * b / (1.0 - b * b).sqrt()) }
}

/// Restitution of a linear oscillator with damping ratio `b`, contact ending at zero force.
///
/// e = exp(−b s), tan(w s) = −2 b w/(1 − 2b²), w = √(1 − b²) (Schwager & Pöschel 2007). Tsuji's law is the same
/// oscillator in the variable δ^{5/4} with b = α/√5, so the formula serves both laws.
pub(crate) fn cut_off(b: f64) -> f64 {
    if b < 1.0 {
        let w = (1.0 - b * b).sqrt();
        libm::exp(-b / w * (PI - libm::atan2(2.0 * b * w, 1.0 - 2.0 * b * b)))
    } else if b == 1.0 {
        libm::exp(-2.0)
    } else if b < 1e4 {
        let w = (b * b - 1.0).sqrt();
        libm::exp(-b / w * libm::log((b + w) / (b - w)))
    } else {
        // The difference has lost its digits, and 1/(b + w) is what it should be.
        let w = (b * b - 1.0).sqrt();
        libm::exp(-2.0 * b / w * libm::log(b + w))
    }
}

/// Damping ratio of the linear law that gives restitution `e` (0 < e ≤ 1) with attraction cut off.
pub fn linear_damping_ratio(e: f64) -> f64 {
    if e >= 1.0 {
        return 0.0;
    }
    // e falls monotonically with b, like 1/(4 b^2) for large b.
    let (mut low, mut high) = (0.0, 2.0 + 1.0 / e);
    for _ in 0..200 {
        let b = 0.5 * (low + high);
        if cut_off(b) > e { low = b } else { high = b }
    }
    0.5 * (low + high)
}

/// α of Tsuji's law that gives restitution `e` (0 < e ≤ 1) with attraction cut off.
pub(crate) fn tsuji_alpha(e: f64) -> f64 {
    5f64.sqrt() * linear_damping_ratio(e)
}

/// Restitution (cut off, textbook) of the visco-elastic law with the dimensionless damping
/// a = A (k/m*)^{2/5} v^{1/5}, by integrating ẍ = −x^{3/2} − (3/2) a √x ẋ from x = 0, ẋ = 1.
///
/// Runge–Kutta of fourth order with steps that shrink like √x towards the ends, where √x is not smooth; `steps`
/// steps per unit of time at most, error below 2e-7 at 4000.
pub(crate) fn visco_elastic(a: f64, steps: u32) -> (f64, f64) {
    fall(a, steps, false)
}

/// As [`visco_elastic`]; `only_cut_off` ends at zero force and gives that value twice.
fn fall(a: f64, steps: u32, only_cut_off: bool) -> (f64, f64) {
    let f = |x: f64, v: f64| {
        let r = if x > 0.0 { x.sqrt() } else { 0.0 };
        -(x * r) - 1.5 * a * r * v
    };
    // Graded steps near the ends, where sqrt(x) is not smooth: h ~ sqrt(x).
    let (mut x, mut v, mut stop) = (0.0f64, 1.0f64, None);
    let base = 1.0 / f64::from(steps);
    // Start: v = 1 - a x^{3/2} + O(x^{5/2}), exact enough at x = 1e-9.
    x += 1e-9;
    v -= a * x * x.sqrt();
    loop {
        let h = base * x.sqrt().clamp(1e-5, 1.0);
        let (k1, l1) = (v, f(x, v));
        let (k2, l2) = (v + 0.5 * h * l1, f(x + 0.5 * h * k1, v + 0.5 * h * l1));
        let (k3, l3) = (v + 0.5 * h * l2, f(x + 0.5 * h * k2, v + 0.5 * h * l2));
        let (k4, l4) = (v + h * l3, f(x + h * k3, v + h * l3));
        let (x1, v1) = (x + h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4), v + h / 6.0 * (l1 + 2.0 * (l2 + l3) + l4));
        if stop.is_none() && v1 < 0.0 && x1 > 0.0 && f(x1, v1) >= 0.0 {
            // Interpolate to zero force: the velocity is stationary there, so linear is enough.
            let e = -v1.min(v);
            if only_cut_off {
                return (e, e);
            }
            stop = Some(e);
        }
        // Strong damping creeps to zero overlap without end: the rest cannot change either result.
        if let (Some(e), true) = (stop, x1 > 0.0 && x1 < 1e-6) {
            return (e, -v1);
        }
        if x1 <= 0.0 {
            let share = x / (x - x1);
            let at_zero = -(v + share * (v1 - v));
            return (stop.unwrap_or(at_zero), at_zero);
        }
        (x, v) = (x1, v1);
    }
}

/// Dissipative constant A (s) of the visco-elastic law that gives restitution `e` (0 < e < 1) at impact speed
/// `speed`, for effective mass `mass` and Hertz stiffness k = (4/3) E* √R*.
pub fn dissipative_constant(e: f64, speed: f64, mass: f64, stiffness: f64) -> f64 {
    // e falls monotonically with a; it is below 1e-3 at a = 100.
    let (mut low, mut high) = (0.0, 100.0);
    for _ in 0..60 {
        let a = 0.5 * (low + high);
        if fall(a, 1000, true).0 > e { low = a } else { high = a }
    }
    0.5 * (low + high) / (libm::pow(stiffness / mass, 0.4) * libm::pow(speed, 0.2))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// reference_values.json: restitution_tsuji_alpha0.1, 0.6 (7 digits given).
    #[test]
    fn reference_tsuji_closed_forms() {
        for (alpha, book, cut) in [(0.1, 0.868_804_629, 0.872_291_467), (0.6, 0.416_833_397, 0.484_938_946)] {
            let b = alpha / 5f64.sqrt();
            assert!((textbook(b) - book).abs() < 1e-8);
            assert!((cut_off(b) - cut).abs() < 1e-8);
        }
    }

    /// reference_values.json: restitution_viscoelastic_F0_A0.05, A0.2.
    #[test]
    fn reference_visco_elastic_integral() {
        for (a, cut, book) in [(0.05, 0.918_132_856, 0.917_771_502), (0.2, 0.722_085_44, 0.714_044_881)] {
            let (c, b) = visco_elastic(a, 4000);
            assert!((c - cut).abs() < 2e-7, "{c} {cut}");
            assert!((b - book).abs() < 2e-7, "{b} {book}");
        }
    }

    /// The constant found gives the restitution asked for, weak and strong damping.
    #[test]
    fn exact_dissipative_constant() {
        let (m, k, v) = (1e-3f64, 1e8f64, 0.3f64);
        for e in [0.9, 0.5, 0.1] {
            let a = dissipative_constant(e, v, m, k) * libm::pow(k / m, 0.4) * libm::pow(v, 0.2);
            assert!((fall(a, 4000, true).0 - e).abs() < 1e-5);
        }
    }

    /// Inverse of `cut_off`, over-damped side included.
    #[test]
    fn exact_inverse_of_restitution() {
        for e in [1e-20, 1e-9, 1e-6, 1e-3, 0.05, 0.135, 0.2, 0.5, 0.9, 0.999, 1.0] {
            // Digits that (b + w)/(b − w) loses, 1e-16 b², up to b = 1e4.
            assert!((cut_off(linear_damping_ratio(e)) - e).abs() < 1e-12);
            assert!((cut_off(linear_damping_ratio(e)) / e - 1.0).abs() < 1e-7, "{e}");
        }
    }
}
