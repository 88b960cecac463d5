//! Depth of a point below the surface of a shape, and the share of a cell that shapes cover.

use super::polygon;
use super::samples::Samples;
use super::shape::{Axis, Bounds, Shape};
use crate::vector::{dot, norm, sub};

impl Shape {
    /// Depth of a point below the surface, m: positive inside, never more in magnitude than the distance
    /// to the surface.
    #[must_use]
    pub(crate) fn depth(&self, p: [f64; 3]) -> f64 {
        match self {
            Self::Box { min_m, max_m } => {
                (0..3).map(|a| least(p[a] - min_m[a], max_m[a] - p[a])).fold(f64::INFINITY, least)
            }
            Self::Cylinder { point_m, direction, radius_m, length_m } => {
                let (along, across) = split(sub(p, *point_m), *direction);
                let side = radius_m - across;
                length_m.map_or(side, |length| least(side, least(along, length - along)))
            }
            Self::Sphere { centre_m, radius_m } => radius_m - norm(sub(p, *centre_m)),
            Self::Polygon { axis, points_m, from_m, to_m } => {
                let [a, b] = axis.others();
                let h = p[axis.index()];
                let inside = polygon::depth(points_m, [p[a], p[b]]);
                let low = from_m.map_or(f64::INFINITY, |from| h - from);
                let high = to_m.map_or(f64::INFINITY, |to| to - h);
                least(inside, least(low, high))
            }
            Self::Cone { base_m, direction, height_m, base_radius_m, top_radius_m } => {
                let (along, across) = split(sub(p, *base_m), *direction);
                let taper = (base_radius_m - top_radius_m) / height_m;
                let side = (base_radius_m - taper * along - across) / (1.0 + taper * taper).sqrt();
                least(side, least(along, height_m - along))
            }
            Self::HalfSpace { point_m, normal } => -dot(sub(p, *point_m), *normal) / norm(*normal),
            Self::Heightfield(field) => (field.height(p[0], p[1]) - p[2]) / field.steepness(),
            Self::Union(parts) => parts.iter().map(|part| part.depth(p)).fold(f64::NEG_INFINITY, greatest),
            Self::Intersection(parts) => parts.iter().map(|part| part.depth(p)).fold(f64::INFINITY, least),
            Self::Difference { from, minus } => {
                minus.iter().map(|part| -part.depth(p)).fold(from.depth(p), least)
            }
        }
    }

    /// Whether every surface of the shape is normal to an axis.
    fn is_blocky(&self) -> bool {
        match self {
            Self::Box { .. } => true,
            Self::HalfSpace { normal, .. } => normal.iter().filter(|n| **n != 0.0).count() == 1,
            Self::Union(parts) | Self::Intersection(parts) => parts.iter().all(Self::is_blocky),
            Self::Difference { from, minus } => from.is_blocky() && minus.iter().all(Self::is_blocky),
            _ => false,
        }
    }
}

/// Share of a cell that lies inside at least one of the shapes, 0 to 1.
///
/// Exact where all surfaces in the cell are normal to axes and where one polygon swept along an axis is
/// alone; elsewhere from 8 points along each axis of more than one cell, at the same places in every
/// cell and symmetric about its centre, or where plane surfaces normal to the axis cut it from as many in proportion
/// between them.
///
/// # Arguments
/// `low`: low corner of the cell, m. `dx`: its size, m. `thin`: axes of one cell, along which one point
/// in the middle is enough because nothing changes.
#[must_use]
pub(crate) fn covered(shapes: &[&Shape], low: [f64; 3], dx: f64, thin: [bool; 3]) -> f64 {
    let centre = low.map(|x| x + 0.5 * dx);
    let radius = 0.5 * dx * 3.0_f64.sqrt();
    let mut near = Vec::new();
    for shape in shapes {
        let depth = shape.depth(centre);
        if depth >= radius {
            return 1.0;
        }
        if depth > -radius {
            near.push(*shape);
        }
    }
    let cell = Bounds { min: low, max: low.map(|x| x + dx) };
    match near.as_slice() {
        [] => 0.0,
        [Shape::Polygon { axis, points_m, from_m, to_m }] => swept(&cell, *axis, points_m, [*from_m, *to_m]),
        near if near.len() <= MOST_BLOCKS && near.iter().all(|shape| shape.is_blocky()) => {
            blocks(near, &cell)
        }
        near => {
            let samples = Samples::new(near.iter().copied(), low, dx, thin);
            snap(samples.share(|p| near.iter().any(|shape| shape.contains(p))))
        }
    }
}

