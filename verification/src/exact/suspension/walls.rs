//! One sphere and walls in Stokes flow: drag over 6πμaU (the wall factor).
//!
//! `gap` is the distance between the surfaces over the radius; `ratio` the radius over a distance to the centre.

use super::super::ExactError;
use super::within;

/// What lies on the symmetry plane of a pair of bispherical problems.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Plane {
    /// A rigid wall.
    Rigid,
    /// A flat free surface, or the mirror image of the sphere approaching it.
    Free,
    /// Nothing: two spheres in tandem, Stimson & Jeffery.
    Tandem,
}

/// Most terms of a series: a gap of 1e-6 needs some 30 000.
const MOST_TERMS: u32 = 1_000_000;

/// (4/3) sinh α Σ n(n + 1)/((2n − 1)(2n + 3)) × \[…\], cosh α = 1 + x: the three brackets share their terms.
///
/// All hyperbolic functions are multiplied by E = e^{−(2n+1)α} so that nothing overflows and nothing cancels except in
/// the denominators (relative loss 1e-16/x).
pub(super) fn bispherical(x: f64, plane: Plane) -> f64 {
    let sinh = (x * (x + 2.0)).sqrt();
    let alpha = libm::log1p(x + sinh);
    let sinh2 = 2.0 * sinh * (1.0 + x);
    let mut sum = 0.0;
    for n in 1..=MOST_TERMS {
        let n = f64::from(n);
        let m = 2.0 * n + 1.0;
        let e = libm::exp(-m * alpha);
        let shared = e * (m * sinh2 + m * m * sinh * sinh);
        let less = -libm::expm1(-m * alpha);
        let bracket = match plane {
            Plane::Rigid => (2.0 * e * less + shared) / (less * less - e * m * m * sinh * sinh),
            Plane::Free => (2.0 * e * (1.0 + e) + shared) / (less * (1.0 + e) - e * m * sinh2),
            Plane::Tandem => (2.0 * e * less + shared) / (less * (1.0 + e) + e * m * sinh2),
        };
        let term = n * (n + 1.0) / ((2.0 * n - 1.0) * (2.0 * n + 3.0)) * bracket;
        sum += term;
        if term < 1e-17 * sum {
            break;
        }
    }
    4.0 / 3.0 * sinh * sum
}

/// Wall factor of a sphere moving along the normal of a plane no-slip wall; exact series.
///
/// # Arguments
/// `gap`: 1e-6 to 1e6. Error about 1e-16/gap relative.
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Brenner 1961, Chem. Eng. Sci. 16, 242-251, doi 10.1016/0009-2509(61)80035-3; Maude 1961, Br. J. Appl. Phys. 12,
/// 293-295.
pub fn normal_to_wall(gap: f64) -> Result<f64, ExactError> {
    within("gap", gap, 1e-6, 1e6, "must lie between 1e-6 and 1e6 radii")?;
    Ok(bispherical(gap, Plane::Rigid))
}

/// Wall factor of a sphere moving along the normal of a flat free surface (no shear, not deformed); exact series.
///
/// # Arguments
/// `gap`: 1e-6 to 1e6. Error about 1e-16/gap relative.
/// # Errors
/// `Argument` outside the range.
/// # Source
/// The papers of [`normal_to_wall`].
pub fn normal_to_free_surface(gap: f64) -> Result<f64, ExactError> {
    within("gap", gap, 1e-6, 1e6, "must lie between 1e-6 and 1e6 radii")?;
    Ok(bispherical(gap, Plane::Free))
}

