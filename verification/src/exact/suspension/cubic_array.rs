//! Drag on, and settling of, spheres in a simple cubic array in Stokes flow.
//!
//! Convention: F = 6πμa U K(c), with U the superficial velocity (mean over the whole cell, spheres included) relative to
//! the spheres and F the *whole* force on a sphere, which balances the mean pressure drop: F = G L³ with G the drop per
//! length and L³ the cell. Three set-ups measure it:
//!
//! (a) fixed spheres, the fluid driven by a body force f per volume of *fluid only*: it stands for a pressure drop
//! G = f that does not push on the spheres, so that the surface force is (1 − c) f L³, and K = f L³/(6πμaU);
//!
//! (b) spheres falling in a box closed below, no net volume flux: the pressure carries the weight of the mixture,
//! G = cΔρg beyond hydrostatics, the whole force is the weight less buoyancy in the *fluid*, W = (4/3)πa³Δρg, and
//! u/u₀ = 1/K;
//!
//! (c) the same in a box periodic along gravity: no mean pressure drop can arise, a body force f = W/L³ per volume of
//! fluid against gravity takes its place, and the force applied to each sphere must be the weight less buoyancy in the
//! *mixture*, (1 − c) W. Momentum then balances, and again u/u₀ = 1/K, with u relative to the mean over the whole cell
//! (spheres included, moving with u). To apply W itself, with f = W/((1 − c)L³), makes the fall too fast by 1/(1 − c).

use super::super::ExactError;
use super::within;

/// Σ over the simple cubic lattice that is the first coefficient of 1/K: 1.760118876 c^{1/3}.
///
/// # Source
/// Hasimoto 1959, J. Fluid Mech. 5, 317-328, doi 10.1017/S0022112059000222 (there 1.7601); the further digits follow
/// from [`super::sphere_array`] at small c.
pub const HASIMOTO: f64 = 1.760_118_88;

/// Largest c of [`drag`].
pub const MOST_DENSE: f64 = 0.45;

/// Chebyshev coefficients of 1/K on 0 ≤ c^{1/3} ≤ 0.45^{1/3}.
///
/// Interpolation at 26 points of [`super::sphere_array::simple_cubic`] with degree and points (13, 20) for c < 0.12,
/// (17, 28) for c < 0.25, (25, 40) for c < 0.36, (29, 60) above.
const INVERSE: [f64; 26] = [
    4.482_994_810_067e-1,
    -4.923_645_483_744e-1,
    6.983_049_431_831e-2,
    1.027_264_240_681e-2,
    -1.288_195_424_606e-4,
    -3.184_114_665_931e-5,
    -2.091_469_447_616e-4,
    -8.667_891_984_144e-5,
    8.790_394_251_74e-6,
    1.411_824_518_406e-5,
    2.161_442_385_082e-6,
    -1.403_647_483_612e-6,
    -8.173_026_020_152e-7,
    -9.902_593_608_361e-8,
    8.573_407_988_672e-8,
    4.661_873_745_157e-8,
    2.864_866_976_127e-9,
    -7.357_909_802_808e-9,
    -4.014_046_727_486e-9,
    -8.128_092_429_885e-10,
    1.703_186_993_15e-10,
    2.176_239_615_865e-10,
    1.295_894_396_065e-10,
    6.986_300_213_554e-11,
    3.339_030_120_773e-11,
    1.170_088_598_662e-11,
];

/// K(c), by interpolation of [`super::sphere_array::simple_cubic`].
///
/// # Arguments
/// `c`: solid fraction, 0 to 0.45.
/// # Exactness
/// Interpolation: 1e-11 for c ≤ 0.3, 2e-9 at 0.445, measured against the solver between the nodes. The solver itself
/// (change with its resolution): below 1e-10 for c ≤ 0.25, 2e-9 to 0.42, 2e-7 at 0.45.
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Computed here; agrees with Zick & Homsy 1982, Table 2, to the digits printed there ([`ZICK_HOMSY`]).
pub fn drag(c: f64) -> Result<f64, ExactError> {
    within("c", c, 0.0, MOST_DENSE, "must lie between 0 and 0.45")?;
    let x = 2.0 * libm::cbrt(c) / libm::cbrt(MOST_DENSE) - 1.0;
    // Clenshaw's recurrence.
    let (mut one, mut two) = (0.0, 0.0);
    for coefficient in INVERSE[1..].iter().rev() {
        (one, two) = (2.0 * x * one - two + coefficient, one);
    }
    Ok(1.0 / (x * one - two + INVERSE[0]))
}

