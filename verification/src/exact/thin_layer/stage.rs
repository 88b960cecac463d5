//! Implicit time steps of a thin layer.

use super::{ThinLayer, flux};
use crate::exact::ExactError;
use crate::exact::flow_curve::FlowCurve;

/// γ = 1 − 1/√2 of the L-stable two-stage SDIRK.
const GAMMA: f64 = 1.0 - core::f64::consts::FRAC_1_SQRT_2;
/// Newton iterations; a front may cross one dry cell in each.
const ITERATIONS: usize = 25;
/// Residual at which a stage is solved, relative to the volume. What is left is not lost: depths are
/// updated from the fluxes.
const RESIDUAL: f64 = 1e-11;

/// Integrates in time with a step that follows the error.
pub(super) struct Stepper<'a, C> {
    layer: &'a ThinLayer<C>,
    time: f64,
    step: f64,
    shortest: f64,
    volume: f64,
    /// The far end began dry and has to stay so up to this depth.
    dry_end: Option<f64>,
    pub(super) steps: usize,
    pub(super) rejected: usize,
    /// Fluxes through the faces times their size, and derivatives by the depth left and right.
    q: Vec<[f64; 3]>,
    sweep: Vec<[f64; 2]>,
}

impl<'a, C: FlowCurve> Stepper<'a, C> {
    pub(super) fn new(layer: &'a ThinLayer<C>, depth: &[f64], end: f64) -> Self {
        let n = depth.len();
        let deepest = depth.iter().fold(0.0_f64, |a, &b| a.max(b));
        Self {
            layer,
            time: 0.0,
            step: 1e-7 * end,
            shortest: 1e-18 * end,
            volume: depth.iter().enumerate().map(|(i, d)| d * layer.cell(i)).sum(),
            dry_end: (depth[n - 1] == 0.0).then_some(1e-6 * deepest),
            steps: 0,
            rejected: 0,
            q: vec![[0.0; 3]; n + 1],
            sweep: vec![[0.0; 2]; n],
        }
    }

    /// Brings the depths from the present time to a later one.
    pub(super) fn advance(&mut self, depth: &mut Vec<f64>, until: f64) -> Result<(), ExactError> {
        if self.volume == 0.0 {
            self.time = until;
        }
        while self.time < until {
            let left = until - self.time;
            // Two equal steps rather than a long and a tiny one.
            let step = if self.step >= left {
                left
            } else if 2.0 * self.step > left {
                0.5 * left
            } else {
                self.step
            };
            let (next, growth) = match self.try_step(depth, step) {
                Some((next, error)) => {
                    let growth = 0.9 * (self.layer.tolerance / error.max(1e-30)).sqrt();
                    (Some(next).filter(|_| error <= self.layer.tolerance), growth.clamp(0.2, 2.0))
                }
                None => (None, 0.2),
            };
            if let Some(next) = next {
                *depth = next;
                self.time = if step == left { until } else { self.time + step };
                self.steps += 1;
                // A step cut short for a snapshot says nothing against a longer one.
                self.step = if step < self.step { self.step.max(step * growth) } else { step * growth };
                self.check_end(depth)?;
            } else {
                self.rejected += 1;
                self.step = step * growth.min(0.5);
                if self.step < self.shortest {
                    return Err(ExactError::NotConverged {
                        what: "thin layer, time step",
                        iterations: self.steps,
                        residual: self.step,
                    });
                }
            }
        }
        Ok(())
    }

    fn check_end(&self, depth: &[f64]) -> Result<(), ExactError> {
        match self.dry_end {
            Some(limit) if depth[depth.len() - 1] > limit => {
                Err(ExactError::EndReached { length: depth.len() as f64 * self.layer.dx, time: self.time })
            }
            _ => Ok(()),
        }
    }

    /// One step, and the volume it may have misplaced relative to the whole; `None` if a stage was not
    /// solved.
    fn try_step(&mut self, depth: &[f64], step: f64) -> Option<(Vec<f64>, f64)> {
        let mut stage = depth.to_vec();
        self.solve(&mut stage, depth, GAMMA * step)?;
        let first = self.change(&stage);
        let base: Vec<f64> = depth.iter().zip(&first).map(|(d, k)| d + (1.0 - GAMMA) * step * k).collect();
        self.solve(&mut stage, &base, GAMMA * step)?;
        let second = self.change(&stage);
        let mut error = 0.0;
        for (i, (a, b)) in first.iter().zip(&second).enumerate() {
            stage[i] = base[i] + GAMMA * step * b;
            error += (b - a).abs() * self.layer.cell(i);
        }
        Some((stage, GAMMA * step * error / self.volume))
    }

