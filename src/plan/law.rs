//! Constitutive laws in SI units: estimates, and conversion to lattice units.

use crate::rheology::Law;
use crate::scene::Rheology;
use crate::units::Units;

/// σ0, K, n of a law, all in SI; the smooth Papanastasiou law counts with its yield stress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Yield stress, Pa.
    pub sigma0: f64,
    /// Consistency, Pa sⁿ.
    pub k: f64,
    /// Flow index.
    pub n: f64,
}

/// The three numbers of a law.
#[must_use]
pub fn parameters(rheology: &Rheology) -> Parameters {
    match *rheology {
        Rheology::Newtonian { viscosity_pa_s } => Parameters { sigma0: 0.0, k: viscosity_pa_s, n: 1.0 },
        Rheology::Bingham { yield_stress_pa, plastic_viscosity_pa_s } => {
            Parameters { sigma0: yield_stress_pa, k: plastic_viscosity_pa_s, n: 1.0 }
        }
        Rheology::HerschelBulkley { yield_stress_pa, consistency_pa_s_n, flow_index }
        | Rheology::Papanastasiou { yield_stress_pa, consistency_pa_s_n, flow_index, .. } => {
            Parameters { sigma0: yield_stress_pa, k: consistency_pa_s_n, n: flow_index }
        }
        Rheology::PowerLaw { consistency_pa_s_n, flow_index } => {
            Parameters { sigma0: 0.0, k: consistency_pa_s_n, n: flow_index }
        }
    }
}

/// Whether the law is rigid below its yield stress.
#[must_use]
pub fn has_plug(rheology: &Rheology) -> bool {
    !matches!(rheology, Rheology::Papanastasiou { .. }) && parameters(rheology).sigma0 > 0.0
}

/// Viscosity without the yield stress at a shear rate: K γ̇ⁿ⁻¹, Pa s.
#[must_use]
pub fn plastic_viscosity(rheology: &Rheology, gamma_dot: f64) -> f64 {
    let Parameters { k, n, .. } = parameters(rheology);
    if n == 1.0 { k } else { k * libm::pow(gamma_dot, n - 1.0) }
}

/// Apparent viscosity σ/γ̇ at a shear rate > 0, Pa s.
#[must_use]
pub fn apparent_viscosity(rheology: &Rheology, gamma_dot: f64) -> f64 {
    let Parameters { sigma0, .. } = parameters(rheology);
    let yielded = match *rheology {
        Rheology::Papanastasiou { growth_s, .. } => -sigma0 * libm::expm1(-growth_s * gamma_dot),
        _ => sigma0,
    };
    yielded / gamma_dot + plastic_viscosity(rheology, gamma_dot)
}

/// Shear rate at a stress, 1/s: ((σ − σ0)/K)^(1/n), 0 below σ0.
#[must_use]
pub fn shear_rate(rheology: &Rheology, sigma: f64) -> f64 {
    let Parameters { sigma0, k, n } = parameters(rheology);
    if sigma <= sigma0 { 0.0 } else { libm::pow((sigma - sigma0) / k, 1.0 / n) }
}

/// Largest velocity of the steady flow between two walls, m/s:
/// n/(n+1) K^(−1/n) (σ_w − σ0)^(1+1/n) / f with σ_w = f a.
///
/// `force` f in N/m³, `half_gap` a in m. A round pipe of radius a is slower, by at least a half.
#[must_use]
pub fn channel_velocity(rheology: &Rheology, force: f64, half_gap: f64) -> f64 {
    let Parameters { sigma0, n, .. } = parameters(rheology);
    let wall_stress = force * half_gap;
    if wall_stress <= sigma0 {
        return 0.0;
    }
    n / (n + 1.0) * shear_rate(rheology, wall_stress) * (wall_stress - sigma0) / force
}

/// The law in lattice units.
#[must_use]
pub fn to_lattice(rheology: &Rheology, units: &Units) -> Law {
    let stress = |pa| units.stress_to_lattice(pa);
    let viscosity = |pa_s| units.viscosity_to_lattice(pa_s);
    let consistency = |k, n| units.consistency_to_lattice(k, n);
    match *rheology {
        Rheology::Newtonian { viscosity_pa_s } => Law::Newtonian { mu: viscosity(viscosity_pa_s) },
        Rheology::Bingham { yield_stress_pa, plastic_viscosity_pa_s } => {
            Law::Bingham { sigma0: stress(yield_stress_pa), mu: viscosity(plastic_viscosity_pa_s) }
        }
        Rheology::HerschelBulkley { yield_stress_pa, consistency_pa_s_n: k, flow_index: n } => {
            Law::HerschelBulkley { sigma0: stress(yield_stress_pa), k: consistency(k, n), n }
        }
        Rheology::PowerLaw { consistency_pa_s_n: k, flow_index: n } => {
            Law::PowerLaw { k: consistency(k, n), n }
        }
        Rheology::Papanastasiou { yield_stress_pa, consistency_pa_s_n: k, flow_index: n, growth_s } => {
            Law::Papanastasiou {
                sigma0: stress(yield_stress_pa),
                k: consistency(k, n),
                n,
                m: units.time_to_lattice(growth_s),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HB: Rheology =
        Rheology::HerschelBulkley { yield_stress_pa: 2.0, consistency_pa_s_n: 3.0, flow_index: 0.5 };

    #[test]
    fn exact_shear_rate_inverts_the_law() {
        // σ = 2 + 3·√4 = 8.
        assert_eq!(shear_rate(&HB, 8.0), 4.0);
        assert_eq!(shear_rate(&HB, 2.0), 0.0);
        assert_eq!(apparent_viscosity(&HB, 4.0), 2.0);
    }

    #[test]
    fn exact_channel_velocity_is_f_a2_over_2_mu_for_newtonian() {
        let water = Rheology::Newtonian { viscosity_pa_s: 0.5 };
        assert_eq!(channel_velocity(&water, 2.0, 0.5), 0.5);
        assert_eq!(channel_velocity(&HB, 4.0, 0.5), 0.0);
    }
}
