//! The nonlinear system of one implicit stage.

use super::{Flow1d, LowerEnd};
use crate::exact::ExactError;
use crate::exact::flow_curve::FlowCurve;

/// Newton's method gives up after this many steps; yield surfaces that cross many mid-points in one
/// time step take the longest.
const NEWTON_STEPS: usize = 300;

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, v| if v.abs() > m { v.abs() } else { m })
}

fn norm(residual: &[f64]) -> f64 {
    residual.iter().map(|r| r * r).sum::<f64>().sqrt()
}

/// One implicit stage: base velocities b, its δ, G and Δy.
pub(super) struct Stage<'a, C> {
    pub flow: &'a Flow1d<C>,
    pub base: &'a [f64],
    pub delta: f64,
    pub force: f64,
    pub dy: f64,
}

impl<C: FlowCurve> Stage<'_, C> {
    /// Solves u = base + δ/ρ (G + ∂σ/∂y), ∂u/∂y = R(σ) for the stresses, by Newton's method with a
    /// line search on the convex function.
    pub fn solve(&self, guess: &[f64]) -> Result<Vec<f64>, ExactError> {
        let mut stress = guess.to_vec();
        let mut residual = self.residual(&stress);
        let mut size = norm(&residual);
        let mut energy = self.energy(&stress);
        for _ in 0..NEWTON_STEPS {
            let change = self.newton_change(&stress, &residual);
            let largest = largest(&change);
            let slope = change.iter().zip(&residual).map(|(d, r)| d * r).sum::<f64>() * self.dy;
            let before = size;
            let mut part = 1.0;
            let mut accepted = false;
            for _ in 0..60 {
                let trial: Vec<f64> =
                    stress.iter().zip(&change).map(|(s, d)| self.moved(*s, part * d)).collect();
                let trial_residual = self.residual(&trial);
                let (trial_size, trial_energy) = (norm(&trial_residual), self.energy(&trial));
                // Armijo on the convex function, or on its gradient where rounding hides the fall.
                if trial_energy <= energy + 1e-4 * part * slope || trial_size < 0.9 * size {
                    (stress, residual, size, energy) = (trial, trial_residual, trial_size, trial_energy);
                    accepted = true;
                    break;
                }
                part *= 0.5;
            }
            let small = largest <= self.resolution(&stress);
            if size == 0.0 || (small && !(accepted && size < 0.5 * before)) {
                return Ok(stress);
            }
            if !accepted {
                break;
            }
        }
        Err(ExactError::NotConverged {
            what: "the stresses of a time step",
            iterations: NEWTON_STEPS,
            residual: size,
        })
    }

    /// The stress after a Newton change. Where the law is steep at yield the change is made in the
    /// rate, γ̇ + R′ dσ, and carried back through σ(γ̇): to first order the same, but free of the
    /// overshoot across the yield stress that the infinite slope of R would cause.
    fn moved(&self, stress: f64, change: f64) -> f64 {
        let law = &self.flow.law;
        if law.steep_at_yield() {
            let sign = if stress < 0.0 { -1.0 } else { 1.0 };
            let slope = law.rate_slope(stress.abs());
            let rate = law.rate(stress.abs()) + slope * sign * change;
            if slope > 0.0 && rate > 0.0 {
                return sign * law.stress(rate);
            }
        }
        stress + change
    }

    /// The change of stress below which Newton's method may end once it no longer gains: 1e-10 of the
    /// stresses, or what the rounding of u does to ρ u h/δ (64 ulp).
    fn resolution(&self, stress: &[f64]) -> f64 {
        let flow = self.flow;
        let speed = largest(self.base) + flow.wall_speed.abs();
        let rounding = 64.0 * f64::EPSILON * flow.density * speed * flow.length / self.delta;
        1e-10 * (largest(stress) + flow.law.yield_stress()) + rounding
    }

    /// Velocities that a stress field gives by the momentum balance of every free node.
    fn velocity(&self, stress: &[f64]) -> Vec<f64> {
        let cells = stress.len();
        let per_density = self.delta / self.flow.density;
        (0..=cells)
            .map(|i| {
                if i == cells {
                    self.flow.wall_speed
                } else if i > 0 {
                    self.base[i] + per_density * (self.force + (stress[i] - stress[i - 1]) / self.dy)
                } else if self.flow.lower == LowerEnd::Symmetry {
                    // Half a cell above the plane of symmetry, which carries no stress.
                    self.base[0] + per_density * (self.force + 2.0 * stress[0] / self.dy)
                } else {
                    0.0
                }
            })
            .collect()
    }

    /// R(σ_f) − (u_{f+1} − u_f)/Δy.
    fn residual(&self, stress: &[f64]) -> Vec<f64> {
        let u = self.velocity(stress);
        let gap = |f: usize, s: &f64| self.flow.signed_rate(*s) - (u[f + 1] - u[f]) / self.dy;
        stress.iter().enumerate().map(|(f, s)| gap(f, s)).collect()
    }

    /// The convex function whose gradient is Δy times the residual:
    /// Σ Δy ∫R dσ + Σ_i (mass of node i)/(2δ) u_i² − U σ_last (+ 0 · σ_0 at a lower wall).
    fn energy(&self, stress: &[f64]) -> f64 {
        let u = self.velocity(stress);
        let complementary: f64 =
            stress.iter().map(|s| self.flow.law.moment(0, s.abs())).sum::<f64>() * self.dy;
        let first = if self.flow.lower == LowerEnd::Symmetry { 0.5 * u[0] * u[0] } else { 0.0 };
        let inner: f64 = u[1..stress.len()].iter().map(|u| u * u).sum();
        let kinetic = 0.5 * self.flow.density * self.dy / self.delta * (first + inner);
        complementary + kinetic - self.flow.wall_speed * stress.last().copied().unwrap_or(0.0)
    }

    /// Solves (diag R′ + δ/(ρΔy²) tridiag(−1, 2, −1)) d = −residual by elimination (no pivoting is
    /// needed: the matrix is positive definite). An end at a wall has one neighbour less, the plane
    /// of symmetry half the mass.
    fn newton_change(&self, stress: &[f64], residual: &[f64]) -> Vec<f64> {
        let cells = stress.len();
        let link = self.delta / (self.flow.density * self.dy * self.dy);
        let diagonal = |f: usize| {
            let below = match (f, self.flow.lower) {
                (0, LowerEnd::Symmetry) => 2.0,
                (0, LowerEnd::Wall) => 0.0,
                _ => 1.0,
            };
            let above = if f + 1 == cells { 0.0 } else { 1.0 };
            self.flow.law.rate_slope(stress[f].abs()) + link * (below + above)
        };
        let mut pivots = vec![0.0; cells];
        let mut right: Vec<f64> = residual.iter().map(|r| -r).collect();
        for f in 0..cells {
            pivots[f] = diagonal(f);
            if f > 0 {
                let factor = link / pivots[f - 1];
                pivots[f] -= factor * link;
                right[f] += factor * right[f - 1];
            }
            // Rigid fluid between two walls leaves a constant stress undetermined: the last pivot
            // would be 0.
            if pivots[f] < 1e-13 * link {
                pivots[f] = 1e-13 * link;
            }
        }
        for f in (0..cells).rev() {
            let next = if f + 1 < cells { link * right[f + 1] } else { 0.0 };
            right[f] = (right[f] + next) / pivots[f];
        }
        right
    }
}
