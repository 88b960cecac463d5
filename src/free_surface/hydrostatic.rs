//! Densities that balance the weight of a fluid at rest.

use super::Kind;
use super::columns::Columns;
pub(crate) use super::columns::axis_of;
use super::confined::{Confined, Stretch};

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
