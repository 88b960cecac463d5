//! Stokeslet of a simple cubic lattice (Ewald sum), and how it differs from the free one.
//!
//! Velocity of the fluid due to a unit force at every lattice point, balanced by a uniform body force, mean zero:
//! G = G₀ + R, 8πG₀ = 1/r + rr/r³, R smooth for |d| below the spacing.
//!
//! # Source
//! Hasimoto 1959, J. Fluid Mech. 5, 317-328, doi 10.1017/S0022112059000222; the split of the sum as in Lindbo & Tornberg
//! 2010, J. Comput. Phys. 229, 8994-9010 (from memory; the tests show it to be right).

use core::f64::consts::PI;

/// A vector.
pub type V3 = [f64; 3];

/// Splitting parameter ξ of the Ewald sum, lattice spacing 1: both sums then fall below 1e-13.
const SPLIT: f64 = 3.2;

/// Real-space reach: erfc(ξr) and exp(−ξ²r²) are below 1e-13 beyond.
const REACH: f64 = 1.75;

/// Largest |k|²/4π²: exp(−k²/4ξ²) is below 1e-13 beyond.
const SHELLS: usize = 31;

/// Components 0 to 5 of those reciprocal vectors.
const COMPONENTS: usize = 6;

/// The lattice sums, made once.
pub struct PeriodicStokeslet {
    modes: Vec<Mode>,
}

impl Default for PeriodicStokeslet {
    fn default() -> Self {
        Self::new()
    }
}

impl PeriodicStokeslet {
    /// Prepares the reciprocal vectors.
    #[must_use]
    pub fn new() -> Self {
        Self { modes: modes() }
    }

    /// 8πR(d): periodic Stokeslet less the free one, for |d| < 1 (lattice spacing 1, viscosity 1).
    ///
    /// # Exactness
    /// Absolute error below 1e-12.
    pub fn smooth_part(&self, d: V3) -> [V3; 3] {
        let root = 1.0 / PI.sqrt();
        let mut out = reciprocal_part(d, &self.modes);
        let mut add = |x: V3, isotropic: f64, dyadic: f64| {
            for i in 0..3 {
                for j in 0..3 {
                    out[i][j] += dyadic * x[i] * x[j];
                }
                out[i][i] += isotropic;
            }
        };
        for x in -2..=2_i32 {
            for y in -2..=2_i32 {
                for z in -2..=2_i32 {
                    let at = [d[0] + f64::from(x), d[1] + f64::from(y), d[2] + f64::from(z)];
                    let r2 = dot(at, at);
                    if (x, y, z) != (0, 0, 0) && r2 < REACH * REACH {
                        let r = r2.sqrt();
                        let gauss = 2.0 * SPLIT * root * libm::exp(-SPLIT * SPLIT * r2);
                        let tail = libm::erfc(SPLIT * r) / r;
                        add(at, tail - gauss, (tail + gauss) / r2);
                    }
                }
            }
        }
        // The cell itself: short-range part less the free Stokeslet.
        let r2 = dot(d, d);
        let z = SPLIT * r2.sqrt();
        let gauss = 2.0 * SPLIT * root * libm::exp(-z * z);
        if z > 0.02 {
            let head = -libm::erf(z) * SPLIT / z;
            add(d, head - gauss, (head + gauss) / r2);
        } else {
            // Power series of erf z / z: next terms below 1e-14.
            let z2 = z * z;
            let head = -2.0 * SPLIT * root * (1.0 - z2 / 3.0 + z2 * z2 / 10.0 - z2 * z2 * z2 / 42.0);
            let dyadic = 2.0 * SPLIT * root * SPLIT * SPLIT * (-2.0 / 3.0 + 0.4 * z2 - z2 * z2 / 7.0);
            add(d, head - gauss, dyadic);
        }
        out
    }
}

/// The reciprocal vectors 2π(±x, ±y, ±z) together: their size 8π (1 + k²/4ξ²) e^{−k²/4ξ²}/k² times their number.
struct Mode {
    index: [usize; 3],
    size: f64,
}

/// Length of a reciprocal vector with a component of index n.
fn wave_number(n: usize) -> f64 {
    2.0 * PI * n as f64
}

