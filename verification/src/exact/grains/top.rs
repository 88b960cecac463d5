//! The free asymmetric top by elliptic functions.

use super::V3;

/// Complete elliptic integral of the first kind, parameter m = k², by the arithmetic–geometric mean; 0 ≤ m < 1.
pub fn elliptic_k(m: f64) -> f64 {
    let (mut a, mut g) = (1.0, (1.0 - m).sqrt());
    // Quadratic convergence: eight rounds serve every m below 1 − 1e-16.
    for _ in 0..8 {
        (a, g) = (0.5 * (a + g), (a * g).sqrt());
    }
    core::f64::consts::FRAC_PI_2 / a
}

/// Jacobi's sn, cn and dn of argument `u` and parameter m, 0 ≤ m < 1, by descending Landen transformations.
///
/// # Source
/// Abramowitz & Stegun 16.4.
pub fn jacobi(u: f64, m: f64) -> (f64, f64, f64) {
    const ROUNDS: usize = 8;
    let (mut a, mut c) = ([1.0; ROUNDS + 1], [m.sqrt(); ROUNDS + 1]);
    let mut b = (1.0 - m).sqrt();
    for n in 0..ROUNDS {
        a[n + 1] = 0.5 * (a[n] + b);
        c[n + 1] = 0.5 * (a[n] - b);
        b = (a[n] * b).sqrt();
    }
    let mut phi = a[ROUNDS] * u * (1u32 << ROUNDS) as f64;
    for n in (1..=ROUNDS).rev() {
        phi = 0.5 * (phi + libm::asin(c[n] / a[n] * libm::sin(phi)));
    }
    let sn = libm::sin(phi);
    (sn, libm::cos(phi), (1.0 - m * sn * sn).sqrt())
}

/// A free top in its principal frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Top {
    /// Parameter m of the elliptic functions.
    pub parameter: f64,
    /// Their argument per second.
    pub rate: f64,
    /// Largest spin about the intermediate axis, rad/s.
    pub amplitude: f64,
}

impl Top {
    /// From ascending principal moments and the spin in the principal frame at some time.
    ///
    /// With L² > 2 E I₂ the spin about the middle axis is ω₂ = amplitude · sn(rate t, m); otherwise the outer axes
    /// change places.
    ///
    /// # Source
    /// Landau & Lifshitz, Mechanics, §37.
    pub fn new(i: V3, w: V3) -> Self {
        let l2 = (0..3).map(|k| i[k] * i[k] * w[k] * w[k]).sum::<f64>();
        let e2 = (0..3).map(|k| i[k] * w[k] * w[k]).sum::<f64>();
        let (i1, i2, i3) = if l2 > e2 * i[1] { (i[0], i[1], i[2]) } else { (i[2], i[1], i[0]) };
        Self {
            parameter: (i2 - i1) * (e2 * i3 - l2) / ((i3 - i2) * (l2 - e2 * i1)),
            rate: ((i3 - i2) * (l2 - e2 * i1) / (i1 * i2 * i3)).sqrt(),
            amplitude: ((e2 * i3 - l2) / (i2 * (i3 - i2))).sqrt(),
        }
    }

    /// Period of the spin in the principal frame, 4 K(m)/rate, s; the middle component changes sign twice in it.
    pub fn period(&self) -> f64 {
        4.0 * elliptic_k(self.parameter) / self.rate
    }

    /// Spin about the intermediate axis, rad/s, a time `t` after it rose through zero.
    pub fn middle_spin(&self, t: f64) -> f64 {
        self.amplitude * jacobi(self.rate * t, self.parameter).0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// K(½) = Γ(¼)²/(4√π); sn(K) = 1; near m = 1 the functions are hyperbolic.
    #[test]
    fn exact_elliptic() {
        let quarter = libm::tgamma(0.25);
        let exact = quarter * quarter / (4.0 * core::f64::consts::PI.sqrt());
        assert!((elliptic_k(0.5) / exact - 1.0).abs() < 1e-15);
        for m in [0.1, 0.5, 0.99, 0.999_999] {
            let k = elliptic_k(m);
            let (sn, cn, dn) = jacobi(k, m);
            assert!((sn - 1.0).abs() < 1e-12 && cn.abs() < 1e-6 && (dn - (1.0 - m).sqrt()).abs() < 1e-12);
            let (sn, cn, _) = jacobi(0.7, m);
            assert!((sn * sn + cn * cn - 1.0).abs() < 1e-14);
        }
        assert!((jacobi(0.7, 1.0 - 1e-12).0 - libm::tanh(0.7)).abs() < 1e-11);
        assert!((jacobi(0.7, 0.0).0 - libm::sin(0.7)).abs() < 1e-14);
    }

    /// Euler's equations integrated by a fourth-order rule: the middle spin returns after a period. Error h⁴.
    #[test]
    fn exact_period_of_euler_equations() {
        let i = [1.0, 1.7, 2.2];
        let rate = |w: V3| {
            [
                (i[1] - i[2]) / i[0] * w[1] * w[2],
                (i[2] - i[0]) / i[1] * w[2] * w[0],
                (i[0] - i[1]) / i[2] * w[0] * w[1],
            ]
        };
        for start in [[0.3, 0.0, 1.0], [1.0, 0.0, 0.2]] {
            let top = Top::new(i, start);
            let n = 4000;
            let h = top.period() / f64::from(n);
            let mut w = start;
            let mut worst = 0.0f64;
            let rising = rate(w)[1] > 0.0;
            for k in 1..=n {
                let add = |k: V3, s: f64| [0, 1, 2].map(|j| w[j] + s * k[j]);
                let k1 = rate(w);
                let k2 = rate(add(k1, 0.5 * h));
                let k3 = rate(add(k2, 0.5 * h));
                let k4 = rate(add(k3, h));
                w = [0, 1, 2].map(|j| w[j] + h / 6.0 * (k1[j] + 2.0 * (k2[j] + k3[j]) + k4[j]));
                let exact = top.middle_spin(f64::from(k) * h);
                worst = worst.max((w[1] - if rising { exact } else { -exact }).abs());
            }
            assert!(worst < 1e-10, "{worst}");
            assert!((0..3).all(|j| (w[j] - start[j]).abs() < 1e-10));
        }
    }
}
