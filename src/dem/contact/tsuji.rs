//! Hertz contact with damping that makes restitution independent of speed (Tsuji et al. 1992) \[D1\].

use super::{Geometry, Normal};

/// Terms of F = k δ^{3/2} + α √(m* k) δ^{1/4} δ̇ with k = (4/3) E* √R*.
///
/// # Source
/// docs/method.md \[D1\]; Tsuji, Tanaka & Ishida 1992, doi:10.1016/0032-5910(92)88030-L.
/// # Verified by
/// `reference_restitution_tsuji`.
#[inline(always)]
pub(crate) fn constant_restitution(young: f64, shear: f64, alpha: f64, g: &Geometry) -> Normal {
    let root = (g.radius * g.overlap).sqrt();
    let ka = 4.0 / 3.0 * young * root; // k sqrt(delta)
    Normal {
        elastic: ka * g.overlap,
        damping: alpha * (g.mass * ka).sqrt(),
        root,
        tangential_stiffness: 8.0 * shear * root,
    }
}
