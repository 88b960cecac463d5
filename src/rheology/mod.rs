//! Constitutive laws σ(γ̇) and the local solve \[Y3\] that turns a stress into a shear rate.

pub(crate) mod bagnold;
mod bingham;
mod curve;
mod flow;
mod herschel_bulkley;
mod newtonian;
mod papanastasiou;
mod power_law;
mod power_sum;
pub mod relaxation;
mod yielding;

use serde::{Deserialize, Serialize};

use crate::lane::Lane;
use crate::units::Units;

pub use bingham::Bingham;
pub(crate) use curve::{FlowCurve, PowerCurve};
pub use flow::Flow;
pub use herschel_bulkley::HerschelBulkley;
pub use newtonian::Newtonian;
pub use papanastasiou::Papanastasiou;
pub use power_law::PowerLaw;
pub use power_sum::PowerSum;
pub use yielding::YieldTreatment;

/// A density that adds nothing to the stress, with a logarithm.
const VANISHING: f64 = 1e-200;

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

    /// The law read the other way round, for σ ≥ 0: what the wall law \[B3\] integrates over the half cell at a wall.
    ///
    /// As written here γ̇ is the local solve at a vanishing density, and Γ = σγ̇ − ∫ σ dγ̇ by five points in √γ̇;
    /// laws that have closed forms give them.
    #[inline(always)]
    fn flow<L: Lane>(&self, sigma: L) -> Flow<L> {
        let rate = self.shear_rate(L::splat(VANISHING), sigma);
        let flowing = L::zero().less(rate);
        let safe = L::select(flowing, rate, L::one());
        let integral = sigma * rate - flow::work(safe, |gamma_dot| self.stress(gamma_dot));
        let zero = L::zero();
        Flow {
            rate,
            slope: L::select(flowing, L::one() / self.tangent_viscosity(safe), zero),
            integral: L::select(flowing, integral, zero),
        }
    }

    /// Whether the fluid thickens, σ(γ̇) being convex: then γ̇(σ) starts with an infinite slope.
    #[inline(always)]
    fn thickens(&self) -> bool {
        false
    }

    /// Apparent dynamic viscosity σ(γ̇)/γ̇; infinite or undefined at γ̇ = 0 for yield-stress laws.
    #[inline(always)]
    fn viscosity<L: Lane>(&self, gamma_dot: L) -> L {
        self.stress(gamma_dot) / gamma_dot
    }
}

