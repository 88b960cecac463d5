//! Point in polygon.

/// Whether `p` is inside a closed polygon, by the even-odd rule: count the edges crossed by the
/// ray from `p` towards +first coordinate. Edges are half open, so that two polygons that share
/// an edge never both hold a point of it.
#[must_use]
pub(crate) fn contains(points: &[[f64; 2]], p: [f64; 2]) -> bool {
    let mut inside = false;
    for (i, &b) in points.iter().enumerate() {
        let a = points[if i == 0 { points.len() - 1 } else { i - 1 }];
        let crosses_height = (a[1] > p[1]) != (b[1] > p[1]);
        if crosses_height && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) {
            inside = !inside;
        }
    }
    inside
}

/// Area with sign: positive for counter-clockwise points.
#[must_use]
pub(crate) fn signed_area(points: &[[f64; 2]]) -> f64 {
    let mut twice = 0.0;
    for (i, &b) in points.iter().enumerate() {
        let a = points[if i == 0 { points.len() - 1 } else { i - 1 }];
        twice += a[0] * b[1] - b[0] * a[1];
    }
    0.5 * twice
}

/// Distance of a point to the nearest edge, positive inside.
#[must_use]
pub(crate) fn depth(points: &[[f64; 2]], p: [f64; 2]) -> f64 {
    let mut least = f64::INFINITY;
    for (i, &b) in points.iter().enumerate() {
        let a = points[if i == 0 { points.len() - 1 } else { i - 1 }];
        let (edge, r) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
        let length = edge[0] * edge[0] + edge[1] * edge[1];
        let t = if length > 0.0 { ((r[0] * edge[0] + r[1] * edge[1]) / length).clamp(0.0, 1.0) } else { 0.0 };
        let (x, y) = (r[0] - t * edge[0], r[1] - t * edge[1]);
        let square = x * x + y * y;
        least = if square < least { square } else { least };
    }
    let distance = least.sqrt();
    if contains(points, p) { distance } else { -distance }
}

/// Area of the part of a polygon inside a rectangle `[low, high]` (Sutherland-Hodgman clipping; edges
/// that a concave polygon leaves doubled on the rectangle have no area).
#[must_use]
pub(crate) fn area_within(points: &[[f64; 2]], [low, high]: [[f64; 2]; 2]) -> f64 {
    let mut clipped = points.to_vec();
    for axis in [0, 1] {
        clipped = clip(&clipped, axis, |x| x - low[axis]);
        clipped = clip(&clipped, axis, |x| high[axis] - x);
    }
    if clipped.len() < 3 { 0.0 } else { signed_area(&clipped).abs() }
}

/// The part of a polygon where `room` of a coordinate is not negative.
fn clip(points: &[[f64; 2]], axis: usize, room: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    let mut out = Vec::with_capacity(points.len() + 2);
    for (i, &b) in points.iter().enumerate() {
        let a = points[if i == 0 { points.len() - 1 } else { i - 1 }];
        let (from, to) = (room(a[axis]), room(b[axis]));
        if (from < 0.0) != (to < 0.0) {
            let t = from / (from - to);
            out.push([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
        }
        if to >= 0.0 {
            out.push(b);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    const L_SHAPE: [[f64; 2]; 6] = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];

    #[test]
    fn exact_inside_of_a_concave_polygon() {
        assert!(contains(&L_SHAPE, [0.5, 1.5]));
        assert!(contains(&L_SHAPE, [1.5, 0.5]));
        assert!(!contains(&L_SHAPE, [1.5, 1.5]));
        assert!(!contains(&L_SHAPE, [-0.1, 0.5]));
    }

    #[test]
    fn exact_area_with_sign() {
        assert_eq!(signed_area(&L_SHAPE), 3.0);
        let mut reversed = L_SHAPE;
        reversed.reverse();
        assert_eq!(signed_area(&reversed), -3.0);
    }

    #[test]
    fn exact_area_within_a_rectangle() {
        assert_eq!(area_within(&L_SHAPE, [[0.5, 0.5], [1.5, 1.5]]), 0.75);
        assert_eq!(area_within(&L_SHAPE, [[-1.0, -1.0], [3.0, 3.0]]), 3.0);
        assert_eq!(area_within(&L_SHAPE, [[1.2, 1.2], [1.8, 1.8]]), 0.0);
        assert_eq!(depth(&L_SHAPE, [0.5, 0.25]), 0.25);
        assert_eq!(depth(&L_SHAPE, [-3.0, -4.0]), -5.0);
    }

    #[test]
    fn shared_edge_belongs_to_one_polygon() {
        let left = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let right = [[1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0]];
        let on_edge = [1.0, 0.5];
        assert_ne!(contains(&left, on_edge), contains(&right, on_edge));
    }
}
