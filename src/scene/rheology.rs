//! The constitutive law of a fluid as a scene gives it: keys, checks, and the law they mean.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::checker::Checker;
use super::{SceneError, SceneProblem};
use crate::rheology::Law;

/// Shear stress magnitude σ as a function of the shear rate γ̇.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Rheology {
    /// σ = μ γ̇.
    Newtonian {
        /// Dynamic viscosity μ, Pa s.
        viscosity_pa_s: f64,
    },
    /// σ = σ0 + μ γ̇, rigid below σ0.
    Bingham {
        /// Yield stress σ0, Pa.
        yield_stress_pa: f64,
        /// Plastic viscosity μ, Pa s.
        plastic_viscosity_pa_s: f64,
    },
    /// σ = σ0 + K γ̇ⁿ, rigid below σ0.
    HerschelBulkley {
        /// Yield stress σ0, Pa.
        yield_stress_pa: f64,
        /// Consistency K, Pa sⁿ.
        consistency_pa_s_n: f64,
        /// Flow index n.
        flow_index: f64,
    },
    /// σ = K γ̇ⁿ.
    PowerLaw {
        /// Consistency K, Pa sⁿ.
        consistency_pa_s_n: f64,
        /// Flow index n.
        flow_index: f64,
    },
    /// σ = σ0 (1 − exp(−m γ̇)) + K γ̇ⁿ: a smooth stand-in for a yield stress.
    Papanastasiou {
        /// Yield stress σ0, Pa.
        yield_stress_pa: f64,
        /// Consistency K, Pa sⁿ.
        consistency_pa_s_n: f64,
        /// Flow index n.
        flow_index: f64,
        /// Growth time m, s.
        growth_s: f64,
    },
}

impl Rheology {
    /// The law it means, in SI units.
    #[must_use]
    pub const fn law(&self) -> Law {
        match *self {
            Self::Newtonian { viscosity_pa_s } => Law::Newtonian { mu: viscosity_pa_s },
            Self::Bingham { yield_stress_pa, plastic_viscosity_pa_s } => {
                Law::Bingham { sigma0: yield_stress_pa, mu: plastic_viscosity_pa_s }
            }
            Self::HerschelBulkley { yield_stress_pa, consistency_pa_s_n, flow_index } => {
                Law::HerschelBulkley { sigma0: yield_stress_pa, k: consistency_pa_s_n, n: flow_index }
            }
            Self::PowerLaw { consistency_pa_s_n, flow_index } => {
                Law::PowerLaw { k: consistency_pa_s_n, n: flow_index }
            }
            Self::Papanastasiou { yield_stress_pa, consistency_pa_s_n, flow_index, growth_s } => {
                Law::Papanastasiou {
                    sigma0: yield_stress_pa,
                    k: consistency_pa_s_n,
                    n: flow_index,
                    m: growth_s,
                }
            }
        }
    }

    /// Checks its values; `path` is where it stands in the scene.
    pub(super) fn check(&self, at: &Checker, path: &str) -> Result<(), SceneError> {
        let viscosity = |key: &str, mu: f64| {
            let way_out = "1e-3 for water; there is no inviscid flow here";
            at.positive(&format!("{path}.{key}"), mu, "Pa s", "τ − ½ = 3ν must be > 0 [L6]", way_out)
        };
        let yield_stress = |key: &str, sigma0: f64| {
            let way_out = "0 for a fluid without yield stress";
            at.not_negative(
                &format!("{path}.{key}.yield_stress_pa"),
                sigma0,
                "Pa",
                "σ = σ0 + … [Y3]",
                way_out,
            )
        };
        let power = |key: &str, k: f64, n: f64| {
            let consistency = format!("{path}.{key}.consistency_pa_s_n");
            let way_out = "the stress at a shear rate of 1/s, less the yield stress";
            at.positive(&consistency, k, "Pa sⁿ", "stress grows with shear rate [Y3]", way_out)?;
            let index = format!("{path}.{key}.flow_index");
            at.ensure((0.05..=5.0).contains(&n), &index, || SceneProblem::OutOfRange {
                found: n,
                unit: "",
                low: 0.05,
                high: 5.0,
                because: "σ = σ0 + K γ̇ⁿ must grow with γ̇ for [Y3] to have one solution",
                way_out: "1 for a Bingham or Newtonian fluid, below 1 for shear thinning",
            })
        };
        match *self {
            Self::Newtonian { viscosity_pa_s } => viscosity("newtonian.viscosity_pa_s", viscosity_pa_s),
            Self::Bingham { yield_stress_pa, plastic_viscosity_pa_s } => {
                yield_stress("bingham", yield_stress_pa)?;
                viscosity("bingham.plastic_viscosity_pa_s", plastic_viscosity_pa_s)
            }
            Self::HerschelBulkley { yield_stress_pa, consistency_pa_s_n, flow_index } => {
                yield_stress("herschel_bulkley", yield_stress_pa)?;
                power("herschel_bulkley", consistency_pa_s_n, flow_index)
            }
            Self::PowerLaw { consistency_pa_s_n, flow_index } => {
                power("power_law", consistency_pa_s_n, flow_index)
            }
            Self::Papanastasiou { yield_stress_pa, consistency_pa_s_n, flow_index, growth_s } => {
                yield_stress("papanastasiou", yield_stress_pa)?;
                power("papanastasiou", consistency_pa_s_n, flow_index)?;
                let path = format!("{path}.papanastasiou.growth_s");
                at.positive(
                    &path,
                    growth_s,
                    "s",
                    "the stress grows over it",
                    "`herschel_bulkley` for a true yield stress",
                )
            }
        }
    }
}
