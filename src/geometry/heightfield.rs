//! Terrain: heights on a regular grid.

use std::sync::OnceLock;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Everything below a surface given by heights on a regular grid in x and y, joined bilinearly. Beyond
/// the grid the outermost heights continue.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Heightfield {
    /// x and y of the first height of the first row, m.
    #[serde(default)]
    pub(crate) origin_m: [f64; 2],
    /// Distance between heights along x and y, m.
    pub(crate) spacing_m: f64,
    /// Heights z, m: one row per y, in each row one height per x; all rows of the same length.
    heights_m: Vec<Vec<f64>>,
    /// Found when it is first asked for, at every cell of a box: it takes all heights.
    #[serde(skip)]
    steepness: Found,
}

/// What follows from the heights, which do not change; two fields are alike whether it was asked for or not.
#[derive(Clone, Debug, Default)]
struct Found(OnceLock<f64>);

impl PartialEq for Found {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Heightfield {
    /// Heights z, m, on a grid: one row per y, in each row one height per x; all rows of the same length. `origin_m` is the
    /// place of the first height of the first row, `spacing_m` the distance between heights, both m.
    #[must_use]
    pub fn new(origin_m: [f64; 2], spacing_m: f64, heights_m: Vec<Vec<f64>>) -> Self {
        Self { origin_m, spacing_m, heights_m, steepness: Found::default() }
    }

    /// The heights, m, row by row.
    #[must_use]
    pub fn heights_m(&self) -> &[Vec<f64>] {
        &self.heights_m
    }

    /// Height at a place, m.
    #[must_use]
    pub(crate) fn height(&self, x: f64, y: f64) -> f64 {
        let rows = self.heights_m.len();
        let columns = self.heights_m.first().map_or(0, Vec::len);
        if rows == 0 || columns == 0 {
            return f64::NEG_INFINITY;
        }
        let (i, s) = place(x - self.origin_m[0], self.spacing_m, columns);
        let (j, t) = place(y - self.origin_m[1], self.spacing_m, rows);
        let at = |i: usize, j: usize| {
            let row = &self.heights_m[j.min(rows - 1)];
            row.get(i.min(columns - 1)).copied().unwrap_or(0.0)
        };
        let low = at(i, j) + s * (at(i + 1, j) - at(i, j));
        let high = at(i, j + 1) + s * (at(i + 1, j + 1) - at(i, j + 1));
        low + t * (high - low)
    }

    /// √(1 + s²) with s a bound of the slope: how much longer a vertical distance is than the distance
    /// to the surface, at most.
    #[must_use]
    pub(crate) fn steepness(&self) -> f64 {
        *self.steepness.0.get_or_init(|| self.steepest())
    }

    fn steepest(&self) -> f64 {
        let mut steps = [0.0_f64; 2];
        for (j, row) in self.heights_m.iter().enumerate() {
            for (i, h) in row.iter().enumerate() {
                let right = row.get(i + 1).map_or(0.0, |r| (r - h).abs());
                let above = self.heights_m.get(j + 1).and_then(|r| r.get(i)).map_or(0.0, |r| (r - h).abs());
                steps = [steps[0].max(right), steps[1].max(above)];
            }
        }
        let slope = steps.map(|step| step / self.spacing_m);
        (1.0 + slope[0] * slope[0] + slope[1] * slope[1]).sqrt()
    }

    /// Least and greatest height, m.
    #[must_use]
    pub(crate) fn range(&self) -> [f64; 2] {
        let all = self.heights_m.iter().flatten();
        all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &h| {
            [if h < low { h } else { low }, if h > high { h } else { high }]
        })
    }
}

/// Grid cell that holds a coordinate, and where in it, 0 to 1.
fn place(x: f64, spacing: f64, count: usize) -> (usize, f64) {
    let at = (x / spacing).clamp(0.0, (count - 1) as f64);
    let i = libm::floor(at);
    (i as usize, at - i)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_bilinear_heights() {
        let heights = vec![vec![0.0, 1.0], vec![2.0, 3.0], vec![2.0, 3.0]];
        let field = Heightfield::new([1.0, 2.0], 2.0, heights);
        assert_eq!(field.height(2.0, 2.0), 0.5);
        assert_eq!(field.height(1.0, 3.0), 1.0);
        assert_eq!(field.height(100.0, 100.0), 3.0);
        assert_eq!(field.height(-5.0, -5.0), 0.0);
        assert_eq!(field.range(), [0.0, 3.0]);
    }
}
