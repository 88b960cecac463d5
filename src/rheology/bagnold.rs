//! Bagnold number of the size classes of a mixture: which grains belong in the rheology of the fluid, and which must be
//! grains.
//!
//! Ba = ρ_s d² √λ γ̇/μ compares the stress of colliding grains with the viscous stress; λ is the linear concentration,
//! grain diameter over mean free distance. Bagnold measured a macro-viscous regime below 40 and grain inertia above
//! 450, with equal, neutrally buoyant grains in a Newtonian liquid: for a mixture of sizes in mud the number is an
//! indicator, not a law.

/// Largest Bagnold number of the macro-viscous regime.
///
/// # Source
/// Bagnold 1954, Proc. R. Soc. Lond. A 225, 49-63, doi 10.1098/rspa.1954.0186.
pub(crate) const MACRO_VISCOUS_BELOW: f64 = 40.0;

/// Smallest Bagnold number of the grain-inertia regime.
///
/// # Source
/// As [`MACRO_VISCOUS_BELOW`].
pub(crate) const GRAIN_INERTIA_ABOVE: f64 = 450.0;

/// Allowed departure of the sum of the volume shares from 1: shares given to three or four digits.
pub(crate) const SHARE_TOLERANCE: f64 = 1e-3;

/// Regime of a size class.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Regime {
    /// Ba ≤ 40: part of the rheology of the fluid.
    MacroViscous,
    /// 40 < Ba < 450: either; the choice has to be stated.
    Transitional,
    /// Ba ≥ 450: collisions matter, resolve as grains.
    GrainInertia,
}

impl Regime {
    /// Regime of a Bagnold number ≥ 0.
    #[must_use]
    pub fn of(bagnold: f64) -> Self {
        if bagnold <= MACRO_VISCOUS_BELOW {
            Self::MacroViscous
        } else if bagnold < GRAIN_INERTIA_ABOVE {
            Self::Transitional
        } else {
            Self::GrainInertia
        }
    }
}

/// Why no Bagnold number could be given.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub(crate) enum BagnoldError {
    /// A quantity is not positive and finite.
    #[error("{what} = {value}: must be positive and finite")]
    NotPositive {
        /// Its name with the unit.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// The solid fraction is not below the maximum packing.
    #[error(
        "solid fraction {solid_fraction} with maximum packing {maximum_packing}: the linear concentration \
         1/((maximum/fraction)^(1/3) - 1) needs 0 < fraction < maximum <= 1"
    )]
    Packing {
        /// Solid fraction.
        solid_fraction: f64,
        /// Maximum packing.
        maximum_packing: f64,
    },
    /// No size classes.
    #[error("no size classes given")]
    NoClasses,
    /// The shares do not add up.
    #[error("the volume shares of the size classes add up to {sum}, not to 1 (within 0.001)")]
    Shares {
        /// Their sum.
        sum: f64,
    },
}

/// Grains of about one size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SizeClass {
    /// Diameter, m.
    pub diameter_m: f64,
    /// Share of the volume of all solids, 0 to 1.
    pub volume_share: f64,
}

/// A mixture in shear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mixture {
    /// Volume of all grains over the volume of the mixture, 0 to 1.
    pub solid_fraction: f64,
    /// Largest possible solid fraction of these grains: about 0.64 for equal spheres at random, 0.74 closest packing
    /// (Bagnold's own figure), more for wide size distributions.
    pub maximum_packing: f64,
    /// Density of the grains, kg/m³.
    pub grain_density: f64,
    /// Density of the fluid, kg/m³; enters the Reynolds number only.
    pub fluid_density: f64,
    /// Dynamic viscosity of the fluid between the grains, Pa s; in a fluid with yield stress the apparent one at the
    /// shear rate.
    pub viscosity_pa_s: f64,
    /// Shear rate, 1/s.
    pub shear_rate: f64,
}

/// What was found for one class.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ClassReport {
    /// The class.
    pub class: SizeClass,
    /// Bagnold number with the linear concentration of *all* grains, which is what keeps a grain from moving past its
    /// neighbours: an upper bound for the class.
    pub bagnold: f64,
    /// Bagnold number as if the class were alone, with the linear concentration of its own share of the volume: a lower
    /// bound.
    pub bagnold_alone: f64,
    /// Regime by [`Self::bagnold`].
    pub regime: Regime,
    /// Reynolds number of a grain in shear, ρ_f γ̇ d²/μ.
    pub grain_reynolds: f64,
}

