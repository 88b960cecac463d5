//! Which cells are solid, which fluid they hold, and how wide the gaps between walls are.

use super::facts::Facts;
use super::surface::{self, Drawing, Ground, Pool};
use crate::geometry::{Axis, Shape};
use crate::scene::{Boundary, Domain};

/// The box in cells. Per-cell arrays are empty when nothing would be in them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cells {
    /// Cells along x, y, z.
    pub extents: [usize; 3],
    /// Per cell: 0 fluid, s > 0 solid s − 1; empty without solids.
    pub solids: Vec<u8>,
    /// Per cell: number of the fluid; empty with one fluid.
    pub fluid_of_cell: Vec<u8>,
    /// Fluid cells, at time 0.
    pub fluid_cells: u64,
    /// Fill at time 0; empty without a free surface.
    pub fill: Vec<f64>,
    /// How the fluid lies; `None` without a free surface.
    pub pool: Option<Pool>,
    /// Widest place between walls, in cells: over all fluid cells, the largest value of the
    /// shortest of the three axis-parallel distances from wall to wall. Infinite without walls.
    pub gap: f64,
}

/// Cells along each axis.
#[must_use]
pub(crate) fn extents(domain: &Domain) -> [usize; 3] {
    std::array::from_fn(|a| (domain.size_m[a] / domain.spacing_m).round() as usize)
}

/// Fills the box.
#[must_use]
pub(crate) fn fill(facts: &Facts) -> Cells {
    let scene = facts.scene;
    let extents = extents(&scene.domain);
    let shapes: Vec<(&Shape, bool)> = scene.solids.iter().map(|s| (&s.shape, s.invert)).collect();
    let solids = paint(extents, scene.domain.spacing_m, &shapes);
    let layers: Vec<(&Shape, bool)> = scene.layers.iter().map(|l| (&l.shape, false)).collect();
    let fluid_of_cell = paint(extents, scene.domain.spacing_m, &layers);
    let total = extents.iter().map(|&n| n as u64).product::<u64>();
    let open_cells = total - solids.iter().filter(|&&s| s != 0).count() as u64;
    let gap = gap(extents, &facts.faces, &solids);
    let drawing = surface::draw(facts, &Ground::of(facts, extents, &solids));
    let pool = drawing.as_ref().map(|drawing| surface::pool(facts, extents, &solids, drawing));
    let filled = |drawing: &Drawing| drawing.fill.iter().filter(|&&fill| fill > 0.0).count() as u64;
    let fluid_cells = drawing.as_ref().map_or(open_cells, filled);
    let fill = drawing.unwrap_or_default().fill;
    Cells { extents, solids, fluid_of_cell, fluid_cells, fill, pool, gap }
}

/// Number (from 1) of the last shape that holds a cell's centre, 0 without one; empty without
/// shapes.
fn paint([nx, ny, nz]: [usize; 3], dx: f64, shapes: &[(&Shape, bool)]) -> Vec<u8> {
    if shapes.is_empty() {
        return Vec::new();
    }
    let centre = |i: usize| (i as f64 + 0.5) * dx;
    let mut cells = Vec::with_capacity(nx * ny * nz);
    for k in 0..nz {
        for j in 0..ny {
            let at = [centre(j), centre(k)];
            let rows: Vec<_> = shapes.iter().map(|(shape, invert)| (shape.row(at), *invert)).collect();
            for i in 0..nx {
                let last = rows.iter().rposition(|(row, invert)| row.contains(centre(i)) != *invert);
                cells.push(last.map_or(0, |s| u8::try_from(s + 1).unwrap_or(u8::MAX)));
            }
        }
    }
    cells
}

/// Whether a shape holds at least one cell centre of the box.
#[must_use]
pub(crate) fn holds_a_cell(shape: &Shape, invert: bool, domain: &Domain) -> bool {
    paint(extents(domain), domain.spacing_m, &[(shape, invert)]).contains(&1)
}

/// How many cell centres of the box a shape holds.
#[must_use]
pub(crate) fn holds_cells(shape: &Shape, invert: bool, domain: &Domain) -> u64 {
    let cells = paint(extents(domain), domain.spacing_m, &[(shape, invert)]);
    cells.iter().filter(|&&s| s != 0).count() as u64
}