/// Near contact, normal to a wall: 1/ε + (1/5) ln(1/ε) + 0.971280 + (1/21) ε ln(1/ε).
///
/// # Arguments
/// `gap`: ε, up to 0.1. Relative error against [`normal_to_wall`] 2e-7 at 0.001, 2e-5 at 0.01, 1.4e-3 at 0.1.
/// # Errors
/// `Argument` outside 0 < ε ≤ 0.1.
/// # Source
/// Cox & Brenner 1967, Chem. Eng. Sci. 22, 1753-1777; the first term alone is Reynolds lubrication (Taylor). Constant
/// from memory, confirmed by the series.
pub fn normal_to_wall_contact(gap: f64) -> Result<f64, ExactError> {
    ExactError::positive("gap", gap)?;
    within("gap", gap, 0.0, 0.1, "must not exceed 0.1 radii")?;
    let log = libm::log(1.0 / gap);
    Ok(1.0 / gap + 0.2 * log + 0.971_280 + gap * log / 21.0)
}

/// Wall factor of a sphere moving (not turning) along a plane no-slip wall: 1/(1 − (9/16)k + k³/8 − (45/256)k⁴ − k⁵/16).
///
/// # Arguments
/// `ratio`: k = a/(distance of the centre), 0 to 0.7. Against the exact values of [`PARALLEL_WALL`]: 1e-5 at 0.1,
/// 1e-4 at 0.27, 1e-3 at 0.43, 1 % at 0.65. Up to k = 0.3 it is as good as the table to 2e-4 and the better choice
/// (the table has few points there).
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Faxén 1923; Happel & Brenner, *Low Reynolds Number Hydrodynamics*, eq. 7-4.28.
pub fn parallel_to_wall(ratio: f64) -> Result<f64, ExactError> {
    within("ratio", ratio, 0.0, 0.7, "must lie between 0 and 0.7")?;
    let k = ratio;
    let k3 = k * k * k;
    Ok(1.0 / (1.0 - 9.0 / 16.0 * k + k3 / 8.0 - 45.0 / 256.0 * k3 * k - k3 * k * k / 16.0))
}

/// Exact wall factors of a sphere moving along a plane wall without turning: (centre distance over radius, factor).
///
/// # Source
/// O'Neill 1964, Mathematika 11, 67-74, and Goldman, Cox & Brenner 1967, Chem. Eng. Sci. 22, 637-651,
/// doi 10.1016/0009-2509(67)80047-2, Table 2 (from memory; consistent with [`parallel_to_wall`] far from the wall and
/// with [`parallel_to_wall_contact`] near it).
pub const PARALLEL_WALL: [(f64, f64); 7] = [
    (3.7622, 1.1738),
    (2.3524, 1.3079),
    (1.5431, 1.5675),
    (1.1276, 2.1514),
    (1.0453, 2.6475),
    (1.005_004, 3.7863),
    (1.003_202, 4.0223),
];

/// Resistance near contact with a plane wall, motion along it; coefficients of the four couplings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallContact {
    /// Force of translation over 6πμaU: (8/15) ln(1/ε) + 0.9588.
    pub force: f64,
    /// Torque of translation over 8πμa²U, and force of rotation over (4/3)·6πμa²ω: −((1/10) ln(1/ε) − 0.1895).
    ///
    /// Positive: the torque of a rolling body. Near contact the wall holds back the lower side of the sphere.
    pub coupling: f64,
    /// Torque of rotation over 8πμa³ω: (2/5) ln(1/ε) + 0.37.
    pub torque: f64,
}

/// Near contact, motion along a plane wall.
///
/// # Arguments
/// `gap`: ε, up to 0.01.
/// # Exactness
/// Errors of the constants: 0.005 in `force`, 0.001 in `coupling`, 0.01 in `torque` (0.3709 and 0.3817 are both
/// printed); terms of order ε ln ε are dropped.
/// # Errors
/// `Argument` outside 0 < ε ≤ 0.01.
/// # Source
/// Goldman, Cox & Brenner 1967, Chem. Eng. Sci. 22, 637-651 (checked); Cooley & O'Neill 1968, J. Inst. Math. Appl. 4,
/// 163-173.
pub fn parallel_to_wall_contact(gap: f64) -> Result<WallContact, ExactError> {
    ExactError::positive("gap", gap)?;
    within("gap", gap, 0.0, 0.01, "must not exceed 0.01 radii")?;
    let log = libm::log(1.0 / gap);
    Ok(WallContact {
        force: 8.0 / 15.0 * log + 0.9588,
        coupling: 0.1 * log - 0.1895,
        torque: 0.4 * log + 0.376,
    })
}

