//! Settling of suspensions, and drag of random arrays of fixed spheres, at low to moderate Reynolds number.
//!
//! Three averages must not be mixed. *Settling*: every sphere carries the same force, the mean speed is sought (in a
//! box without net volume flux), u/u₀ = 1 − 6.55c + …. *Fixed random array*: every sphere has the same velocity, the
//! mean force is sought; its inverse is smaller (1 − 2.12√c + …). *Regular array*: [`super::cubic_array`]. Also: the
//! exponents of Richardson & Zaki come from suspensions whose structure the flow has made, which differs from that of
//! hard spheres placed at random. Everything here serves validation.

use super::super::ExactError;
use super::cubic_array::HASIMOTO;
use super::within;

/// u/u₀ = (1 − c)ⁿ.
///
/// # Arguments
/// `c`: 0 to 0.55 (range of the experiments); `exponent`: n, from one of the functions below.
/// # Exactness
/// Scatter of the experiments about 10 % in speed at c = 0.3; not a series in c: the slope at c → 0 is −n, not −6.55.
/// # Errors
/// `Argument` outside the range of c.
/// # Source
/// Richardson & Zaki 1954, Trans. Inst. Chem. Eng. 32, 35-53.
pub fn richardson_zaki(c: f64, exponent: f64) -> Result<f64, ExactError> {
    within("c", c, 0.0, 0.55, "must lie between 0 and 0.55")?;
    Ok(libm::pow(1.0 - c, exponent))
}

/// Exponent n at low Reynolds number of suspensions stirred by Brownian motion, whose structure stays that of hard
/// spheres at random, and its uncertainty: what random boxes should be compared with.
///
/// # Source
/// Brzinski & Durian 2018, Phys. Rev. Fluids 3, 124303 (arXiv 1710.09314): 27 data sets, 5.6 ± 0.1 (checked).
pub const BROWNIAN_EXPONENT: (f64, f64) = (5.6, 0.1);

/// Exponent n at low Reynolds number of suspensions without Brownian motion, whose structure the flow has made, and its
/// uncertainty.
///
/// # Source
/// Brzinski & Durian 2018, as for [`BROWNIAN_EXPONENT`]: 4.48 ± 0.04 (checked). Richardson & Zaki's own 4.65 lies near this branch.
pub const NON_BROWNIAN_EXPONENT: (f64, f64) = (4.48, 0.04);

/// Exponent n(Re) of Richardson & Zaki in a wide vessel: 4.65 (Re < 0.2), 4.35 Re^−0.03 (< 1), 4.45 Re^−0.1 (< 500),
/// 2.39 above. Re = ρ u₀ d/μ of *one* sphere. Jumps of 2 % at the joints; ±3 %.
///
/// # Errors
/// `Argument` if Re is not positive.
/// # Source
/// Richardson & Zaki 1954 (the third branch checked, the others from memory).
pub fn richardson_zaki_exponent(re: f64) -> Result<f64, ExactError> {
    ExactError::positive("Re", re)?;
    Ok(if re < 0.2 {
        4.65
    } else if re < 1.0 {
        4.35 * libm::pow(re, -0.03)
    } else if re < 500.0 {
        4.45 * libm::pow(re, -0.1)
    } else {
        2.39
    })
}

/// Exponent by (5.1 − n)/(n − 2.7) = 0.1 Re^0.9, 0.001 ≤ Re ≤ 3e4.
///
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Garside & Al-Dibouni 1977, Ind. Eng. Chem. Process Des. Dev. 16, 206-214, doi 10.1021/i260062a008 (checked).
pub fn garside_al_dibouni_exponent(re: f64) -> Result<f64, ExactError> {
    within("Re", re, 1e-3, 3e4, "must lie between 0.001 and 3e4")?;
    let x = 0.1 * libm::pow(re, 0.9);
    Ok((5.1 + 2.7 * x) / (1.0 + x))
}

