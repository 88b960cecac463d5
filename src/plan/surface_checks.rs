//! What can be wrong with the fluid at time 0 and the solids around it.

use super::cells::Cells;
use super::error::PlanProblem;
use super::facts::Facts;
use super::film_error::LEAST_DEPTH;
use super::surface::{Ground, level_shape};
use crate::geometry::{Axis, Shape};
use crate::lattice::C;
use crate::scene::{Boundary, FACE_KEYS, Scene};

type Found = Result<(), (String, PlanProblem)>;

/// Every part of the fluid fills something, some room is left, and nothing touches an open face.
pub(super) fn surface(facts: &Facts, cells: &Cells) -> Found {
    let scene = facts.scene;
    let Some(initial) = &scene.fluid.initial else { return Ok(()) };
    let dx = scene.domain.spacing_m;
    let level = initial.fill_level.as_ref().map(|level| level_shape(facts, level));
    let level = level.iter().map(|shape| ("fluid.initial.fill_level".to_owned(), "fill_level", shape));
    let parts = initial.shapes.iter().enumerate().map(|(i, part)| {
        let path = format!("fluid.initial.shapes[{i}].shape");
        (path, part.name.as_deref().unwrap_or("this shape"), &part.shape)
    });
    for (path, name, shape) in level.chain(parts) {
        let name = name.to_owned();
        let ground = Ground::of(facts, cells.extents, &cells.solids);
        if !ground.bare().any_filled(shape) {
            return Err((path, PlanProblem::NoCellFilled { name, spacing: dx }));
        }
        if !cells.solids.is_empty() && !ground.any_filled(shape) {
            return Err((
                path,
                PlanProblem::FluidInsideSolids { name, solids: around(scene, &ground, shape) },
            ));
        }
    }
    deep_enough(cells, dx)?;
    room(cells, facts)?;
    open_faces(cells, facts)
}

fn deep_enough(cells: &Cells, spacing: f64) -> Found {
    match &cells.pool {
        Some(pool) if pool.depth < LEAST_DEPTH * spacing => {
            let problem = PlanProblem::NoDepth { depth: pool.depth, spacing, least: LEAST_DEPTH };
            Err(("fluid.initial".to_owned(), problem))
        }
        _ => Ok(()),
    }
}

/// Names of the solids that hold the cells of a shape.
fn around(scene: &Scene, ground: &Ground, shape: &Shape) -> String {
    let inside = ground.bare().draw(&[shape]).fill;
    let cells = inside.iter().zip(ground.solids).filter(|(fill, _)| **fill > 0.0);
    let mut numbers: Vec<u8> = cells.map(|(_, &s)| s).collect();
    numbers.sort_unstable();
    numbers.dedup();
    let name = |s: &u8| scene.solids.get(usize::from(*s) - 1).map(|solid| format!("`{}`", solid.name));
    numbers.iter().filter(|s| **s != 0).filter_map(name).collect::<Vec<_>>().join(", ")
}

/// Fluid that fills everything it can reach has no free surface.
fn room(cells: &Cells, facts: &Facts) -> Found {
    let [nx, ny, nz] = cells.extents;
    let solid = |cell: usize| cells.solids.get(cell).is_some_and(|&s| s != 0);
    let mut seen = vec![false; cells.fill.len()];
    let mut edge: Vec<usize> = (0..seen.len()).filter(|&cell| cells.fill[cell] > 0.0).collect();
    edge.iter().for_each(|&cell| seen[cell] = true);
    let fluid = edge.len() as u64;
    let periodic = facts.closed.map(|closed| !closed);
    while let Some(cell) = edge.pop() {
        if cells.fill[cell] < 1.0 {
            return Ok(());
        }
        let at = [cell % nx, cell / nx % ny, cell / (nx * ny)];
        for c in &C[1..] {
            let Some(next) = step(at, c, cells.extents, periodic) else { continue };
            let next = next[0] + nx * (next[1] + ny * next[2]);
            if !seen[next] && !solid(next) {
                seen[next] = true;
                edge.push(next);
            }
        }
    }
    let solids = cells.solids.iter().filter(|&&s| s != 0).count() as u64;
    let cells = (nx * ny * nz) as u64;
    Err(("fluid.initial".to_owned(), PlanProblem::NoRoom { fluid, solids, cells }))
}

