//! Where surfaces cut the links of cells beside solids.

use crate::lattice::Q;

/// A cell beside a solid whose surface does not lie half-way on every link \[B4\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutCell {
    /// Linear index; not solid.
    pub cell: u32,
    /// Per direction: share of the link along c_i that lies outside the surface, 0 to 1; ½ along links that no surface
    /// cuts and along those into faces of the box.
    pub shares: [f64; Q],
}
