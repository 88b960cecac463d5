//! Time-dependent unidirectional flow of any law with an ideal yield stress, solved to convergence
//! on a fine one-dimensional grid.
//!
//! ρ ∂u/∂t = G(t) + ∂σ/∂y, ∂u/∂y = R(σ) with R(σ) = sgn(σ) γ̇(|σ|), the single-valued inverse of the
//! law: R = 0 in unyielded material, so nothing is regularised. Velocities sit at the nodes y_i,
//! stresses at the mid-points. An implicit stage
//! u_i = b_i + δ/ρ (G + (σ_{i+½} − σ_{i−½})/Δy) turns into a system for the stresses alone,
//! R(σ_f) = (u_{f+½} − u_{f−½})/Δy: the optimality condition of a strictly convex function, whose
//! semismooth Newton matrix is tridiagonal, symmetric and positive definite. Afterwards u is summed
//! from the wall with R(σ), so plugs are rigid and arrested fluid is at rest to the last bit.
//!
//! In time: backward Euler (order 1) or the two-stage stiffly accurate SDIRK with γ = 1 − 1/√2
//! (order 2). In space: order 2. Verified by the tests below.

use super::ExactError;
use super::flow_curve::FlowCurve;
use stage::Stage;

mod stage;
#[cfg(test)]
mod tests;

/// Time integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// Order 1, monotone.
    BackwardEuler,
    /// Order 2, L-stable (Alexander 1977, SIAM J. Numer. Anal. 14, 1006-1021).
    Sdirk2,
}

/// The lower end of the interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LowerEnd {
    /// y = 0 is a plane of symmetry: the upper half of a channel.
    Symmetry,
    /// y = 0 is a resting wall.
    Wall,
}

/// What is fixed during a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Flow1d<C> {
    /// The law (dynamic values), ideal or clamped.
    pub law: C,
    /// ρ.
    pub density: f64,
    /// Length of the interval: half width of a channel (`Symmetry`) or gap (`Wall`).
    pub length: f64,
    /// Number of intervals Δy = length/cells.
    pub cells: usize,
    /// Lower end.
    pub lower: LowerEnd,
    /// Velocity of the wall at y = length; not 0 only with a lower wall.
    pub wall_speed: f64,
    /// Time integration.
    pub scheme: Scheme,
}

/// Velocity and stress at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Time.
    pub time: f64,
    /// Interval length.
    pub length: f64,
    /// u at the nodes y_i = i Δy, `cells + 1` values.
    pub velocity: Vec<f64>,
    /// σ at the mid-points y = (f + ½)Δy, `cells` values. The sign is that of ∂u/∂y.
    pub stress: Vec<f64>,
}

impl Profile {
    /// u(y) by linear interpolation (an error of order Δy², as the solution's), |y| for a half channel.
    pub fn velocity_at(&self, y: f64) -> f64 {
        let cells = self.stress.len();
        let x = (y.abs() / self.length * cells as f64).clamp(0.0, cells as f64);
        let i = (x as usize).min(cells.saturating_sub(1));
        let part = x - i as f64;
        match (self.velocity.get(i), self.velocity.get(i + 1)) {
            (Some(a), Some(b)) => (1.0 - part) * a + part * b,
            _ => f64::NAN,
        }
    }

    /// Largest |u|.
    pub fn largest_velocity(&self) -> f64 {
        self.velocity.iter().fold(0.0, |m, u| if u.abs() > m { u.abs() } else { m })
    }

    /// ∫ u dy over the interval (trapezoidal rule).
    pub fn flux(&self) -> f64 {
        let dy = self.length / self.stress.len() as f64;
        self.velocity.windows(2).map(|w| 0.5 * (w[0] + w[1]) * dy).sum()
    }

    /// ∫ u²/2 dy over the interval (trapezoidal rule); times ρ the kinetic energy.
    pub fn kinetic_energy_over_density(&self) -> f64 {
        let dy = self.length / self.stress.len() as f64;
        self.velocity.windows(2).map(|w| 0.25 * (w[0] * w[0] + w[1] * w[1]) * dy).sum()
    }

    /// σ at the wall y = length under the force `force`: the momentum balance of the last half cell,
    /// whose wall is not accelerated.
    pub fn wall_stress(&self, force: f64) -> f64 {
        let dy = self.length / self.stress.len() as f64;
        self.stress.last().map_or(f64::NAN, |s| s - 0.5 * dy * force)
    }
}

impl<C: FlowCurve> Flow1d<C> {
    /// Fluid at rest (the wall already moving if `wall_speed` is not 0).
    ///
    /// # Errors
    /// `Argument` for ρ, length ≤ 0, fewer than 2 cells, or a moving wall opposite a plane of symmetry.
    pub fn at_rest(&self) -> Result<Profile, ExactError> {
        self.check()?;
        let mut velocity = vec![0.0; self.cells + 1];
        if let Some(last) = velocity.last_mut() {
            *last = self.wall_speed;
        }
        // A moving wall shears sooner or later: its steady stress is a better first guess than none.
        let steady =
            if self.wall_speed == 0.0 { 0.0 } else { self.law.stress(self.wall_speed.abs() / self.length) };
        let guess = if self.wall_speed < 0.0 { -steady } else { steady };
        Ok(Profile { time: 0.0, length: self.length, velocity, stress: vec![guess; self.cells] })
    }

