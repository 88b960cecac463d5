//! A sphere by itself.

use super::V3;

/// A sphere of a clump, or of a packing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Centre, m.
    pub centre: V3,
    /// Radius, m.
    pub radius: f64,
}
