//! How much of a box a solid takes.

use super::beside::Body;
use super::samples::line;

/// Most points at which a solid is asked for.
const MOST_POINTS: usize = 4_000_000;

impl Body<'_> {
    /// Volume of the solid in a box of cells, m³, from 8, 4 or 2 points along each axis of a cell, between the planes of
    /// the shape in proportion; `None` where even 2 would be too many: a solid of so many cells is resolved.
    #[must_use]
    pub(crate) fn volume(&self, extents: [usize; 3], dx: f64) -> Option<f64> {
        let cells: usize = extents.iter().product();
        let most = MOST_POINTS / self.shape.weight().max(1);
        let count =
            [8, 4, 2].into_iter().find(|count| cells.saturating_mul(count * count * count) <= most)?;
        let mut planes: [Vec<f64>; 3] = Default::default();
        self.shape.planes(&mut planes);
        let [x, y, z] = std::array::from_fn(|a| {
            let cells = (0..extents[a]).flat_map(|i| line(&planes[a], i as f64 * dx, dx, count));
            cells.collect::<Vec<_>>()
        });
        let mut shares = 0.0;
        for &(z, of_z) in &z {
            for &(y, of_y) in &y {
                let row = self.shape.row([y, z]);
                let inside = x.iter().filter(|(x, _)| row.contains(*x) != self.invert);
                shares += of_z * of_y * inside.map(|(_, share)| share).sum::<f64>();
            }
        }
        Some(shares * dx * dx * dx)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Shape;

    #[test]
    fn volumes_of_a_box_a_ball_and_what_is_outside_it() {
        let of = |shape: &Shape, invert: bool| {
            Body { shape, invert }.volume([10, 8, 6], 0.5).expect("few enough points")
        };
        // Cut by the low end of the box in x; 1.3 · 2.1 · 0.9 m³, exact but for rounding.
        let block = Shape::Box { min_m: [-1.0, 0.2, 0.3], max_m: [1.3, 2.3, 1.2] };
        assert!((of(&block, false) - 2.457).abs() < 1e-12, "{}", of(&block, false));
        // Two cells in radius: the points, 1/8 cell apart, err by less than a hundredth.
        let ball = Shape::Sphere { centre_m: [2.5, 2.0, 1.5], radius_m: 1.0 };
        let exact = 4.0 / 3.0 * std::f64::consts::PI;
        assert!((of(&ball, false) / exact - 1.0).abs() < 0.01, "{}", of(&ball, false));
        assert!((of(&ball, true) + of(&ball, false) - 60.0).abs() < 1e-9);
        assert_eq!(Body { shape: &ball, invert: false }.volume([1000; 3], 0.5), None);
    }
}