/// Exponent by n = (4.7 + 0.41 Re^0.75)/(1 + 0.175 Re^0.75), 0.2 ≤ Re ≤ 1000 (4.7 and 2.35 at the ends).
///
/// # Errors
/// `Argument` if Re is not positive.
/// # Source
/// Rowe 1987, Chem. Eng. Sci. 42, 2795-2796 (from memory).
pub fn rowe_exponent(re: f64) -> Result<f64, ExactError> {
    ExactError::positive("Re", re)?;
    let x = libm::pow(re, 0.75);
    Ok((4.7 + 0.41 * x) / (1.0 + 0.175 * x))
}

/// Dilute random suspension of equal hard spheres: u/u₀ = 1 − 6.55 c, c ≤ 0.05.
///
/// # Exactness
/// The next term is +22 c²: 1.4 % of u₀ at c = 0.025.
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Batchelor 1972, J. Fluid Mech. 52, 245-268, doi 10.1017/S0022112072001399 (6.55; later 6.546).
pub fn batchelor(c: f64) -> Result<f64, ExactError> {
    within("c", c, 0.0, 0.05, "must lie between 0 and 0.05")?;
    Ok(1.0 - 6.55 * c)
}

/// Random suspension to second order: u/u₀ = 1 − 6.546 c + 21.918 c², c ≤ 0.1.
///
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Cichocki, Ekiel-Jeżewska, Szymczak & Wajnryb 2002, J. Chem. Phys. 117, 1231-1241, doi 10.1063/1.1484380 (from
/// memory).
pub fn three_body(c: f64) -> Result<f64, ExactError> {
    within("c", c, 0.0, 0.1, "must lie between 0 and 0.1")?;
    Ok(1.0 - 6.546 * c + 21.918 * c * c)
}

/// Random suspension: u/u₀ = (1 − c)³/(1 + 2c + 1.429 c (1 − c)³), c ≤ 0.5.
///
/// # Exactness
/// Semi-empirical, no error stated. Its slope at c → 0 is −6.43. Within 1 % of [`BROWNIAN_EXPONENT`] at c = 0.1, 7 % above
/// it at 0.15 and 45 % at 0.3, where it meets [`NON_BROWNIAN_EXPONENT`]: use it up to 0.15.
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Hayakawa & Ichiki 1995, Phys. Rev. E 51, R3815-R3818, doi 10.1103/PhysRevE.51.R3815 (from memory).
pub fn hayakawa_ichiki(c: f64) -> Result<f64, ExactError> {
    within("c", c, 0.0, 0.5, "must lie between 0 and 0.5")?;
    let free = (1.0 - c) * (1.0 - c) * (1.0 - c);
    Ok(free / (1.0 + 2.0 * c + 1.429 * c * free))
}

/// Random suspension, far-field mobilities only (Rotne-Prager with the Percus-Yevick structure):
/// u/u₀ = 1 + c − c²/5 − (6c/5)(5 − c + c²/2)/(1 + 2c), c ≤ 0.5.
///
/// # Exactness
/// Slope −5 instead of −6.55: near-field interactions are missing, and the speed is too high (10 % at c = 0.1).
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Brady & Durlofsky 1988, Phys. Fluids 31, 717-727, doi 10.1063/1.866808 (from memory).
pub fn brady_durlofsky(c: f64) -> Result<f64, ExactError> {
    within("c", c, 0.0, 0.5, "must lie between 0 and 0.5")?;
    Ok(1.0 + c - 0.2 * c * c - 1.2 * c * (5.0 - c + 0.5 * c * c) / (1.0 + 2.0 * c))
}

/// Structure factor of hard spheres at zero wave number, (1 − c)⁴/((1 + 2c)² + c³(c − 4)), c ≤ 0.5.
///
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Carnahan & Starling 1969, J. Chem. Phys. 51, 635-636, doi 10.1063/1.1672048: inverse of d(cZ)/dc.
pub fn structure_factor(c: f64) -> Result<f64, ExactError> {
    within("c", c, 0.0, 0.5, "must lie between 0 and 0.5")?;
    let free = (1.0 - c) * (1.0 - c);
    let open = 1.0 + 2.0 * c;
    Ok(free * free / (open * open + c * c * c * (c - 4.0)))
}

/// High-frequency viscosity of a random suspension over that of the fluid: (1 + (3/2) x)/(1 − x),
/// x = c (1 + c − 0.189 c²), c ≤ 0.45.
///
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Ladd 1990, J. Chem. Phys. 93, 3484-3494, doi 10.1063/1.458830: fit to simulations (from memory).
pub fn viscosity_ratio(c: f64) -> Result<f64, ExactError> {
    within("c", c, 0.0, 0.45, "must lie between 0 and 0.45")?;
    let x = c * (1.0 + c - 0.189 * c * c);
    Ok((1.0 + 1.5 * x) / (1.0 - x))
}

/// What a cubic periodic box with N spheres takes from the settling speed: (u(∞) − u(N))/u₀ =
/// 1.7601 (c/N)^{1/3} S(0)/(μ_s/μ).
///
/// To be *added* to the mean speed of an ensemble of random boxes (mean over equilibrium hard-sphere configurations).
/// With N = 1 and S = μ_s/μ = 1 it is the leading deficit of a simple cubic array.
///
/// # Arguments
/// `c`: 0 to 0.45; `spheres`: N ≥ 1.
/// # Exactness
/// Removes most of the dependence on N; what is left is of order c/N. At c = 0.1, N = 27 it is 0.095, a sixth of the
/// speed: never omit it.
/// # Errors
/// `Argument` outside the ranges.
/// # Source
/// Ladd 1990, J. Chem. Phys. 93, 3484-3494; Mo & Sangani 1994, Phys. Fluids 6, 1637-1652, doi 10.1063/1.868227.
pub fn periodic_box_deficit(c: f64, spheres: u32) -> Result<f64, ExactError> {
    ExactError::positive("spheres", f64::from(spheres))?;
    Ok(HASIMOTO * libm::cbrt(c / f64::from(spheres)) * structure_factor(c)? / viscosity_ratio(c)?)
}

/// Fixed random array, Stokes flow: whole force on a sphere (share of the mean pressure gradient included) over 6πμaU
/// with U the superficial velocity; for c < 0.4 (1 + 3√(c/2) + (135/64) c ln c + 16.14 c)/(1 + 0.681c − 8.48c² +
/// 8.16c³), above 10c/(1 − c)³.
///
/// # Arguments
/// `c`: 0 to 0.6.
/// # Exactness
/// Fit to lattice-Boltzmann simulations, about 3 %; 1 % jump at 0.4. A variant with 17.14 is in circulation (Koch &
/// Sangani 1999); 16.14 joins the second branch and [`beetstra`] better.
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Hill, Koch & Ladd 2001, J. Fluid Mech. 448, 213-241, doi 10.1017/S0022112001005948 (from memory).
pub fn hill_koch_ladd(c: f64) -> Result<f64, ExactError> {
    within("c", c, 0.0, 0.6, "must lie between 0 and 0.6")?;
    if c == 0.0 {
        return Ok(1.0);
    }
    if c >= 0.4 {
        let free = 1.0 - c;
        return Ok(10.0 * c / (free * free * free));
    }
    let top = 1.0 + 3.0 * (0.5 * c).sqrt() + 135.0 / 64.0 * c * libm::log(c) + 16.14 * c;
    Ok(top / (1.0 + 0.681 * c - 8.48 * c * c + 8.16 * c * c * c))
}

/// Dilute fixed random array, whole force over 6πμaU: 1 + (3/√2)√c + (135/64) c ln c + 16.456 c, c ≤ 0.1.
///
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Kim & Russel 1985, J. Fluid Mech. 154, 269-286, doi 10.1017/S0022112085001525 (Brinkman: the first two terms, also
/// Childress 1972 and Howells 1974; last coefficient from memory).
pub fn kim_russel(c: f64) -> Result<f64, ExactError> {
    within("c", c, 0.0, 0.1, "must lie between 0 and 0.1")?;
    let log = if c > 0.0 { libm::log(c) } else { 0.0 };
    Ok(1.0 + 3.0 * (0.5 * c).sqrt() + 135.0 / 64.0 * c * log + 16.456 * c)
}

/// Fixed random array at Reynolds number Re = ρ U d/μ (superficial velocity): *whole* force over 6πμaU.
///
/// The paper gives the part without the mean pressure gradient,
/// 10c/(1−c)² + (1−c)²(1 + 1.5√c) + (0.413 Re/(24(1−c)²)) ((1−c)^−1 + 3c(1−c) + 8.4 Re^−0.343)/(1 +
/// 10^{3c} Re^{−(1+4c)/2}); here it is divided by 1 − c.
///
/// # Arguments
/// `c`: 0 to 0.6; `re`: 0 (Stokes flow) to 1000.
/// # Exactness
/// Fit to lattice-Boltzmann simulations, 3 % at Re → 0 and about 8 % otherwise, as its authors state.
/// # Errors
/// `Argument` outside the ranges.
/// # Source
/// van der Hoef, Beetstra & Kuipers 2005, J. Fluid Mech. 528, 233-254, doi 10.1017/S0022112004003295 (Re → 0);
/// Beetstra, van der Hoef & Kuipers 2007, AIChE J. 53, 489-501, doi 10.1002/aic.11065 (checked).
pub fn beetstra(c: f64, re: f64) -> Result<f64, ExactError> {
    within("c", c, 0.0, 0.6, "must lie between 0 and 0.6")?;
    within("Re", re, 0.0, 1000.0, "must lie between 0 and 1000")?;
    let e = 1.0 - c;
    let creeping = 10.0 * c / (e * e) + e * e * (1.0 + 1.5 * c.sqrt());
    let inertia = if re > 0.0 {
        let top = 1.0 / e + 3.0 * c * e + 8.4 * libm::pow(re, -0.343);
        let below = 1.0 + libm::pow(10.0, 3.0 * c) * libm::pow(re, -0.5 * (1.0 + 4.0 * c));
        0.413 * re / (24.0 * e * e) * top / below
    } else {
        0.0
    };
    Ok((creeping + inertia) / e)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limit_dilute_settling() {
        let slope = |f: &dyn Fn(f64) -> f64| (f(1e-5) - 1.0) / 1e-5;
        assert!((slope(&|c| batchelor(c).unwrap()) + 6.55).abs() < 1e-6);
        assert!((slope(&|c| three_body(c).unwrap()) + 6.546).abs() < 1e-3);
        assert!((slope(&|c| hayakawa_ichiki(c).unwrap()) + 6.429).abs() < 1e-3);
        assert!((slope(&|c| brady_durlofsky(c).unwrap()) + 5.0).abs() < 1e-3);
    }

    #[test]
    fn parity_of_settling_laws() {
        for c in [0.05, 0.1] {
            let series = three_body(c).unwrap();
            // The next term of the series is unknown, of order 60 c³ (6 % at 0.1).
            assert!((hayakawa_ichiki(c).unwrap() / series - 1.0).abs() < 0.08, "{c}");
            assert!((richardson_zaki(c, 5.1).unwrap() / series - 1.0).abs() < 0.12, "{c}");
        }
        for c in [0.1, 0.2, 0.3, 0.4] {
            let (a, b) = (hayakawa_ichiki(c).unwrap(), brady_durlofsky(c).unwrap());
            assert!((a / b - 1.0).abs() < 0.25, "{c} {a} {b}");
            // Mobile spheres settle faster than a fixed random array lets fluid through: different averages.
            assert!(a > 1.0 / hill_koch_ladd(c).unwrap(), "{c}");
        }
    }

    #[test]
    fn two_branches() {
        let law = |c: f64, n: f64| richardson_zaki(c, n).unwrap();
        // Random hard spheres at low c: the Brownian branch and the three-body series differ by 3 % at 0.05, 2 % at 0.1.
        for c in [0.05, 0.1] {
            let ratio = three_body(c).unwrap() / law(c, BROWNIAN_EXPONENT.0);
            assert!((ratio - 1.0).abs() < 0.035, "{c} {ratio}");
        }
        let ratio = |c: f64, n: f64| hayakawa_ichiki(c).unwrap() / law(c, n);
        assert!((ratio(0.1, BROWNIAN_EXPONENT.0) - 1.0).abs() < 0.015);
        assert!((ratio(0.3, BROWNIAN_EXPONENT.0) - 1.45).abs() < 0.02);
        assert!((ratio(0.3, NON_BROWNIAN_EXPONENT.0) - 1.0).abs() < 0.04);
    }

    #[test]
    fn limit_exponents() {
        assert_eq!(richardson_zaki_exponent(0.1).unwrap(), 4.65);
        assert_eq!(richardson_zaki_exponent(1e4).unwrap(), 2.39);
        for edge in [0.2, 1.0, 500.0] {
            let jump =
                richardson_zaki_exponent(edge * 0.999_999).unwrap() / richardson_zaki_exponent(edge).unwrap();
            assert!((jump - 1.0).abs() < 0.025, "{edge} {jump}");
        }
        assert!((garside_al_dibouni_exponent(1e-3).unwrap() - 5.1).abs() < 1e-3);
        let n = garside_al_dibouni_exponent(30.0).unwrap();
        assert!(((5.1 - n) / (n - 2.7) / (0.1 * libm::pow(30.0, 0.9)) - 1.0).abs() < 1e-12);
        assert!((rowe_exponent(1e-6).unwrap() - 4.7).abs() < 1e-4);
        // The three agree within their scatter.
        for re in [1.0, 10.0, 100.0] {
            let a = richardson_zaki_exponent(re).unwrap();
            assert!((rowe_exponent(re).unwrap() / a - 1.0).abs() < 0.06, "{re}");
            assert!((garside_al_dibouni_exponent(re).unwrap() / a - 1.0).abs() < 0.15, "{re}");
        }
    }

    #[test]
    fn exact_structure_factor_is_the_compressibility() {
        let z = |c: f64| c * (1.0 + c + c * c - c * c * c) / libm::pow(1.0 - c, 3.0);
        for c in [0.05, 0.2, 0.45] {
            let h = 1e-5;
            let slope = (z(c + h) - z(c - h)) / (2.0 * h);
            // Central difference: h² times a third derivative below 1e4.
            assert!((structure_factor(c).unwrap() * slope - 1.0).abs() < 1e-7, "{c}");
        }
    }

    #[test]
    fn limit_box_and_viscosity() {
        // Einstein, and one sphere per box: Hasimoto.
        assert!(((viscosity_ratio(1e-6).unwrap() - 1.0) / 1e-6 - 2.5).abs() < 1e-4);
        let c = 1e-9;
        assert!((periodic_box_deficit(c, 1).unwrap() / (1.760_118_88 * libm::cbrt(c)) - 1.0).abs() < 1e-7);
        assert!((periodic_box_deficit(0.1, 27).unwrap() - 0.0951).abs() < 1e-4);
        assert!(periodic_box_deficit(0.1, 0).is_err());
    }

    #[test]
    fn parity_of_fixed_arrays() {
        for c in [0.1, 0.2, 0.3, 0.4, 0.5] {
            let ratio = beetstra(c, 0.0).unwrap() / hill_koch_ladd(c).unwrap();
            assert!((ratio - 1.0).abs() < 0.07, "{c} {ratio}");
        }
        for c in [0.001, 0.01, 0.05] {
            let ratio = kim_russel(c).unwrap() / hill_koch_ladd(c).unwrap();
            assert!((ratio - 1.0).abs() < 0.03, "{c} {ratio}");
        }
        // Kozeny-Carman with constant 180 at high c: whole force 10c/(1 − c)³.
        assert!((beetstra(0.6, 0.0).unwrap() * 0.064 / 6.0 - 1.0).abs() < 0.06);
        // One sphere: the drag curve.
        let one = beetstra(0.0, 10.0).unwrap();
        assert!((one / (1.0 + 0.15 * libm::pow(10.0, 0.687)) - 1.0).abs() < 0.1, "{one}");
        assert!(hill_koch_ladd(0.7).is_err() && beetstra(0.1, -1.0).is_err() && kim_russel(0.2).is_err());
    }
}
