//! Prisms and terrain as triangles.

use crate::dem::walls::Mesh;
use crate::dem::{DemError, V3};
use crate::geometry::{Axis, Heightfield};

/// A polygon swept along `axis` between two positions, with both caps.
///
/// # Errors
/// A polygon that cannot be cut into triangles.
pub(super) fn prism(axis: Axis, points: &[[f64; 2]], ends: [f64; 2]) -> Result<Mesh, DemError> {
    let (a, [u, v]) = (axis.index(), axis.others());
    let n = points.len() as u32;
    let mut corners = Vec::with_capacity(2 * points.len());
    for end in ends {
        corners.extend(points.iter().map(|p| {
            let mut x = V3::zeros();
            (x[a], x[u], x[v]) = (end, p[0], p[1]);
            x
        }));
    }
    let mut faces = Vec::new();
    for i in 0..n {
        let j = (i + 1) % n;
        faces.push([i, j, i + n]);
        faces.push([j, j + n, i + n]);
    }
    for triangle in triangles(points) {
        faces.push(triangle);
        faces.push(triangle.map(|corner| corner + n));
    }
    Mesh::new(&corners, &faces)
}

/// Flat faces around a cone; their middles are 5e-4 of the radius inside it.
const FACES: u32 = 96;

/// The side of a cone between two discs, with the discs if it is `closed`.
///
/// # Errors
/// Numbers that are not finite.
pub(super) fn cone(base: V3, axis: V3, height: f64, radii: [f64; 2], closed: bool) -> Result<Mesh, DemError> {
    let k = (0..3).min_by(|&a, &b| axis[a].abs().total_cmp(&axis[b].abs())).unwrap_or(0);
    let u = axis.cross(&V3::ith(k, 1.0)).normalize();
    let v = axis.cross(&u);
    let mut corners = Vec::with_capacity(2 * FACES as usize + 2);
    for (end, radius) in [base, base + axis * height].into_iter().zip(radii) {
        corners.extend((0..FACES).map(|i| {
            let angle = 2.0 * std::f64::consts::PI * f64::from(i) / f64::from(FACES);
            end + (u * libm::cos(angle) + v * libm::sin(angle)) * radius
        }));
        corners.push(end);
    }
    let (second, middle) = (FACES + 1, FACES);
    let mut faces = Vec::new();
    for i in 0..FACES {
        let j = (i + 1) % FACES;
        // At a tip all corners are one place: the triangle that has its edge there would have no area.
        if radii[0] > 0.0 {
            faces.push([i, j, second + i]);
        }
        if radii[1] > 0.0 {
            faces.push([j, second + j, second + i]);
        }
        if closed && radii[0] > 0.0 {
            faces.push([i, j, middle]);
        }
        if closed && radii[1] > 0.0 {
            faces.push([second + i, second + j, second + middle]);
        }
    }
    Mesh::new(&corners, &faces)
}