/// Linear concentration λ = 1/((c_max/c)^{1/3} − 1).
///
/// The ratio inverted, as one source prints it, makes λ negative (docs/errata.md 45).
///
/// # Arguments
/// `solid_fraction`: 0 < c < c_max; `maximum_packing`: c_max ≤ 1.
/// # Errors
/// `Packing` outside those ranges.
/// # Exactness
/// Correctly rounded operations and one libm cube root; c close to c_max is ill-conditioned.
/// # Source
/// Bagnold 1954, eq. 2; 004 Eq 2.4 corrected.
/// # Verified by
/// Unit tests `exact_linear_concentration` and `exact_for_a_regular_array`.
pub(crate) fn linear_concentration(solid_fraction: f64, maximum_packing: f64) -> Result<f64, BagnoldError> {
    let legal = solid_fraction > 0.0 && solid_fraction < maximum_packing && maximum_packing <= 1.0;
    if !legal {
        return Err(BagnoldError::Packing { solid_fraction, maximum_packing });
    }
    Ok(1.0 / (libm::cbrt(maximum_packing / solid_fraction) - 1.0))
}

/// Ba = ρ_s d² √λ γ̇/μ.
///
/// # Arguments
/// Density kg/m³, diameter m, λ as [`linear_concentration`], shear rate 1/s, viscosity Pa s; all positive.
/// # Returns
/// The number; not finite or negative for senseless arguments ([`classify`] checks them).
/// # Exactness
/// Correctly rounded operations: the same bits everywhere.
/// # Source
/// 000 Eq 1; 004 Eq 2.3.
/// # Verified by
/// Unit test `exact_bagnold_number`.
pub(crate) fn bagnold_number(
    density: f64,
    diameter: f64,
    lambda: f64,
    shear_rate: f64,
    viscosity: f64,
) -> f64 {
    density * diameter * diameter * lambda.sqrt() * shear_rate / viscosity
}

/// Diameter at which the Bagnold number reaches a threshold, m.
///
/// # Arguments
/// `mixture`; `threshold`: [`MACRO_VISCOUS_BELOW`] or [`GRAIN_INERTIA_ABOVE`], or another positive number.
/// # Errors
/// As [`classify`], without classes.
/// # Source
/// 000 Eq 1 solved for d.
/// # Verified by
/// Unit test `regimes_change_at_the_thresholds`.
#[cfg(test)]
fn threshold_diameter(mixture: &Mixture, threshold: f64) -> Result<f64, BagnoldError> {
    positive("threshold", threshold)?;
    let lambda = checked(mixture)?;
    let scale = mixture.grain_density * lambda.sqrt() * mixture.shear_rate;
    Ok((threshold * mixture.viscosity_pa_s / scale).sqrt())
}

/// Bagnold number and regime of every size class, in the order given.
///
/// # Errors
/// `NoClasses`; `NotPositive` for a diameter, share, density, viscosity or shear rate that is not; `Packing`;
/// `Shares` if the shares do not add up to 1 within 0.001.
/// # Source
/// 000 Eq 1; 004 Eqs 2.3-2.4 corrected; thresholds of Bagnold 1954.
/// # Verified by
/// Unit tests `regimes_change_at_the_thresholds` and `refuses_bad_input`.
pub(crate) fn classify(classes: &[SizeClass], mixture: &Mixture) -> Result<Vec<ClassReport>, BagnoldError> {
    let lambda = checked(mixture)?;
    if classes.is_empty() {
        return Err(BagnoldError::NoClasses);
    }
    for class in classes {
        positive("diameter_m", class.diameter_m)?;
        positive("volume_share", class.volume_share)?;
    }
    let sum: f64 = classes.iter().map(|class| class.volume_share).sum();
    if (sum - 1.0).abs() > SHARE_TOLERANCE {
        return Err(BagnoldError::Shares { sum });
    }
    let number = |class: &SizeClass, lambda: f64| {
        let Mixture { grain_density, shear_rate, viscosity_pa_s, .. } = *mixture;
        bagnold_number(grain_density, class.diameter_m, lambda, shear_rate, viscosity_pa_s)
    };
    classes
        .iter()
        .map(|class| {
            // A single class with a share of up to 1.001 is meant to be all of the solids.
            let own = class.volume_share.min(1.0) * mixture.solid_fraction;
            let bagnold = number(class, lambda);
            let per_rate = mixture.fluid_density * class.diameter_m * class.diameter_m;
            Ok(ClassReport {
                class: *class,
                bagnold,
                bagnold_alone: number(class, linear_concentration(own, mixture.maximum_packing)?),
                regime: Regime::of(bagnold),
                grain_reynolds: per_rate * mixture.shear_rate / mixture.viscosity_pa_s,
            })
        })
        .collect()
}

