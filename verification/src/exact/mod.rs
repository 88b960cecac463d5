//! One analytic or independently computed reference solution per file.
//!
//! Nothing here uses the lattice-Boltzmann code. Unless a file says otherwise every quantity may be
//! given in any consistent system of units: lengths, dynamic viscosities, stresses and forces per
//! volume in SI, or all of them in lattice units. A [`lahar::rheology::Law`] holds dynamic values.

pub mod abc;
pub mod annulus;
mod complex;
pub mod couette;
pub mod dam_break;
pub mod discrete_modes;
pub mod duct;
pub mod film;
pub mod film_wave;
pub mod flow_curve;
pub mod grains;
pub mod layered_channel;
pub mod norms;
pub mod oscillating_wall;
pub mod pipe;
pub mod poiseuille;
pub mod poiseuille_clamped;
pub mod quadrature;
pub mod shear_wave;
pub mod slip;
pub mod slump;
pub mod start_up;
pub mod suspension;
pub mod taylor_couette;
pub mod taylor_green;
pub mod thin_layer;
pub mod turning_cylinders;
pub mod viscoplastic_1d;
pub mod womersley;

/// Why a reference solution could not be given.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ExactError {
    /// An argument lies outside the range of the solution.
    #[error("{what} = {value}: {allowed}")]
    Argument {
        /// Name of the argument.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The range allowed.
        allowed: &'static str,
    },
    /// An iteration did not converge.
    #[error("{what} did not converge in {iterations} iterations (residual {residual:e})")]
    NotConverged {
        /// What was being solved.
        what: &'static str,
        /// Iterations done.
        iterations: usize,
        /// Residual left.
        residual: f64,
    },
    /// The fluid was still moving at the end of the time allowed.
    #[error("not at rest by t = {until}: largest velocity {velocity:e}")]
    StillMoving {
        /// End of the time allowed.
        until: f64,
        /// Largest |u| left.
        velocity: f64,
    },
    /// Fluid reached the end of the domain, which began dry.
    #[error("the fluid reached the end of the domain of length {length} at t = {time}")]
    EndReached {
        /// Length of the domain.
        length: f64,
        /// When.
        time: f64,
    },
    /// No eigenvalues.
    #[error("the eigenvalues of a {size} x {size} matrix could not be computed")]
    Eigenvalues {
        /// Size of the matrix.
        size: usize,
    },
}

impl ExactError {
    pub(crate) fn positive(what: &'static str, value: f64) -> Result<(), Self> {
        if value > 0.0 && value.is_finite() {
            Ok(())
        } else {
            Err(Self::Argument { what, value, allowed: "must be positive and finite" })
        }
    }
}
