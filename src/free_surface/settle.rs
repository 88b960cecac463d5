//! Fluid at rest that has the mass that was drawn.

use super::columns::Columns;

/// Levels closer to each other than this, cells, are one: rounding of the fill.
const SAME_LEVEL: f64 = 1e-9;

/// Steps of Newton's method; it doubles the digits in each.
const STEPS: usize = 20;

/// A stretch of fluid cells in a column.
struct Stretch {
    /// From the top down.
    cells: Vec<usize>,
    /// Σ φ.
    depth: f64,
    /// Height of its upper end above that of the box at which the force points.
    level: f64,
    /// Whether gas is above it; otherwise a solid or the end of the box.
    is_open: bool,
}

/// Lowers the surface until the mass of the fluid at rest is that of what was drawn at the reference density.
///
/// A column of depth h whose pressure balances its weight holds the mass h + (3/2) f h²: with the surface as
/// drawn it is too heavy, and the thin flow that it becomes has 3fh/2 too much volume. Connected fluid with one level
/// is lowered as a whole, together with what is below solids, and stays level; other fluid is lowered column by column: the depth
/// h′ = (√(1 + 6fh) − 1)/(3f) has the mass h. Columns that reach up to a solid or the end of the box have no room to settle.
///
/// # Arguments
/// `extents`: cells along x, y, z. `periodic`: axes whose two faces are one. `fill`: φ as drawn, 0 to 1.
/// `is_solid(cell)`. `force`: F, lattice units.
/// # Returns
/// φ of every cell; columns are those along the largest component of the force.
/// # Source
/// [`super::hydrostatic`] integrated over the depth.
/// # Verified by
/// Tests `exact_mass_of_settled_columns`, `exact_mass_of_a_settled_pool`; exhibit `thesis-time-step`.
#[must_use]
pub fn settle(
    extents: [usize; 3],
    periodic: [bool; 3],
    fill: &[f64],
    is_solid: impl Fn(usize) -> bool,
    force: &[f64; 3],
) -> Vec<f64> {
    let mut settled = fill.to_vec();
    let columns = Columns::of(extents, periodic, force);
    let weight = force[columns.axis].abs();
    if weight == 0.0 {
        return settled;
    }
    let stretches = stretches(&columns, fill, is_solid);
    for body in bodies(&columns, &stretches, fill.len()) {
        let body: Vec<&Stretch> = body.into_iter().map(|i| &stretches[i]).collect();
        let open = || body.iter().filter(|stretch| stretch.is_open);
        let together = is_level(&body).then(|| drop_of_level(&body, weight));
        for stretch in open() {
            lower(
                &mut settled,
                &stretch.cells,
                together.unwrap_or_else(|| drop_alone(stretch.depth, weight)),
            );
        }
    }
    settled
}

fn stretches(columns: &Columns, fill: &[f64], is_solid: impl Fn(usize) -> bool) -> Vec<Stretch> {
    let is_fluid = |cell: usize| !is_solid(cell) && fill[cell] > 0.0;
    let mut all = Vec::new();
    columns.for_each(|column| {
        let mut k = 0;
        while k < column.len() {
            let count = column[k..].iter().take_while(|&&cell| is_fluid(cell)).count();
            if count > 0 {
                let cells = column[k..k + count].to_vec();
                let depth = cells.iter().map(|&cell| fill[cell]).sum();
                let level = (column.len() - k - 1) as f64 + fill[cells[0]];
                let is_open = k > 0 && !is_solid(column[k - 1]);
                all.push(Stretch { cells, depth, level, is_open });
            }
            k += count.max(1);
        }
    });
    all
}

/// Stretches that links join, each group in order.
fn bodies(columns: &Columns, stretches: &[Stretch], cells: usize) -> Vec<Vec<usize>> {
    let mut number = vec![usize::MAX; cells];
    for (i, stretch) in stretches.iter().enumerate() {
        stretch.cells.iter().for_each(|&cell| number[cell] = i);
    }
    let mut seen = vec![false; stretches.len()];
    let mut all = Vec::new();
    for first in 0..stretches.len() {
        if seen[first] {
            continue;
        }
        seen[first] = true;
        let (mut body, mut next) = (vec![first], 0);
        while let Some(&i) = body.get(next) {
            for &cell in &stretches[i].cells {
                for other in (-1..=1).flat_map(|down| columns.beside(cell, down)).map(|cell| number[cell]) {
                    if other != usize::MAX && !seen[other] {
                        seen[other] = true;
                        body.push(other);
                    }
                }
            }
            next += 1;
        }
        body.sort_unstable();
        all.push(body);
    }
    all
}

/// Whether a body has one level, and columns that do not settle alike by themselves.
fn is_level(body: &[&Stretch]) -> bool {
    let mut open = body.iter().filter(|stretch| stretch.is_open);
    let Some(first) = open.next() else { return false };
    let level = open.all(|stretch| (stretch.level - first.level).abs() < SAME_LEVEL);
    level && body.iter().any(|other| !other.is_open || (other.depth - first.depth).abs() >= SAME_LEVEL)
}

/// By how much the surface of a column goes down.
fn drop_alone(depth: f64, weight: f64) -> f64 {
    depth - ((1.0 + 6.0 * weight * depth).sqrt() - 1.0) / (3.0 * weight)
}

