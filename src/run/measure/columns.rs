//! The fluid seen as columns normal to the bed: bed, depth, surface, mean velocity.

use crate::free_surface::Kind;
use crate::geometry::Axis;
use crate::setup::Setup;
use crate::solver::run::Fields;
use crate::units::Units;

/// Which way columns stand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::run) struct Upright {
    /// The axis of the columns.
    pub up: Axis,
    /// Whether they stand on the low end of it.
    pub down_is_low: bool,
}

/// One column, m and m/s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::run) struct Column {
    /// Top of the highest solid below the lowest fluid; without fluid, of the solids at the bottom.
    pub bed: f64,
    /// Height of the fluid, all gaps closed.
    pub depth: f64,
    /// Mean velocity of the fluid, 0 without any.
    pub velocity: [f64; 3],
}

impl Upright {
    /// The two axes across the columns, in alphabetical order.
    pub(crate) fn across(self) -> [usize; 2] {
        self.up.others()
    }

    /// All columns, the first of [`Self::across`] fastest. Only fluid above `above_m` counts; within a cell it
    /// is taken to lie at the bottom.
    pub(crate) fn columns(
        self,
        setup: &Setup,
        fields: &Fields,
        units: &Units,
        above_m: Option<f64>,
    ) -> Vec<Column> {
        let [a, b] = self.across();
        let mut columns = Vec::with_capacity(setup.extents[a] * setup.extents[b]);
        for ib in 0..setup.extents[b] {
            for ia in 0..setup.extents[a] {
                let mut cell = [0; 3];
                (cell[a], cell[b]) = (ia, ib);
                columns.push(self.column(setup, fields, units, above_m, cell));
            }
        }
        columns
    }

    /// The column through a cell; what grains cover below fluid counts as depth.
    pub(crate) fn column(
        self,
        setup: &Setup,
        fields: &Fields,
        units: &Units,
        above_m: Option<f64>,
        mut cell: [usize; 3],
    ) -> Column {
        let n = setup.extents[self.up.index()];
        let cut = above_m.map_or(0.0, |above| {
            let above = units.length_to_lattice(above);
            if self.down_is_low { above } else { n as f64 - above }
        });
        let (mut bed, mut wet, mut depth, mut flux) = (0, false, 0.0, [0.0; 3]);
        // Solids at the bottom, until the first cell that is none; later ones only below fluid.
        let mut footing = true;
        // Fluid, and cells that grains cover since the last of it.
        let (mut moving, mut covered) = (0.0, 0.0);
        for k in 0..n {
            cell[self.up.index()] = if self.down_is_low { k } else { n - 1 - k };
            let index = setup.index(cell);
            if setup.is_solid(index) {
                if !wet {
                    bed = if footing { k + 1 } else { bed };
                }
                continue;
            }
            footing = false;
            let counted = |fill: f64| (fill - (cut - k as f64).clamp(0.0, 1.0)).clamp(0.0, 1.0);
            if !fields.is_fluid(index, false) {
                let is_grain = fields.kind.get(index) == Some(&(Kind::Solid as u8));
                covered += if is_grain { counted(1.0) } else { 0.0 };
                continue;
            }
            let fill = fields.fill.get(index).copied().unwrap_or(1.0).clamp(0.0, 1.0);
            if !wet && fill > 0.0 {
                wet = true;
                bed = (0..k).rev().find(|&below| is_solid_at(self, setup, cell, below)).map_or(0, |s| s + 1);
            }
            let counted = counted(fill);
            depth += counted + covered;
            moving += counted;
            covered = 0.0;
            for c in 0..3 {
                flux[c] += counted * fields.velocity[index][c];
            }
        }
        let height = |cells: usize| units.length_to_si(cells as f64);
        let bed = if self.down_is_low { height(bed) } else { height(n) - height(bed) };
        let mean = if moving > 0.0 { flux.map(|f| f / moving) } else { [0.0; 3] };
        Column { bed, depth: units.length_to_si(depth), velocity: units.velocities_to_si(mean) }
    }

