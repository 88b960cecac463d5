//! Normal and curvature of a surface that only says which points are inside \[B4\].

use crate::vector::{dot, norm, sub};

/// Normal and curvature of a piece of surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Patch {
    /// Unit normal, into the solid.
    pub normal: [f64; 3],
    /// Curvature as a tensor xx, yy, zz, xy, xz, yz, 1/cells; positive where the fluid is inside the bend, as in a pipe.
    pub curvature: [f64; 6],
}

/// Sampled steps along a ray, per cell, and how far to either side of where the surface is expected.
const STEPS_PER_CELL: i32 = 4;
const REACH: i32 = 6;

/// Halvings of a step: 2⁻³² of a cell, of which a second difference leaves 1e-9.
const HALVINGS: u32 = 30;

/// What a paraboloid may miss of the nine points, cells: edges and corners miss more, and have no curvature.
const ROUGH: f64 = 0.1;

/// Largest curvature that nine points a cell apart can tell; the three points across an edge bend more.
const SHARPEST: f64 = 0.5;

impl Patch {
    /// Fits a paraboloid through nine points of the surface ahead of a point outside it, first along `ahead`, then along
    /// the normal found. Where it does not fit, the normal is `ahead` and the surface flat.
    ///
    /// # Arguments
    /// `is_inside`: whether a point, in cells, is inside. `from`: a point outside. `ahead`: unit vector into the solid.
    /// # Exactness
    /// Spheres and cylinders of R cells: curvature to 1/(8R²) of itself, from the fourth order of the circle.
    /// # Verified by
    /// Test `exact_normal_and_curvature`.
    #[must_use]
    pub(crate) fn ahead(is_inside: &impl Fn([f64; 3]) -> bool, from: [f64; 3], ahead: [f64; 3]) -> Self {
        let flat = Self { normal: ahead, curvature: [0.0; 6] };
        let Some(rough) = fit(is_inside, from, ahead) else { return flat };
        fit(is_inside, from, rough.normal).unwrap_or(rough)
    }
}

fn fit(is_inside: &impl Fn([f64; 3]) -> bool, from: [f64; 3], ahead: [f64; 3]) -> Option<Patch> {
    let frame = frame(ahead);
    let point = |x: f64, y: f64, z: f64| {
        std::array::from_fn(|a| from[a] + (x * frame[0][a] + y * frame[1][a]) + z * frame[2][a])
    };
    let centre = crossing(|z| is_inside(point(0.0, 0.0, z)), 0.0)?;
    let mut z = [[0.0; 3]; 3];
    for (row, y) in z.iter_mut().zip([-1.0, 0.0, 1.0]) {
        for (z, x) in row.iter_mut().zip([-1.0, 0.0, 1.0]) {
            *z = crossing(|z| is_inside(point(x, y, z)), centre)?;
        }
    }
    let row = |j: usize| z[j][0] + z[j][1] + z[j][2];
    let column = |i: usize| z[0][i] + z[1][i] + z[2][i];
    let slope = [(column(2) - column(0)) / 6.0, (row(2) - row(0)) / 6.0];
    let bend = [
        (column(2) - 2.0 * column(1) + column(0)) / 3.0,
        (row(2) - 2.0 * row(1) + row(0)) / 3.0,
        (z[2][2] - z[2][0] - z[0][2] + z[0][0]) / 4.0,
    ];
    if bend.iter().any(|bend| bend.abs() > SHARPEST) {
        return None;
    }
    let height = (row(0) + row(1) + row(2)) / 9.0 - (bend[0] + bend[1]) / 3.0;
    for (row, y) in z.iter().zip([-1.0, 0.0, 1.0]) {
        for (z, x) in row.iter().zip([-1.0, 0.0, 1.0]) {
            let plane = height + slope[0] * x + slope[1] * y;
            let fitted = plane + 0.5 * (bend[0] * x * x + bend[1] * y * y) + bend[2] * x * y;
            if (z - fitted).abs() > ROUGH {
                return None;
            }
        }
    }
    Some(patch(&frame, slope, bend))
}