    /// ∂D/∂t of every cell.
    fn change(&mut self, depth: &[f64]) -> Vec<f64> {
        self.fluxes(depth);
        (0..depth.len()).map(|i| (self.q[i][0] - self.q[i + 1][0]) / self.layer.cell(i)).collect()
    }

    /// Fluxes through all inner faces; those at the ends stay 0.
    fn fluxes(&mut self, depth: &[f64]) {
        let layer = self.layer;
        let weight = layer.density * layer.gravity;
        let (along, across) = (weight * libm::sin(layer.slope), weight * libm::cos(layer.slope));
        for i in 1..depth.len() {
            let (left, right) = (depth[i - 1], depth[i]);
            let rise = (right + layer.bed[i] - left - layer.bed[i - 1]) / layer.dx;
            let force = along - across * rise;
            let mean = 0.5 * (left + right);
            let donor = if force > 0.0 { left } else { right };
            let (face, by_left, by_right) = if mean <= 2.0 * donor {
                (mean, 0.5, 0.5)
            } else if force > 0.0 {
                (2.0 * left, 2.0, 0.0)
            } else {
                (2.0 * right, 0.0, 2.0)
            };
            let flux = flux(&layer.law, face, force);
            let by_rise = flux.by_force * across / layer.dx;
            let size = layer.face(i);
            self.q[i] = [
                size * flux.q,
                size * (flux.by_depth * by_left + by_rise),
                size * (flux.by_depth * by_right - by_rise),
            ];
        }
    }

    /// Solves D − Δ ∂D/∂t(D) = base by damped Newton steps from the given D.
    fn solve(&mut self, depth: &mut Vec<f64>, base: &[f64], delta: f64) -> Option<()> {
        let mut residual = self.residual(depth, base, delta);
        for _ in 0..ITERATIONS {
            if residual <= RESIDUAL * self.volume {
                return Some(());
            }
            let correction = self.correction(depth, base, delta);
            let mut fraction = 1.0;
            loop {
                let trial: Vec<f64> = depth.iter().zip(&correction).map(|(d, c)| d + fraction * c).collect();
                let left = self.residual(&trial, base, delta);
                if left < residual {
                    (*depth, residual) = (trial, left);
                    break;
                }
                fraction *= 0.5;
                // Also taken when the residual is not a number.
                if fraction < 0.01 {
                    return None;
                }
            }
        }
        None
    }

    /// Σ |D − base − Δ ∂D/∂t| over the cells, weighted by their size; leaves the fluxes of D behind.
    fn residual(&mut self, depth: &[f64], base: &[f64], delta: f64) -> f64 {
        self.fluxes(depth);
        (0..depth.len()).map(|i| self.cell_residual(i, depth, base, delta).abs()).sum()
    }

    fn cell_residual(&self, i: usize, depth: &[f64], base: &[f64], delta: f64) -> f64 {
        self.layer.cell(i) * (depth[i] - base[i]) + delta * (self.q[i + 1][0] - self.q[i][0])
    }

    /// Newton's correction: the tridiagonal system by elimination without pivoting.
    fn correction(&mut self, depth: &[f64], base: &[f64], delta: f64) -> Vec<f64> {
        let n = depth.len();
        let (mut above, mut value) = (0.0, 0.0);
        for i in 0..n {
            let lower = -delta * self.q[i][1];
            let upper = delta * self.q[i + 1][2];
            let diagonal = self.layer.cell(i) + delta * (self.q[i + 1][1] - self.q[i][2]);
            let pivot = diagonal - lower * above;
            value = (-self.cell_residual(i, depth, base, delta) - lower * value) / pivot;
            above = upper / pivot;
            self.sweep[i] = [above, value];
        }
        let mut correction = vec![0.0; n];
        let mut next = 0.0;
        for i in (0..n).rev() {
            let [above, value] = self.sweep[i];
            next = value - above * next;
            correction[i] = next;
        }
        correction
    }
}
