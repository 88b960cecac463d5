//! Decay of shear and sound waves in the continuum, and the leading lattice errors.

/// Amplitude of a shear wave after time t over its first value, e^{−νk²t}.
pub fn shear_decay(nu: f64, wave_number: f64, t: f64) -> f64 {
    libm::exp(-nu * wave_number * wave_number * t)
}

/// ν_eff/ν = 1 − 3U² of a shear wave along a mean flow U (lattice units, c_s² = 1/3): what the
/// second-order equilibrium leaves of Galilean invariance for long waves. 1 for a wave across it.
///
/// # Source
/// Qian & Orszag 1993, Europhys. Lett. 21, 255-259. With its discrete correction:
/// [`super::discrete_modes::shear_viscosity_ratio`].
pub fn galilean_viscosity_ratio(mean_flow_along_k: f64) -> f64 {
    1.0 - 3.0 * mean_flow_along_k * mean_flow_along_k
}

/// c_s = 1/√3 in lattice units.
pub fn sound_speed() -> f64 {
    (1.0_f64 / 3.0).sqrt()
}

/// Rate at which the amplitude of a plane sound wave decays, ½(4ν/3 + ν_b)k².
///
/// `bulk_viscosity` ν_b = 2ν/3 where the trace relaxes with τ⁺ (BGK, TRT), which makes the rate
/// νk²; ν_b = 1/9 where the trace relaxes at rate 1 (τ = 1, ν_b = (2/3)(1 − ½)/3).
///
/// # Source
/// Landau & Lifshitz §79, without heat conduction; Dellar 2001, Phys. Rev. E 64, 031203.
pub fn sound_decay_rate(nu: f64, bulk_viscosity: f64, wave_number: f64) -> f64 {
    0.5 * (4.0 / 3.0 * nu + bulk_viscosity) * wave_number * wave_number
}

/// Frequency (not angular) of the lowest standing sound wave between walls a distance H apart,
/// c_s/(2H), in lattice units and without damping.
pub fn standing_wave_frequency(height: f64) -> f64 {
    sound_speed() / (2.0 * height)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::discrete_modes::{Relaxation, Shear, shear_viscosity_ratio, sound};

    #[test]
    fn limit_of_long_discrete_waves() {
        let relaxation = Relaxation::bgk(0.8);
        let nu = relaxation.viscosity();
        for u in [0.0, 0.05, 0.1, 0.17] {
            let ratio = shear_viscosity_ratio(Shear::Axis, relaxation, 1000.0, u).unwrap();
            // Leading correction of order k² = 4e-5, coefficients below 1.
            assert!((ratio - galilean_viscosity_ratio(u)).abs() < 4e-5, "{u} {ratio}");
        }
        let (speed, decay) = sound(relaxation, 1000.0).unwrap();
        // Dispersion ~ (νk/c_s)²/2 and k²/24.
        assert!((speed / sound_speed() - 1.0).abs() < 1e-5, "{speed}");
        let k = core::f64::consts::TAU / 1000.0;
        let expected = sound_decay_rate(nu, 2.0 * nu / 3.0, k) / (nu * k * k);
        assert!((expected - 1.0).abs() < 1e-15);
        assert!((decay / expected - 1.0).abs() < 4e-5, "{decay}");
    }

    #[test]
    fn exact_relations() {
        // e^{−1}; rounding only.
        assert!((shear_decay(0.5, 2.0, 0.5) * core::f64::consts::E - 1.0).abs() < 1e-15);
        assert_eq!(standing_wave_frequency(10.0) * 20.0, sound_speed());
    }
}