/// Most blocky shapes in a cell that are cut into pieces, of which there are as many as the cube of their number.
const MOST_BLOCKS: usize = 16;

/// Exact share of a cell inside a polygon swept along an axis.
fn swept(cell: &Bounds, axis: Axis, points: &[[f64; 2]], ends: [Option<f64>; 2]) -> f64 {
    let [a, b] = axis.others();
    let h = axis.index();
    let low = ends[0].map_or(cell.min[h], |from| greatest(from, cell.min[h]));
    let high = ends[1].map_or(cell.max[h], |to| least(to, cell.max[h]));
    let along = if high > low { (high - low) / (cell.max[h] - cell.min[h]) } else { 0.0 };
    let window = [[cell.min[a], cell.min[b]], [cell.max[a], cell.max[b]]];
    let area = (window[1][0] - window[0][0]) * (window[1][1] - window[0][1]);
    let share = along * polygon::area_within(points, window) / area;
    // Rounding of a full cell.
    snap(share)
}

/// Exact share of a cell inside blocky shapes: the cell is cut where any of them begins or ends, and
/// each piece is wholly inside or outside.
fn blocks(shapes: &[&Shape], cell: &Bounds) -> f64 {
    let mut cuts: [Vec<f64>; 3] = std::array::from_fn(|a| vec![cell.min[a], cell.max[a]]);
    shapes.iter().for_each(|shape| shape.planes(&mut cuts));
    for (a, cuts) in cuts.iter_mut().enumerate() {
        cuts.retain(|&x| cell.min[a] <= x && x <= cell.max[a]);
        cuts.sort_by(f64::total_cmp);
        cuts.dedup();
    }
    let middle = |pair: &[f64]| 0.5 * (pair[0] + pair[1]);
    let mut volume = 0.0;
    for z in cuts[2].windows(2) {
        for y in cuts[1].windows(2) {
            for x in cuts[0].windows(2) {
                let point = [middle(x), middle(y), middle(z)];
                if shapes.iter().any(|shape| shape.contains(point)) {
                    volume += ((x[1] - x[0]) * (y[1] - y[0])) * (z[1] - z[0]);
                }
            }
        }
    }
    let size = cell.max[0] - cell.min[0];
    snap(volume / (size * (cell.max[1] - cell.min[1]) * (cell.max[2] - cell.min[2])))
}

/// Shares within rounding of empty and full are exactly 0 and 1.
pub(super) fn snap(share: f64) -> f64 {
    const ROUNDING: f64 = 1e-9;
    if share < ROUNDING {
        0.0
    } else if share > 1.0 - ROUNDING {
        1.0
    } else {
        share
    }
}

/// Distance along a direction and across it.
fn split(r: [f64; 3], direction: [f64; 3]) -> (f64, f64) {
    let along = dot(r, direction) / norm(direction);
    let square = dot(r, r) - along * along;
    (along, if square > 0.0 { square.sqrt() } else { 0.0 })
}