/// Checks a mixture and gives its linear concentration.
fn checked(mixture: &Mixture) -> Result<f64, BagnoldError> {
    positive("grain_density (kg/m3)", mixture.grain_density)?;
    positive("fluid_density (kg/m3)", mixture.fluid_density)?;
    positive("viscosity_pa_s", mixture.viscosity_pa_s)?;
    positive("shear_rate (1/s)", mixture.shear_rate)?;
    linear_concentration(mixture.solid_fraction, mixture.maximum_packing)
}

fn positive(what: &'static str, value: f64) -> Result<(), BagnoldError> {
    if value > 0.0 && value.is_finite() { Ok(()) } else { Err(BagnoldError::NotPositive { what, value }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MUD: Mixture = Mixture {
        solid_fraction: 0.32,
        maximum_packing: 0.64,
        grain_density: 2650.0,
        fluid_density: 1500.0,
        viscosity_pa_s: 5.0,
        shear_rate: 10.0,
    };

    #[test]
    fn exact_linear_concentration() {
        // Half of the maximum: 1/(2^{1/3} − 1) = 3.847; the misprint gives −4.847 = −(1 + λ).
        let lambda = linear_concentration(0.32, 0.64).unwrap();
        assert!((lambda - 3.847_322_101_863).abs() < 1e-11, "{lambda}");
        assert!((1.0 / (libm::cbrt(0.5) - 1.0) + 1.0 + lambda).abs() < 1e-12);
        // c = c_max/8: free distance equal to the diameter.
        assert!((linear_concentration(0.08, 0.64).unwrap() - 1.0).abs() < 1e-14);
    }

    #[test]
    fn exact_for_a_regular_array() {
        // Spheres of diameter 1 on a cubic lattice, 0.2 apart: λ is 1/0.2, whatever the lattice.
        let packed = core::f64::consts::PI / 6.0;
        let apart = packed / (1.2 * 1.2 * 1.2);
        assert!((linear_concentration(apart, packed).unwrap() - 5.0).abs() < 1e-13);
    }

    #[test]
    fn exact_bagnold_number() {
        // 2650 · 1e-4 · √4 · 10/5 = 1.06.
        assert!((bagnold_number(2650.0, 0.01, 4.0, 10.0, 5.0) - 1.06).abs() < 1e-15);
    }

    #[test]
    fn regimes_change_at_the_thresholds() {
        let low = threshold_diameter(&MUD, MACRO_VISCOUS_BELOW).unwrap();
        let high = threshold_diameter(&MUD, GRAIN_INERTIA_ABOVE).unwrap();
        let class = |diameter_m| SizeClass { diameter_m, volume_share: 0.25 };
        let classes = [class(low * 0.999), class(low * 1.001), class(high * 0.999), class(high * 1.001)];
        let found = classify(&classes, &MUD).unwrap();
        let regimes: Vec<Regime> = found.iter().map(|f| f.regime).collect();
        let expected =
            [Regime::MacroViscous, Regime::Transitional, Regime::Transitional, Regime::GrainInertia];
        assert_eq!(regimes, expected);
        assert!((found[3].bagnold / 450.0 - 1.001 * 1.001).abs() < 1e-12);
        assert!(found.iter().all(|f| f.bagnold_alone < f.bagnold && f.bagnold_alone > 0.0));
        assert!((found[0].grain_reynolds - 1500.0 * 10.0 * low * low * 0.999 * 0.999 / 5.0).abs() < 1e-12);
        assert_eq!(Regime::of(40.0), Regime::MacroViscous);
        assert_eq!(Regime::of(450.0), Regime::GrainInertia);
    }

    #[test]
    fn refuses_bad_input() {
        let one = [SizeClass { diameter_m: 0.01, volume_share: 1.0 }];
        assert_eq!(classify(&[], &MUD), Err(BagnoldError::NoClasses));
        let dense = Mixture { solid_fraction: 0.64, ..MUD };
        assert!(matches!(classify(&one, &dense), Err(BagnoldError::Packing { .. })));
        let still = Mixture { shear_rate: 0.0, ..MUD };
        assert!(matches!(classify(&one, &still), Err(BagnoldError::NotPositive { .. })));
        let short = [SizeClass { diameter_m: 0.01, volume_share: 0.5 }];
        assert!(matches!(classify(&short, &MUD), Err(BagnoldError::Shares { .. })));
        let nan = [SizeClass { diameter_m: f64::NAN, volume_share: 1.0 }];
        assert!(matches!(classify(&nan, &MUD), Err(BagnoldError::NotPositive { .. })));
        let alone = classify(&one, &MUD).unwrap();
        assert_eq!(alone[0].bagnold, alone[0].bagnold_alone);
    }
}
