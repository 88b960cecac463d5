//! Reference solutions for grains in a fluid: drag, settling, lubrication, rotation, yield, floating.
//!
//! Closed forms, series, one boundary-integral solution and published correlations; nothing here uses the
//! lattice-Boltzmann code or [`lahar::dem`]. Lengths may be given in any one unit; most results are ratios. Three
//! kinds of source are kept apart in the documentation of each item: *exact* (derived or computed here, with a stated
//! numerical error), *published and checked* (a second copy of the number was found and compared), and *from memory*
//! (quoted without a second copy at hand: check before it becomes a gate). A reference taken from experiments or
//! simulations serves validation, never verification.

pub mod bingham_sphere;
pub mod cubic_array;
pub mod floating;
pub mod pair_lubrication;
pub mod periodic_stokeslet;
pub mod rotation;
pub mod settling;
pub mod single_sphere;
pub mod sphere_array;
pub mod ten_cate;
pub mod two_spheres;
pub mod walls;

use super::ExactError;

/// `Ok` if `low <= value <= high`; `allowed` says the same in words.
fn within(
    what: &'static str,
    value: f64,
    low: f64,
    high: f64,
    allowed: &'static str,
) -> Result<(), ExactError> {
    if value >= low && value <= high { Ok(()) } else { Err(ExactError::Argument { what, value, allowed }) }
}
