//! Grains to start from: lattices and random packings in boxes, spheres and cylinders.
//!
//! Generators return grains ordered along a space-filling curve, so that neighbours in space are neighbours in
//! memory; see `order_by_place`.

pub mod lattice;
pub(crate) mod random;
pub(crate) mod region;
pub mod scatter;
pub(crate) mod sizes;

use super::{Sphere, V3};
pub use lattice::{Lattice, lattice};
pub use random::Random;
pub use region::Region;
pub use scatter::scatter;
pub use sizes::Sizes;

/// Sorts spheres along the Morton curve of cells of edge `cell`: neighbours in space become neighbours in memory,
/// which is what keeps the cost per grain from growing with their number.
pub(crate) fn order_by_place(spheres: &mut [Sphere], cell: f64) {
    let low = spheres.iter().fold(V3::repeat(f64::MAX), |l, s| l.inf(&s.centre));
    let spread = |x: f64| {
        let n = (x / cell) as u64 & 0x1F_FFFF;
        (0..21).fold(0u64, |k, bit| k | ((n >> bit) & 1) << (3 * bit))
    };
    let key = |s: &Sphere| {
        let d = s.centre - low;
        spread(d.x) | spread(d.y) << 1 | spread(d.z) << 2
    };
    spheres.sort_by_cached_key(key);
}
