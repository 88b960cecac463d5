//! Edges of a polygon that cross or touch.

/// Two edges of a polygon with a point in common that simple polygons do not have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crossing {
    /// Numbers of the corners at which the two edges begin, from 0; they end at the next corner.
    pub edges: [usize; 2],
    /// A point of both.
    pub at: [f64; 2],
}

/// The first crossing found; `None` for a simple polygon. Corners that repeat the one before, as a last one that closes the
/// polygon does, are no crossing; nor is the direction in which the corners go round.
///
/// Edges are sorted by their least first coordinate and compared with those that overlap them in it.
#[must_use]
pub(crate) fn first_crossing(points: &[[f64; 2]]) -> Option<Crossing> {
    let edges = edges(points);
    let mut order: Vec<usize> = (0..edges.len()).collect();
    let low = |e: usize| edges[e].1[0].min(edges[e].2[0]);
    let high = |e: usize| edges[e].1[0].max(edges[e].2[0]);
    order.sort_by(|&a, &b| low(a).total_cmp(&low(b)));
    let mut active: Vec<usize> = Vec::new();
    for e in order {
        active.retain(|&other| high(other) >= low(e));
        for &other in &active {
            let (first, second) = if e < other { (e, other) } else { (other, e) };
            if let Some(at) = common_point(&edges, first, second) {
                return Some(Crossing { edges: [edges[first].0, edges[second].0], at });
            }
        }
        active.push(e);
    }
    None
}

/// An edge: number of its first corner, and both ends.
type Edge = (usize, [f64; 2], [f64; 2]);

/// The edges of positive length.
fn edges(points: &[[f64; 2]]) -> Vec<Edge> {
    let n = points.len();
    let all = (0..n).map(|i| (i, points[i], points[(i + 1) % n]));
    all.filter(|(_, a, b)| a != b).collect()
}

/// A point that two edges have in common besides the corner that joins neighbours.
fn common_point(edges: &[Edge], first: usize, second: usize) -> Option<[f64; 2]> {
    let ((_, a, b), (_, c, d)) = (edges[first], edges[second]);
    if second == first + 1 {
        return turns_back(a, b, d).then_some(b);
    }
    if first == 0 && second == edges.len() - 1 {
        return turns_back(c, d, b).then_some(d);
    }
    let (of_c, of_d) = (side(a, b, c), side(a, b, d));
    let (of_a, of_b) = (side(c, d, a), side(c, d, b));
    if of_c * of_d < 0.0 && of_a * of_b < 0.0 {
        let t = of_c / (of_c - of_d);
        return Some([c[0] + t * (d[0] - c[0]), c[1] + t * (d[1] - c[1])]);
    }
    let touching = [(of_c, a, b, c), (of_d, a, b, d), (of_a, c, d, a), (of_b, c, d, b)];
    touching.into_iter().find(|&(side, p, q, r)| side == 0.0 && between(p, q, r)).map(|(.., r)| r)
}

/// Whether an edge from `a` to `b` is followed by one that runs back along it.
fn turns_back(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> bool {
    side(a, b, c) == 0.0 && (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]) < 0.0
}

/// Sign and size of the area of the triangle: positive with `r` to the left of the way from `p` to `q`. Scaled, so that it
/// neither overflows nor vanishes with the unit of length.
fn side(p: [f64; 2], q: [f64; 2], r: [f64; 2]) -> f64 {
    let scale = [p, q, r].iter().flatten().fold(f64::MIN_POSITIVE, |most: f64, x| most.max(x.abs()));
    let of = |a: [f64; 2], b: [f64; 2]| [(b[0] - a[0]) / scale, (b[1] - a[1]) / scale];
    let (u, v) = (of(p, q), of(p, r));
    u[0] * v[1] - u[1] * v[0]
}

/// Whether a point of the line lies between its ends or on one.
fn between(p: [f64; 2], q: [f64; 2], r: [f64; 2]) -> bool {
    (0..2).all(|a| p[a].min(q[a]) <= r[a] && r[a] <= p[a].max(q[a]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crossings_are_named() {
        let bow_tie = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert_eq!(first_crossing(&bow_tie), Some(Crossing { edges: [0, 2], at: [0.5, 0.5] }));
        let touching = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.0], [0.0, 2.0]];
        assert_eq!(first_crossing(&touching).map(|found| found.at), Some([1.0, 0.0]));
        let same_corner = [[0.0, 0.0], [2.0, 0.0], [1.0, 1.0], [2.0, 2.0], [0.0, 2.0], [1.0, 1.0]];
        assert_eq!(first_crossing(&same_corner).map(|found| found.at), Some([1.0, 1.0]));
        let spike = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        assert!(first_crossing(&spike).is_some());
        // Five corners, each joined to the next but one.
        let star: Vec<[f64; 2]> = (0..5)
            .map(|k| 2.0 * std::f64::consts::TAU * f64::from(k) / 5.0)
            .map(|angle| [libm::cos(angle), libm::sin(angle)])
            .collect();
        assert!(first_crossing(&star).is_some());
    }

    #[test]
    fn simple_polygons_have_none() {
        let l_shape = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        let mut reversed = l_shape;
        reversed.reverse();
        assert_eq!(first_crossing(&l_shape), None);
        assert_eq!(first_crossing(&reversed), None);
        let closed = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0]];
        assert_eq!(
            first_crossing(&closed),
            None,
            "a corner given twice in a row, and the first again at the end"
        );
        let tiny = l_shape.map(|p| p.map(|x| 1e-200 * x));
        assert_eq!(first_crossing(&tiny), None);
        let straight = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0]];
        assert_eq!(first_crossing(&straight), None, "a corner on a straight edge");
    }

    /// 30 000 corners on a circle: overlaps in one coordinate are few.
    #[test]
    fn many_corners_take_no_time() {
        let n = 30_000;
        let points: Vec<[f64; 2]> = (0..n)
            .map(|k| std::f64::consts::TAU * f64::from(k) / f64::from(n))
            .map(|angle| [libm::cos(angle), libm::sin(angle)])
            .collect();
        let start = std::time::Instant::now();
        assert_eq!(first_crossing(&points), None);
        // Every pair of edges would be 4.5e8 comparisons, a minute without optimisation.
        assert!(start.elapsed().as_secs() < 10);
    }
}