/// Twice the signed area of a triangle.
fn area(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// A simple polygon cut into triangles by clipping ears: corners that stick out and hold no other corner.
fn triangles(points: &[[f64; 2]]) -> Vec<[u32; 3]> {
    let n = points.len();
    let turn: f64 = (0..n).map(|i| area([0.0; 2], points[i], points[(i + 1) % n])).sum();
    let mut left: Vec<u32> = (0..n as u32).collect();
    if turn < 0.0 {
        left.reverse();
    }
    let at = |i: u32| points[i as usize];
    let mut out = Vec::new();
    while left.len() > 3 {
        let m = left.len();
        let ear = (0..m).find(|&k| {
            let [i, j, l] = [left[(k + m - 1) % m], left[k], left[(k + 1) % m]];
            let (a, b, c) = (at(i), at(j), at(l));
            let inside = |p: [f64; 2]| area(a, b, p) >= 0.0 && area(b, c, p) >= 0.0 && area(c, a, p) >= 0.0;
            area(a, b, c) > 0.0 && !left.iter().any(|&o| o != i && o != j && o != l && inside(at(o)))
        });
        let Some(k) = ear else {
            // Corners on one line, or edges that cross: drop a corner without area, else give up on the rest.
            let flat =
                (0..m).find(|&k| area(at(left[(k + m - 1) % m]), at(left[k]), at(left[(k + 1) % m])) == 0.0);
            let Some(k) = flat else { return out };
            left.remove(k);
            continue;
        };
        out.push([left[(k + m - 1) % m], left[k], left[(k + 1) % m]]);
        left.remove(k);
    }
    if let [i, j, l] = left[..]
        && area(at(i), at(j), at(l)) != 0.0
    {
        out.push([i, j, l]);
    }
    out
}

/// Terrain as two triangles per cell of its grid; a twisted cell differs from the bilinear surface by at most a
/// quarter of its twist. The outermost heights continue to one box length beyond the box.
///
/// # Errors
/// Numbers that are not finite.
pub(super) fn terrain(field: &Heightfield, size_m: [f64; 3]) -> Result<Mesh, DemError> {
    let rows = field.heights_m().len();
    let columns = field.heights_m().first().map_or(0, Vec::len);
    let lines = |origin: f64, count: usize, size: f64| {
        let mut lines: Vec<f64> = (0..count).map(|k| origin + k as f64 * field.spacing_m).collect();
        let (first, last) = (lines.first().copied().unwrap_or(0.0), lines.last().copied().unwrap_or(0.0));
        if first > -size {
            lines.insert(0, -size);
        }
        if last < 2.0 * size {
            lines.push(2.0 * size);
        }
        lines
    };
    let x = lines(field.origin_m[0], columns, size_m[0]);
    let y = lines(field.origin_m[1], rows, size_m[1]);
    let mut corners = Vec::with_capacity(x.len() * y.len());
    for &b in &y {
        corners.extend(x.iter().map(|&a| V3::new(a, b, field.height(a, b))));
    }
    let mut faces = Vec::new();
    let row = x.len() as u32;
    for j in 0..y.len() as u32 - 1 {
        for i in 0..row - 1 {
            let k = j * row + i;
            faces.push([k, k + 1, k + row]);
            faces.push([k + 1, k + row + 1, k + row]);
        }
    }
    Mesh::new(&corners, &faces)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sum(points: &[[f64; 2]]) -> f64 {
        let corner = |i: u32| points[i as usize];
        triangles(points).iter().map(|t| 0.5 * area(corner(t[0]), corner(t[1]), corner(t[2])).abs()).sum()
    }

    /// An L, given in both senses, and a corner on a straight edge: the triangles fill the polygon's area.
    #[test]
    fn exact_area_of_polygons_that_are_not_convex() {
        let mut l = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0], [0.0, 1.5]];
        assert_eq!(sum(&l), 4.0);
        l.reverse();
        assert_eq!(sum(&l), 4.0);
        assert_eq!(sum(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), 0.5);
    }

    /// A cone with a tip and a funnel: bounds, faces, and the distance of the flat faces from the axis.
    #[test]
    fn exact_cones() {
        let tip = cone(V3::zeros(), V3::z(), 2.0, [1.0, 0.0], true).unwrap();
        assert_eq!(tip.triangles.len(), 2 * 96);
        assert_eq!((tip.bounds().0.z, tip.bounds().1.z), (0.0, 2.0));
        let funnel = cone(V3::zeros(), V3::z(), 1.0, [1.0, 1.0], false).unwrap();
        assert_eq!(funnel.triangles.len(), 2 * 96);
        let mut near = Vec::new();
        funnel.near(&V3::new(0.0, 0.0, 0.5), 2.0, None, &mut near);
        let least = near.iter().map(|n| n.distance).fold(f64::INFINITY, f64::min);
        assert!((least - libm::cos(std::f64::consts::PI / 96.0)).abs() < 1e-14);
    }

    #[test]
    fn exact_prism_and_terrain() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let mesh = prism(Axis::Y, &square, [2.0, 5.0]).unwrap();
        assert_eq!(mesh.bounds(), (V3::new(0.0, 2.0, 0.0), V3::new(1.0, 5.0, 1.0)));
        assert_eq!(mesh.triangles.len(), 2 * 4 + 2 * 2);
        let field = Heightfield::new([0.0; 2], 1.0, vec![vec![0.0, 1.0], vec![0.0, 1.0]]);
        let mesh = terrain(&field, [1.0, 1.0, 1.0]).unwrap();
        assert_eq!(mesh.bounds(), (V3::new(-1.0, -1.0, 0.0), V3::new(2.0, 2.0, 1.0)));
    }
}