/// Sphere on the axis of a circular cylinder: (1 − 0.75857 λ⁵)/(1 − 2.1050 λ + 2.0865 λ³ − 1.7068 λ⁵ + 0.72603 λ⁶).
///
/// # Arguments
/// `ratio`: λ = a over the radius of the cylinder, 0 to 0.8; sphere moving, cylinder and far fluid at rest.
/// # Exactness
/// Within about 1 % of the full solution at 0.8, 0.1 % at 0.5.
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Haberman & Sayre 1958, David Taylor Model Basin Report 1143, doi 10.21236/AD0206307 (checked).
pub fn cylinder_axis(ratio: f64) -> Result<f64, ExactError> {
    within("ratio", ratio, 0.0, 0.8, "must lie between 0 and 0.8")?;
    let l = ratio;
    let l3 = l * l * l;
    let l5 = l3 * l * l;
    Ok((1.0 - 0.75857 * l5) / (1.0 - 2.1050 * l + 2.0865 * l3 - 1.7068 * l5 + 0.72603 * l3 * l3))
}

/// Sphere midway between two parallel walls, moving along them: 1/(1 − 1.004 λ + 0.418 λ³ + 0.21 λ⁴ − 0.169 λ⁵).
///
/// # Arguments
/// `ratio`: λ = a over *half* the distance of the walls, 0 to 0.5.
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Faxén 1922, Ann. Phys. 373 (68), 89-119; Happel & Brenner, eq. 7-4.27 (from memory).
pub fn midway_between_walls(ratio: f64) -> Result<f64, ExactError> {
    within("ratio", ratio, 0.0, 0.5, "must lie between 0 and 0.5")?;
    let l = ratio;
    let l3 = l * l * l;
    Ok(1.0 / (1.0 - 1.004 * l + 0.418 * l3 + 0.21 * l3 * l - 0.169 * l3 * l * l))
}

/// Sphere at a quarter of the distance of two parallel walls: 1/(1 − 0.6526 λ + 0.1475 λ³ − 0.131 λ⁴ − 0.0644 λ⁵).
///
/// # Arguments
/// `ratio`: λ = a over the distance of the centre from the *nearer* wall, 0 to 0.5.
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Faxén 1922; Happel & Brenner, eq. 7-4.28 ff. (from memory).
pub fn quarter_between_walls(ratio: f64) -> Result<f64, ExactError> {
    within("ratio", ratio, 0.0, 0.5, "must lie between 0 and 0.5")?;
    let l = ratio;
    let l3 = l * l * l;
    Ok(1.0 / (1.0 - 0.6526 * l + 0.1475 * l3 - 0.131 * l3 * l - 0.0644 * l3 * l * l))
}

