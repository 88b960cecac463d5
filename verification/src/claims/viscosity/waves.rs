//! Plane waves of small amplitude in periodic boxes: their decay per step and their phase speed.

use std::sync::Arc;

use crate::claim::VerifyError;
use crate::exact::ExactError;
use crate::exact::discrete_modes::Relaxation;
use crate::reference_values::ReferenceError;
use lahar::collision::CollisionChoice;
use lahar::rheology::Law;
use lahar::setup::{FlowPoint, Setup};
use lahar::solver::run::{Backend, Run};

/// Amplitude of the transverse waves: the nonlinear error is its square, 1e-12.
pub const AMPLITUDE: f64 = 1e-6;

/// A transverse wave.
#[derive(Clone, Copy, Debug)]
pub struct Wave {
    /// Box, cells.
    pub extents: [usize; 3],
    /// Waves per box along each axis.
    pub waves: [f64; 3],
    /// Direction of the velocity, unit vector across the wave vector; two polarisations may be
    /// superposed, they do not interact at this amplitude.
    pub polarisation: [f64; 3],
    /// Mean flow.
    pub mean: [f64; 3],
    /// Mean density.
    pub density: f64,
}

impl Wave {
    /// k along y, velocity along x, in a column of `n` cells.
    pub const fn axis(n: usize) -> Self {
        Self {
            extents: [1, n, 1],
            waves: [0.0, 1.0, 0.0],
            polarisation: [1.0, 0.0, 0.0],
            mean: [0.0; 3],
            density: 1.0,
        }
    }

    /// k along (1, 1, 0), velocity along `polarisation`.
    pub const fn diagonal(n: usize, polarisation: [f64; 3]) -> Self {
        Self { extents: [n, n, 1], waves: [1.0, 1.0, 0.0], polarisation, mean: [0.0; 3], density: 1.0 }
    }

    /// The wave vector.
    pub fn k(&self) -> [f64; 3] {
        std::array::from_fn(|a| core::f64::consts::TAU * self.waves[a] / self.extents[a] as f64)
    }

    /// |k|².
    pub fn k2(&self) -> f64 {
        let k = self.k();
        (k[0] * k[0] + k[1] * k[1]) + k[2] * k[2]
    }

    /// The set-up that starts it.
    pub fn setup(&self, law: Law, collision: CollisionChoice) -> Setup {
        let mut setup = Setup::periodic(self.extents, law);
        setup.collision = collision;
        let wave = *self;
        setup.initial = Some(Arc::new(move |cell| {
            let (k, phase) = (wave.k(), wave.phase(cell));
            let (sin, cos) = (libm::sin(phase), libm::cos(phase));
            FlowPoint {
                density: wave.density,
                velocity: std::array::from_fn(|a| wave.mean[a] + AMPLITUDE * wave.polarisation[a] * sin),
                gradient: std::array::from_fn(|a| {
                    std::array::from_fn(|b| AMPLITUDE * wave.polarisation[a] * k[b] * cos)
                }),
            }
        }));
        setup
    }

    fn phase(&self, cell: [usize; 3]) -> f64 {
        let k = self.k();
        let at = |a: usize| k[a] * (cell[a] as f64 + 0.5);
        (at(0) + at(1)) + at(2)
    }

    /// Σ over cells of u·polarisation e^{−ik·x}, as (real, imaginary).
    fn project(&self, run: &dyn Run) -> (f64, f64) {
        let velocity = run.fields().velocity;
        let p = self.polarisation;
        let mut sum = (0.0, 0.0);
        for (cell, u) in velocity.iter().enumerate() {
            let phase = self.phase(run.setup().coordinates(cell));
            let v =
                (p[0] * (u[0] - self.mean[0]) + p[1] * (u[1] - self.mean[1])) + p[2] * (u[2] - self.mean[2]);
            sum = (sum.0 + v * libm::cos(phase), sum.1 - v * libm::sin(phase));
        }
        sum
    }

    /// Decay rate of the amplitude per step over `window` steps, after `skip` steps that let the
    /// kinetic modes die.
    ///
    /// # Errors
    /// As the backend's.
    pub fn decay(
        &self,
        backend: &dyn Backend,
        setup: &Setup,
        skip: u64,
        window: u64,
    ) -> Result<f64, VerifyError> {
        let mut run = backend.start(setup)?;
        run.advance(skip)?;
        let (re, im) = self.project(&*run);
        let before = re * re + im * im;
        run.advance(window)?;
        let (re, im) = self.project(&*run);
        Ok(-0.5 * libm::log((re * re + im * im) / before) / window as f64)
    }

    /// ν_eff/ν of a Newtonian fluid with these relaxation times.
    ///
    /// # Errors
    /// As the backend's.
    pub fn viscosity_ratio(
        &self,
        backend: &dyn Backend,
        collision: CollisionChoice,
        relaxation: Relaxation,
    ) -> Result<f64, VerifyError> {
        let nu = relaxation.viscosity();
        let setup = self.setup(Law::Newtonian { mu: nu }, collision);
        let nominal = nu * self.k2();
        let rate = self.decay(backend, &setup, skip(relaxation, nominal), window(nominal))?;
        Ok(rate / nominal)
    }
}

/// Steps over which the decay of a wave with this rate is measured: 64, or until e⁻⁵ is left. The two
/// amplitudes are good to 1e-14, so the slowest decay of the ladders, 4e-6 per step, comes out to 1e-10.
pub fn window(rate: f64) -> u64 {
    (5.0 / rate).clamp(4.0, 64.0) as u64
}

/// Steps until the kinetic modes, which keep |1 − 1/τ| per step, have lost 13 decades against a wave
/// that decays at `rate`; but at most e⁻⁴⁵ of the wave may be gone, or rounding of the modes that do
/// not decay would show.
pub fn skip(relaxation: Relaxation, rate: f64) -> u64 {
    let kept = (1.0 - 1.0 / relaxation.even).abs().max((1.0 - 1.0 / relaxation.odd).abs());
    let gain = -libm::log(kept) - 1.2 * rate;
    let steps = if gain > 0.0 { 30.0 / gain } else { 3000.0 };
    steps.clamp(40.0, 3000.0).min(45.0 / rate).ceil() as u64
}

impl From<ExactError> for VerifyError {
    fn from(error: ExactError) -> Self {
        Self::Numerics { what: "the reference solution", detail: error.to_string() }
    }
}

impl From<ReferenceError> for VerifyError {
    fn from(error: ReferenceError) -> Self {
        Self::Numerics { what: "the reference value", detail: error.to_string() }
    }
}
