//! Which cells lie inside a grain \[C1\].

use super::link::{Ball, Box3};
use crate::setup::Setup;

/// Cells with their centre inside some balls.
pub(super) struct Inside {
    /// Ascending.
    pub cells: Vec<u32>,
    /// Least distance of any cell centre from the surface of a ball, cells, at most 1.
    pub clearance: f64,
}

/// Looks at all cells within one of the surface of a ball, or inside it.
pub(super) fn inside(setup: &Setup, shape: &Box3, balls: &[Ball]) -> Inside {
    let mut cells = Vec::new();
    let mut clearance = 1.0_f64;
    for ball in balls {
        let (r2, reach) = (ball.radius * ball.radius, ball.radius + 1.0);
        // | |d| − r | ≥ |d² − r²| / (2r + 1) for all cells looked at.
        let scale = 1.0 / (ball.radius + reach);
        let range = |a: usize| {
            let low = (ball.centre[a] - reach - 0.5).ceil() as i64;
            let high = (ball.centre[a] + reach - 0.5).floor() as i64;
            let n = shape.extents[a] as i64;
            if shape.periodic[a] { (low, high) } else { (low.max(0), high.min(n - 1)) }
        };
        let [x, y, z] = [range(0), range(1), range(2)];
        let fold = |k: i64, a: usize| {
            if shape.periodic[a] { k.rem_euclid(shape.extents[a] as i64) as usize } else { k as usize }
        };
        for k in z.0..=z.1 {
            let dz = k as f64 + 0.5 - ball.centre[2];
            for j in y.0..=y.1 {
                let dy = j as f64 + 0.5 - ball.centre[1];
                let rest = dy * dy + dz * dz;
                // Beyond this no cell is inside, or nearer to the surface than 1.
                let span2 = reach * reach - rest;
                if span2 < 0.0 {
                    continue;
                }
                let span = span2.sqrt();
                let low = ((ball.centre[0] - span - 0.5).ceil() as i64).max(x.0);
                let high = ((ball.centre[0] + span - 0.5).floor() as i64).min(x.1);
                let row = setup.index([0, fold(j, 1), fold(k, 2)]);
                for i in low..=high {
                    let dx = i as f64 + 0.5 - ball.centre[0];
                    let beyond = (dx * dx + rest) - r2;
                    let gap = beyond.abs() * scale;
                    if gap < clearance {
                        clearance = gap;
                    }
                    if beyond < 0.0 {
                        let cell = row + fold(i, 0);
                        if !setup.is_solid(cell) {
                            cells.push(cell as u32);
                        }
                    }
                }
            }
        }
    }
    cells.sort_unstable();
    cells.dedup();
    Inside { cells, clearance }
}
