//! Densities that balance the weight of a fluid at rest.

use super::Kind;
use super::columns::Columns;
pub(crate) use super::columns::axis_of;
use super::confined::{Confined, Stretch};

/// Lowers the surface, column by column, until the mass of the fluid at rest is that of what was drawn at the
/// reference density.
///
/// A column of depth h whose pressure balances its weight holds the mass h + (3/2) f h²: with the surface as
/// drawn it is too heavy, and the thin flow that it becomes has 3fh/2 too much volume. The depth
/// h′ = (√(1 + 6fh) − 1)/(3f) has the mass h. Fluid that reaches up to a solid or the end of the box has no
/// room to settle and stays as it is.
///
/// # Arguments
/// `extents`: cells along x, y, z. `fill`: φ as drawn, 0 to 1. `is_solid(cell)`. `force`: F, lattice units.
/// # Returns
/// φ of every cell; columns are those along the largest component of the force.
/// # Source
/// `density_excess` integrated over the depth.
/// # Verified by
/// Test `exact_mass_of_settled_columns`; exhibit `thesis-time-step`.
#[must_use]
pub fn settle(
    extents: [usize; 3],
    fill: &[f64],
    is_solid: impl Fn(usize) -> bool,
    force: &[f64; 3],
) -> Vec<f64> {
    let mut settled = fill.to_vec();
    let axis = axis_of(force);
    let weight = force[axis].abs();
    if weight == 0.0 {
        return settled;
    }
    let is_fluid = |cell: usize| !is_solid(cell) && fill[cell] > 0.0;
    Columns::of(extents, [false; 3], force).for_each(|column| {
        let mut k = 0;
        while k < column.len() {
            let run = column[k..].iter().take_while(|&&cell| is_fluid(cell)).count();
            let below_gas = k > 0 && !is_solid(column[k - 1]);
            if run > 0 && below_gas {
                lower(&mut settled, &column[k..k + run], weight);
            }
            k += run.max(1);
        }
    });
    settled
}

/// Takes from the top of a column what its weight compresses it by.
fn lower(fill: &mut [f64], column: &[usize], weight: f64) {
    let depth: f64 = column.iter().map(|&cell| fill[cell]).sum();
    let settled = ((1.0 + 6.0 * weight * depth).sqrt() - 1.0) / (3.0 * weight);
    let mut excess = depth - settled;
    for &cell in column {
        let taken = if excess < fill[cell] { excess } else { fill[cell] };
        fill[cell] -= taken;
        excess -= taken;
    }
}

/// ρ − 1 of every cell so that the pressure along the axis of the largest force component balances it,
/// column by column, in the scheme's own discrete sense: zero gas pressure (ρ = 1) at height φ of the
/// topmost cell, ρ′ − ρ = 3·½(φF + φ′F′) between neighbours. Fluid below a solid or the end of the box has the pressure
/// of the nearest fluid beside it whose surface is open; without a way to any, none at its top. With a level surface
/// this is exact rest, whatever solids are in the fluid.
///
/// # Arguments
/// `extents`: cells along x, y, z. `periodic`: axes whose two faces are one. `kinds`, `fill`: per cell. `force`: F,
/// lattice units.
/// # Returns
/// ρ − 1 per cell; 0 in gas and solids, and everywhere when the force is zero.
/// # Source
/// docs/method.md \[F3\]; stationary solution of collision and streaming with f = w(ρ − (3/2) c·F).
/// # Verified by
/// Claim `pool-at-rest`; tests `rest_below_solids`, `lift_of_a_submerged_block`.
#[must_use]
pub(crate) fn density_excess(
    extents: [usize; 3],
    periodic: [bool; 3],
    kinds: &[Kind],
    fill: &[f64],
    force: &[f64; 3],
) -> Vec<f64> {
    let mut excess = vec![0.0; kinds.len()];
    let columns = Columns::of(extents, periodic, force);
    let weight = force[columns.axis].abs();
    if weight == 0.0 {
        return excess;
    }
    let own = |cell: usize| if kinds[cell] == Kind::Liquid { 1.0 } else { fill[cell] };
    let mut stretches = Vec::new();
    columns.for_each(|column| {
        let mut k = 0;
        while k < column.len() {
            let cells = column[k..].iter().take_while(|&&cell| kinds[cell].is_fluid()).count();
            if cells > 0 {
                hang(&column[k..k + cells], own, weight, &mut excess);
                // A partly filled cell has its surface in itself.
                let is_confined = own(column[k]) >= 1.0
                    && columns.above(column[k]).is_none_or(|above| kinds[above] == Kind::Solid);
                if is_confined {
                    stretches.push(Stretch { top: column[k], cells });
                }
            }
            k += cells.max(1);
        }
    });
    if !stretches.is_empty() {
        let fill: Vec<f64> = (0..kinds.len()).map(own).collect();
        Confined::new(columns, kinds, &fill, weight, &stretches).connect(&mut excess);
    }
    excess
}

/// The pressure of a stretch of fluid with none at its top.
fn hang(stretch: &[usize], own: impl Fn(usize) -> f64, weight: f64, excess: &mut [f64]) {
    let (mut above, mut rho) = (None, 0.0);
    for &cell in stretch {
        let own = own(cell);
        rho = match above {
            None => 1.5 * own * weight,
            Some(upper) => rho + 1.5 * ((upper + own) * weight),
        };
        excess[cell] = rho;
        above = Some(own);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let settled = settle(extents, &fill, is_solid, &force);
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
        assert_eq!(settle(extents, &fill, is_solid, &[0.0; 3]), fill);
    }
}
