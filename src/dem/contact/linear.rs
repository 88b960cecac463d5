//! Linear spring and dashpot.

use super::{Geometry, Normal};

/// Terms of F = k δ + 2 b √(k m*) δ̇; the tangential spring does not depend on the overlap.
///
/// # Source
/// Cundall & Strack 1979, doi:10.1680/geot.1979.29.1.47.
/// # Verified by
/// `exact_linear_restitution`.
#[inline(always)]
pub(crate) fn spring_dashpot(stiffness: f64, ratio: f64, tangential: f64, g: &Geometry) -> Normal {
    Normal {
        elastic: stiffness * g.overlap,
        damping: 2.0 * ratio * (stiffness * g.mass).sqrt(),
        root: 1.0,
        tangential_stiffness: tangential,
    }
}
