//! Eigenvalues of the matrix of one step: small, complex, without symmetry.

use nalgebra::Complex;

use crate::lattice::Q;

/// A complex number.
pub type C64 = Complex<f64>;
/// A matrix over the nineteen populations, row by row.
pub type Matrix = [[C64; Q]; Q];

/// All eigenvalues of a matrix, in no order; `None` where they were not found.
pub type EigenvalueSolver = fn(&Matrix) -> Option<[C64; Q]>;

/// Zero.
pub(crate) const ZERO: C64 = Complex::new(0.0, 0.0);
/// Sweeps until one eigenvalue has settled: two or three are usual, the shift is changed after every tenth.
const SWEEPS: u32 = 60;

/// All eigenvalues of a matrix, in no order; `None` for one that is not finite.
///
/// Householder reflections to Hessenberg form, then QR sweeps with Wilkinson's shift on the part that has not fallen
/// apart yet.
///
/// # Exactness
/// Operations + − × ÷ √ only; bit-stable. Backward stable: the eigenvalues are those of a matrix that differs by a few dozen
/// roundings of its norm, so that a simple one is found to about 1e-15 and a nearly defective pair to about 1e-8.
/// # Source
/// J. H. Wilkinson, The Algebraic Eigenvalue Problem (1965), chapter 8; G. H. Golub and C. F. Van Loan, Matrix
/// Computations, sections 7.4 and 7.5.
/// # Verified by
/// Tests `exact_eigenvalues_of_permutations`, `exact_eigenvalues_of_a_known_spectrum`; of the harness
/// `parity_spectral_radius_with_faer`.
#[must_use]
pub fn eigenvalues(matrix: &Matrix) -> Option<[C64; Q]> {
    let finite = |z: &C64| z.re.is_finite() && z.im.is_finite();
    // A triangular matrix has eigenvalues whatever stands above its diagonal.
    if !matrix.iter().flatten().all(finite) {
        return None;
    }
    let mut h = hessenberg(matrix);
    let mut values = [ZERO; Q];
    let mut end = Q;
    let mut sweeps = 0;
    while end > 0 {
        let start = block_start(&mut h, end);
        if start + 1 == end {
            values[start] = h[start][start];
            (end, sweeps) = (start, 0);
            continue;
        }
        if sweeps == SWEEPS {
            return None;
        }
        sweeps += 1;
        let shift = if sweeps % 10 == 0 { odd_shift(&h, end) } else { wilkinson_shift(&h, end) };
        sweep(&mut h, start..end, shift);
    }
    values.iter().all(finite).then_some(values)
}

/// |z|.
#[inline]
pub(crate) fn modulus(z: C64) -> f64 {
    (z.re * z.re + z.im * z.im).sqrt()
}

/// |Re z| + |Im z|.
#[inline]
fn size(z: C64) -> f64 {
    z.re.abs() + z.im.abs()
}

/// √z with a real part that is not negative.
#[inline]
fn root(z: C64) -> C64 {
    let r = modulus(z);
    if r == 0.0 {
        return ZERO;
    }
    if z.re >= 0.0 {
        let t = (0.5 * (r + z.re)).sqrt();
        C64::new(t, 0.5 * z.im / t)
    } else {
        let t = (0.5 * (r - z.re)).sqrt();
        C64::new(0.5 * z.im.abs() / t, t.copysign(z.im))
    }
}

/// Pᴴ M P with zeros below the first subdiagonal, P a product of Householder reflections.
fn hessenberg(matrix: &Matrix) -> Matrix {
    let mut h = *matrix;
    for k in 0..Q - 2 {
        let below = h[k + 2..].iter().fold(0.0, |s, row| s + row[k].norm_sqr());
        if below == 0.0 {
            continue;
        }
        let first = h[k + 1][k];
        let norm = (below + first.norm_sqr()).sqrt();
        // The first entry grows by the norm in its own direction, so that nothing cancels.
        let along = if first == ZERO { C64::new(1.0, 0.0) } else { first / modulus(first) };
        let mut v = [ZERO; Q];
        v[k + 1] = first + along * norm;
        for i in k + 2..Q {
            v[i] = h[i][k];
        }
        let scale = 2.0 / (below + v[k + 1].norm_sqr());
        for j in k..Q {
            let sum = (k + 1..Q).fold(ZERO, |s, i| s + v[i].conj() * h[i][j]) * scale;
            for i in k + 1..Q {
                h[i][j] -= v[i] * sum;
            }
        }
        for row in &mut h {
            let sum = (k + 1..Q).fold(ZERO, |s, j| s + row[j] * v[j]) * scale;
            for j in k + 1..Q {
                row[j] -= sum * v[j].conj();
            }
        }
        for row in &mut h[k + 2..] {
            row[k] = ZERO;
        }
    }
    h
}

/// First row of the last block that has not fallen apart; subdiagonal entries below rounding become zero.
fn block_start(h: &mut Matrix, end: usize) -> usize {
    for k in (1..end).rev() {
        let beside = size(h[k - 1][k - 1]) + size(h[k][k]);
        if size(h[k][k - 1]) <= f64::EPSILON * beside {
            h[k][k - 1] = ZERO;
            return k;
        }
    }
    0
}