/// Settling speed of a cubic array over that of one sphere, 1/K(c), in a box without net volume flux.
///
/// # Errors
/// `Argument` where [`drag`] is not known.
pub fn settling_ratio(c: f64) -> Result<f64, ExactError> {
    Ok(1.0 / drag(c)?)
}

/// Simple cubic rows of Table 2 of Zick & Homsy: (c, K). Last digit as printed; π/6 is the closest packing.
///
/// # Source
/// Zick & Homsy 1982, J. Fluid Mech. 115, 13-26, doi 10.1017/S0022112082000627. Compared with a second public copy of
/// the table for c ≥ 0.027; the rows 0.000125, 0.001 and 0.008 are from memory (and agree with [`drag`]).
pub const ZICK_HOMSY: [(f64, f64); 10] = [
    (0.000_125, 1.096),
    (0.001, 1.212),
    (0.008, 1.525),
    (0.027, 2.008),
    (0.064, 2.810),
    (0.125, 4.292),
    (0.216, 7.442),
    (0.343, 15.4),
    (0.45, 28.1),
    (core::f64::consts::FRAC_PI_6, 42.1),
];

/// Dilute series 1/K = 1 − 1.7601 c^{1/3} + c − 1.5593 c².
///
/// # Arguments
/// `c`: 0 to 0.1; error of 1/K below 4 c^{8/3} (2e-8 at 0.001, 0.9 % of 1 at 0.1).
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Hasimoto 1959 (with the c² coefficient of Sangani & Acrivos 1982).
pub fn hasimoto(c: f64) -> Result<f64, ExactError> {
    within("c", c, 0.0, 0.1, "must lie between 0 and 0.1")?;
    Ok(1.0 / (1.0 - HASIMOTO * libm::cbrt(c) + c - 1.5593 * c * c))
}

