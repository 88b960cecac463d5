//! The fluid at time 0 of a scene with a free surface: fill of the cells, depths and falls.

use super::facts::Facts;
use crate::geometry::{Axis, Body, Bounds, Shape, drawn};
use crate::scene::{FillLevel, Solid};

/// How the fluid lies at time 0, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pool {
    /// The axis along which the force is strongest.
    pub up: Axis,
    /// Whether the force points towards smaller coordinates of that axis.
    pub down_is_low: bool,
    /// Greatest depth along that axis.
    pub depth: f64,
    /// Whether all columns that are not solid have that depth.
    pub level: bool,
    /// Longest stretch of fluid along each axis.
    pub runs: [f64; 3],
    /// Farthest that fluid can fall freely through air along the axis; infinite where nothing stops it.
    pub fall: f64,
    /// Volume of the fluid in the cells, m³.
    pub volume: f64,
    /// Volume of what is drawn as fluid and not as a solid, m³.
    pub drawn: f64,
}

/// The shape of a fill level: everything on the side towards which gravity pulls.
#[must_use]
pub(crate) fn level_shape(facts: &Facts, level: &FillLevel) -> Shape {
    let axis = level.axis.or_else(|| facts.forces.up_axis()).unwrap_or(Axis::Z);
    let pull = facts.forces.extremes[0][axis.index()];
    let (mut point_m, mut normal) = ([0.0; 3], [0.0; 3]);
    point_m[axis.index()] = level.height_m;
    normal[axis.index()] = if pull > 0.0 { -1.0 } else { 1.0 };
    Shape::HalfSpace { point_m, normal }
}

/// The fluid of a scene at time 0, drawn onto cells.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Drawing {
    /// Fill of every cell, 0 in solids.
    pub fill: Vec<f64>,
    /// Volume of what is drawn as fluid and not as a solid, cells.
    pub volume: f64,
}

/// Where fluid is drawn: the box and what is solid in it.
pub(crate) struct Ground<'a> {
    pub extents: [usize; 3],
    pub spacing_m: f64,
    pub up: Axis,
    /// Shapes of the solids.
    pub bodies: Vec<Body<'a>>,
    /// Per cell: whether a solid holds its centre, if not 0; empty without solids.
    pub solids: &'a [u8],
}

impl<'a> Ground<'a> {
    /// That of a scene.
    #[must_use]
    pub fn of(facts: &Facts<'a>, extents: [usize; 3], solids: &'a [u8]) -> Self {
        let body = |solid: &'a Solid| Body { shape: &solid.shape, invert: solid.invert };
        let bodies = facts.scene.solids.iter().map(body).collect();
        Self { extents, spacing_m: facts.scene.domain.spacing_m, up: facts.forces.up, bodies, solids }
    }

    /// The same box without solids.
    #[must_use]
    pub fn bare(&self) -> Self {
        Self { bodies: Vec::new(), solids: &[], ..*self }
    }

    /// Whether a shape fills any cell: only those are looked at that its bounds touch.
    #[must_use]
    pub fn any_filled(&self, shape: &Shape) -> bool {
        let [nx, ny, _] = self.extents;
        let (dx, up) = (self.spacing_m, self.up.index());
        let thin = self.extents.map(|n| n == 1);
        let [x, y, z] = cells_within(&shape.bounds(), self.extents, dx);
        let filled = |i: usize, j: usize, k: usize| {
            let cell = i + nx * (j + ny * k);
            let low = [i, j, k].map(|i| i as f64 * dx);
            self.solids.get(cell).is_none_or(|&s| s == 0)
                && drawn(&[shape], &self.bodies, low, dx, thin, up).fill > 0.0
        };
        z.into_iter().any(|k| y.clone().any(|j| x.clone().any(|i| filled(i, j, k))))
    }