/// By how much the one level of a body goes down: the root of its excess mass,
/// Σ h′ + (3/2) f h′² − h over open columns, h′ = max(h − δ, 0), and Σ 3f (Z − δ − z) over cells below solids.
fn drop_of_level(body: &[&Stretch], weight: f64) -> f64 {
    let level = body.iter().find(|stretch| stretch.is_open).map_or(0.0, |stretch| stretch.level);
    // Newton's method from above the root of a decreasing convex function never passes it.
    let mut drop = 0.0;
    for _ in 0..STEPS {
        let (mut excess, mut slope) = (0.0, 0.0);
        for stretch in body {
            if stretch.is_open {
                let left = if stretch.depth > drop { stretch.depth - drop } else { 0.0 };
                excess += left + 1.5 * weight * left * left - stretch.depth;
                slope += if left > 0.0 { 1.0 + 3.0 * weight * left } else { 0.0 };
            } else {
                let cells = stretch.cells.len() as f64;
                let middle = stretch.level - 0.5 * cells;
                excess += 3.0 * weight * cells * (level - drop - middle);
                slope += 3.0 * weight * cells;
            }
        }
        if slope == 0.0 || excess / slope < f64::EPSILON {
            break;
        }
        drop += excess / slope;
    }
    drop
}

/// Takes from the top of a column.
fn lower(fill: &mut [f64], column: &[usize], drop: f64) {
    let mut excess = drop;
    for &cell in column {
        let taken = if excess < fill[cell] { excess } else { fill[cell] };
        fill[cell] -= taken;
        excess -= taken;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::free_surface::Kind;
    use crate::free_surface::hydrostatic::density_excess;

    #[test]
    fn exact_mass_of_settled_columns() {
        // A column 12.3 cells deep on a floor, one under a lid, and a thin one on a ledge.
        let extents = [3, 1, 16];
        let force = [1e-4, 0.0, -3e-3];
        let is_solid = |cell: usize| cell % 3 == 2 && cell / 3 < 4;
        let depth = |cell: usize| {
            let (x, z) = (cell % 3, (cell / 3) as f64);
            let depth = [12.3, 16.0, 6.5][x] - z;
            if is_solid(cell) { 0.0 } else { depth.clamp(0.0, 1.0) }
        };
        let fill: Vec<f64> = (0..48).map(depth).collect();
        let settled = settle(extents, [false; 3], &fill, is_solid, &force);
        let kinds: Vec<Kind> = (0..48)
            .map(|cell| match settled[cell] {
                _ if is_solid(cell) => Kind::Solid,
                fill if fill <= 0.0 => Kind::Gas,
                fill if fill < 1.0 => Kind::Interface,
                _ => Kind::Liquid,
            })
            .collect();
        let excess = density_excess(extents, [false; 3], &kinds, &settled, &force);
        let mass = |x: usize| -> f64 {
            (0..16).map(|z| x + 3 * z).map(|cell| settled[cell] * (1.0 + excess[cell])).sum()
        };
        let drawn = |x: usize| -> f64 { (0..16).map(|z| fill[x + 3 * z]).sum() };
        // 16 sums of numbers below 1.1.
        for x in [0, 2] {
            assert!((mass(x) - drawn(x)).abs() < 16.0 * 2.0 * 16.0 * f64::EPSILON, "{x}: {}", mass(x));
            assert!(settled.iter().sum::<f64>() < fill.iter().sum());
        }
        assert!((0..16).all(|z| settled[1 + 3 * z] == fill[1 + 3 * z]), "no room under the lid");
        assert_eq!(settle(extents, [false; 3], &fill, is_solid, &[0.0; 3]), fill);
    }

    #[test]
    fn exact_mass_of_a_settled_pool() {
        // On stairs, with a block under water and a culvert to a second basin.
        let (extents, force) = ([8, 1, 16], [0.0, 0.0, -2e-3]);
        let is_solid = |cell: usize| match (cell % 8, cell / 8) {
            (x, z) if x < 3 => z < 3 * x,
            (3 | 4, z) => (3..7).contains(&z),
            (6, z) => z > 2,
            _ => false,
        };
        let fill: Vec<f64> = (0..128)
            .map(|cell| if is_solid(cell) { 0.0 } else { (10.4 - (cell / 8) as f64).clamp(0.0, 1.0) })
            .collect();
        let settled = settle(extents, [false; 3], &fill, is_solid, &force);
        let kind = |cell: usize| match settled[cell] {
            _ if is_solid(cell) => Kind::Solid,
            fill if fill <= 0.0 => Kind::Gas,
            fill if fill < 1.0 => Kind::Interface,
            _ => Kind::Liquid,
        };
        let kinds: Vec<Kind> = (0..128).map(kind).collect();
        let excess = density_excess(extents, [false; 3], &kinds, &settled, &force);
        let mass: f64 = (0..128).map(|cell| settled[cell] * (1.0 + excess[cell])).sum();
        let drawn: f64 = fill.iter().sum();
        // 128 sums of numbers up to 70.
        assert!((mass - drawn).abs() < 128.0 * 70.0 * f64::EPSILON, "{mass} {drawn}");
        let top = |x: usize| settled[x + 8 * 10];
        assert!(top(0) < 0.4 && (0..6).chain([7]).all(|x| (top(x) - top(0)).abs() < 1e-12));
    }
}
