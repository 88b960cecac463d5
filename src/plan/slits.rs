//! Gaps between solids and to walls of the box, and solids between gaps, that have another width in cells than as drawn.

use super::cells::Cells;
use super::warning::Warning;
use crate::geometry::Axis;
use crate::scene::{Boundary, Scene};

/// Width below which a mismatch matters, cells: above it a flow through the gap is resolved.
const NARROW: f64 = 4.0;
/// Mismatch worth a warning, as a share of the width as drawn.
const MISMATCH: f64 = 0.1;
/// Points per cell along a line, the centre among them, which is what makes a cell solid; ends are then found by halving.
const POINTS: usize = 9;
/// Points asked along an axis, of simple solids; lines are left out where it would be more.
const BUDGET: usize = 1_000_000;
/// Ends of a neighbouring line that lie farther off than this, cells, belong to a curved or oblique surface: widths along a
/// line say nothing about it.
const PARALLEL: f64 = 0.05;

/// A stretch of a line in or between solids.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stretch {
    axis: Axis,
    solid: bool,
    /// Whether a wall of the box is an end of it.
    at_wall: bool,
    /// Place on the line and ends along it, cells.
    at: [f64; 3],
    ends: [f64; 2],
}

impl Stretch {
    fn width(&self) -> f64 {
        self.ends[1] - self.ends[0]
    }

    /// Cells whose centres it holds.
    fn cells(&self) -> f64 {
        (self.ends[1] - 0.5).ceil() - (self.ends[0] - 0.5).ceil()
    }

    fn mismatch(&self) -> f64 {
        (self.cells() - self.width()).abs() / self.width()
    }
}

/// The gap and the bar whose width differs most from that of their cells.
pub(super) fn warnings(scene: &Scene, cells: &Cells) -> Vec<Warning> {
    if scene.solids.is_empty() {
        return Vec::new();
    }
    let dx = scene.domain.spacing_m;
    let inside = |p: [f64; 3]| {
        let point = p.map(|x| x * dx);
        scene.solids.iter().any(|solid| solid.shape.contains(point) != solid.invert)
    };
    let budget = BUDGET / scene.solids.iter().map(|solid| solid.shape.weight()).sum::<usize>().max(1);
    let faces = scene.domain.boundaries.by_axis();
    let walls = faces.map(|pair| pair.map(|face| !matches!(face, Boundary::Periodic | Boundary::Open)));
    let all = Axis::ALL.into_iter().flat_map(|axis| along(axis, cells, budget, walls[axis.index()], &inside));
    let found: Vec<Stretch> = all.collect();
    let worst = |solid: bool| {
        let these = found.iter().filter(|stretch| stretch.solid == solid);
        these.max_by(|a, b| a.mismatch().total_cmp(&b.mismatch()))
    };
    let warning = |stretch: &Stretch| Warning::OtherWidth {
        what: match (stretch.solid, stretch.at_wall) {
            (true, _) => "a solid between gaps",
            (false, false) => "a gap between solids",
            (false, true) => "a gap between a solid and a wall",
        },
        axis: stretch.axis.letter(),
        at_m: stretch.at.map(|x| x * dx),
        drawn_m: stretch.width() * dx,
        cells: stretch.cells(),
        cells_m: stretch.cells() * dx,
    };
    [false, true].into_iter().filter_map(worst).map(warning).collect()
}

/// Mismatches along the lines of one axis; `walls`: at which of its faces a wall or a mirror ends a gap.
fn along(
    axis: Axis,
    cells: &Cells,
    budget: usize,
    walls: [bool; 2],
    inside: &dyn Fn([f64; 3]) -> bool,
) -> Vec<Stretch> {
    let (a, [b, c]) = (axis.index(), axis.others());
    let n = cells.extents;
    if n[a] == 1 {
        return Vec::new();
    }
    let lines = n[b] * n[c];
    // An odd step, so that lines do not keep to one side of a regular pattern.
    let every = (lines * n[a] * POINTS / budget.max(1)) | 1;
    let mut found = Vec::new();
    for line in (0..lines).step_by(every) {
        let mut at = [0.0; 3];
        (at[b], at[c]) = ((line % n[b]) as f64 + 0.5, (line / n[b]) as f64 + 0.5);
        let wrong = stretches(axis, at, n[a], walls, inside).into_iter();
        let wrong = wrong.filter(|s| s.width() < NARROW && s.mismatch() > MISMATCH);
        found.extend(wrong.filter(|stretch| is_plane(stretch, [b, c], n, walls, inside)));
    }
    found
}

