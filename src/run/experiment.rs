//! What the driver needs to know of what it moves.

use super::load_summary::LoadSummary;
use super::measure::quantity::Quantity;
use super::measure::rest::Pace;
use super::recorder::Recorder;
use super::stop::StopReport;
use super::summary::Parts;
use crate::output::OutputError;
use crate::scene::RestMeasure;
use crate::solver::steady::SteadyOutcome;
use crate::state::{StateError, Tape};

/// What a run moves: a fluid, grains, or both.
pub(super) trait Experiment {
    /// Steps taken so far.
    fn step(&self) -> u64;

    /// Time since the start, s.
    fn time_s(&self) -> f64;

    /// Duration of a step, s.
    fn step_s(&self) -> f64;

    /// Cells or spheres that a step updates now.
    fn size(&self) -> u64;

    /// Most steps to be taken before the next [`Self::tidy`].
    fn stride(&self) -> u64;

    /// Takes steps.
    ///
    /// # Errors
    /// A guard stopped the run.
    fn advance(&mut self, steps: u64) -> Result<(), Box<StopReport>>;

    /// What has to be done between strides: take out grains that have left, add up forces.
    fn tidy(&mut self) {}

    /// Whether there is nothing left to be moved.
    fn is_empty(&self) -> bool {
        false
    }

    /// Prepares the state to be measured, after steps were taken.
    fn look(&mut self) {}

    /// Step at which the next look for steadiness is due; never where none was asked for.
    fn next_look(&self) -> u64 {
        u64::MAX
    }

    /// Looks, if that is due, whether the flow is steady.
    fn is_steady(&mut self) -> bool {
        false
    }

    /// What the looks found; `None` where none were asked for.
    fn steadiness(&self) -> Option<SteadyOutcome> {
        None
    }

    /// How fast everything is, for being at rest.
    fn pace(&self, measure: RestMeasure) -> Pace;

    /// What every probe says now; means begin anew.
    fn row(&mut self) -> Vec<(String, Vec<Quantity>)>;

    /// Writes fields, surfaces, profiles and maps.
    ///
    /// # Errors
    /// I/O.
    fn write_fields(&mut self) -> Result<(), OutputError>;

    /// Writes grains, contacts and walls.
    ///
    /// # Errors
    /// I/O.
    fn write_grains(&mut self) -> Result<(), OutputError>;

    /// Writes tables and pictures at the end.
    ///
    /// # Errors
    /// I/O.
    fn finish(&self, recorder: &Recorder) -> Result<(), OutputError>;

    /// What the loads on solids and walls have been so far.
    fn loads(&self) -> Vec<LoadSummary>;

    /// What people are told about the state.
    fn line(&self) -> String;

    /// The state in numbers.
    fn parts(&self) -> Parts;

    /// Writes the whole state to a tape, or reads it from there; probes, files and loads with it. [`Self::look`] after reading.
    ///
    /// # Errors
    /// I/O, another state, or a solver that does not have this.
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError>;
}
