//! Hertz contact with visco-elastic damping (Brilliantov et al. 1996) \[D1\].

use super::{Geometry, Normal};

/// Terms of F = k δ^{3/2} + (3/2) A k √δ δ̇ with k = (4/3) E* √R*.
///
/// With a = √(R* δ): elastic (4/3) E* a δ, damping 2 A E* a, tangential stiffness 8 G* a (Mindlin).
///
/// # Source
/// docs/method.md \[D1\]; Brilliantov, Spahn, Hertzsch & Pöschel 1996, doi:10.1103/PhysRevE.53.5382.
/// # Verified by
/// `exact_hertz_contact`, `reference_restitution_viscoelastic`.
#[inline(always)]
pub(crate) fn visco_elastic(young: f64, shear: f64, time: f64, g: &Geometry) -> Normal {
    let root = (g.radius * g.overlap).sqrt();
    let ea = young * root;
    Normal {
        elastic: 4.0 / 3.0 * ea * g.overlap,
        damping: 2.0 * time * ea,
        root,
        tangential_stiffness: 8.0 * shear * root,
    }
}