/// Six-term series 1/K = 1 − 1.7601 c^{1/3} + c − 1.5593 c² + 3.9799 c^{8/3} − 3.0734 c^{10/3}.
///
/// # Arguments
/// `c`: 0 to 0.1; error of 1/K measured against [`drag`]: 7e-10 at 0.01, 1.4e-6 at 0.05, 4e-5 at 0.1.
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Sangani & Acrivos 1982, Int. J. Multiphase Flow 8, 343-360, doi 10.1016/0301-9322(82)90047-7 (coefficients from
/// memory, confirmed by the comparison).
pub fn sangani_acrivos_dilute(c: f64) -> Result<f64, ExactError> {
    within("c", c, 0.0, 0.1, "must lie between 0 and 0.1")?;
    let s = libm::cbrt(c);
    let s8 = c * c * s * s;
    Ok(1.0 / (1.0 - HASIMOTO * s + c - 1.5593 * c * c + 3.9799 * s8 - 3.0734 * s8 * s * s))
}

/// Coefficients q_n of K = Σ q_n χⁿ, χ = (6c/π)^{1/3}.
const SANGANI_ACRIVOS: [f64; 31] = [
    1.0,
    1.418_649,
    2.012_564,
    2.331_523,
    2.564_809,
    2.584_787,
    2.873_609,
    3.340_163,
    3.536_763,
    3.504_092,
    3.253_622,
    2.689_757,
    2.037_769,
    1.809_341,
    1.877_347,
    1.534_685,
    0.903_470_8,
    0.285_789_6,
    -0.551_262_6,
    -1.278_724,
    1.013_350,
    5.492_491,
    4.615_388,
    -0.573_602_3,
    -2.865_924,
    -4.709_215,
    -6.870_076,
    0.145_530_4,
    12.518_91,
    9.742_811,
    -5.566_269,
];

/// Series K = Σ_{n ≤ 30} q_n (6c/π)^{n/3}.
///
/// # Arguments
/// `c`: 0 to 0.4.
/// # Exactness
/// Truncated: relative error against [`drag`] 1.5e-7 at 0.1, 8.7e-5 at 0.2, 0.9 % at 0.343. No gate above 0.15.
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Sangani & Acrivos 1982, Table 2 (coefficients from memory, confirmed to all their digits by [`drag`] up to c = 0.1
/// and by a second evaluation of the same series at c = 0.2 and 0.343).
pub fn sangani_acrivos(c: f64) -> Result<f64, ExactError> {
    within("c", c, 0.0, 0.4, "must lie between 0 and 0.4")?;
    let chi = libm::cbrt(6.0 * c / core::f64::consts::PI);
    Ok(SANGANI_ACRIVOS.iter().rev().fold(0.0, |sum, q| sum * chi + q))
}

/// Factor by which (1 − c)ⁿ exceeds the settling ratio of a regular array: (1 − c)ⁿ K(c).
///
/// A correct solver must miss the law of Richardson and Zaki by this factor on a regular grid.
///
/// # Arguments
/// `c`: 0 to 0.45; `exponent`: n, 4.65 at low Reynolds number.
/// # Errors
/// `Argument` where [`drag`] is not known.
pub fn richardson_zaki_excess(c: f64, exponent: f64) -> Result<f64, ExactError> {
    Ok(libm::pow(1.0 - c, exponent) * drag(c)?)
}

#[cfg(test)]
mod tests {
    use super::super::sphere_array::simple_cubic;
    use super::*;

    /// K by the method of fundamental solutions (independent program), as tabled for the project: (c, K).
    const FUNDAMENTAL: [(f64, f64); 7] = [
        (0.001, 1.212_140_9),
        (0.005, 1.420_479_2),
        (0.01, 1.585_651_1),
        (0.027, 2.007_747_7),
        (0.1, 3.642_448_6),
        (0.2, 6.775_922),
        (0.343, 15.399_58),
    ];

    fn relative(a: f64, b: f64) -> f64 {
        (a / b - 1.0).abs()
    }

    #[test]
    fn exact_interpolation_meets_the_solver() {
        for (c, degree, points) in [(0.0005, 9, 16), (0.05, 11, 18), (0.15, 15, 24), (0.3, 21, 32)] {
            let exact = simple_cubic(c, degree, points).map(|a| a.drag).unwrap();
            assert!(relative(drag(c).unwrap(), exact) < 1e-9, "{c}");
        }
    }

    #[test]
    fn exact_solver_is_spectral() {
        let at = |degree, points| simple_cubic(0.2, degree, points).unwrap().drag;
        let best = at(15, 24);
        // Errors measured 1.2e-4, 7e-8 and 7e-11.
        assert!(relative(at(5, 12), best) < 2e-4);
        assert!(relative(at(9, 16), best) < 1e-7);
        assert!(relative(at(13, 20), best) < 1e-9);
    }

    #[test]
    fn paper_zick_homsy_1982() {
        for (c, k) in ZICK_HOMSY.into_iter().filter(|row| row.0 <= MOST_DENSE) {
            // Half a unit of the last digit printed.
            let digit = if k < 10.0 { 0.0005 } else { 0.05 };
            assert!((drag(c).unwrap() - k).abs() <= digit * 1.001, "{c} {}", drag(c).unwrap());
        }
    }

    #[test]
    fn parity_with_an_independent_method() {
        for (c, k) in FUNDAMENTAL {
            // Eight digits, and the scatter of that method: below 5e-8 for c <= 0.064, 1e-5 at 0.343.
            let tolerance = if c < 0.05 {
                5e-8
            } else if c < 0.3 {
                5e-7
            } else {
                1e-5
            };
            assert!(relative(drag(c).unwrap(), k) < tolerance, "{c}");
        }
    }

    #[test]
    fn limit_series() {
        for c in [1e-6, 1e-4, 1e-3] {
            let s = libm::cbrt(c);
            assert!((1.0 / drag(c).unwrap() - 1.0 / hasimoto(c).unwrap()).abs() < 4.0 * c * c * s * s + 2e-9);
        }
        assert!((1.0 / drag(0.01).unwrap() - 1.0 / sangani_acrivos_dilute(0.01).unwrap()).abs() < 2e-9);
        assert!((1.0 / drag(0.1).unwrap() - 1.0 / sangani_acrivos_dilute(0.1).unwrap()).abs() < 1e-4);
        assert_eq!(hasimoto(0.0).unwrap(), 1.0);
        // Seven digits of the coefficients.
        assert!(relative(sangani_acrivos(0.05).unwrap(), drag(0.05).unwrap()) < 3e-7);
        // The truncation, as tabled for the project.
        assert!(relative(sangani_acrivos(0.2).unwrap(), 6.776_511) < 2e-7);
        assert!(relative(sangani_acrivos(0.343).unwrap(), 15.5315) < 1e-5);
    }

    #[test]
    fn richardson_zaki_must_be_missed() {
        for (c, factor) in [(0.001, 1.207), (0.01, 1.513), (0.1, 2.232), (0.2, 2.401), (0.343, 2.18)] {
            // Digits of the table.
            let digit = if c > 0.3 { 5e-3 } else { 5e-4 };
            assert!((richardson_zaki_excess(c, 4.65).unwrap() - factor).abs() <= digit, "{c}");
        }
        assert!((settling_ratio(0.1).unwrap() - 0.274_540_6).abs() < 1e-7);
        assert!(drag(0.46).is_err() && drag(-0.1).is_err() && drag(f64::NAN).is_err());
        assert!(simple_cubic(0.2, 9, 5).is_err() && simple_cubic(0.6, 9, 20).is_err());
    }
}
