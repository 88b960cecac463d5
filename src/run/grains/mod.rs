//! Grains without fluid, as the driver moves them; and what is written about grains in any run.

pub(super) mod books;
pub(super) mod files;
pub(super) mod pictures;
pub(super) mod population;
pub(super) mod stop;
mod walls;

use std::sync::Arc;

use super::error::RunError;
use super::experiment::Experiment;
use super::load_summary::LoadSummary;
use super::measure::grains::Grains;
use super::measure::loads::{Loads, of_walls, start_of_walls};
use super::measure::quantity::Quantity;
use super::measure::rest::{self, Pace};
use super::measure::{Probes, State};
use super::recorder::Recorder;
use super::schedule::between_rows;
use super::series_plots;
use super::stop::StopReport;
use super::summary::Parts;
use super::view::View;
use crate::dem::Dem;
use crate::geometry::Axis;
use crate::output::OutputError;
use crate::plan::grains::GrainPlan;
use crate::scene::dry::DryScene;
use crate::scene::{Measure, RestMeasure};
use crate::state::{State as _, StateError, Tape};
use files::Files;
use population::Population;

/// Sphere updates between two movements of the progress bar.
const UPDATES_PER_MOVE: u64 = 1_000_000;
/// Steps between two looks for grains that have left; they fly freely meanwhile.
const STEPS_PER_LOOK: u64 = 200;

/// Grains without fluid.
pub(super) struct Dry<'a> {
    scene: &'a DryScene,
    plan: &'a GrainPlan,
    dem: Dem,
    population: Population,
    probes: Probes,
    /// Loads on walls, looked at in every step.
    loads: Loads,
    files: Files<'a>,
}

impl<'a> Dry<'a> {
    /// The grains of a plan at time 0.
    ///
    /// # Errors
    /// The method refuses the set-up.
    pub(crate) fn start(
        scene: &'a DryScene,
        plan: &'a GrainPlan,
        recorder: &Recorder,
    ) -> Result<Self, RunError> {
        let refused = |error| RunError::Stopped(Box::new(stop::refused(&scene.file, &error)));
        let dem = Dem::new(&plan.setup).map_err(refused)?;
        let size_m = scene.domain.size_m;
        let probes = Probes::of_grains(scene);
        let rows = between_rows(scene.output.series, scene.stop.end_time_s);
        let about = |measure: &Measure| start_of_walls(plan, measure);
        let loads = Loads::new(&probes, rows, dem.time_step(), up(scene), &about);
        Ok(Self {
            population: Population::new(plan, size_m, &dem),
            probes,
            loads,
            files: Files::new(plan, size_m, Arc::clone(recorder.folder())),
            scene,
            plan,
            dem,
        })
    }

    fn view(&self) -> View<'_> {
        self.population.view(&self.dem, self.dem.time())
    }
}

/// The axis along which gravity is strongest; z without any.
fn up(scene: &DryScene) -> Axis {
    let direction = scene.gravity();
    let stronger = |most: Axis, axis: Axis| {
        if direction[axis.index()].abs() > direction[most.index()].abs() { axis } else { most }
    };
    [Axis::Y, Axis::X].into_iter().fold(Axis::Z, stronger)
}

impl Experiment for Dry<'_> {
    fn step(&self) -> u64 {
        self.dem.steps()
    }

    fn time_s(&self) -> f64 {
        self.dem.time()
    }

    fn step_s(&self) -> f64 {
        self.dem.time_step()
    }

    fn size(&self) -> u64 {
        self.dem.members().len() as u64
    }

    fn stride(&self) -> u64 {
        let stride = if self.loads.any() { 1 } else { (UPDATES_PER_MOVE / self.size().max(1)).max(1) };
        if self.population.has_open_faces() {
            stride.min(STEPS_PER_LOOK - self.step() % STEPS_PER_LOOK)
        } else {
            stride
        }
    }

    fn advance(&mut self, steps: u64) -> Result<(), Box<StopReport>> {
        let result = self.dem.step(steps);
        let report = |error| stop::report(&self.scene.file, self.plan, &self.population, &self.dem, &error);
        result.map_err(|error| Box::new(report(error)))?;
        let Some(open) = self.population.audit(&self.dem) else { return Ok(()) };
        let state = (&self.dem, self.dem.steps(), self.dem.time());
        Err(Box::new(stop::open_books(&self.scene.file, self.plan, &self.population, state, &open)))
    }

    /// Takes down the loads and takes out the free grains that are wholly beyond an open face.
    fn tidy(&mut self) {
        let (dem, walls) = (&self.dem, &self.plan.walls);
        self.loads.sample(dem.time(), &|measure, about| of_walls(dem, walls, measure, about));
        if !self.population.has_open_faces() {
            return;
        }
        if let Some(leaving) = self.population.leaving(&self.dem) {
            self.dem.retain(&leaving.stays, self.population.walls());
            self.population.book(&leaving, &self.dem);
        }
    }

    fn is_empty(&self) -> bool {
        self.population.nothing_left(&self.dem)
    }

    fn pace(&self, measure: RestMeasure) -> Pace {
        rest::of_grains(&self.view(), measure)
    }

    fn row(&mut self) -> Vec<(String, Vec<Quantity>)> {
        let view = self.population.view(&self.dem, self.dem.time());
        let grains = Grains { view, plan: self.plan };
        self.probes.row(&State { fluid: None, grains: Some(grains), contacts: None })
    }

    fn write_fields(&mut self) -> Result<(), OutputError> {
        Ok(())
    }

    fn write_grains(&mut self) -> Result<(), OutputError> {
        self.files.snapshot(&self.population.view(&self.dem, self.dem.time()))
    }

    fn finish(&self, recorder: &Recorder) -> Result<(), OutputError> {
        let view = self.view();
        self.files.tables(&view)?;
        series_plots::draw(recorder, &self.probes, &self.plan.numbers.title)?;
        pictures::picture(recorder, self.plan, self.scene.domain.size_m, &view)
    }

    fn loads(&self) -> Vec<LoadSummary> {
        self.loads.summaries()
    }

    fn line(&self) -> String {
        let view = self.view();
        let left = match view.left.number {
            0 => String::new(),
            number => format!(", {number} left"),
        };
        let contacts = self.dem.pair_counts().1;
        format!("largest speed {:.4e} m/s, {contacts} contacts{left}", view.max_speed())
    }

    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let Self { dem, population, probes, loads, files, scene: _, plan: _ } = self;
        if let Some(keep) = population.state(tape)? {
            dem.retain(&keep, population.walls());
        }
        dem.state(tape)?;
        probes.state(tape)?;
        loads.state(tape)?;
        files.state(tape)
    }

    fn parts(&self) -> Parts {
        Parts::Dry(Box::new(books::dry(&self.view())))
    }
}
