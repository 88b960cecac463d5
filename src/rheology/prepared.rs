//! Any law, chosen per call: for flows of several fluids and for laws chosen at run time.

use super::{Bingham, HerschelBulkley, Law, Newtonian, Papanastasiou, PowerLaw, Rheology};
use crate::lane::Lane;

/// A [`Law`] with what its local solve needs.
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

impl Prepared {
    pub(super) fn new(law: &Law) -> Self {
        match *law {
            Law::Newtonian { mu } => Self::Newtonian(Newtonian { mu }),
            Law::Bingham { sigma0, mu } => Self::Bingham(Bingham { sigma0, mu }),
            Law::HerschelBulkley { sigma0, k, n } => {
                Self::HerschelBulkley(HerschelBulkley::new(sigma0, k, n))
            }
            Law::PowerLaw { k, n } => Self::PowerLaw(PowerLaw::new(k, n)),
            Law::Papanastasiou { sigma0, k, n, m } => Self::Papanastasiou(Papanastasiou { sigma0, k, n, m }),
        }
    }
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
    fn viscosity<L: Lane>(&self, gamma_dot: L) -> L {
        for_each_law!(self, law => law.viscosity(gamma_dot))
    }
}
