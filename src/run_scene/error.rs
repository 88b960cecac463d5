//! Why a run did not end as planned.

use std::fmt;
use std::path::PathBuf;

use crate::dem::DemError;
use crate::output::OutputError;
use crate::plan::Plan;
use crate::run_grains::GrainStopReport;
use crate::scene::Scene;
use crate::setup::WallRule;
use crate::solver::run::{Runaway, StartError, Stopped};

/// Why a run did not end as planned.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The output folder cannot be made.
    #[error("cannot make the folder {}: {source}", .path.display())]
    Folder { path: PathBuf, source: std::io::Error },
    /// The backend refused the set-up.
    #[error("cannot start: {0}")]
    Start(StartError),
    /// A guard stopped the run.
    #[error("{0}")]
    Stopped(Box<StopReport>),
    /// A guard stopped a run of grains.
    #[error("{0}")]
    Grains(Box<GrainStopReport>),
    /// The worker threads cannot be made.
    #[error("cannot make worker threads: {0}")]
    Threads(String),
    /// A file could not be written.
    #[error(transparent)]
    Output(OutputError),
}

/// What a guard found, for people.
#[derive(Clone, Debug, PartialEq)]
pub struct StopReport {
    /// Scene file.
    pub file: String,
    /// Step.
    pub step: u64,
    /// Time, s.
    pub time_s: f64,
    /// Cell.
    pub cell: [usize; 3],
    /// Centre of the cell, m.
    pub position_m: [f64; 3],
    /// What was found, with its unit.
    pub found: String,
    /// τ of the cell.
    pub tau: f64,
    /// The likely cause and what to do.
    pub cause: &'static str,
}

impl StopReport {
    /// `failure`: what the discrete element method says. `number`: number at time 0 of a grain.
    pub(super) fn new(
        plan: &Plan,
        scene: &Scene,
        stopped: &Stopped,
        failure: Option<&DemError>,
        number: &dyn Fn(u32) -> u32,
    ) -> Self {
        let units = &plan.units;
        let name = |grain: u32| match &plan.grains {
            Some(coupled) => coupled.grains.name(number(grain) as usize),
            None => format!("grain {grain}"),
        };
        let found = match stopped.what {
            Runaway::NotFinite => "density or velocity is not a finite number".to_owned(),
            Runaway::NoDensity { density } => {
                format!("density of {density:.4} times the reference density, which is not > 0")
            }
            Runaway::Ledger { residual, bound } => {
                format!(
                    "mass changed by {residual:.3e} of the whole in one step; rounding allows {bound:.1e}"
                )
            }
            Runaway::Grains { grain } => match failure {
                Some(error) => format!("{}: {error}", name(grain)),
                None => format!("{} could not go on", name(grain)),
            },
            Runaway::GrainTooFast { grain, speed, limit } => format!(
                "{} moves at {:.4e} m/s, {speed:.3} cells per step; the limit is {limit}",
                name(grain),
                units.velocity_to_si(speed)
            ),
            Runaway::TooFast { speed, limit } => format!(
                "{:.4e} m/s, {speed:.3} cells per step; the limit is {limit}",
                units.velocity_to_si(speed)
            ),
        };
        Self {
            file: scene.file.clone(),
            step: stopped.step,
            time_s: units.time_to_si(stopped.step as f64),
            cell: stopped.cell,
            position_m: units.cell_centre_m(stopped.cell),
            found,
            tau: stopped.tau,
            cause: cause(plan, stopped),
        }
    }
}

/// The likeliest cause, by what the plan already knew.
fn cause(plan: &Plan, stopped: &Stopped) -> &'static str {
    let numbers = &plan.numbers;
    if matches!(stopped.what, Runaway::Ledger { .. }) {
        "a defect of the solver; please report the scene"
    } else if matches!(stopped.what, Runaway::Grains { .. }) {
        "an impact too fast or a load too high for this Young's modulus; stiffer material, more \
         `grains.coupling.sub_steps`, or a higher `grains.numerics.design_speed_m_per_s`"
    } else if matches!(stopped.what, Runaway::GrainTooFast { .. }) {
        "grains fall faster than the velocity scale assumed; give `numerics.reference_velocity_m_per_s` or a smaller \
         time step"
    } else if stopped.tau < 0.52
        && numbers.depth_cells.is_some()
        && plan.setup.wall_rule == WallRule::ViscosityIndependent
    {
        "the relaxation time is near ½ below a free surface; a finer `domain.spacing_m`, a larger viscosity, or \
         `half_way` walls"
    } else if stopped.tau < 0.55 {
        "the relaxation time is near ½, where waves grow [K5]; a finer `domain.spacing_m` or a larger viscosity"
    } else if stopped.tau.is_finite() && stopped.tau > 3.0 && !numbers.operator.has_odd_rate() {
        "one relaxation rate at a large relaxation time; `central_moment`, or a smaller time step"
    } else if numbers.mach > 0.17 {
        "the Mach number is high; a smaller time step"
    } else if numbers.reference_velocity_m_per_s == 0.0 {
        "the flow was expected to be at rest; give `numerics.reference_velocity_m_per_s`"
    } else {
        "the flow is faster than the velocity scale assumed; give `numerics.reference_velocity_m_per_s` or a \
         smaller time step"
    }
}

impl fmt::Display for StopReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [i, j, k] = self.cell;
        let [x, y, z] = self.position_m;
        writeln!(f, "{}: stopped at step {}, time {:.6} s", self.file, self.step, self.time_s)?;
        writeln!(f, "  where: cell ({i}, {j}, {k}), at ({x:.6}, {y:.6}, {z:.6}) m")?;
        // Guards of grains have no relaxation time.
        let tau =
            if self.tau.is_nan() { String::new() } else { format!("; relaxation time {:.4}", self.tau) };
        writeln!(f, "  found: {}{tau}", self.found)?;
        writeln!(f, "  likely cause: {}", self.cause)?;
        write!(f, "  files written before stay as they are")
    }
}
