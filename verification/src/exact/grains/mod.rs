//! Closed forms of elementary grain physics: one collision, rolling, free rotation, two joined spheres.
//!
//! Nothing here uses [`lahar::dem`]. Formulas that the discrete element method needs itself (to choose a time
//! step or a damping) are written down a second time, in another way.

pub mod collision;
pub mod rolling;
pub mod top;
pub mod two_spheres;

/// A vector of three numbers.
pub type V3 = [f64; 3];
