//! A sphere floating at a flat free surface, no surface tension.
//!
//! Lengths in radii: `depth` is the height of the wetted cap over the radius, 0 (touching) to 2 (covered).

use core::f64::consts::PI;

use super::super::ExactError;
use super::within;

/// Share of the volume of a sphere below the surface: η²(3 − η)/4.
///
/// # Arguments
/// `depth`: η, 0 to 2.
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Volume of a spherical cap, πh²(3a − h)/3.
pub fn submerged_share(depth: f64) -> Result<f64, ExactError> {
    within("depth", depth, 0.0, 2.0, "must lie between 0 and 2 radii")?;
    Ok(0.25 * depth * depth * (3.0 - depth))
}

/// Depth at which a sphere of relative density s floats: the root of η²(3 − η) = 4s,
/// η = 1 + 2 cos((arccos(1 − 2s) + 4π)/3).
///
/// # Arguments
/// `relative_density`: s = ρ_s/ρ_f, 0 to 1.
/// # Exactness
/// Rounding, 1e-15; near s = 0 and 1 the root itself is ill-conditioned (η ≈ √(4s/3)).
/// # Errors
/// `Argument` outside the range: a denser sphere sinks.
pub fn depth(relative_density: f64) -> Result<f64, ExactError> {
    within("relative_density", relative_density, 0.0, 1.0, "must lie between 0 and 1 (denser spheres sink)")?;
    let angle = (libm::acos(1.0 - 2.0 * relative_density) + 4.0 * PI) / 3.0;
    Ok((1.0 + 2.0 * libm::cos(angle)).clamp(0.0, 2.0))
}

/// Buoyancy over ρ_f g a³ at a depth: (π/3) η²(3 − η).
///
/// # Errors
/// `Argument` for a depth outside 0 to 2 radii.
pub fn buoyancy(depth: f64) -> Result<f64, ExactError> {
    Ok(4.0 / 3.0 * PI * submerged_share(depth)?)
}

/// Radius of the waterline circle over the radius of the sphere, √(η(2 − η)).
///
/// # Errors
/// `Argument` for a depth outside 0 to 2 radii.
pub fn waterline_radius(depth: f64) -> Result<f64, ExactError> {
    within("depth", depth, 0.0, 2.0, "must lie between 0 and 2 radii")?;
    Ok((depth * (2.0 - depth)).sqrt())
}

/// Angular frequency of small bobbing over √(g/a): √(3η(2 − η)/(4(s + m))), with m the added mass over ρ_f (4/3)πa³.
///
/// # Arguments
/// `relative_density`: 0 < s < 1; `added_mass`: m ≥ 0, 0 for the hydrostatic frequency. For s = ½ the added mass lies
/// between ¼ (high frequency, free surface as pressure node) and about 0.4 (low frequency); from memory.
/// # Errors
/// `Argument` outside the ranges.
/// # Source
/// Stiffness ρ_f g π r_w² of the waterline; elementary.
pub fn bobbing_frequency(relative_density: f64, added_mass: f64) -> Result<f64, ExactError> {
    ExactError::positive("relative_density", relative_density)?;
    within("added_mass", added_mass, 0.0, f64::MAX, "must not be negative")?;
    let eta = depth(relative_density)?;
    Ok((0.75 * eta * (2.0 - eta) / (relative_density + added_mass)).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_equilibrium() {
        for s in [0.05, 0.2, 0.5, 0.73, 0.99] {
            let eta = depth(s).unwrap();
            assert!((submerged_share(eta).unwrap() - s).abs() < 2e-15, "{s}");
        }
        assert!((depth(0.5).unwrap() - 1.0).abs() < 1e-15);
        assert!(depth(0.0).unwrap() < 1e-7 && depth(1.0).unwrap() > 2.0 - 1e-7);
        // η ≈ √(4s/3) for light spheres; next term s/2·(4/9).
        assert!((depth(1e-6).unwrap() / (4e-6_f64 / 3.0).sqrt() - 1.0).abs() < 1e-3);
        assert!(depth(1.1).is_err() && submerged_share(2.1).is_err() && bobbing_frequency(0.0, 0.0).is_err());
    }

    #[test]
    fn exact_cap_volume_by_slices() {
        let eta = 0.8;
        let slices = 20_000;
        let step = eta / f64::from(slices);
        let volume: f64 =
            (0..slices).map(|i| (f64::from(i) + 0.5) * step).map(|z| PI * z * (2.0 - z) * step).sum();
        // Midpoint rule: error π η³... step²/24 × second derivative 2π.
        assert!((buoyancy(eta).unwrap() - volume).abs() < 1e-8);
    }

    #[test]
    fn bobbing_is_the_slope_of_buoyancy() {
        let (s, h) = (0.5, 1e-5);
        let eta = depth(s).unwrap();
        let slope = (buoyancy(eta + h).unwrap() - buoyancy(eta - h).unwrap()) / (2.0 * h);
        let omega2 = slope / (4.0 / 3.0 * PI * s);
        let frequency = bobbing_frequency(s, 0.0).unwrap();
        assert!((frequency * frequency / omega2 - 1.0).abs() < 1e-9);
        assert!((frequency - 1.5_f64.sqrt()).abs() < 1e-15);
        assert!((waterline_radius(eta).unwrap() - 1.0).abs() < 1e-15);
    }
}
