//! Vectors of three numbers, `[f64; 3]`: places, velocities and forces outside the grains' own mechanics.
//!
//! # Exactness
//! Sums run x, y, z, from the left: (a_x b_x + a_y b_y) + a_z b_z. + − × √ only; bit-stable.

/// a · b
#[inline]
#[must_use]
pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// |a|² = a · a
#[inline]
#[must_use]
pub(crate) fn norm_squared(a: [f64; 3]) -> f64 {
    dot(a, a)
}

/// |a|
#[inline]
#[must_use]
pub fn norm(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// a − b
#[inline]
#[must_use]
pub(crate) fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}

/// a × b
#[inline]
#[must_use]
pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// u = u_p + ω × r: velocity of a point of a rigid body.
///
/// # Arguments
/// `velocity`: u_p of the body's centre. `spin`: ω, radians per unit of time. `arm`: r, the point less the centre.
/// # Source
/// 004 Eq 3.38; docs/errata.md 18 (order of the product).
/// # Verified by
/// Claims `taylor-couette`, `sphere-spin-in-shear`.
#[inline]
#[must_use]
pub(crate) fn surface_velocity(velocity: [f64; 3], spin: [f64; 3], arm: [f64; 3]) -> [f64; 3] {
    let turning = cross(spin, arm);
    std::array::from_fn(|i| velocity[i] + turning[i])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_products_of_axes() {
        let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert_eq!((cross(x, y), cross(y, z), cross(z, x)), (z, x, y));
        assert_eq!((dot([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]), norm([2.0, 3.0, 6.0])), (32.0, 7.0));
        // On a wheel that turns about z the point at x moves along y.
        assert_eq!(surface_velocity(z, [0.0, 0.0, 2.0], x), [0.0, 2.0, 1.0]);
    }
}