    /// The steady state of the discrete half channel under a constant force: σ = −Gy at the mid-points.
    ///
    /// # Errors
    /// `Argument` as [`Flow1d::at_rest`], and for a lower wall, whose stress is not known beforehand.
    pub fn steady_half_channel(&self, force: f64) -> Result<Profile, ExactError> {
        self.check()?;
        if self.lower == LowerEnd::Wall {
            let allowed = "the steady state is given for the symmetric half channel only";
            return Err(ExactError::Argument { what: "lower", value: 0.0, allowed });
        }
        let dy = self.length / self.cells as f64;
        let stress: Vec<f64> = (0..self.cells).map(|f| -force * (f as f64 + 0.5) * dy).collect();
        Ok(Profile { time: 0.0, length: self.length, velocity: self.velocity_of(&stress), stress })
    }

    /// One time step of length `dt` under the force per volume `force(t)`, which is read at the stage
    /// times t + γΔt and t + Δt (backward Euler: the latter). A jump of the force belongs on a step's
    /// end; the step before must see the old value at its own end.
    ///
    /// # Errors
    /// `Argument` for Δt ≤ 0, `NotConverged`.
    pub fn step(&self, from: &Profile, dt: f64, force: &dyn Fn(f64) -> f64) -> Result<Profile, ExactError> {
        ExactError::positive("dt", dt)?;
        let end = from.time + dt;
        let (velocity, stress) = match self.scheme {
            Scheme::BackwardEuler => self.solve(&from.velocity, dt, force(end), &from.stress)?,
            Scheme::Sdirk2 => {
                let gamma = 1.0 - core::f64::consts::FRAC_1_SQRT_2;
                let (first, stress) =
                    self.solve(&from.velocity, gamma * dt, force(from.time + gamma * dt), &from.stress)?;
                let carry = (1.0 - gamma) / gamma;
                let base: Vec<f64> =
                    from.velocity.iter().zip(&first).map(|(old, new)| old + carry * (new - old)).collect();
                self.solve(&base, gamma * dt, force(end), &stress)?
            }
        };
        Ok(Profile { time: end, length: self.length, velocity, stress })
    }

    /// Profiles at the given increasing times. Steps grow by a quarter each from `first_step`, which
    /// resolves a sudden start, up to `largest_step`, and are shortened to end on the times asked for.
    ///
    /// # Errors
    /// `Argument` for Δt ≤ 0, `NotConverged`, from any [`Flow1d::step`].
    pub fn profiles(
        &self,
        from: &Profile,
        times: &[f64],
        first_step: f64,
        largest_step: f64,
        force: &dyn Fn(f64) -> f64,
    ) -> Result<Vec<Profile>, ExactError> {
        ExactError::positive("first_step", first_step)?;
        ExactError::positive("largest_step", largest_step)?;
        let mut now = from.clone();
        let mut step = first_step.min(largest_step);
        let mut out = Vec::with_capacity(times.len());
        for time in times {
            while now.time < *time {
                let left = *time - now.time;
                let equal = left / libm::ceil(left / step);
                let mut next = self.step(&now, equal, force)?;
                if equal >= left * (1.0 - 1e-12) {
                    next.time = *time;
                }
                now = next;
                step = (1.25 * step).min(largest_step);
            }
            out.push(now.clone());
        }
        Ok(out)
    }

    /// The time, counted from `from`, at which every velocity is exactly 0 under a constant force.
    ///
    /// Steps of `dt`; the step in which the flow stops is halved until it is below `dt`/2¹².
    ///
    /// # Errors
    /// `StillMoving` if that does not happen within `longest`, and as [`Flow1d::step`].
    pub fn stopping_time(
        &self,
        from: &Profile,
        force: f64,
        dt: f64,
        longest: f64,
    ) -> Result<f64, ExactError> {
        let mut now = from.clone();
        let mut step = dt;
        while now.time - from.time < longest {
            let next = self.step(&now, step, &|_| force)?;
            if next.velocity.iter().any(|u| *u != 0.0) {
                now = next;
            } else if step > dt / 4096.0 {
                step *= 0.5;
            } else {
                return Ok(next.time - from.time);
            }
        }
        Err(ExactError::StillMoving { until: now.time, velocity: now.largest_velocity() })
    }

    fn check(&self) -> Result<(), ExactError> {
        ExactError::positive("density", self.density)?;
        ExactError::positive("length", self.length)?;
        if self.cells < 2 {
            let allowed = "must be at least 2";
            return Err(ExactError::Argument { what: "cells", value: self.cells as f64, allowed });
        }
        if self.lower == LowerEnd::Symmetry && self.wall_speed != 0.0 {
            let allowed = "must be 0 opposite a plane of symmetry";
            return Err(ExactError::Argument { what: "wall_speed", value: self.wall_speed, allowed });
        }
        Ok(())
    }

    /// R(σ).
    fn signed_rate(&self, stress: f64) -> f64 {
        if stress < 0.0 { -self.law.rate(-stress) } else { self.law.rate(stress) }
    }

    /// u summed from the moving wall: u_i = U − Σ_{f ≥ i} R(σ_f) Δy.
    fn velocity_of(&self, stress: &[f64]) -> Vec<f64> {
        let dy = self.length / stress.len() as f64;
        let mut velocity = vec![0.0; stress.len()];
        let mut u = self.wall_speed;
        for (node, s) in velocity.iter_mut().zip(stress).rev() {
            u -= self.signed_rate(*s) * dy;
            *node = u;
        }
        if let (LowerEnd::Wall, Some(first)) = (self.lower, velocity.first_mut()) {
            *first = 0.0;
        }
        velocity.push(self.wall_speed);
        velocity
    }

    /// One implicit stage: velocities and stresses.
    fn solve(
        &self,
        base: &[f64],
        delta: f64,
        force: f64,
        guess: &[f64],
    ) -> Result<(Vec<f64>, Vec<f64>), ExactError> {
        let stage = Stage { flow: self, base, delta, force, dy: self.length / self.cells as f64 };
        let stress = stage.solve(guess)?;
        Ok((self.velocity_of(&stress), stress))
    }
}
