//! Eigenvalues by faer, an implementation of others: where many waves neither grow nor decay, rounding decides which of
//! them a search follows, and records were made with these.

use faer::Mat;
use lahar::lattice::Q;
use lahar::stability::eigenvalues::{C64, Matrix};

/// All eigenvalues of a matrix; `None` where the iteration did not converge.
pub fn by_faer(matrix: &Matrix) -> Option<[C64; Q]> {
    let found = Mat::from_fn(Q, Q, |i, j| matrix[i][j]).eigenvalues().ok()?;
    found.try_into().ok()
}
