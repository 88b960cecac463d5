//! A uniform film on an incline: one column of cells over a wall, gravity tilted.

use crate::claim::VerifyError;
use crate::exact::film::Film;
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, FreeSurface, Setup, SurfaceForce, YieldTreatment};
use lahar::solver::run::{Backend, Run};
use lahar::solver::steady::{SteadyRule, run_to_steady};

/// The slope of the thesis, 16°, in radians.
pub const SLOPE: f64 = 16.0 * core::f64::consts::PI / 180.0;

/// A film, lattice units.
#[derive(Clone, Copy, Debug)]
pub struct Sheet {
    /// The law.
    pub law: Law,
    /// H in cells, any fill level.
    pub depth: f64,
    /// g.
    pub gravity: f64,
    /// How the force acts in the interface cell.
    pub force: SurfaceForce,
    /// How τ follows from the law.
    pub yielding: YieldTreatment,
}

/// A film that has become steady.
#[derive(Clone, Debug)]
pub struct Flow {
    /// u along the slope at the cell centres, bed first; fluid cells only.
    pub velocity: Vec<f64>,
    /// φ of the same cells.
    pub fill: Vec<f64>,
    /// Cells that changed kind.
    pub conversions: u64,
}

impl Flow {
    /// Σ u φ: the discharge per width, by mass.
    pub fn flux(&self) -> f64 {
        self.velocity.iter().zip(&self.fill).map(|(u, fill)| u * fill).sum()
    }

    /// The velocities of the liquid cells.
    pub fn liquid(&self) -> &[f64] {
        &self.velocity[..self.velocity.len() - 1]
    }
}

impl Sheet {
    /// A film with the default rules.
    pub fn new(law: Law, depth: f64, gravity: f64) -> Self {
        Self { law, depth, gravity, force: SurfaceForce::default(), yielding: YieldTreatment::Exact }
    }

    /// The exact film.
    pub fn exact(&self) -> Film<Law> {
        Film { law: self.law, thickness: self.depth, density: 1.0, gravity: self.gravity, slope: SLOPE }
    }

    /// u(z) of the exact film at the centres of the first `cells` cells.
    pub fn profile(&self, cells: usize) -> Vec<f64> {
        let film = self.exact();
        (0..cells).map(|k| film.velocity(k as f64 + 0.5)).collect()
    }

    /// A column with a wall below and room above.
    pub fn setup(&self) -> Setup {
        let cells = libm::ceil(self.depth) as usize + 2;
        let mut setup = Setup::periodic([1, 1, cells], self.law);
        setup.faces[2] = [Face::NoSlip; 2];
        setup.yielding = self.yielding;
        let (sine, cosine) = (libm::sin(SLOPE), libm::cos(SLOPE));
        setup.force = BodyForce::Constant([self.gravity * sine, 0.0, -self.gravity * cosine]);
        let fill = (0..cells).map(|k| (self.depth - k as f64).clamp(0.0, 1.0)).collect();
        setup.free_surface = Some(FreeSurface { force: self.force, ..FreeSurface::new(fill) });
        setup
    }

    /// From rest to the steady state.
    ///
    /// # Errors
    /// A guard stopped the run, or it is not steady within the rule.
    pub fn steady(&self, backend: &dyn Backend, rule: SteadyRule) -> Result<Flow, VerifyError> {
        let mut run = backend.start(&self.setup())?;
        let outcome = run_to_steady(run.as_mut(), rule)?;
        if !outcome.steady {
            return Err(VerifyError::not_steady(&outcome, rule.tolerance));
        }
        Ok(flow(run.as_ref()))
    }
}

/// The film as it is now.
pub fn flow(run: &dyn Run) -> Flow {
    let fields = run.fields();
    let fluid = |cell: &usize| fields.is_fluid(*cell, false);
    Flow {
        velocity: (0..fields.fill.len()).filter(fluid).map(|cell| fields.velocity[cell][0]).collect(),
        fill: (0..fields.fill.len()).filter(fluid).map(|cell| fields.fill[cell]).collect(),
        conversions: run.ledger().map_or(0, |ledger| ledger.conversions),
    }
}