/// The eigenvalue of the last two rows and columns that is nearer to the last entry.
fn wilkinson_shift(h: &Matrix, end: usize) -> C64 {
    let (m, n) = (end - 2, end - 1);
    let half = (h[m][m] - h[n][n]) * 0.5;
    let product = h[m][n] * h[n][m];
    let square = root(half * half + product);
    // The root with the sign of `half`: the smaller of both solutions comes without cancellation.
    let sum = if half.re * square.re + half.im * square.im >= 0.0 { half + square } else { half - square };
    if sum == ZERO { h[n][n] } else { h[n][n] - product / sum }
}

/// A shift for blocks on which Wilkinson's goes in circles, for instance permutations.
fn odd_shift(h: &Matrix, end: usize) -> C64 {
    h[end - 1][end - 1] + 0.75 * size(h[end - 1][end - 2])
}

/// H − s = Q R, then R Q + s, on one block.
fn sweep(h: &mut Matrix, block: std::ops::Range<usize>, shift: C64) {
    for k in block.clone() {
        h[k][k] -= shift;
    }
    let mut rotations = [(ZERO, ZERO); Q];
    for k in block.start..block.end - 1 {
        let (a, b) = (h[k][k], h[k + 1][k]);
        let norm = (a.norm_sqr() + b.norm_sqr()).sqrt();
        let (c, s) = if norm == 0.0 { (C64::new(1.0, 0.0), ZERO) } else { (a / norm, b / norm) };
        rotations[k] = (c, s);
        for j in k..block.end {
            let (x, y) = (h[k][j], h[k + 1][j]);
            h[k][j] = c.conj() * x + s.conj() * y;
            h[k + 1][j] = c * y - s * x;
        }
    }
    for k in block.start..block.end - 1 {
        let (c, s) = rotations[k];
        for row in &mut h[block.start..(k + 2).min(block.end)] {
            let (x, y) = (row[k], row[k + 1]);
            row[k] = x * c + y * s;
            row[k + 1] = y * c.conj() - x * s.conj();
        }
    }
    for k in block {
        h[k][k] += shift;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn diagonal(values: impl Fn(usize) -> C64) -> Matrix {
        std::array::from_fn(|i| std::array::from_fn(|j| if i == j { values(i) } else { ZERO }))
    }

    /// Roots of unity: Wilkinson's shift alone never moves these.
    #[test]
    fn exact_eigenvalues_of_permutations() {
        let cycle: Matrix = std::array::from_fn(|i| {
            std::array::from_fn(|j| C64::new(if (i + 1) % Q == j { 1.0 } else { 0.0 }, 0.0))
        });
        let found = eigenvalues(&cycle).unwrap_or([ZERO; Q]);
        for k in 0..Q {
            let angle = 2.0 * std::f64::consts::PI * k as f64 / Q as f64;
            let exact = C64::new(libm::cos(angle), libm::sin(angle));
            // Orthonormal eigenvectors; some hundred rotations.
            assert!(found.iter().any(|x| modulus(x - exact) < 1e-13), "{exact}: {found:?}");
        }
        assert_eq!(eigenvalues(&diagonal(|_| C64::new(1.0, 0.0))), Some([C64::new(1.0, 0.0); Q]));
        assert_eq!(eigenvalues(&[[ZERO; Q]; Q]), Some([ZERO; Q]));
    }

    /// A triangular matrix T with known eigenvalues, seen in a mirror: (1 − 2 v vᵀ) T (1 − 2 v vᵀ).
    #[test]
    fn exact_eigenvalues_of_a_known_spectrum() {
        let value = |i: usize| C64::new(0.9 - 0.1 * i as f64, 0.05 * (i * i % 7) as f64);
        let triangular: Matrix = std::array::from_fn(|i| {
            std::array::from_fn(|j| match i.cmp(&j) {
                std::cmp::Ordering::Less if j == i + 1 => C64::new(0.02, -0.01 * i as f64 / 19.0),
                std::cmp::Ordering::Equal => value(i),
                _ => ZERO,
            })
        });
        let mirror = |i: usize, j: usize| if i == j { 1.0 - 2.0 / Q as f64 } else { -2.0 / Q as f64 };
        let product = |i: usize, j: usize| {
            (0..Q).fold(ZERO, |s, k| {
                (0..Q).fold(s, |s, l| s + triangular[k][l] * (mirror(i, k) * mirror(l, j)))
            })
        };
        let matrix: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| product(i, j)));
        let found = eigenvalues(&matrix).unwrap_or([ZERO; Q]);
        for i in 0..Q {
            // Neighbours on the diagonal are five times as far apart as what couples them: condition below 2.
            assert!(found.iter().any(|x| modulus(x - value(i)) < 1e-13), "{}: {found:?}", value(i));
        }
    }

    #[test]
    fn what_is_not_finite_has_no_eigenvalues() {
        for wrong in [f64::NAN, f64::INFINITY] {
            let mut matrix = diagonal(|i| C64::new(i as f64, 0.0));
            matrix[3][7] = C64::new(wrong, 0.0);
            assert_eq!(eigenvalues(&matrix), None);
        }
    }
}