    /// Height of the surface of a column, m: at least `above_m`.
    pub(crate) fn surface(self, column: &Column, above_m: Option<f64>) -> f64 {
        let base = match above_m {
            Some(above) if (above > column.bed) == self.down_is_low => above,
            _ => column.bed,
        };
        if self.down_is_low { base + column.depth } else { base - column.depth }
    }
}

fn is_solid_at(upright: Upright, setup: &Setup, mut cell: [usize; 3], k: usize) -> bool {
    let n = setup.extents[upright.up.index()];
    cell[upright.up.index()] = if upright.down_is_low { k } else { n - 1 - k };
    setup.is_solid(setup.index(cell))
}

/// Farthest position at which a depth per layer exceeds the threshold, interpolated to the next layer;
/// `start` when none does.
///
/// # Arguments
/// `depths`: m, one per layer of cells of size `dx`, m. Layers whose middle lies before `start` do not count.
pub(super) fn front(depths: &[f64], dx: f64, threshold: f64, start: f64) -> f64 {
    let middle = |i: usize| (i as f64 + 0.5) * dx;
    let last = (0..depths.len()).rev().find(|&i| depths[i] > threshold && middle(i) >= start);
    let Some(last) = last else { return start };
    match depths.get(last + 1) {
        Some(next) => middle(last) + dx * (depths[last] - threshold) / (depths[last] - next),
        None => middle(last) + 0.5 * dx,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rheology::Law;

    #[test]
    fn exact_front_between_columns() {
        assert_eq!(front(&[5.0, 4.0, 2.0, 0.0], 2.0, 1.0, 0.0), 6.0);
        assert_eq!(front(&[5.0, 4.0, 2.0, 0.0], 2.0, 3.0, 0.0), 4.0);
        assert_eq!(front(&[5.0, 4.0], 2.0, 3.0, 0.0), 4.0);
        assert_eq!(front(&[5.0, 0.0], 2.0, 6.0, 1.5), 1.5);
        assert_eq!(front(&[5.0, 0.0, 0.0], 2.0, 1.0, 1.5), 1.5);
    }

    #[test]
    fn exact_depth_above_a_bed_and_above_a_height() {
        // One column: solid, full, half, air; the same upside down.
        let mut setup = Setup::periodic([1, 1, 4], Law::Newtonian { mu: 0.1 });
        setup.solids = vec![1, 0, 0, 0];
        let units = Units::new(0.5, 1.0, 1.0);
        let fields = |order: [usize; 4]| Fields {
            fill: order.map(|i| [0.0, 1.0, 0.5, 0.0][i]).to_vec(),
            kind: order.map(|i| [3, 2, 1, 0][i]).to_vec(),
            velocity: order.map(|i| [[0.0; 3], [1.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0; 3]][i]).to_vec(),
            ..Fields::default()
        };
        let upright = Upright { up: Axis::Z, down_is_low: true };
        let column = |above| upright.columns(&setup, &fields([0, 1, 2, 3]), &units, above)[0];
        assert_eq!(column(None), Column { bed: 0.5, depth: 0.75, velocity: [1.0, 0.0, 0.0] });
        assert_eq!(upright.surface(&column(None), None), 1.25);
        // From 0.75 m: half of the full cell and the half cell.
        assert_eq!(column(Some(0.75)).depth, 0.5);
        assert_eq!(upright.surface(&column(Some(0.75)), Some(0.75)), 1.25);
        let mut setup = setup.clone();
        setup.solids.reverse();
        let upright = Upright { up: Axis::Z, down_is_low: false };
        let column = upright.columns(&setup, &fields([3, 2, 1, 0]), &units, None)[0];
        assert_eq!((column.bed, column.depth), (1.5, 0.75));
        assert_eq!(upright.surface(&column, None), 0.75);
    }
}