    /// Fluid inside any of the shapes.
    #[must_use]
    pub fn draw(&self, shapes: &[&Shape]) -> Drawing {
        let [nx, ny, nz] = self.extents;
        let (dx, up) = (self.spacing_m, self.up.index());
        let thin = self.extents.map(|n| n == 1);
        let mut drawing = Drawing { fill: Vec::with_capacity(nx * ny * nz), volume: 0.0 };
        let mut ranges = Ranges::of(shapes, self.extents, dx);
        for k in 0..nz {
            for j in 0..ny {
                for i in 0..nx {
                    let shapes = ranges.near([i, j, k]);
                    let solid = self.solids.get(drawing.fill.len()).is_some_and(|&s| s != 0);
                    let low = [i, j, k].map(|i| i as f64 * dx);
                    let cell = drawn(shapes, &self.bodies, low, dx, thin, up);
                    drawing.volume += cell.volume;
                    drawing.fill.push(if solid { 0.0 } else { cell.fill });
                }
            }
        }
        drawing
    }
}

/// Cells along each axis that bounds touch, and one more on either side.
fn cells_within(bounds: &Bounds, extents: [usize; 3], dx: f64) -> [std::ops::Range<usize>; 3] {
    std::array::from_fn(|a| {
        // A cast saturates, and sends what is not a number to 0.
        let low = ((bounds.min[a] / dx).floor() - 1.0).max(0.0) as usize;
        let high = ((bounds.max[a] / dx).ceil() + 1.0).max(0.0) as usize;
        low.min(extents[a])..high.min(extents[a])
    })
}

/// Most shapes of which every one is looked at in every cell.
const FEW: usize = 16;

/// Where shapes are, if there are so many that a cell had better not ask all of them.
struct Ranges<'a> {
    shapes: &'a [&'a Shape],
    cells: Option<Vec<[std::ops::Range<usize>; 3]>>,
    /// Those that reach into the row of cells along x that is passed, and into the cell.
    row: Vec<usize>,
    near: Vec<&'a Shape>,
}

impl<'a> Ranges<'a> {
    fn of(shapes: &'a [&'a Shape], extents: [usize; 3], dx: f64) -> Self {
        let of = |shape: &&Shape| cells_within(&shape.bounds(), extents, dx);
        let cells = (shapes.len() > FEW).then(|| shapes.iter().map(of).collect());
        Self { shapes, cells, row: Vec::new(), near: Vec::new() }
    }

    /// Those that may reach into a cell; rows are passed from their first cell on.
    fn near(&mut self, [i, j, k]: [usize; 3]) -> &[&'a Shape] {
        let Some(cells) = &self.cells else { return self.shapes };
        if i == 0 {
            let reaches = |s: &usize| cells[*s][1].contains(&j) && cells[*s][2].contains(&k);
            self.row = (0..cells.len()).filter(reaches).collect();
        }
        self.near.clear();
        self.near.extend(self.row.iter().filter(|s| cells[**s][0].contains(&i)).map(|s| self.shapes[*s]));
        &self.near
    }
}

/// The fluid of a scene at time 0; `None` without a free surface.
#[must_use]
pub(crate) fn draw(facts: &Facts, ground: &Ground) -> Option<Drawing> {
    let initial = facts.scene.fluid.initial.as_ref()?;
    let level = initial.fill_level.as_ref().map(|level| level_shape(facts, level));
    let shapes: Vec<&Shape> = level.iter().chain(initial.shapes.iter().map(|part| &part.shape)).collect();
    Some(ground.draw(&shapes))
}