/// Sphere on the axis of a long duct of square section, first order: 1/(1 − 1.903266 λ).
///
/// # Arguments
/// `ratio`: λ = a over *half* the side, 0 to 0.15; the next term is of order λ³ (about 2 λ³, 0.7 % at 0.15).
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Happel & Bart 1974, Appl. Sci. Res. 29, 241-258, doi 10.1007/BF00384149 (coefficient from memory; it lies between
/// those of midway walls and of the inscribed cylinder, as it must).
pub fn square_duct_axis(ratio: f64) -> Result<f64, ExactError> {
    within("ratio", ratio, 0.0, 0.15, "must lie between 0 and 0.15")?;
    Ok(1.0 / (1.0 - 1.903_266 * ratio))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limit_far_from_a_wall() {
        for h in [50.0, 500.0] {
            // Images: 1/(1 − 9/(8h) + 1/(2h³)), next −57/(100 h⁴) 1e-7 at 50; free surface 1/(1 + … 3/(4h)).
            let wall = 1.0 / (1.0 - 1.125 / h + 0.5 / (h * h * h));
            assert!((normal_to_wall(h - 1.0).unwrap() / wall - 1.0).abs() < 2.0 / (h * h * h * h));
            let free = 1.0 / (1.0 - 0.75 / h);
            assert!((normal_to_free_surface(h - 1.0).unwrap() / free - 1.0).abs() < 1.0 / (h * h * h));
        }
    }

    #[test]
    fn limit_lubrication() {
        // The dropped terms are of order ε, hence ε² relative.
        for (gap, tolerance) in [(1e-4, 1e-7), (1e-3, 1e-6), (1e-2, 1e-4), (0.1, 5e-3)] {
            let ratio = normal_to_wall_contact(gap).unwrap() / normal_to_wall(gap).unwrap() - 1.0;
            assert!(ratio.abs() < tolerance, "{gap} {ratio}");
        }
        // A free surface: half the gap to the image, 1/(4ε).
        let free = normal_to_free_surface(1e-5).unwrap() * 4e-5;
        assert!((free - 1.0).abs() < 4e-5 * (0.45 * libm::log(5e4) + 2.0), "{free}");
    }

    #[test]
    fn paper_brenner_1961() {
        // Table in Brenner's paper, cosh α: (1.543081, 3.0360932), (10.067662, 1.1252) (from memory).
        assert!((normal_to_wall(0.543_081).unwrap() - 3.0361).abs() < 5e-4);
        assert!((normal_to_wall(9.067_662).unwrap() - 1.1252).abs() < 5e-4);
    }

    #[test]
    fn paper_goldman_cox_brenner_1967_along_a_wall() {
        for (h, factor) in PARALLEL_WALL {
            if h > 1.5 {
                let error = (parallel_to_wall(1.0 / h).unwrap() / factor - 1.0).abs();
                let k = 1.0 / h;
                // Next term of the series of order k⁶, with the rounding of the table.
                assert!(error < 0.2 * libm::pow(k, 6.0) + 1e-4, "{h} {error}");
            } else if h < 1.01 {
                let near = parallel_to_wall_contact(h - 1.0).unwrap().force;
                assert!((near - factor).abs() < 0.005, "{h} {near}");
            }
        }
        for (k, value) in [(0.1, 1.059_483), (0.2, 1.125_874), (0.3, 1.200_409)] {
            assert!((parallel_to_wall(k).unwrap() - value).abs() < 6e-7);
        }
    }

    #[test]
    fn order_of_containers() {
        // The more walls, the more drag: one wall, two walls, square duct, inscribed cylinder.
        let l = 0.1;
        let ladder = [
            parallel_to_wall(l).unwrap(),
            midway_between_walls(l).unwrap(),
            square_duct_axis(l).unwrap(),
            cylinder_axis(l).unwrap(),
        ];
        assert!(ladder.windows(2).all(|w| w[0] < w[1] * 1.005), "{ladder:?}");
        // Nearer wall at the same distance: quarter way lies between one wall and midway.
        let quarter = quarter_between_walls(l).unwrap();
        assert!(ladder[0] < quarter && quarter < ladder[1]);
        // Faxén's series of the cylinder, 1 − 2.10444λ + 2.08877λ³ − 0.94813λ⁵ − …, agrees to 1e-3 at 0.2.
        let faxen = 1.0 / (1.0 - 2.10444 * 0.2 + 2.08877 * 0.008 - 0.94813 * 3.2e-4);
        assert!((cylinder_axis(0.2).unwrap() / faxen - 1.0).abs() < 1e-3);
        assert!(cylinder_axis(0.9).is_err() && normal_to_wall(0.0).is_err());
    }
}
