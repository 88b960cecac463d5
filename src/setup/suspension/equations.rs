//! The equations that the coupling of grains and fluid takes from here.

use super::lubrication;
use crate::vector;
use std::fmt::Debug;

/// Three statements of the coupling that a run can be made with others of: a harness that shows that it would notice
/// a wrong one implements them so. Lattice units.
pub trait CouplingEquations: Debug + Send + Sync {
    /// u = U + ω × r: velocity of a grain's surface where a link meets it \[C1\].
    ///
    /// # Arguments
    /// `velocity`, `spin`: U and ω of the grain. `arm`: r, from its centre.
    fn surface_velocity(&self, velocity: [f64; 3], spin: [f64; 3], arm: [f64; 3]) -> [f64; 3] {
        vector::surface_velocity(velocity, spin, arm)
    }

    /// Normal friction of a gap \[C5\], see [`lubrication::normal`].
    fn lubrication(&self, viscosity: f64, reduced: f64, gap: f64, cutoff: f64) -> f64 {
        lubrication::normal(viscosity, reduced, gap, cutoff)
    }

    /// Mass and momentum that the books of the fluid gain when a grain covers a cell which holds `mass` and
    /// `momentum` \[C3\]: they leave it.
    fn covering(&self, mass: f64, momentum: [f64; 3]) -> (f64, [f64; 3]) {
        (-mass, momentum.map(|p| -p))
    }
}

/// The equations as they should be.
#[derive(Clone, Copy, Debug, Default)]
pub struct StandardCoupling;

impl CouplingEquations for StandardCoupling {}
