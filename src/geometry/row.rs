//! A shape along one row of points parallel to x, prepared once for all of them.

use super::shape::{Axis, Shape};

/// A shape at given y and z.
pub(crate) enum Row<'a> {
    /// Nothing of it depends on x.
    Whole(bool),
    /// Inside where an odd number of these lie beyond x; sorted.
    Crossings(Vec<f64>),
    /// Asked at every point.
    Plain(&'a Shape, [f64; 2]),
    /// In any of them.
    Any(Vec<Row<'a>>),
    /// In all of them.
    All(Vec<Row<'a>>),
    /// In the first and in none of the others.
    Less(Box<Row<'a>>, Vec<Row<'a>>),
}

impl Shape {
    /// The shape along the row of points (x, `y`, `z`), m: gives what [`Shape::contains`] gives, in a time that does not
    /// depend on the number of corners of a polygon.
    #[must_use]
    pub(crate) fn row(&self, [y, z]: [f64; 2]) -> Row<'_> {
        match self {
            // Its corners are in y and z: one point stands for the row.
            Self::Polygon { axis: Axis::X, from_m: None, to_m: None, .. } => {
                Row::Whole(self.contains([0.0, y, z]))
            }
            Self::Polygon { axis: Axis::X, .. } => Row::Plain(self, [y, z]),
            Self::Polygon { axis, points_m, from_m, to_m } => {
                let (along, across) = if *axis == Axis::Y { (y, z) } else { (z, y) };
                let within = from_m.is_none_or(|from| from <= along) && to_m.is_none_or(|to| along < to);
                if within { Row::Crossings(crossings(points_m, across)) } else { Row::Whole(false) }
            }
            Self::Union(parts) => Row::Any(parts.iter().map(|part| part.row([y, z])).collect()),
            Self::Intersection(parts) => Row::All(parts.iter().map(|part| part.row([y, z])).collect()),
            Self::Difference { from, minus } => {
                Row::Less(Box::new(from.row([y, z])), minus.iter().map(|part| part.row([y, z])).collect())
            }
            _ => Row::Plain(self, [y, z]),
        }
    }

    /// What asking for a point costs: 1, and more for many corners or parts.
    #[must_use]
    pub(crate) fn weight(&self) -> usize {
        match self {
            Self::Polygon { points_m, .. } => 1 + points_m.len() / 8,
            Self::Union(parts) | Self::Intersection(parts) => parts.iter().map(Self::weight).sum(),
            Self::Difference { from, minus } => from.weight() + minus.iter().map(Self::weight).sum::<usize>(),
            _ => 1,
        }
    }
}

impl Row<'_> {
    /// Whether the point at x, m, is inside.
    #[must_use]
    pub(crate) fn contains(&self, x: f64) -> bool {
        match self {
            Self::Whole(inside) => *inside,
            Self::Crossings(at) => (at.len() - at.partition_point(|&edge| edge <= x)) % 2 == 1,
            Self::Plain(shape, [y, z]) => shape.contains([x, *y, *z]),
            Self::Any(parts) => parts.iter().any(|part| part.contains(x)),
            Self::All(parts) => parts.iter().all(|part| part.contains(x)),
            Self::Less(from, minus) => from.contains(x) && !minus.iter().any(|part| part.contains(x)),
        }
    }
}

/// First coordinates at which edges cross a second one: those of the even-odd rule in `polygon::contains`.
fn crossings(points: &[[f64; 2]], at: f64) -> Vec<f64> {
    let n = points.len();
    let edges = (0..n).map(|i| (points[if i == 0 { n - 1 } else { i - 1 }], points[i]));
    let crossing = edges.filter(|(a, b)| (a[1] > at) != (b[1] > at));
    let mut found: Vec<f64> =
        crossing.map(|(a, b)| a[0] + (at - a[1]) / (b[1] - a[1]) * (b[0] - a[0])).collect();
    found.sort_by(f64::total_cmp);
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same bits of the same coordinates are compared, so that not one point differs.
    #[test]
    fn exact_parity_with_points() {
        let star = |axis| Shape::Polygon {
            axis,
            points_m: vec![[0.1, 0.1], [0.9, 0.2], [0.4, 0.4], [0.8, 0.9], [0.5, 0.5], [0.3, 0.9]],
            from_m: Some(0.2),
            to_m: Some(0.8),
        };
        let ball = Shape::Sphere { centre_m: [0.5; 3], radius_m: 0.3 };
        let shapes = [
            star(Axis::X),
            star(Axis::Y),
            star(Axis::Z),
            Shape::Union(vec![star(Axis::Y), ball.clone()]),
            Shape::Intersection(vec![star(Axis::Z), ball.clone()]),
            Shape::Difference { from: Box::new(star(Axis::Z)), minus: vec![ball] },
        ];
        let n = 20;
        let at = |i: i32| f64::from(i) / f64::from(n);
        for shape in &shapes {
            for (j, k) in (0..=n).flat_map(|j| (0..=n).map(move |k| (j, k))) {
                let row = shape.row([at(j), at(k)]);
                for i in 0..=n {
                    let p = [at(i), at(j), at(k)];
                    assert_eq!(row.contains(p[0]), shape.contains(p), "{shape:?} {p:?}");
                }
            }
        }
    }

    fn polygon(corners: usize) -> Shape {
        let turn = |k: usize| std::f64::consts::TAU * k as f64 / corners as f64;
        let points_m = (0..corners).map(|k| [libm::cos(turn(k)), libm::sin(turn(k))]).collect();
        Shape::Polygon { axis: Axis::Z, points_m, from_m: None, to_m: None }
    }

    /// 1 for what is simple, more for many corners, and for many parts what they cost together.
    #[test]
    fn limit_weights_of_corners_and_parts() {
        let ball = || Shape::Sphere { centre_m: [0.5; 3], radius_m: 0.3 };
        assert_eq!((ball().weight(), polygon(4).weight()), (1, 1));
        let [few, many] = [polygon(400), polygon(800)].map(|shape| shape.weight());
        // Every corner is looked at: twice as many cost twice as much, but for the 1 that a point costs at all.
        assert!(few > 10 && (many - 1) == 2 * (few - 1), "{few} {many}");
        for parts in [vec![ball(); 7], vec![polygon(400), ball(), polygon(800)]] {
            let together = parts.iter().map(Shape::weight).sum::<usize>();
            assert_eq!(Shape::Union(parts.clone()).weight(), together);
            assert_eq!(Shape::Intersection(parts.clone()).weight(), together);
            let from = Box::new(Shape::Union(vec![ball(), ball()]));
            assert_eq!(Shape::Difference { from, minus: parts }.weight(), 2 + together);
        }
    }
}
