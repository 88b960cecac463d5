//! The velocity that a grain's surface has during a step \[C6\].

use super::L3;
use nalgebra::{Matrix6, Vector6};

/// Friction of the links: force and torque are `driving` − `matrix` · (U, ω).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Friction {
    /// Force and torque on the grain with its surface at rest.
    pub driving: [f64; 6],
    /// Upper triangle, row by row.
    pub matrix: [f64; 21],
}

impl Default for Friction {
    fn default() -> Self {
        Self { driving: [0.0; 6], matrix: [0.0; 21] }
    }
}

impl Friction {
    /// Adds a link that pushes with `push` − `rate` v · (U, ω) along v = (c, r × c).
    #[inline]
    pub(crate) fn add(&mut self, v: &[f64; 6], push: f64, rate: f64) {
        let mut k = 0;
        for a in 0..6 {
            self.driving[a] += v[a] * push;
            let scaled = rate * v[a];
            for b in a..6 {
                self.matrix[k] += scaled * v[b];
                k += 1;
            }
        }
    }

    /// Z as a matrix.
    #[must_use]
    pub(crate) fn full(&self) -> Matrix6<f64> {
        let mut full = Matrix6::zeros();
        let mut k = 0;
        for a in 0..6 {
            for b in a..6 {
                full[(a, b)] = self.matrix[k];
                full[(b, a)] = self.matrix[k];
                k += 1;
            }
        }
        full
    }
}

/// Velocity and spin in the middle of the step, (M + ½Z) ΔW = driving + other − Z W, W + ½ΔW.
///
/// What a link returns depends on the velocity of the surface, and a light grain answers within the step: with the
/// velocity from the beginning of the step the scheme overshoots where Z > M, with this one it never does. It
/// belongs to the middle of the step, as half-way links do.
///
/// # Arguments
/// `friction`: of the links. `mass`; `inertia`: about the centre, frame of the box. `motion`: (U, ω) at the start of
/// the step. `other`: force and torque besides those of the links.
/// # Source
/// After Nguyen & Ladd 2002, Phys. Rev. E 66, 046708 (implicit update), at the middle of the step.
/// # Verified by
/// Claims `coupled-density-ratios`, `neutral-sphere-at-rest`.
#[must_use]
pub(crate) fn middle(
    friction: &Friction,
    mass: f64,
    inertia: &[L3; 3],
    motion: &[f64; 6],
    other: &[f64; 6],
) -> [f64; 6] {
    let z = friction.full();
    let w = Vector6::from_row_slice(motion);
    let right = Vector6::from_row_slice(&friction.driving) + Vector6::from_row_slice(other) - z * w;
    let mut left = z * 0.5;
    for a in 0..3 {
        left[(a, a)] += mass;
        for b in 0..3 {
            left[(a + 3, b + 3)] += inertia[a][b];
        }
    }
    // Positive definite: the mass is above zero and Z is a sum of squares.
    match left.cholesky() {
        Some(factors) => {
            let change = factors.solve(&right);
            std::array::from_fn(|a| motion[a] + 0.5 * change[a])
        }
        None => *motion,
    }
}