/// Stretches of a line that end within the box, or where a gap does at a wall of it.
fn stretches(
    axis: Axis,
    at: [f64; 3],
    n: usize,
    walls: [bool; 2],
    inside: &dyn Fn([f64; 3]) -> bool,
) -> Vec<Stretch> {
    let a = axis.index();
    let place = |x: f64| {
        let mut p = at;
        p[a] = x;
        p
    };
    let of = |i: usize| (i as f64 + 0.5) / POINTS as f64;
    let (mut out, mut state, mut start) = (Vec::new(), inside(place(of(0))), None);
    let mut from_wall = walls[0] && !state;
    if from_wall {
        start = Some(0.0);
    }
    for i in 1..n * POINTS {
        if inside(place(of(i))) == state {
            continue;
        }
        let (mut low, mut high) = (of(i - 1), of(i));
        // To 1e-7 of a cell.
        for _ in 0..20 {
            let middle = 0.5 * (low + high);
            if inside(place(middle)) == state { low = middle } else { high = middle }
        }
        let end = 0.5 * (low + high);
        if let Some(start) = start {
            let at = place(0.5 * (start + end));
            out.push(Stretch { axis, solid: state, at_wall: from_wall, at, ends: [start, end] });
        }
        from_wall = false;
        (state, start) = (!state, Some(end));
    }
    if let Some(start) = start.filter(|_| walls[1] && !state) {
        let ends = [start, n as f64];
        let at = place(0.5 * (ends[0] + ends[1]));
        out.push(Stretch { axis, solid: false, at_wall: true, at, ends });
    }
    out
}

/// Whether both ends stay where they are on the lines beside it, half a cell away along both other axes.
fn is_plane(
    stretch: &Stretch,
    others: [usize; 2],
    n: [usize; 3],
    walls: [bool; 2],
    inside: &dyn Fn([f64; 3]) -> bool,
) -> bool {
    let a = stretch.axis.index();
    let beside = |axis: usize, by: f64| {
        let mut at = stretch.at;
        at[axis] += by;
        let lines = stretches(stretch.axis, at, n[a], walls, inside);
        let near = |x: f64, y: f64| (x - y).abs() < PARALLEL;
        lines.iter().any(|s| near(s.ends[0], stretch.ends[0]) && near(s.ends[1], stretch.ends[1]))
    };
    others
        .into_iter()
        .filter(|&axis| n[axis] > 1)
        .all(|axis| [-0.5, 0.5].into_iter().any(|by| beside(axis, by)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const N: [usize; 3] = [40, 10, 1];

    fn found(inside: impl Fn([f64; 3]) -> bool) -> Vec<(bool, f64, f64)> {
        within([false; 2], inside)
    }

    fn within(walls: [bool; 2], inside: impl Fn([f64; 3]) -> bool) -> Vec<(bool, f64, f64)> {
        let cells = Cells { extents: N, ..Cells::default() };
        let all = Axis::ALL
            .into_iter()
            .flat_map(|axis| along(axis, &cells, BUDGET, walls, &inside))
            .collect::<Vec<_>>();
        let mut out: Vec<_> =
            all.iter().map(|s| (s.solid, (1e4 * s.width()).round() / 1e4, s.cells())).collect();
        out.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
        out.dedup();
        out
    }

    /// Bars of 1.2 cells and slits of 0.8 that become one cell each.
    #[test]
    fn exact_bars_and_slits() {
        let rack = |p: [f64; 3]| (20.0..21.0).contains(&p[0]) && (p[1] / 2.0).fract() < 0.6;
        assert_eq!(found(rack), [(false, 0.8, 1.0), (true, 1.2, 1.0)]);
        // A slit that no centre of a cell lies in.
        let closed = |p: [f64; 3]| !(5.6..5.9).contains(&p[0]);
        assert_eq!(found(closed), [(false, 0.3, 0.0)]);
    }

    /// A gate 1.4 cells above the floor, one that the cells shut, and a sheet of a fiftieth of a cell that becomes a cell.
    #[test]
    fn exact_gates_and_sheets() {
        let gate = |above: f64| move |p: [f64; 3]| (20.0..22.0).contains(&p[0]) && p[1] > above;
        assert_eq!(within([true; 2], gate(1.4)), [(false, 1.4, 1.0)]);
        assert_eq!(within([true; 2], gate(0.4)), [(false, 0.4, 0.0)]);
        assert!(within([true; 2], gate(2.0)).is_empty() && found(gate(1.4)).is_empty());
        let lid = |p: [f64; 3]| (20.0..22.0).contains(&p[0]) && p[1] < 8.3;
        assert_eq!(within([true; 2], lid), [(false, 1.7, 2.0)]);
        assert_eq!(found(|p| (p[0] - 20.5).abs() < 0.01), [(true, 0.02, 1.0)]);
    }

    #[test]
    fn limit_round_and_wide_and_exact_solids_are_left_alone() {
        assert!(found(|p| libm::hypot(p[0] - 20.3, p[1] - 5.1) < 3.3).is_empty(), "a cylinder");
        assert!(found(|p| p[0] + 0.7 * p[1] > 20.0 && p[0] + 0.7 * p[1] < 22.3).is_empty(), "an oblique bar");
        assert!(found(|p| (3.0..5.0).contains(&p[0])).is_empty(), "two whole cells");
        assert!(found(|p| (3.2..9.9).contains(&p[0])).is_empty(), "wide");
    }
}