fn gap(extents: [usize; 3], faces: &[[Boundary; 2]; 3], solids: &[u8]) -> f64 {
    if solids.is_empty() {
        return (0..3).map(|a| empty_run(extents[a], faces[a])).fold(f64::INFINITY, least);
    }
    let mut shortest = vec![f32::INFINITY; solids.len()];
    for axis in Axis::ALL {
        runs_along(axis, extents, faces[axis.index()], solids, &mut shortest);
    }
    let fluid = shortest.iter().zip(solids).filter(|(_, s)| **s == 0);
    fluid.map(|(run, _)| f64::from(*run)).fold(0.0, |a, b| if b > a { b } else { a })
}

/// Distance from wall to wall along an axis without solids; a mirror plane doubles it.
fn empty_run(n: usize, faces: [Boundary; 2]) -> f64 {
    let walls = faces.iter().filter(|face| is_wall(face)).count();
    match walls {
        2 => n as f64,
        1 => 2.0 * n as f64,
        _ => f64::INFINITY,
    }
}

fn is_wall(face: &Boundary) -> bool {
    matches!(face, Boundary::NoSlip | Boundary::MovingWall { .. })
}

fn least(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// Lowers `shortest` to the length of the fluid run through each cell along one axis.
fn runs_along(axis: Axis, extents: [usize; 3], faces: [Boundary; 2], solids: &[u8], shortest: &mut [f32]) {
    let [nx, ny, _] = extents;
    let stride = [1, nx, nx * ny][axis.index()];
    let n = extents[axis.index()];
    let [a, b] = axis.others();
    let strides = [1, nx, nx * ny];
    for ib in 0..extents[b] {
        for ia in 0..extents[a] {
            let start = ia * strides[a] + ib * strides[b];
            let line: Vec<bool> = (0..n).map(|i| solids[start + i * stride] != 0).collect();
            for (i, run) in line_runs(&line, faces).into_iter().enumerate() {
                let cell = &mut shortest[start + i * stride];
                *cell = if run < *cell { run } else { *cell };
            }
        }
    }
}

/// Length of the fluid run through each cell of a line; 0 in solids.
fn line_runs(solid: &[bool], faces: [Boundary; 2]) -> Vec<f32> {
    let n = solid.len();
    let Some(first_solid) = solid.iter().position(|&s| s) else {
        return vec![empty_run(n, faces) as f32; n];
    };
    let periodic = faces[0] == Boundary::Periodic;
    let mut runs = vec![0.0; n];
    // A periodic line is cut at a solid, so that no run crosses the cut.
    let offset = if periodic { first_solid } else { 0 };
    let at = |i: usize| (i + offset) % n;
    let mut i = 0;
    while i < n {
        if solid[at(i)] {
            i += 1;
            continue;
        }
        let end = (i..n).find(|&e| solid[at(e)]).unwrap_or(n);
        let mirror = !periodic
            && ((i == 0 && faces[0] == Boundary::FreeSlip) || (end == n && faces[1] == Boundary::FreeSlip));
        let length = (end - i) as f32 * if mirror { 2.0 } else { 1.0 };
        for e in i..end {
            runs[at(e)] = length;
        }
        i = end;
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_runs_of_a_periodic_line_wrap() {
        let line = [false, true, false, false, true, false];
        assert_eq!(line_runs(&line, [Boundary::Periodic; 2]), [2.0, 0.0, 2.0, 2.0, 0.0, 2.0]);
        assert_eq!(line_runs(&line, [Boundary::NoSlip; 2]), [1.0, 0.0, 2.0, 2.0, 0.0, 1.0]);
        assert_eq!(line_runs(&line, [Boundary::FreeSlip; 2])[0], 2.0);
    }

    #[test]
    fn exact_gap_of_pipe_and_channel() {
        let pipe = Shape::Cylinder {
            point_m: [0.0, 8.0, 8.0],
            direction: [1.0, 0.0, 0.0],
            radius_m: 6.0,
            length_m: None,
        };
        let extents = [1, 16, 16];
        let solids = paint(extents, 1.0, &[(&pipe, true)]);
        assert_eq!(gap(extents, &[[Boundary::Periodic; 2]; 3], &solids), 12.0);
        let mut faces = [[Boundary::Periodic; 2]; 3];
        assert_eq!(gap(extents, &faces, &[]), f64::INFINITY);
        faces[1] = [Boundary::NoSlip, Boundary::FreeSlip];
        assert_eq!(gap(extents, &faces, &[]), 32.0);
    }
}