/// The cell one link away; `None` beyond a face that is not periodic.
fn step(at: [usize; 3], c: &[i32; 3], extents: [usize; 3], periodic: [bool; 3]) -> Option<[usize; 3]> {
    let mut next = at;
    for a in 0..3 {
        let n = extents[a];
        let to = at[a] as i64 + i64::from(c[a]);
        next[a] = match usize::try_from(to) {
            Ok(to) if to < n => to,
            _ if !periodic[a] => return None,
            _ if to < 0 => n - 1,
            _ => 0,
        };
    }
    Some(next)
}

fn open_faces(cells: &Cells, facts: &Facts) -> Found {
    let [nx, ny, _] = cells.extents;
    for (axis, faces) in Axis::ALL.into_iter().zip(facts.faces) {
        let a = axis.index();
        for (side, face) in faces.iter().enumerate() {
            if *face != Boundary::Open {
                continue;
            }
            let layer = if side == 0 { 0 } else { cells.extents[a] - 1 };
            let touching: Vec<[usize; 3]> = (0..cells.fill.len())
                .filter(|&cell| cells.fill[cell] > 0.0)
                .map(|cell| [cell % nx, cell / nx % ny, cell / (nx * ny)])
                .filter(|at| at[a] == layer)
                .collect();
            if let Some(first) = touching.first() {
                let at_m = first.map(|i| (i as f64 + 0.5) * facts.scene.domain.spacing_m);
                let key = FACE_KEYS[a][side];
                let problem = PlanProblem::OpenUnderFluid { face: key, cells: touching.len() as u64, at_m };
                return Err((format!("domain.boundaries.{key}"), problem));
            }
        }
    }
    Ok(())
}

/// Every part taken away from a shape takes at least one cell centre.
pub(super) fn recesses(scene: &Scene) -> Found {
    let extents = super::cells::extents(&scene.domain);
    let dx = scene.domain.spacing_m;
    for (i, solid) in scene.solids.iter().enumerate() {
        recess(&solid.shape, &format!("solids[{i}].shape"), extents, dx)?;
    }
    for (i, part) in scene.fluid.initial.iter().flat_map(|initial| &initial.shapes).enumerate() {
        recess(&part.shape, &format!("fluid.initial.shapes[{i}].shape"), extents, dx)?;
    }
    Ok(())
}

fn recess(shape: &Shape, path: &str, extents: [usize; 3], dx: f64) -> Found {
    match shape {
        Shape::Union(parts) | Shape::Intersection(parts) => {
            let key = if matches!(shape, Shape::Union(_)) { "union" } else { "intersection" };
            for (i, part) in parts.iter().enumerate() {
                recess(part, &format!("{path}.{key}[{i}]"), extents, dx)?;
            }
            Ok(())
        }
        Shape::Difference { from, minus } => {
            for (i, part) in minus.iter().enumerate() {
                if !overlap(from, part, extents, dx) {
                    let path = format!("{path}.difference.minus[{i}]");
                    return Err((path, PlanProblem::NothingRemoved { spacing: dx }));
                }
            }
            recess(from, &format!("{path}.difference.from"), extents, dx)
        }
        _ => Ok(()),
    }
}

/// Whether a cell centre of the box is inside both.
fn overlap(one: &Shape, other: &Shape, [nx, ny, nz]: [usize; 3], dx: f64) -> bool {
    let centre = |i: usize| (i as f64 + 0.5) * dx;
    let inside = |i, j, k| {
        let point = [centre(i), centre(j), centre(k)];
        other.contains(point) && one.contains(point)
    };
    (0..nz).any(|k| (0..ny).any(|j| (0..nx).any(|i| inside(i, j, k))))
}
