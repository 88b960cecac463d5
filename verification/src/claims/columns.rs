//! Depth of fluid column by column, and where it ends.

use lahar::setup::Setup;
use lahar::solver::run::Fields;

/// Depth along x on the plane y = 0, cells: Σφ over the layers from `bed` up.
pub fn depths(setup: &Setup, fields: &Fields, bed: usize) -> Vec<f64> {
    let [nx, _, nz] = setup.extents;
    (0..nx).map(|i| (bed..nz).map(|k| fields.fill[setup.index([i, 0, k])]).sum()).collect()
}

/// Largest x at which a depth falls through a threshold, cells, linear between columns; 0 if nowhere.
pub fn front(depths: &[f64], threshold: f64) -> f64 {
    let Some(i) = depths.iter().rposition(|&d| d > threshold) else { return 0.0 };
    let next = depths.get(i + 1).copied().unwrap_or(0.0);
    i as f64 + 0.5 + (depths[i] - threshold) / (depths[i] - next)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_front_between_columns() {
        assert_eq!(front(&[5.0, 4.0, 2.0, 0.0], 1.0), 3.0);
        assert_eq!(front(&[5.0, 4.0, 0.0, 0.0], 3.0), 1.75);
        assert_eq!(front(&[1.0, 1.0], 3.0), 0.0);
    }
}
