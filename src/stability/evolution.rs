//! Exact linear evolution of a disturbance in a periodic box: every wave of the box by its own M(k).

use std::f64::consts::PI;

use rayon::prelude::*;

use super::Linearised;
use super::eigenvalues::{C64, Matrix, ZERO};
use crate::lattice::Q;

/// Fourier amplitudes of the nineteen populations, one entry per wave of a cubic periodic box.
#[derive(Clone, Debug)]
pub struct Spectrum {
    cells: usize,
    amplitudes: Vec<[C64; Q]>,
}

impl Spectrum {
    /// Discrete Fourier transform of `populations` (x fastest) in a box of `cells`³.
    #[must_use]
    pub fn of(populations: &[[f64; Q]], cells: usize) -> Self {
        let mut amplitudes: Vec<[C64; Q]> = populations.iter().map(|h| h.map(|x| C64::new(x, 0.0))).collect();
        for stride in [1, cells, cells * cells] {
            transform(&mut amplitudes, cells, stride);
        }
        Self { cells, amplitudes }
    }

    /// Root mean square over cells of the part that varies in space: the wave k = 0, which holds the
    /// conserved totals, is left out.
    #[must_use]
    pub fn norm(&self) -> f64 {
        let square = |a: &[C64; Q]| a.iter().fold(0.0, |s, x| s + (x.re * x.re + x.im * x.im));
        let sum = self.amplitudes.iter().skip(1).fold(0.0, |s, a| s + square(a));
        sum.sqrt() / self.amplitudes.len() as f64
    }

    /// The norms after `interval`, 2 `interval`, … `count` `interval` steps of linear evolution.
    ///
    /// # Source
    /// docs/method.md \[K5\]: f(k, t) = M(k)^t f(k, 0).
    /// # Verified by
    /// Claim `neumann-noise-evolution`.
    #[must_use]
    pub fn norms(&self, linearised: &Linearised, interval: u32, count: usize) -> Vec<f64> {
        let n = self.cells;
        let squares: Vec<Vec<f64>> = (1..self.amplitudes.len())
            .into_par_iter()
            .map(|at| {
                let index = [at % n, (at / n) % n, at / (n * n)];
                let k = index.map(|i| 2.0 * PI * i as f64 / n as f64);
                let step = power(&linearised.amplification(k), interval);
                let mut a = self.amplitudes[at];
                (0..count)
                    .map(|_| {
                        a = apply(&step, &a);
                        a.iter().fold(0.0, |s, x| s + (x.re * x.re + x.im * x.im))
                    })
                    .collect()
            })
            .collect();
        (0..count)
            .map(|c| squares.iter().fold(0.0, |s, of| s + of[c]).sqrt() / self.amplitudes.len() as f64)
            .collect()
    }
}

/// In-place naive Fourier transform of all lines of one axis.
fn transform(amplitudes: &mut [[C64; Q]], n: usize, stride: usize) {
    let root: Vec<C64> = (0..n)
        .map(|i| {
            let angle = -2.0 * PI * i as f64 / n as f64;
            C64::new(libm::cos(angle), libm::sin(angle))
        })
        .collect();
    let mut line = vec![[ZERO; Q]; n];
    for start in (0..amplitudes.len()).filter(|at| (at / stride).is_multiple_of(n)) {
        for (k, out) in line.iter_mut().enumerate() {
            *out = [ZERO; Q];
            for i in 0..n {
                let factor = root[(k * i) % n];
                for (out, x) in out.iter_mut().zip(amplitudes[start + i * stride]) {
                    *out += factor * x;
                }
            }
        }
        for (k, out) in line.iter().enumerate() {
            amplitudes[start + k * stride] = *out;
        }
    }
}

fn apply(m: &Matrix, a: &[C64; Q]) -> [C64; Q] {
    std::array::from_fn(|i| (0..Q).fold(ZERO, |s, j| s + m[i][j] * a[j]))
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let mut out = [[ZERO; Q]; Q];
    for i in 0..Q {
        for j in 0..Q {
            let factor = a[i][j];
            for k in 0..Q {
                out[i][k] += factor * b[j][k];
            }
        }
    }
    out
}

/// M^n by repeated squaring, n ≥ 1.
fn power(m: &Matrix, n: u32) -> Matrix {
    let mut result = *m;
    for bit in (0..n.ilog2()).rev() {
        result = product(&result, &result);
        if n >> bit & 1 == 1 {
            result = product(&result, m);
        }
    }
    result
}