fn least(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

fn greatest(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Heightfield;

    const THICK: [bool; 3] = [false; 3];

    fn block(min_m: [f64; 3], max_m: [f64; 3]) -> Shape {
        Shape::Box { min_m, max_m }
    }

    /// A plane that rises by 0.75 along x and by 1 along y: √(1 + 0.75² + 1²) = 1.6008.
    #[test]
    fn depth_below_a_slope_is_its_distance() {
        let heights = (0..3).map(|j| (0..3).map(|i| 0.75 * f64::from(i) + f64::from(j)).collect()).collect();
        let slope = Shape::Heightfield(Heightfield::new([0.0; 2], 1.0, heights));
        let depth = slope.depth([1.0, 1.0, 0.75]);
        assert!((depth - 1.0 / (1.0_f64 + 0.5625 + 1.0).sqrt()).abs() < 1e-15, "{depth}");
    }

    #[test]
    fn exact_share_of_boxes_and_their_combinations() {
        let half = block([0.0; 3], [1.0, 1.0, 0.5]);
        let quarter = block([0.0; 3], [1.0, 0.5, 1.0]);
        assert_eq!(covered(&[&half], [0.0; 3], 1.0, THICK), 0.5);
        assert_eq!(covered(&[&half, &quarter], [0.0; 3], 1.0, THICK), 0.75);
        let cut = Shape::Difference { from: Box::new(half.clone()), minus: vec![quarter.clone()] };
        assert_eq!(covered(&[&cut], [0.0; 3], 1.0, THICK), 0.25);
        let level = Shape::HalfSpace { point_m: [9.0, 9.0, 0.375], normal: [0.0, 0.0, 2.0] };
        assert_eq!(covered(&[&level], [0.0; 3], 1.0, THICK), 0.375);
        assert_eq!(covered(&[&level], [0.0, 0.0, 1.0], 1.0, THICK), 0.0);
        assert_eq!(covered(&[&Shape::Intersection(vec![half, quarter])], [0.0; 3], 1.0, THICK), 0.25);
    }

    #[test]
    fn exact_share_of_a_wedge() {
        let wedge = Shape::Polygon {
            axis: Axis::Y,
            points_m: vec![[0.0, 0.0], [4.0, 0.0], [4.0, 1.0]],
            from_m: None,
            to_m: Some(0.5),
        };
        // Height 3/4 to 1 in the last cell, half of it along y.
        let share = covered(&[&wedge], [3.0, 0.0, 0.0], 1.0, THICK);
        // A dozen roundings of numbers up to 4.
        assert!((share - 0.875 / 2.0).abs() < 50.0 * f64::EPSILON, "{share}");
    }

    /// Volumes of curved shapes: the error per cut cell is random with a standard deviation below 1/16,
    /// so that of N cut cells is below √N/16.
    #[test]
    fn volumes_of_ball_and_cone() {
        let volume = |shape: &Shape| {
            let mut sum = 0.0;
            for k in 0..24 {
                for j in 0..24 {
                    for i in 0..24 {
                        sum += covered(&[shape], [f64::from(i), f64::from(j), f64::from(k)], 1.0, THICK);
                    }
                }
            }
            sum
        };
        let ball = Shape::Sphere { centre_m: [12.0; 3], radius_m: 10.3 };
        let exact = 4.0 / 3.0 * std::f64::consts::PI * 10.3 * 10.3 * 10.3;
        assert!((volume(&ball) - exact).abs() < 3.0, "{} {exact}", volume(&ball));
        let cone = Shape::Cone {
            base_m: [12.0, 12.0, 0.0],
            direction: [0.0, 0.0, 1.0],
            height_m: 20.0,
            base_radius_m: 10.0,
            top_radius_m: 5.0,
        };
        let exact = std::f64::consts::PI * 20.0 / 3.0 * (100.0 + 50.0 + 25.0);
        assert!((volume(&cone) - exact).abs() < 3.0, "{} {exact}", volume(&cone));
    }

    #[test]
    fn exact_mirror_symmetry_of_shares() {
        let ball = Shape::Sphere { centre_m: [4.0; 3], radius_m: 2.7 };
        for (i, j, k) in [(1, 2, 3), (1, 3, 3), (2, 2, 1), (1, 1, 2)] {
            let share = |c: [i32; 3]| covered(&[&ball], c.map(f64::from), 1.0, THICK);
            let here = share([i, j, k]);
            assert_eq!(here, share([7 - i, j, k]));
            assert_eq!(here, share([i, 7 - j, 7 - k]));
            assert_eq!(here, share([j, k, i]));
        }
    }

    #[test]
    fn depth_never_exceeds_the_distance_and_has_the_sign_of_contains() {
        let shapes = [
            block([0.2, 0.1, 0.3], [0.9, 0.8, 0.7]),
            Shape::Cone {
                base_m: [0.5, 0.5, 0.1],
                direction: [0.0, 0.2, 1.0],
                height_m: 0.7,
                base_radius_m: 0.4,
                top_radius_m: 0.1,
            },
            Shape::Polygon {
                axis: Axis::Z,
                points_m: vec![[0.1, 0.1], [0.9, 0.2], [0.4, 0.4], [0.3, 0.9]],
                from_m: Some(0.2),
                to_m: Some(0.8),
            },
        ];
        let n = 15;
        for shape in &shapes {
            let points: Vec<[f64; 3]> = (0..n * n * n)
                .map(|c| [c % n, c / n % n, c / n / n].map(|i| (f64::from(i) + 0.25) / f64::from(n)))
                .collect();
            for p in points.iter().step_by(7) {
                let depth = shape.depth(*p);
                assert_eq!(depth > 0.0, shape.contains(*p), "{shape:?} {p:?}");
                for q in &points {
                    // Every point nearer than |depth| is on the same side.
                    let r = norm(sub(*p, *q));
                    assert!(
                        r >= depth.abs() || shape.contains(*q) == shape.contains(*p),
                        "{shape:?} {p:?} {q:?}"
                    );
                }
            }
        }
    }
}
