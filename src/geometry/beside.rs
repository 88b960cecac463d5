//! Fluid in cells that the surface of a solid runs through.

use super::combine::{covered, snap};
use super::samples::{Samples, touches};
use super::shape::Shape;

/// Gaps between fluid and solid narrower than this share of a cell are drawn to be none: scenes give coordinates with some
/// digits, and surfaces that are meant to be one are described in different ways.
const SLIVER: f64 = 1e-3;

/// A solid: a shape, or all that is outside it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Body<'a> {
    pub shape: &'a Shape,
    pub invert: bool,
}

impl Body<'_> {
    pub(crate) fn contains(&self, p: [f64; 3]) -> bool {
        self.shape.contains(p) != self.invert
    }

    fn depth(&self, p: [f64; 3]) -> f64 {
        if self.invert { -self.shape.depth(p) } else { self.shape.depth(p) }
    }
}

/// The fluid that is drawn in a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Drawn {
    /// Share of the cell that holds fluid and no solid.
    pub volume: f64,
    /// Fill of a cell whose centre is in no solid.
    pub fill: f64,
}

impl Drawn {
    fn all(share: f64) -> Self {
        Self { volume: share, fill: share }
    }
}

/// The fluid that is drawn in a cell beside solids.
///
/// The fill is that of the open part of the cell, row by row: the share of each row's open part that is fluid, and in rows
/// without an open part that of the nearest row with one. So fluid that ends at a solid fills the cells beside it, and a
/// level surface is at the same height in them as in all others. Where the fluid is drawn on into the solid in the same
/// way, this is the share of the whole cell.
///
/// # Arguments
/// `fluid`: the shapes of the fluid. `solids`. `low`: low corner of the cell, m. `dx`: its size, m. `thin`: axes of one
/// cell. `up`: the axis across the rows.
/// # Exactness
/// As [`covered`] away from solids; beside them exact where all surfaces are normal to axes, and elsewhere from at least 8
/// points along each axis.
/// # Verified by
/// Tests of this file and `tests/fluid_beside_solids.rs`.
pub(crate) fn drawn(
    fluid: &[&Shape],
    solids: &[Body],
    low: [f64; 3],
    dx: f64,
    thin: [bool; 3],
    up: usize,
) -> Drawn {
    let share = covered(fluid, low, dx, thin);
    if share == 0.0 || solids.is_empty() {
        return Drawn::all(share);
    }
    let centre = low.map(|x| x + 0.5 * dx);
    let radius = 0.5 * dx * 3.0_f64.sqrt();
    let mut near = Vec::new();
    for solid in solids {
        let depth = solid.depth(centre);
        if depth >= radius {
            return Drawn::default();
        }
        if depth > -radius {
            near.push(*solid);
        }
    }
    if near.is_empty() {
        return Drawn::all(share);
    }
    let shapes = fluid.iter().copied().chain(near.iter().map(|solid| solid.shape));
    let samples = Samples::new(shapes, low, dx, thin);
    let is_wet = |p: [f64; 3]| fluid.iter().any(|shape| shape.contains(p));
    let in_solid = |p: [f64; 3]| near.iter().any(|solid| solid.contains(p));
    let rows = rows(&samples, up, is_wet, in_solid, SLIVER * dx);
    let buried: f64 = rows.iter().map(|row| row.buried).sum();
    let volume = if buried > 0.0 { snap(rows.iter().map(|row| row.wet).sum()) } else { share };
    let whole: f64 = rows.iter().map(|row| row.wet + row.buried).sum();
    let fill = match fill(&rows) {
        // All of the cell's points are in solids, and its centre is not: a slit.
        None if is_wet(centre) || touches(centre, SLIVER * dx, is_wet) => 1.0,
        None => 0.0,
        Some(fill) if (fill - whole).abs() < 1e-9 => share,
        Some(fill) => snap(fill),
    };
    Drawn { volume, fill }
}

/// A row of a cell: shares of the cell.
#[derive(Clone, Copy, Debug, Default)]
struct Row {
    /// Its place across the rows.
    at: f64,
    /// All of it.
    height: f64,
    /// What is open.
    open: f64,
    /// What is open and fluid.
    wet: f64,
    /// What is drawn as fluid inside solids.
    buried: f64,
}

fn rows(
    samples: &Samples,
    up: usize,
    is_wet: impl Fn([f64; 3]) -> bool,
    in_solid: impl Fn([f64; 3]) -> bool,
    sliver: f64,
) -> Vec<Row> {
    let [a, b] = [[1, 2], [0, 2], [0, 1]][up];
    let row = |&(at, height): &(f64, f64)| {
        let mut row = Row { at, height, ..Row::default() };
        for &(y, dy) in &samples.lines[b] {
            for &(x, dx) in &samples.lines[a] {
                let mut p = [0.0; 3];
                (p[up], p[a], p[b]) = (at, x, y);
                let share = height * dx * dy;
                match (is_wet(p), in_solid(p)) {
                    (true, true) => row.buried += share,
                    (true, false) => {
                        row.open += share;
                        row.wet += share;
                    }
                    (false, false) if !touches(p, sliver, &in_solid) => row.open += share,
                    (false, _) => {}
                }
            }
        }
        row
    };
    samples.lines[up].iter().map(row).collect()
}

