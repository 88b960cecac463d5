//! The pressure around a grain as a linear function of place: for the parts of its surface where a wall or another
//! grain leaves no room for a fluid cell.

use super::L3;
use crate::vector::dot;
use nalgebra::{Matrix4, Vector4};

/// Sums over the fluid cells around a grain.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Samples {
    count: f64,
    /// Σ r and Σ r rᵀ (xx, yy, zz, xy, xz, yz).
    first: L3,
    second: [f64; 6],
    /// Σ (ρ − 1) and Σ r (ρ − 1).
    value: f64,
    moment: L3,
    /// Least and largest ρ − 1.
    range: [f64; 2],
}

/// ρ − 1 ≈ mean + slope · r, r from the grain's centre.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Fit {
    mean: f64,
    slope: L3,
    /// Values it may take.
    range: [f64; 2],
}

/// How far beyond what was found around a grain the pressure may be continued, as a share of its range: a gap lies at
/// most half a cell below the lowest cell beside it, a tenth of the height of a grain of five cells.
const BEYOND: f64 = 0.25;

impl Samples {
    /// Adds a cell at `r` from the centre.
    #[inline]
    pub(crate) fn add(&mut self, r: &L3, excess: f64) {
        self.range = match self.count {
            0.0 => [excess; 2],
            _ => [self.range[0].min(excess), self.range[1].max(excess)],
        };
        self.count += 1.0;
        self.value += excess;
        for a in 0..3 {
            self.first[a] += r[a];
            self.moment[a] += r[a] * excess;
        }
        let products = [r[0] * r[0], r[1] * r[1], r[2] * r[2], r[0] * r[1], r[0] * r[2], r[1] * r[2]];
        for (sum, product) in self.second.iter_mut().zip(products) {
            *sum += product;
        }
    }

    /// Least squares; the mean alone where the cells do not span space; `None` without any.
    ///
    /// # Exactness
    /// A linear pressure (fluid at rest under gravity) is reproduced up to rounding.
    /// # Verified by
    /// Test `exact_linear_pressure`; claim `grain-on-the-bed-weighs-less`.
    #[must_use]
    pub(crate) fn fit(&self) -> Option<Fit> {
        if self.count == 0.0 {
            return None;
        }
        let [x, y, z] = self.first;
        let [xx, yy, zz, xy, xz, yz] = self.second;
        let matrix = Matrix4::new(
            self.count, x, y, z, //
            x, xx, xy, xz, //
            y, xy, yy, yz, //
            z, xz, yz, zz,
        );
        let right = Vector4::new(self.value, self.moment[0], self.moment[1], self.moment[2]);
        let [low, high] = self.range;
        let range = [low - BEYOND * (high - low), high + BEYOND * (high - low)];
        let plain = Fit { mean: self.value / self.count, slope: [0.0; 3], range };
        // Cells on all sides of a surface: each principal spread is a good part of the largest.
        let spread = (xx / self.count).min(yy / self.count).min(zz / self.count);
        if self.count < 8.0 || spread < 0.05 {
            return Some(plain);
        }
        let solved = matrix.cholesky().map(|factors| factors.solve(&right));
        Some(solved.map_or(plain, |s| Fit { mean: s[0], slope: [s[1], s[2], s[3]], range }))
    }
}

impl Fit {
    /// ρ − 1 at `r` from the centre.
    #[inline]
    #[must_use]
    pub(crate) fn at(&self, r: &L3) -> f64 {
        let value = self.mean + dot(self.slope, *r);
        // Not `clamp`: a fluid that has blown up must reach the guard, and not a panic here.
        if value < self.range[0] {
            self.range[0]
        } else if value > self.range[1] {
            self.range[1]
        } else {
            value
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_linear_pressure() {
        let mut samples = Samples::default();
        let truth = |r: &L3| 2e-3 - 3e-4 * r[2] + 1e-4 * r[0];
        for k in 0..40 {
            let t = f64::from(k);
            let r = [libm::cos(t) * 4.0, libm::sin(1.7 * t) * 4.0, libm::cos(0.6 * t + 1.0) * 4.0];
            samples.add(&r, truth(&r));
        }
        let fit = samples.fit().unwrap_or_default();
        for r in [[0.0, 0.0, -5.0], [3.0, -2.0, 1.0]] {
            // A few dozen roundings of sums below 1, amplified by a condition of about 10.
            assert!((fit.at(&r) - truth(&r)).abs() < 1e-14);
        }
    }
}
