//! Linear stability: von Neumann analysis of any collision operator \[K5\].
//!
//! *Stable* means here: in an unbounded fluid of uniform velocity and constant τ, no wave of any
//! length and direction grows by more than 1e-8 per step. That is a necessary condition. It says
//! nothing of walls, of gradients of τ or of velocity, of free surfaces or of forces; a flow inside
//! the limit can still be unstable through them, and one slightly outside it grows slowly enough to
//! pass unnoticed in a short run.

mod amplification;
pub mod eigenvalues;
mod evolution;
mod search;
pub mod table;

pub use amplification::{Linearised, phases};
pub use evolution::Spectrum;
pub use search::{CEILING, Direction, Limit, Peak, Search, max_stable_speed_along, peak};

use crate::collision::{Collision, CollisionChoice};

/// Spectral radius up to which a wave counts as not growing: 1 + this. Eigenvalues of modulus one
/// come out with errors of a few 1e-15, of a nearly defective pair with errors of 1e-8.
pub const GROWTH_TOLERANCE: f64 = 1e-8;

/// Why an analysis failed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StabilityError {
    /// The matrix of a step has no eigenvalues.
    #[error("no eigenvalues for velocity {velocity:?} and wave vector {wave:?}: the matrix is not finite")]
    Eigenvalues {
        /// Velocity of the uniform flow, lattice units.
        velocity: [f64; 3],
        /// Wave vector, radians per cell.
        wave: [f64; 3],
    },
    /// τ⁺ is not above ½.
    #[error("tau = {tau} is not above 1/2, so the viscosity is not positive")]
    Tau {
        /// The value found.
        tau: f64,
    },
}

/// Growth per step of the wave k in uniform flow u: spectral radius of M(k) minus one.
///
/// # Arguments
/// `tau`: τ⁺ > ½. `u`: lattice units. `k`: radians per cell.
/// # Errors
/// τ⁺ is not above ½, or the eigenvalues did not converge.
/// # Source
/// docs/method.md \[K5\].
/// # Verified by
/// Claim `neumann-growth-rates`.
pub fn growth<O: Collision>(
    collision: &O,
    tau: f64,
    u: [f64; 3],
    k: [f64; 3],
) -> Result<f64, StabilityError> {
    check_tau(tau)?;
    Ok(Linearised::about(collision, tau, u).spectral_radius(k)? - 1.0)
}

/// The largest speed at which uniform flow is stable, whatever its direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StabilityLimit {
    /// Speed, lattice units.
    pub speed: f64,
    /// Whether it was computed for just this operator and τ⁺; false: interpolated in the table.
    pub exact: bool,
}

/// The largest stable speed, least over the directions x, xy and xyz.
///
/// The operators of [`table::OPERATORS`] are looked up; any other is analysed at this τ⁺, which takes
/// about a second.
///
/// # Arguments
/// `tau`: τ⁺ > ½; infinite stands for an unyielded cell whose ω⁺ stays zero whatever happens. A real one
/// yields when the wave's stress reaches σ₀, which bounds what such a wave can do: judge a yield-stress
/// flow by the τ⁺ of its yielded part.
/// # Errors
/// τ⁺ is not above ½, or eigenvalues did not converge.
/// # Source
/// docs/method.md \[K5\].
/// # Verified by
/// Claim `neumann-table`.
pub fn max_stable_speed(collision: &CollisionChoice, tau: f64) -> Result<StabilityLimit, StabilityError> {
    check_tau(tau)?;
    if let Some(speed) = table::interpolated(collision, tau) {
        return Ok(StabilityLimit { speed, exact: false });
    }
    let speed = table::Row::compute(collision, tau, &Search::QUICK)?.least();
    Ok(StabilityLimit { speed, exact: true })
}

fn check_tau(tau: f64) -> Result<(), StabilityError> {
    // Written so that NaN is refused too; infinity is an unyielded cell.
    if tau > 0.5 { Ok(()) } else { Err(StabilityError::Tau { tau }) }
}

#[cfg(test)]
mod tests;
