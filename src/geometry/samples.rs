//! Points that stand for the parts of a cell.

use super::shape::{Axis, Shape};

/// Points along each axis of a cell that a curved or oblique surface cuts. Even, so that the points are symmetric about
/// the cell centre and none lies on it.
const SAMPLES: usize = 8;

/// Most planes along an axis at which a cell is cut: with more of them, points without regard to planes are as good and fewer.
const MOST_CUTS: usize = 4 * SAMPLES;

/// Planes closer to each other or to a face of the cell than this share of it are one: rounding.
const SAME: f64 = 1e-9;

impl Shape {
    /// Adds the positions along each axis where plane surfaces normal to it lie: those of boxes, axis-parallel half-spaces
    /// and polygons.
    pub(super) fn planes(&self, planes: &mut [Vec<f64>; 3]) {
        match self {
            Self::Box { min_m, max_m } => {
                for a in 0..3 {
                    planes[a].extend([min_m[a], max_m[a]]);
                }
            }
            Self::HalfSpace { point_m, normal } => {
                let along: Vec<usize> = (0..3).filter(|&a| normal[a] != 0.0).collect();
                if let [a] = along[..] {
                    planes[a].push(point_m[a]);
                }
            }
            Self::Polygon { axis, points_m, from_m, to_m } => {
                planes[axis.index()].extend(from_m.iter().chain(to_m));
                sides(*axis, points_m, planes);
            }
            Self::Union(parts) | Self::Intersection(parts) => {
                parts.iter().for_each(|part| part.planes(planes));
            }
            Self::Difference { from, minus } => {
                from.planes(planes);
                minus.iter().for_each(|part| part.planes(planes));
            }
            Self::Cylinder { .. } | Self::Sphere { .. } | Self::Cone { .. } | Self::Heightfield(_) => {}
        }
    }
}

/// Adds the sides of a polygon that are parallel to an axis.
fn sides(axis: Axis, points: &[[f64; 2]], planes: &mut [Vec<f64>; 3]) {
    for (i, p) in points.iter().enumerate() {
        let next = points[(i + 1) % points.len()];
        for (side, a) in axis.others().into_iter().enumerate() {
            if p[side] == next[side] {
                planes[a].push(p[side]);
            }
        }
    }
}

/// Positions in a cell along one axis, and the share of it that each stands for.
pub(super) type Line = Vec<(f64, f64)>;

/// The sample points of a cell: where no plane cuts it at the same places in every cell and symmetric about its centre, 8
/// along each axis; between planes in proportion, so that what ends at one is had exactly.
pub(super) struct Samples {
    pub lines: [Line; 3],
}

impl Samples {
    /// `low`: low corner of the cell, m. `dx`: its size, m. `thin`: axes along which nothing changes. `shapes`: those whose
    /// planes cut the cell.
    pub fn new<'a>(
        shapes: impl IntoIterator<Item = &'a Shape>,
        low: [f64; 3],
        dx: f64,
        thin: [bool; 3],
    ) -> Self {
        let mut planes: [Vec<f64>; 3] = Default::default();
        shapes.into_iter().for_each(|shape| shape.planes(&mut planes));
        let line = |a: usize| {
            let counts = if thin[a] { 1 } else { SAMPLES };
            line(&planes[a], low[a], dx, counts)
        };
        Self { lines: [line(0), line(1), line(2)] }
    }

    /// Share of the cell whose points hold what is asked.
    pub fn share(&self, holds: impl Fn([f64; 3]) -> bool) -> f64 {
        let [x, y, z] = &self.lines;
        let row = |y: f64, z: f64| -> f64 {
            x.iter().filter(|(x, _)| holds([*x, y, z])).map(|(_, share)| share).sum()
        };
        let layer = |z: f64| -> f64 { y.iter().map(|&(y, share)| share * row(y, z)).sum() };
        z.iter().map(|&(z, share)| share * layer(z)).sum()
    }
}

/// The points of a cell along an axis, `count` and more where planes cut it.
pub(super) fn line(planes: &[f64], low: f64, dx: f64, count: usize) -> Line {
    let mut cuts: Vec<f64> = planes.iter().map(|plane| (plane - low) / dx).collect();
    cuts.retain(|&cut| cut > SAME && cut < 1.0 - SAME);
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|a, b| *a - *b < SAME);
    if cuts.len() > MOST_CUTS {
        cuts.clear();
    }
    let mut line = Vec::with_capacity(count + cuts.len());
    let mut start = 0.0;
    for end in cuts.into_iter().chain([1.0]) {
        let length = end - start;
        let points = (count as f64 * length).round().max(1.0);
        for i in 0..points as usize {
            let at = start + length * ((i as f64 + 0.5) / points);
            line.push((low + dx * at, length / points));
        }
        start = end;
    }
    line
}

/// Whether a point lies within a distance of what holds, along an axis.
pub(super) fn touches(p: [f64; 3], distance: f64, holds: impl Fn([f64; 3]) -> bool) -> bool {
    (0..3).any(|a| {
        [-distance, distance].into_iter().any(|step| {
            let mut q = p;
            q[a] += step;
            holds(q)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_touches_what_lies_on_either_side() {
        for axis in 0..3 {
            for side in [-1.0, 1.0] {
                let holds = |p: [f64; 3]| side * p[axis] >= 0.5;
                assert!(
                    touches([0.0; 3], 0.5, holds) && !touches([0.0; 3], 0.4, holds),
                    "axis {axis}, side {side}"
                );
            }
        }
    }
}