fn modes() -> Vec<Mode> {
    let mut out = Vec::new();
    for x in 0..COMPONENTS {
        for y in 0..COMPONENTS {
            for z in 0..COMPONENTS {
                let index = [x, y, z];
                let square = x * x + y * y + z * z;
                if square > 0 && square <= SHELLS {
                    let number: f64 = index.iter().map(|&n| if n > 0 { 2.0 } else { 1.0 }).product();
                    let k2 = 4.0 * PI * PI * square as f64;
                    let ratio = k2 / (4.0 * SPLIT * SPLIT);
                    out.push(Mode {
                        index,
                        size: number * 8.0 * PI * (1.0 + ratio) * libm::exp(-ratio) / k2,
                    });
                }
            }
        }
    }
    out
}

/// Σ_k over all reciprocal vectors of size (1 − kk/k²) cos k·d, by products of sines and cosines of each component.
fn reciprocal_part(d: V3, modes: &[Mode]) -> [V3; 3] {
    let mut cos = [[1.0; COMPONENTS]; 3];
    let mut sin = [[0.0; COMPONENTS]; 3];
    for i in 0..3 {
        let angle = 2.0 * PI * d[i];
        let (c, s) = (libm::cos(angle), libm::sin(angle));
        for n in 1..COMPONENTS {
            cos[i][n] = cos[i][n - 1] * c - sin[i][n - 1] * s;
            sin[i][n] = sin[i][n - 1] * c + cos[i][n - 1] * s;
        }
    }
    let mut out = [[0.0; 3]; 3];
    for mode in modes {
        let k = mode.index.map(wave_number);
        let c: V3 = [0, 1, 2].map(|i| cos[i][mode.index[i]]);
        let s: V3 = [0, 1, 2].map(|i| sin[i][mode.index[i]]);
        let per = mode.size / dot(k, k);
        let all = c[0] * c[1] * c[2];
        for i in 0..3 {
            let (j, l) = ((i + 1) % 3, (i + 2) % 3);
            out[i][i] += all * (mode.size - per * k[i] * k[i]);
            // The signs of the sines cancel those of the components.
            let mixed = per * k[i] * k[j] * s[i] * s[j] * c[l];
            out[i][j] += mixed;
            out[j][i] += mixed;
        }
    }
    out
}

/// Scalar product.
pub fn dot(a: V3, b: V3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paper_hasimoto_1959() {
        // −8πR(0) = (4/3) · 1.760118876 · (4π/3)^{1/3} = (4/3) · 2.837297, isotropic.
        let at = PeriodicStokeslet::new().smooth_part([0.0; 3]);
        for i in 0..3 {
            assert!((at[i][i] + 4.0 / 3.0 * 2.837_297).abs() < 1e-6, "{at:?}");
            assert!(at[i][(i + 1) % 3].abs() < 1e-13);
        }
        let constant = -0.75 * at[0][0] / libm::cbrt(4.0 * PI / 3.0);
        // Absolute error of the sums.
        assert!((constant - super::super::cubic_array::HASIMOTO).abs() < 1e-8, "{constant}");
    }

    #[test]
    fn exact_divergence_and_periodicity() {
        let lattice = PeriodicStokeslet::new();
        let h = 1e-4;
        for d in [[0.003, 0.0, 0.002], [0.2, -0.1, 0.3], [0.45, 0.4, -0.2]] {
            let ahead = |k: usize, s: f64| {
                let mut at = d;
                at[k] += s;
                lattice.smooth_part(at)
            };
            for j in 0..3 {
                let divergence: f64 =
                    (0..3).map(|k| (ahead(k, h)[k][j] - ahead(k, -h)[k][j]) / (2.0 * h)).sum();
                // h² times third derivatives below 100, and 1e-12/h.
                assert!(divergence.abs() < 2e-6, "{d:?} {divergence}");
            }
        }
        // G is periodic: R(d) + G₀(d) at d = (0.6, 0.1, 0.2) and (−0.4, 0.1, 0.2).
        let full = |d: V3| {
            let (r, mut g) = (dot(d, d).sqrt(), lattice.smooth_part(d));
            for i in 0..3 {
                for j in 0..3 {
                    g[i][j] += d[i] * d[j] / (r * r * r) + if i == j { 1.0 / r } else { 0.0 };
                }
            }
            g
        };
        let (one, two) = (full([0.6, 0.1, 0.2]), full([-0.4, 0.1, 0.2]));
        for i in 0..3 {
            for j in 0..3 {
                assert!((one[i][j] - two[i][j]).abs() < 1e-11, "{i} {j} {}", one[i][j] - two[i][j]);
            }
        }
    }
}
