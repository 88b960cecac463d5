//! Slip of half-way bounce-back walls in plane channel flow.

/// Velocity by which the computed profile of a lattice-aligned plane channel exceeds the exact
/// parabola, the same at every node:
/// u_num − u_exact = (G/ρ) \[2(τ⁻ − ½) − 3/(8(τ⁺ − ½))\].
///
/// It vanishes for Λ = (τ⁺ − ½)(τ⁻ − ½) = 3/16. For BGK, τ⁺ = τ⁻, it is G(16Λ − 3)/(24 ρν).
///
/// # Arguments
/// `force`: tangential force per volume G; `density` ρ; `tau_even` τ⁺ > ½, `tau_odd` τ⁻ ≥ ½, all in
/// lattice units.
///
/// # Source
/// Ginzburg & d'Humières 2003, Phys. Rev. E 68, 066614; He, Zou, Luo & Dembo 1997, J. Stat. Phys.
/// 87, 115-136 (BGK).
pub fn slip_velocity(force: f64, density: f64, tau_even: f64, tau_odd: f64) -> f64 {
    force / density * (2.0 * (tau_odd - 0.5) - 3.0 / (8.0 * (tau_even - 0.5)))
}

/// [`slip_velocity`] of BGK, τ⁺ = τ⁻ = τ.
pub fn slip_velocity_bgk(force: f64, density: f64, tau: f64) -> f64 {
    slip_velocity(force, density, tau, tau)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference_values::find;

    #[test]
    fn reference_bgk_slip() {
        let entry = find("lbm_bgk_halfway_bb_slip", &[]).unwrap();
        for (tau, key) in [(0.55, "tau=.55"), (0.8, "tau=.8"), (1.0, "tau=1"), (1.8, "tau=1.8")] {
            let reference = entry.field(key).unwrap();
            let slip = slip_velocity_bgk(1e-5, 1.0, tau);
            assert!((slip / reference - 1.0).abs() < entry.tolerance(), "{slip} {reference}");
            let (nu, magic) = ((tau - 0.5) / 3.0, (tau - 0.5) * (tau - 0.5));
            // Two ways to write the same formula: a few roundings.
            assert!((slip / (1e-5 * (16.0 * magic - 3.0) / (24.0 * nu)) - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn limit_no_slip_at_the_magic_product() {
        for tau_even in [0.55, 0.8, 1.0, 1.8, 1000.0] {
            let slip = slip_velocity(1.0, 1.0, tau_even, 0.5 + 0.1875 / (tau_even - 0.5));
            // Rounding of τ⁻ − ½ relative to ½.
            assert!(slip.abs() < 1e-15 / (tau_even - 0.5) + 1e-15, "{tau_even} {slip}");
        }
    }
}
