//! Point in polygon.

/// Whether `p` is inside a closed polygon, by the even-odd rule: count the edges crossed by the
/// ray from `p` towards +first coordinate. Edges are half open, so that two polygons that share
/// an edge never both hold a point of it.
#[must_use]
pub fn contains(points: &[[f64; 2]], p: [f64; 2]) -> bool {
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
pub fn signed_area(points: &[[f64; 2]]) -> f64 {
    let mut twice = 0.0;
    for (i, &b) in points.iter().enumerate() {
        let a = points[if i == 0 { points.len() - 1 } else { i - 1 }];
        twice += a[0] * b[1] - b[0] * a[1];
    }
    0.5 * twice
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
    fn shared_edge_belongs_to_one_polygon() {
        let left = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let right = [[1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0]];
        let on_edge = [1.0, 0.5];
        assert_ne!(contains(&left, on_edge), contains(&right, on_edge));
    }
}