/// Mean over the rows of the wet share of their open part; `None` where nothing is open.
fn fill(rows: &[Row]) -> Option<f64> {
    let mut sum = 0.0;
    for row in rows {
        let open = rows.iter().filter(|other| other.open > 0.0);
        let nearest = open.min_by(|a, b| (a.at - row.at).abs().total_cmp(&(b.at - row.at).abs()))?;
        sum += row.height * (nearest.wet / nearest.open);
    }
    Some(sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Axis;

    const UP: usize = 2;
    const THICK: [bool; 3] = [false; 3];

    fn block(min_m: [f64; 3], max_m: [f64; 3]) -> Shape {
        Shape::Box { min_m, max_m }
    }

    /// In the cell at the origin, 1 m wide.
    fn in_cell(fluid: &Shape, solid: &Shape, invert: bool) -> Drawn {
        drawn(&[fluid], &[Body { shape: solid, invert }], [0.0; 3], 1.0, THICK, UP)
    }

    fn is(found: Drawn, volume: f64, fill: f64) {
        // A sum of at most 10³ shares.
        let near = |a: f64, b: f64| (a - b).abs() < 1e3 * f64::EPSILON;
        assert!(near(found.volume, volume) && near(found.fill, fill), "{found:?} {volume} {fill}");
    }

    #[test]
    fn exact_fill_beside_blocks() {
        let wall = block([0.7, -1.0, -1.0], [2.0, 2.0, 2.0]);
        let up_to_it = block([-1.0, -1.0, -1.0], [0.7, 2.0, 2.0]);
        is(in_cell(&up_to_it, &wall, false), 0.7, 1.0);
        // A level surface, up to the wall and through it.
        let pool = block([-1.0, -1.0, -1.0], [0.7, 2.0, 0.37]);
        is(in_cell(&pool, &wall, false), 0.7 * 0.37, 0.37);
        let through = block([-1.0, -1.0, -1.0], [2.0, 2.0, 0.37]);
        assert_eq!(in_cell(&through, &wall, false).fill, covered(&[&through], [0.0; 3], 1.0, THICK));
        // On a floor in the lower half, below a ceiling in the upper one.
        let floor = block([-1.0, -1.0, -1.0], [2.0, 2.0, 0.3]);
        is(in_cell(&block([-1.0, -1.0, 0.3], [2.0, 2.0, 0.8]), &floor, false), 0.5, 0.8);
        let ceiling = block([-1.0, -1.0, 0.6], [2.0, 2.0, 2.0]);
        is(in_cell(&block([-1.0, -1.0, -1.0], [2.0, 2.0, 0.6]), &ceiling, false), 0.6, 1.0);
        // Away from the wall and from the floor on purpose: as drawn.
        is(in_cell(&block([-1.0, -1.0, 0.5], [2.0, 2.0, 2.0]), &floor, false), 0.5, 0.5);
        is(in_cell(&block([-1.0, -1.0, -1.0], [0.35, 2.0, 2.0]), &wall, false), 0.35, 0.5);
        assert_eq!(in_cell(&block([2.0; 3], [3.0; 3]), &wall, false), Drawn::default());
    }

    #[test]
    fn exact_level_beside_a_slope() {
        // Solid above the slope z = x, and below it.
        let slope = |third| Shape::Polygon {
            axis: Axis::Y,
            points_m: vec![[-9.0, -9.0], [9.0, 9.0], third],
            from_m: None,
            to_m: None,
        };
        let below_both = 0.43 * 0.43 / 2.0;
        for (solid, volume) in [(slope([-9.0, 9.0]), 0.43 - below_both), (slope([9.0, -9.0]), below_both)] {
            let through = block([-9.0, -9.0, -9.0], [9.0, 9.0, 0.43]);
            let ended = Shape::Difference { from: Box::new(through.clone()), minus: vec![solid.clone()] };
            for fluid in [through, ended] {
                let found = in_cell(&fluid, &solid, false);
                assert!((found.fill - 0.43).abs() < 1e3 * f64::EPSILON, "{fluid:?} {found:?}");
                // Half a sample, 1/16 of a row, in each of the rows, 0.43 of the cell together.
                assert!((found.volume - volume).abs() < 0.43 / 16.0, "{found:?}");
            }
        }
    }

    #[test]
    fn limit_slits_and_slivers() {
        // Two solids that leave a slit at the centre of the cell, which no sample sees.
        let slit = Shape::Difference {
            from: Box::new(block([-1.0; 3], [2.0; 3])),
            minus: vec![Shape::Sphere { centre_m: [0.5; 3], radius_m: 0.05 }],
        };
        assert_eq!(in_cell(&block([-1.0; 3], [2.0; 3]), &slit, false).fill, 1.0);
        assert_eq!(in_cell(&block([-1.0; 3], [2.0, 2.0, 0.4]), &slit, false).fill, 0.0);
        // A gap of rounding between fluid and wall.
        let wall = block([0.7, -1.0, -1.0], [2.0, 2.0, 2.0]);
        assert_eq!(in_cell(&block([-1.0; 3], [0.699_999, 2.0, 2.0]), &wall, false).fill, 1.0);
    }
}
