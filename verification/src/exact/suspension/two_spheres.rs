//! Two equal spheres in Stokes flow along, and across, their line of centres.
//!
//! Factors are drag over 6πμaU; `gap` is the distance between the surfaces over the radius.

use super::super::ExactError;
use super::walls::{Plane, bispherical};
use super::within;

/// Both spheres moving with the same velocity along their line of centres (falling in line): exact series.
///
/// Equal forces on both; below 1, so that a pair falls faster than one sphere by 1/factor.
///
/// # Arguments
/// `gap`: 1e-6 to 1e6.
/// # Exactness
/// 1e-13 relative.
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Stimson & Jeffery 1926, Proc. R. Soc. Lond. A 111, 110-116, doi 10.1098/rspa.1926.0053.
pub fn in_line(gap: f64) -> Result<f64, ExactError> {
    within("gap", gap, 1e-6, 1e6, "must lie between 1e-6 and 1e6 radii")?;
    Ok(bispherical(0.5 * gap, Plane::Tandem))
}

/// [`in_line`] at contact.
///
/// # Source
/// Faxén 1927; Cooley & O'Neill 1969, Proc. Camb. Phil. Soc. 66, 407-415; 0.6451 is published, the further digits are the limit of the series.
pub const IN_LINE_CONTACT: f64 = 0.645_141_43;

/// The spheres approaching (or parting) with velocities ±U each: exact series.
///
/// By symmetry one sphere approaching a free surface at half the gap.
///
/// # Arguments
/// `gap`: 2e-6 to 1e6. U is half the speed of approach.
/// # Exactness
/// 1e-16/gap relative.
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Brenner 1961, Chem. Eng. Sci. 16, 242-251, doi 10.1016/0009-2509(61)80035-3.
pub fn approaching(gap: f64) -> Result<f64, ExactError> {
    within("gap", gap, 2e-6, 1e6, "must lie between 2e-6 and 1e6 radii")?;
    Ok(bispherical(0.5 * gap, Plane::Free))
}

/// [`approaching`] near contact: 1/(2ξ) + (9/20) ln(1/ξ) + 1.34558 + (3/56) ξ ln(1/ξ).
///
/// # Arguments
/// `gap`: ξ, up to 0.1. Relative error against [`approaching`] 4e-7 at 0.001, 4e-5 at 0.01, 3e-3 at 0.1.
/// # Errors
/// `Argument` outside 0 < ξ ≤ 0.1.
/// # Source
/// X11A − X12A of Jeffrey & Onishi 1984, J. Fluid Mech. 139, 261-290, doi 10.1017/S0022112084000355, for equal
/// spheres (constants 0.9954 and 0.3502, from memory, confirmed by the series).
pub fn approaching_contact(gap: f64) -> Result<f64, ExactError> {
    ExactError::positive("gap", gap)?;
    within("gap", gap, 0.0, 0.1, "must not exceed 0.1 radii")?;
    let log = libm::log(1.0 / gap);
    Ok(0.5 / gap + 0.45 * log + 1.345_58 + 3.0 / 56.0 * gap * log)
}

/// Resistances along the line of centres: F₁ = −6πμa (X11 U₁ + X12 U₂), by superposition of [`in_line`] and
/// [`approaching`]: (X11, X12).
///
/// # Arguments
/// `gap` over the radius, positive.
/// # Errors
/// `Argument` where [`in_line`] or [`approaching`] is not known.
pub fn along(gap: f64) -> Result<(f64, f64), ExactError> {
    let (same, opposite) = (in_line(gap)?, approaching(gap)?);
    Ok((0.5 * (same + opposite), 0.5 * (same - opposite)))
}

/// Speed of two spheres falling in line over that of one, far apart:
/// 1 + (3/2)/r − 1/r³ − (15/4)/r⁴.
///
/// # Arguments
/// `distance`: r of the centres over the radius, at least 4. Next term of order 1/r⁶.
/// # Errors
/// `Argument` below 4.
/// # Source
/// Batchelor 1976, J. Fluid Mech. 74, 1-29; Jeffrey & Onishi 1984.
pub fn in_line_speed_far(distance: f64) -> Result<f64, ExactError> {
    within("distance", distance, 4.0, f64::MAX, "must be at least 4 radii")?;
    let r = distance;
    let r3 = r * r * r;
    Ok(1.0 + 1.5 / r - 1.0 / r3 - 3.75 / (r3 * r))
}

/// Speed of two spheres falling side by side, free to turn, over that of one, far apart:
/// 1 + (3/4)/r + (1/2)/r³ − (17/16)/r⁶.
///
/// # Arguments
/// `distance`: r of the centres over the radius, at least 3. Dropped terms of order 1/r⁷: below 1e-3 at 3.
/// # Errors
/// `Argument` below 3.
/// # Source
/// Batchelor 1976, J. Fluid Mech. 74, 1-29, doi 10.1017/S0022112076001663; Jeffrey & Onishi 1984 (last coefficient
/// from memory).
pub fn side_by_side_speed_far(distance: f64) -> Result<f64, ExactError> {
    within("distance", distance, 3.0, f64::MAX, "must be at least 3 radii")?;
    let r = distance;
    let r3 = r * r * r;
    Ok(1.0 + 0.75 / r + 0.5 / r3 - 17.0 / 16.0 / (r3 * r3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limit_contact() {
        // Linear in the gap, measured slope 0.058.
        for gap in [1e-6, 1e-5, 1e-4] {
            assert!(
                (in_line(gap).unwrap() - IN_LINE_CONTACT - 0.058 * gap).abs() < 0.01 * gap + 1e-8,
                "{gap}"
            );
        }
        for (gap, tolerance) in [(1e-4, 1e-7), (1e-3, 1e-6), (1e-2, 1e-4), (0.1, 5e-3)] {
            let error = approaching_contact(gap).unwrap() / approaching(gap).unwrap() - 1.0;
            assert!(error.abs() < tolerance, "{gap} {error}");
        }
    }

    #[test]
    fn limit_far_apart() {
        for r in [8.0, 20.0, 100.0] {
            let r6 = r * r * r * r * r * r;
            let falling = 1.0 / in_line(r - 2.0).unwrap();
            // Next coefficient of size 10.
            assert!((falling - in_line_speed_far(r).unwrap()).abs() < 12.0 / r6 + 1e-14, "{r}");
            let parting = 1.0 / approaching(r - 2.0).unwrap();
            let far = 1.0 - 1.5 / r + 1.0 / (r * r * r) - 3.75 / (r * r * r * r);
            assert!((parting - far).abs() < 12.0 / r6 + 1e-14, "{r}");
        }
        let (x11, x12) = along(98.0).unwrap();
        assert!((x11 - 1.0 - 2.25e-4).abs() < 1e-6 && (x12 + 1.5e-2).abs() < 1e-4);
    }

    #[test]
    fn paper_stimson_jeffery_1926() {
        // Their table: cosh α = 1.543081 (distance of centres 3.086 radii), factor 0.702 (from memory).
        assert!((in_line(1.086_162).unwrap() - 0.702).abs() < 1e-3);
        // Side by side is slower than in line at any distance.
        assert!(side_by_side_speed_far(4.0).unwrap() < in_line_speed_far(4.0).unwrap());
        assert!(
            in_line(0.0).is_err()
                && approaching_contact(0.2).is_err()
                && side_by_side_speed_far(2.0).is_err()
        );
    }
}