/// From the slopes and second derivatives of the height over the frame's plane.
fn patch(frame: &[[f64; 3]; 3], slope: [f64; 2], bend: [f64; 3]) -> Patch {
    let steep = (1.0 + slope[0] * slope[0] + slope[1] * slope[1]).sqrt();
    let normal: [f64; 3] =
        std::array::from_fn(|a| (frame[2][a] - slope[0] * frame[0][a] - slope[1] * frame[1][a]) / steep);
    // Along the surface only.
    let along = [0, 1].map(|k: usize| {
        let out = dot(frame[k], normal);
        let flat: [f64; 3] = std::array::from_fn(|a| frame[k][a] - out * normal[a]);
        flat
    });
    let curved = |a: usize, b: usize| {
        let of = |i: usize, j: usize| along[i][a] * along[j][b];
        let sum = bend[0] * of(0, 0) + bend[1] * of(1, 1) + bend[2] * (of(0, 1) + of(1, 0));
        -sum / steep
    };
    Patch {
        normal,
        curvature: [curved(0, 0), curved(1, 1), curved(2, 2), curved(0, 1), curved(0, 2), curved(1, 2)],
    }
}

/// Two unit vectors across a third, and that one.
fn frame(ahead: [f64; 3]) -> [[f64; 3]; 3] {
    let least = (0..3).fold(0, |best, a| if ahead[a].abs() < ahead[best].abs() { a } else { best });
    let mut first = ahead.map(|x| -x * ahead[least]);
    first[least] += 1.0;
    let length = norm(first);
    let first = first.map(|x| x / length);
    let second = [
        ahead[1] * first[2] - ahead[2] * first[1],
        ahead[2] * first[0] - ahead[0] * first[2],
        ahead[0] * first[1] - ahead[1] * first[0],
    ];
    [first, second, ahead]
}

/// Where a ray goes in, nearest to an expected place.
fn crossing(is_inside: impl Fn(f64) -> bool, expected: f64) -> Option<f64> {
    let step = 1.0 / f64::from(STEPS_PER_CELL);
    let at = |k: i32| expected + step * f64::from(k);
    let goes_in = |k: i32| !is_inside(at(k)) && is_inside(at(k + 1));
    let k = (0..=REACH).flat_map(|k| [k, -k - 1]).find(|&k| goes_in(k))?;
    let (mut low, mut high) = (at(k), at(k + 1));
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if is_inside(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(high)
}

/// A unit vector along the mean of directions; `None` if they cancel.
#[must_use]
pub(crate) fn mean_direction(directions: impl Iterator<Item = [f64; 3]>) -> Option<[f64; 3]> {
    let sum = directions.fold([0.0; 3], |sum, d| sub(sum, d.map(|x| -x)));
    let length = norm(sum);
    (length > 1e-9).then(|| sum.map(|x| x / length))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative error of a circle's second difference over a cell: 1/(4R²), R = 12.
    const FOURTH_ORDER: f64 = 0.25 / 144.0;

    #[test]
    fn exact_normal_and_curvature() {
        // In a pipe along x, and on a ball, from oblique rays.
        let outside_pipe = |p: [f64; 3]| p[1] * p[1] + p[2] * p[2] > 144.0;
        let found = Patch::ahead(&outside_pipe, [0.0, 6.0, 9.0], [0.0, 0.8, 0.6]);
        let length = (36.0_f64 + 81.0).sqrt();
        let wanted = [0.0, 6.0 / length, 9.0 / length];
        assert!(norm(sub(found.normal, wanted)) < 5e-3, "{found:?}");
        let along = |t: [f64; 3]| {
            let [xx, yy, zz, xy, xz, yz] = found.curvature;
            let [x, y, z] = t;
            xx * x * x + yy * y * y + zz * z * z + 2.0 * (xy * x * y + xz * x * z + yz * y * z)
        };
        assert!(along([1.0, 0.0, 0.0]).abs() < 1e-6, "{found:?}");
        let around = along([0.0, -wanted[2], wanted[1]]);
        assert!((12.0 * around - 1.0).abs() < 4.0 * FOURTH_ORDER, "{around}");
        let ball = |p: [f64; 3]| dot(p, p) < 144.0;
        let found = Patch::ahead(&ball, [-12.4, 1.0, 2.0], [1.0, 0.0, 0.0]);
        let trace = found.curvature[0] + found.curvature[1] + found.curvature[2];
        assert!((6.0 * trace + 1.0).abs() < 8.0 * FOURTH_ORDER, "{found:?}");
    }

    #[test]
    fn limit_an_edge_has_no_curvature() {
        let corner = |p: [f64; 3]| p[0] > 0.0 && p[1] > 0.0;
        let ahead = [0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0];
        let found = Patch::ahead(&corner, [-0.3, -0.3, 0.0], ahead);
        assert_eq!(found, Patch { normal: ahead, curvature: [0.0; 6] });
    }
}