/// A constitutive law: parameters only, in lattice units (reference density 1, so dynamic = kinematic values)
/// wherever a run computes with them. [`Law::prepare`] makes of it what runs compute with, `Law::curve` what
/// estimates ask.
///
/// A new law is a file of this folder and an entry in the two enums and the matches of this file; none of these has
/// a `_` arm, so that the compiler names them all.
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
    /// As people call it.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Newtonian { .. } => "Newtonian law",
            Self::Bingham { .. } => "Bingham law",
            Self::HerschelBulkley { .. } => "Herschel-Bulkley law",
            Self::PowerLaw { .. } => "power law",
            Self::Papanastasiou { .. } => "Papanastasiou law",
        }
    }

    /// All its numbers.
    #[must_use]
    pub(crate) fn parameters(&self) -> Vec<f64> {
        match *self {
            Self::Newtonian { mu } => vec![mu],
            Self::Bingham { sigma0, mu } => vec![sigma0, mu],
            Self::HerschelBulkley { sigma0, k, n } => vec![sigma0, k, n],
            Self::PowerLaw { k, n } => vec![k, n],
            Self::Papanastasiou { sigma0, k, n, m } => vec![sigma0, k, n, m],
        }
    }

    /// The law in lattice units; `self` is in SI units.
    #[must_use]
    pub(crate) fn to_lattice(self, units: &Units) -> Self {
        let stress = |pa| units.stress_to_lattice(pa);
        let viscosity = |pa_s| units.viscosity_to_lattice(pa_s);
        let consistency = |k, n| units.consistency_to_lattice(k, n);
        match self {
            Self::Newtonian { mu } => Self::Newtonian { mu: viscosity(mu) },
            Self::Bingham { sigma0, mu } => Self::Bingham { sigma0: stress(sigma0), mu: viscosity(mu) },
            Self::HerschelBulkley { sigma0, k, n } => {
                Self::HerschelBulkley { sigma0: stress(sigma0), k: consistency(k, n), n }
            }
            Self::PowerLaw { k, n } => Self::PowerLaw { k: consistency(k, n), n },
            Self::Papanastasiou { sigma0, k, n, m } => Self::Papanastasiou {
                sigma0: stress(sigma0),
                k: consistency(k, n),
                n,
                m: units.time_to_lattice(m),
            },
        }
    }

    /// Its flow curve, for estimates, in the units of its parameters.
    #[must_use]
    pub(crate) fn curve(&self) -> Box<dyn FlowCurve> {
        let power = |sigma0, k, n| Box::new(PowerCurve { sigma0, k, n });
        match *self {
            Self::Newtonian { mu } => power(0.0, mu, 1.0),
            Self::Bingham { sigma0, mu } => power(sigma0, mu, 1.0),
            Self::HerschelBulkley { sigma0, k, n } => power(sigma0, k, n),
            Self::PowerLaw { k, n } => power(0.0, k, n),
            Self::Papanastasiou { sigma0, k, n, m } => Box::new(Papanastasiou { sigma0, k, n, m }),
        }
    }

    /// The law with what its local solve needs (a table, for the laws with a power), made once per run.
    #[must_use]
    pub fn prepare(&self) -> Prepared {
        match *self {
            Self::Newtonian { mu } => Prepared::Newtonian(Newtonian { mu }),
            Self::Bingham { sigma0, mu } => Prepared::Bingham(Bingham { sigma0, mu }),
            Self::HerschelBulkley { sigma0, k, n } => {
                Prepared::HerschelBulkley(HerschelBulkley::new(sigma0, k, n))
            }
            Self::PowerLaw { k, n } => Prepared::PowerLaw(PowerLaw::new(k, n)),
            Self::Papanastasiou { sigma0, k, n, m } => {
                Prepared::Papanastasiou(Papanastasiou { sigma0, k, n, m })
            }
        }
    }

    /// Yield stress below which the fluid is rigid; zero for laws that flow at any stress.
    #[must_use]
    pub const fn yield_stress(&self) -> f64 {
        match *self {
            Self::Bingham { sigma0, .. } | Self::HerschelBulkley { sigma0, .. } => sigma0,
            Self::Newtonian { .. } | Self::PowerLaw { .. } | Self::Papanastasiou { .. } => 0.0,
        }
    }

    /// τ = ½ + 3μ of the law that has the same one everywhere \[L6\].
    #[must_use]
    pub(crate) fn constant_tau(&self) -> Option<f64> {
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
    pub(crate) fn viscosity(&self, gamma_dot: f64) -> f64 {
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

/// A [`Law`] with what its local solve needs: any law, chosen per call, for flows of several fluids and for laws
/// chosen at run time.
#[derive(Clone, Debug, PartialEq)]
pub enum Prepared {
    /// σ = μ γ̇.
    Newtonian(Newtonian),
    /// σ = σ0 + μ γ̇.
    Bingham(Bingham),
    /// σ = σ0 + K γ̇ⁿ.
    HerschelBulkley(HerschelBulkley),
    /// σ = K γ̇ⁿ.
    PowerLaw(PowerLaw),
    /// σ = σ0 (1 − exp(−m γ̇)) + K γ̇ⁿ.
    Papanastasiou(Papanastasiou),
}

macro_rules! for_each_law {
    ($law:expr, $name:ident => $body:expr) => {
        match $law {
            Prepared::Newtonian($name) => $body,
            Prepared::Bingham($name) => $body,
            Prepared::HerschelBulkley($name) => $body,
            Prepared::PowerLaw($name) => $body,
            Prepared::Papanastasiou($name) => $body,
        }
    };
}

impl Rheology for Prepared {
    #[inline(always)]
    fn constant_tau(&self) -> Option<f64> {
        for_each_law!(self, law => law.constant_tau())
    }
    #[inline(always)]
    fn stress<L: Lane>(&self, gamma_dot: L) -> L {
        for_each_law!(self, law => law.stress(gamma_dot))
    }
    #[inline(always)]
    fn shear_rate<L: Lane>(&self, rho: L, q: L) -> L {
        for_each_law!(self, law => law.shear_rate(rho, q))
    }
    #[inline(always)]
    fn tangent_viscosity<L: Lane>(&self, gamma_dot: L) -> L {
        for_each_law!(self, law => law.tangent_viscosity(gamma_dot))
    }
    #[inline(always)]
    fn flow<L: Lane>(&self, sigma: L) -> Flow<L> {
        for_each_law!(self, law => law.flow(sigma))
    }
    #[inline(always)]
    fn thickens(&self) -> bool {
        for_each_law!(self, law => law.thickens())
    }
    #[inline(always)]
    fn viscosity<L: Lane>(&self, gamma_dot: L) -> L {
        for_each_law!(self, law => law.viscosity(gamma_dot))
    }
}
