//! Constitutive laws σ(γ̇) and the local solve \[Y3\] that turns a stress into a shear rate.

pub mod bagnold;
mod bingham;
mod herschel_bulkley;
mod newtonian;
mod papanastasiou;
mod power_law;
mod power_sum;
mod prepared;
pub mod relaxation;
mod yielding;

use serde::{Deserialize, Serialize};

use crate::lane::Lane;

pub use bingham::Bingham;
pub use herschel_bulkley::HerschelBulkley;
pub use newtonian::Newtonian;
pub use papanastasiou::Papanastasiou;
pub use power_law::PowerLaw;
pub use power_sum::PowerSum;
pub use prepared::Prepared;
pub use yielding::YieldTreatment;

/// A monotone law σ(γ̇) in lattice units, ready for use in every cell.
pub trait Rheology: Clone + Send + Sync + 'static {
    /// Whether the relaxation time can depend on the flow. A law that says no gives a [`Self::constant_tau`].
    const VARIES: bool = true;

    /// The relaxation time, if it is the same at every shear rate \[L6\]: then no shear rate is
    /// computed. The kinematic viscosity is held constant, at ρ = 1.
    #[inline(always)]
    fn constant_tau(&self) -> Option<f64> {
        None
    }

    /// σ(γ̇), the magnitude of the deviatoric stress of the flowing fluid (γ̇ > 0).
    fn stress<L: Lane>(&self, gamma_dot: L) -> L;

    /// The one γ̇ ≥ 0 with q = σ(γ̇) + (ρ/6) γ̇, zero when q does not exceed the yield stress \[Y3\].
    fn shear_rate<L: Lane>(&self, rho: L, q: L) -> L;

    /// Tangent dynamic viscosity dσ/dγ̇ of the flowing fluid: how much the shear rate changes with the
    /// stress, hence with the distance from a wall.
    fn tangent_viscosity<L: Lane>(&self, gamma_dot: L) -> L;

    /// Apparent dynamic viscosity σ(γ̇)/γ̇; infinite or undefined at γ̇ = 0 for yield-stress laws.
    #[inline(always)]
    fn viscosity<L: Lane>(&self, gamma_dot: L) -> L {
        self.stress(gamma_dot) / gamma_dot
    }
}

/// A constitutive law in lattice units (reference density 1, so dynamic = kinematic values): parameters
/// only. [`Law::prepare`] makes of it what runs compute with.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Law {
    /// σ = μ γ̇.
    Newtonian {
        /// Dynamic viscosity μ.
        mu: f64,
    },
    /// σ = σ0 + μ γ̇.
    Bingham {
        /// Yield stress σ0.
        sigma0: f64,
        /// Plastic viscosity μ.
        mu: f64,
    },
    /// σ = σ0 + K γ̇ⁿ.
    HerschelBulkley {
        /// Yield stress σ0.
        sigma0: f64,
        /// Consistency K.
        k: f64,
        /// Flow index n.
        n: f64,
    },
    /// σ = K γ̇ⁿ.
    PowerLaw {
        /// Consistency K.
        k: f64,
        /// Flow index n.
        n: f64,
    },
    /// σ = σ0 (1 − exp(−m γ̇)) + K γ̇ⁿ.
    Papanastasiou {
        /// Yield stress σ0.
        sigma0: f64,
        /// Consistency K.
        k: f64,
        /// Flow index n.
        n: f64,
        /// Growth rate m of the regularisation, in steps.
        m: f64,
    },
}

impl Law {
    /// Yield stress below which the fluid is rigid; zero for laws that flow at any stress.
    #[must_use]
    pub const fn yield_stress(&self) -> f64 {
        match *self {
            Self::Bingham { sigma0, .. } | Self::HerschelBulkley { sigma0, .. } => sigma0,
            Self::Newtonian { .. } | Self::PowerLaw { .. } | Self::Papanastasiou { .. } => 0.0,
        }
    }

    /// The law with what its local solve needs (a table, for the laws with a power), made once per run.
    #[must_use]
    pub fn prepare(&self) -> Prepared {
        Prepared::new(self)
    }

    /// τ = ½ + 3μ of the law that has the same one everywhere \[L6\].
    #[must_use]
    pub fn constant_tau(&self) -> Option<f64> {
        match *self {
            Self::Newtonian { mu } => Newtonian { mu }.constant_tau(),
            Self::Bingham { .. }
            | Self::HerschelBulkley { .. }
            | Self::PowerLaw { .. }
            | Self::Papanastasiou { .. } => None,
        }
    }

    /// Apparent dynamic viscosity σ(γ̇)/γ̇ at γ̇ > 0: the bits of the prepared law, without preparing it.
    #[must_use]
    pub fn viscosity(&self, gamma_dot: f64) -> f64 {
        match *self {
            Self::Newtonian { mu } => mu,
            Self::Bingham { sigma0, mu } => Bingham { sigma0, mu }.viscosity(gamma_dot),
            Self::HerschelBulkley { sigma0, k, n } => {
                (sigma0 + herschel_bulkley::power_stress(k, n, gamma_dot)) / gamma_dot
            }
            Self::PowerLaw { k, n } => herschel_bulkley::power_stress(k, n, gamma_dot) / gamma_dot,
            Self::Papanastasiou { sigma0, k, n, m } => Papanastasiou { sigma0, k, n, m }.viscosity(gamma_dot),
        }
    }
}