/// Depths and falls of a fill.
#[must_use]
pub(crate) fn pool(facts: &Facts, extents: [usize; 3], solids: &[u8], drawing: &Drawing) -> Pool {
    let fill = &drawing.fill;
    let dx = facts.scene.domain.spacing_m;
    let (up, down_is_low) = (facts.forces.up, facts.forces.down_is_low);
    let solid = |cell: usize| solids.get(cell).is_some_and(|&s| s != 0);
    let runs = Axis::ALL.map(|axis| {
        let mut longest = 0.0;
        for_lines(axis, extents, |line| {
            let mut run = 0.0;
            for cell in line {
                run = if fill[cell] > 0.0 { run + fill[cell] } else { 0.0 };
                longest = if run > longest { run } else { longest };
            }
        });
        longest * dx
    });
    let periodic = !facts.closed[up.index()];
    let (mut depths, mut fall) = (Vec::new(), 0.0_f64);
    for_lines(up, extents, |line| {
        let mut cells: Vec<usize> = line.collect();
        if !down_is_low {
            cells.reverse();
        }
        if cells.iter().all(|&cell| solid(cell)) {
            return;
        }
        depths.push(cells.iter().map(|&cell| fill[cell]).sum::<f64>());
        // From the bottom up: air below fluid is room to fall.
        let (mut air, mut support) = (0.0, !periodic);
        for &cell in &cells {
            if solid(cell) {
                (air, support) = (0.0, true);
            } else if fill[cell] == 0.0 {
                air += 1.0;
            } else {
                let room = if support { air } else { f64::INFINITY };
                fall = if room > fall { room } else { fall };
                (air, support) = (0.0, true);
            }
        }
    });
    let deepest = depths.iter().copied().fold(0.0, |a, b| if b > a { b } else { a });
    // A thousandth of a cell is no gradient that drives anything.
    let level = depths.iter().all(|depth| (depth - deepest).abs() < 1e-3);
    let [volume, drawn] = [fill.iter().sum(), drawing.volume].map(|cells: f64| cells * dx * dx * dx);
    Pool { up, down_is_low, depth: deepest * dx, level, runs, fall: fall * dx, volume, drawn }
}

/// Calls `visit` with the cells of every line along an axis, low end first.
fn for_lines(axis: Axis, extents: [usize; 3], mut visit: impl FnMut(Box<dyn Iterator<Item = usize>>)) {
    let strides = [1, extents[0], extents[0] * extents[1]];
    let [a, b] = axis.others();
    let (n, stride) = (extents[axis.index()], strides[axis.index()]);
    for ib in 0..extents[b] {
        for ia in 0..extents[a] {
            let start = ia * strides[a] + ib * strides[b];
            visit(Box::new((0..n).map(move |i| start + i * stride)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::cells;

    fn pool_of(text: &str) -> Pool {
        let folder = std::path::Path::new(".");
        let scene = crate::scene::flow_from_json(text, "scene.json", folder);
        let scene = scene.unwrap_or_else(|error| panic!("{error}"));
        cells::fill(&Facts::of(&scene)).pool.unwrap_or_else(|| panic!("no surface"))
    }

    /// A reservoir of 0.03 m² in one row of cells 3 mm wide, cut along its slanted surface exactly.
    #[test]
    fn exact_reservoir_of_the_dam_break() {
        let pool = pool_of(include_str!("../../scenes/show/dam_break_slope.json"));
        // 5000 cells, one rounding of their fill each; corners have 7 decimals.
        assert!((pool.volume - 9e-5).abs() < 1e-11, "{}", pool.volume);
        assert!(!pool.level && pool.fall == 0.0 && pool.up == Axis::Z && pool.down_is_low);
        // The column next to the gate: 0.1 + (0.2985 − 0.15) tan 16°.
        assert!((pool.depth - 0.142_582).abs() < 1e-6, "{}", pool.depth);
        assert_eq!(pool.runs[2], pool.depth);
    }

    #[test]
    fn exact_film_is_level_and_drop_falls_to_the_floor() {
        let film = pool_of(include_str!("../../scenes/verify/film_newtonian.json"));
        assert!(film.level && film.fall == 0.0);
        assert!((film.depth - 0.0205).abs() < 1e-15);
        let drop = pool_of(include_str!("../../scenes/verify/falling_drop.json"));
        assert!(!drop.level);
        // From the lowest cell of the drop's outermost column, whose bottom is near its equator.
        assert!((0.068..0.082).contains(&drop.fall), "{}", drop.fall);
        // Area of the disc times the width; 100 cut cells, each off by at most 1/16 at random.
        let exact = std::f64::consts::PI * 0.012 * 0.012 * 0.001;
        assert!((drop.volume / exact - 1.0).abs() < 2e-3, "{}", drop.volume);
    }
}
