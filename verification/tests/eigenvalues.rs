//! The eigenvalues of the product against those of faer, an implementation of others.

use faer::Mat;
use lahar::lattice::Q;
use lahar::stability::table::table;
use lahar::stability::{Direction, GROWTH_TOLERANCE, Linearised};

/// Every limit of the table, below it and above it, for the wave that grows first, its long neighbours, and some
/// others.
#[test]
fn parity_spectral_radius_with_faer() {
    let mut worst = 0.0_f64;
    for column in table() {
        for row in &column.rows {
            for (limit, unit) in row.limits.iter().zip(Direction::ALL.map(Direction::unit)) {
                let first = limit.wave;
                for part in [0.0, 0.9, 1.0, 1.1] {
                    let velocity = unit.map(|e| part * limit.speed * e);
                    let linearised = Linearised::about(&column.collision, row.tau, velocity);
                    for k in [first, first.map(|k| 0.1 * k), [0.0; 3], [1.0, -0.5, 2.0]] {
                        let own = linearised.spectral_radius(k).unwrap_or(f64::NAN);
                        worst = worst.max(difference(&linearised, k, own));
                    }
                }
            }
        }
    }
    // Simple eigenvalues agree to about 1e-14. Nearly defective pairs may differ by more, but by nothing that a limit
    // would notice.
    assert!(worst < 0.1 * GROWTH_TOLERANCE, "{worst:e}");
}

fn difference(linearised: &Linearised, k: [f64; 3], own: f64) -> f64 {
    let matrix = linearised.amplification(k);
    let theirs = Mat::from_fn(Q, Q, |i, j| matrix[i][j]).eigenvalues();
    let radius = theirs
        .map_or(f64::NAN, |all| all.iter().map(|x| (x.re * x.re + x.im * x.im).sqrt()).fold(0.0, f64::max));
    let apart = (own - radius).abs();
    if apart.is_nan() { f64::INFINITY } else { apart }
}
