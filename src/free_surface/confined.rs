//! Pressure at rest of fluid below solids: that of the fluid beside it whose surface is open.
//!
//! *Confined*, as in groundwater: bounded above by a solid or the end of the box.

use super::Kind;
use super::columns::Columns;

/// A stretch of fluid cells in a column that begins below a solid or the end of the box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub top: usize,
    pub cells: usize,
}

/// Number of a cell that is in no confined stretch.
const FREE: u32 = u32::MAX;

/// Rows that links lead to in the columns beside, by how well they tell the pressure.
const ROWS: [&[i64]; 2] = [&[0], &[-1, 1]];

/// Fluid at rest, with its confined stretches.
pub(super) struct Confined<'a> {
    columns: Columns,
    kinds: &'a [Kind],
    /// φ of fluid cells.
    fill: &'a [f64],
    /// Of the force along the columns.
    weight: f64,
    stretches: &'a [Stretch],
    /// By cell: its stretch, or [`FREE`].
    number: Vec<u32>,
}

impl<'a> Confined<'a> {
    /// `fill`: that of all fluid cells, 1 in liquid.
    pub fn new(
        columns: Columns,
        kinds: &'a [Kind],
        fill: &'a [f64],
        weight: f64,
        stretches: &'a [Stretch],
    ) -> Self {
        let mut number = vec![FREE; kinds.len()];
        for (i, stretch) in stretches.iter().enumerate() {
            for k in 0..stretch.cells {
                number[columns.below(stretch.top, k)] = i as u32;
            }
        }
        Self { columns, kinds, fill, weight, stretches, number }
    }

    /// Gives every confined stretch the pressure of the fluid beside it, from the open surfaces inwards, each stretch from
    /// the nearest; those without a way to a surface keep theirs.
    ///
    /// `excess`: ρ − 1 per cell, that of confined stretches as if there were no pressure at their tops.
    ///
    /// Stretches that are as many columns away from an open surface get theirs at once, from the highest row in which
    /// they touch fluid whose pressure is known, as the middle of the extremes there: nothing depends on their order.
    /// In a stretch whose confined fluid touches gas somewhere, what would be suction at its top stays none.
    pub fn connect(&self, excess: &mut [f64]) {
        let vented = self.vented();
        let mut known = vec![false; self.stretches.len()];
        let mut next: Vec<usize> = (0..self.stretches.len()).collect();
        while !next.is_empty() {
            let meets = |&i: &usize| self.meet(i, &known, excess).map(|(k, rho)| (i, k, rho));
            let found: Vec<(usize, usize, f64)> = next.iter().filter_map(meets).collect();
            for &(i, k, rho) in &found {
                known[i] = true;
                self.set(i, k, rho, vented[i], excess);
            }
            next = found.iter().flat_map(|&(i, ..)| self.touching(i)).filter(|&i| !known[i]).collect();
            next.sort_unstable();
            next.dedup();
        }
    }

    /// The cells of a stretch, from the top down.
    fn cells(&self, i: usize) -> impl Iterator<Item = usize> + '_ {
        let Stretch { top, cells } = self.stretches[i];
        (0..cells).map(move |k| self.columns.below(top, k))
    }

    /// The confined stretches that links lead to from one.
    fn touching(&self, i: usize) -> impl Iterator<Item = usize> + '_ {
        let beside = move |cell| (-1..=1).flat_map(move |down| self.columns.beside(cell, down));
        let numbers = self.cells(i).flat_map(beside).map(|cell| self.number[cell]);
        numbers.filter(move |&n| n != FREE && n as usize != i).map(|n| n as usize)
    }

    /// Whether the confined fluid of each stretch touches gas somewhere.
    fn vented(&self) -> Vec<bool> {
        let surface = |i: usize| self.cells(i).any(|cell| self.kinds[cell] == Kind::Interface);
        let mut vented: Vec<bool> = (0..self.stretches.len()).map(surface).collect();
        let mut edge: Vec<usize> = (0..vented.len()).filter(|&i| vented[i]).collect();
        while let Some(i) = edge.pop() {
            for other in self.touching(i) {
                if !vented[other] {
                    vented[other] = true;
                    edge.push(other);
                }
            }
        }
        vented
    }

    /// Where a stretch first touches fluid of known pressure, counted from its top, and ρ − 1 there.
    fn meet(&self, i: usize, known: &[bool], excess: &[f64]) -> Option<(usize, f64)> {
        let is_known = |cell: usize| match self.number[cell] {
            FREE => self.kinds[cell].is_fluid(),
            n => known[n as usize],
        };
        // Partly filled neighbours are the last that are asked: their pressure is that at their surface.
        let asked = ROWS.map(|rows| (rows, true)).into_iter().chain([(ROWS[0], false)]);
        for (rows, full) in asked {
            let tells = |cell: &usize| is_known(*cell) && (self.fill[*cell] >= 1.0) == full;
            for (k, cell) in self.cells(i).enumerate().filter(|&(_, cell)| self.fill[cell] >= 1.0) {
                let beside = |&down: &i64| {
                    let cells = self.columns.beside(cell, down).filter(tells);
                    cells.map(move |other| self.seen(other, down, excess))
                };
                if let Some(rho) = middle(rows.iter().flat_map(beside)) {
                    return Some((k, rho));
                }
            }
        }
        None
    }

    /// ρ − 1 of a full cell beside another, from that of the other so many rows below.
    fn seen(&self, other: usize, down: i64, excess: &[f64]) -> f64 {
        match self.fill[other] {
            // The pressure at its centre, below or above its surface.
            fill if fill < 1.0 => 3.0 * ((fill - 0.5) * self.weight),
            _ if down == 0 => excess[other],
            _ => excess[other] - 3.0 * (down as f64 * self.weight),
        }
    }

    /// Gives a stretch the pressure that it has in its k-th cell.
    fn set(&self, i: usize, k: usize, rho: f64, vented: bool, excess: &mut [f64]) {
        let cells: Vec<usize> = self.cells(i).collect();
        let step = |a: usize, b: usize| 1.5 * ((self.fill[cells[a]] + self.fill[cells[b]]) * self.weight);
        let mut found = vec![rho; cells.len()];
        for above in (0..k).rev() {
            found[above] = found[above + 1] - step(above, above + 1);
        }
        for below in k + 1..cells.len() {
            found[below] = found[below - 1] + step(below - 1, below);
        }
        if vented && found[0] < excess[cells[0]] {
            return;
        }
        for (cell, rho) in cells.into_iter().zip(found) {
            excess[cell] = rho;
        }
    }
}

/// Half the sum of the extremes, `None` of nothing.
fn middle(values: impl Iterator<Item = f64>) -> Option<f64> {
    let extremes = values.fold(None, |found: Option<[f64; 2]>, v| {
        let [low, high] = found.unwrap_or([v; 2]);
        Some([if v < low { v } else { low }, if v > high { v } else { high }])
    });
    // Exact where both are equal.
    extremes.map(|[low, high]| low + 0.5 * (high - low))
}
