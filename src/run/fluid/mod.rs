//! A fluid, with or without grains in it, as the driver moves it.

mod books;
mod files;
mod grains;
mod guard;
mod mesh;
mod pictures;
mod stop;

use std::sync::Arc;

use super::error::RunError;
use super::experiment::Experiment;
use super::load_summary::LoadSummary;
use super::measure::fields::max_speed;
use super::measure::fluid::{Fluid, Frame};
use super::measure::loads::{Loads, of_flow, start_of_moments};
use super::measure::quantity::Quantity;
use super::measure::rest::{self, Pace};
use super::measure::{Probes, State};
use super::recorder::Recorder;
use super::schedule::between_rows;
use super::series_plots;
use super::stop::StopReport;
use super::summary::Parts;
use crate::output::OutputError;
use crate::plan::Plan;
use crate::scene::{FieldChoice, Measure, RestMeasure, Scene};
use crate::solver::run::{Backend, Fields, Run};
use crate::solver::steady::{SteadyOutcome, Watch, push};
use crate::state::{State as _, StateError, Tape, part};
use files::{Files, Shot};
use grains::InFluid;
use guard::MassWatch;
use pictures::Plots;

/// Cell updates between two movements of the progress bar.
const UPDATES_PER_MOVE: u64 = 2_000_000;
/// Steps between two looks for grains that have left; what is beyond a face has no fluid around it.
const STEPS_PER_LOOK: u64 = 50;

/// A fluid, with or without grains in it.
pub(super) struct Flow<'a> {
    scene: &'a Scene,
    plan: &'a Plan,
    run: Box<dyn Run>,
    /// As they were at the last look.
    fields: Fields,
    frame: Frame,
    probes: Probes,
    files: Files<'a>,
    grains: Option<InFluid<'a>>,
    /// Loads on solids, looked at in every step.
    loads: Loads,
    /// Mass at time 0, and when to look at it.
    mass: MassWatch,
    /// Looks for steadiness, where the scene asks for it.
    watch: Option<Watch>,
}

impl<'a> Flow<'a> {
    /// The fluid of a plan at time 0.
    ///
    /// # Errors
    /// The backend refuses the set-up.
    pub(crate) fn start(
        scene: &'a Scene,
        plan: &'a Plan,
        backend: &dyn Backend,
        threads: usize,
        recorder: &Recorder,
    ) -> Result<Self, RunError> {
        let mut setup = plan.setup.clone();
        setup.threads = threads;
        let run = backend.start(&setup).map_err(RunError::Start)?;
        let probes = Probes::of_flow(scene);
        let grains = plan.grains.as_ref().zip(run.grains());
        let grains = grains.map(|(coupled, grains)| InFluid::new(coupled, grains, recorder));
        let rows = between_rows(scene.output.series, scene.stop.end_time_s);
        let about = |measure: &Measure| start_of_moments(scene, plan, measure);
        let loads = Loads::new(&probes, rows, plan.units.dt_s, crate::scene::force::up(scene).0, &about);
        Ok(Self {
            loads,
            fields: run.fields(),
            mass: MassWatch { start: run.totals().mass_excess, end: u64::MAX },
            frame: Frame::new(scene, plan.units),
            files: Files::new(&plan.setup, FieldChoice::of(scene), Arc::clone(recorder.folder())),
            watch: None,
            scene,
            plan,
            run,
            probes,
            grains,
        })
    }

    /// Looks for steadiness from now to the step `end` if the scene asks for it.
    pub(crate) fn watch(&mut self, end: u64) {
        let watch = self.scene.stop.steady.map(|rule| {
            let interval = self.plan.units.time_to_lattice(rule.check_every_s);
            Watch::new(rule.tolerance, interval, self.run.step(), end)
        });
        self.watch = watch;
        self.mass.end = end;
        // The first look is at the start.
        self.is_steady();
    }

    /// Takes down what every step brings to solids and walls.
    fn sample_loads(&mut self) {
        if !self.loads.any() {
            return;
        }
        let time = self.time_s();
        let fluid = Fluid { run: self.run.as_ref(), fields: &self.fields, frame: &self.frame };
        let walls = self.plan.grains.as_ref().map(|coupled| &coupled.grains.walls);
        let grains = self.run.grains().zip(walls);
        self.loads.sample(time, &|measure, about| of_flow(&fluid, grains, measure, about));
    }

    fn opens(&self) -> bool {
        self.grains.as_ref().is_some_and(|grains| grains.population.has_open_faces())
    }
}

impl Experiment for Flow<'_> {
    fn step(&self) -> u64 {
        self.run.step()
    }

    fn time_s(&self) -> f64 {
        self.plan.units.time_to_si(self.run.step() as f64)
    }

    fn step_s(&self) -> f64 {
        self.plan.units.dt_s
    }

    fn size(&self) -> u64 {
        self.run.fluid_cells()
    }

    fn stride(&self) -> u64 {
        let stride = if self.loads.any() { 1 } else { (UPDATES_PER_MOVE / self.size().max(1)).max(1) };
        let stride = stride.min(self.mass.stride(self.step()));
        if self.opens() { stride.min(STEPS_PER_LOOK - self.step() % STEPS_PER_LOOK) } else { stride }
    }

    fn advance(&mut self, steps: u64) -> Result<(), Box<StopReport>> {
        let population = self.grains.as_ref().map(|grains| &grains.population);
        let number = |grain: u32| population.map_or(grain as usize, |all| all.number(grain as usize));
        let moved = self.run.advance(steps);
        if let Err(stopped) = moved.and_then(|()| self.mass.look(self.run.as_ref())) {
            let failure = self.run.grains().and_then(|grains| grains.failure());
            return Err(Box::new(stop::report(&self.scene.file, self.plan, &stopped, failure, &number)));
        }
        let now = (self.step(), self.time_s());
        let report = match (&mut self.grains, self.run.grains()) {
            (Some(part), Some(grains)) => part.audit(&self.scene.file, grains, now),
            _ => None,
        };
        report.map_or(Ok(()), |report| Err(Box::new(report)))
    }

    fn tidy(&mut self) {
        let opens = self.opens();
        self.sample_loads();
        let Some(grains) = &mut self.grains else { return };
        if let (true, Some(immersed)) = (self.loads.any(), self.run.grains()) {
            grains.contacts.sample(immersed, self.plan.units.dt_s);
        }
        if opens && self.run.step().is_multiple_of(STEPS_PER_LOOK) {
            grains.take_out(self.run.as_mut());
        }
    }

    fn look(&mut self) {
        // The old fields go before the new ones come: never two sets at a time.
        drop(std::mem::take(&mut self.fields));
        self.fields = self.run.fields();
    }

    fn next_look(&self) -> u64 {
        self.watch.as_ref().map_or(u64::MAX, Watch::next)
    }

    fn is_steady(&mut self) -> bool {
        let step = self.run.step();
        let Some(watch) = &mut self.watch else { return false };
        watch.next() == step && watch.look(step, &self.fields, push(self.run.as_ref()))
    }

    fn steadiness(&self) -> Option<SteadyOutcome> {
        self.watch.as_ref().map(Watch::outcome)
    }

    /// Of fluid and grains, each by itself.
    fn pace(&self, measure: RestMeasure) -> Pace {
        let fluid = Fluid { run: self.run.as_ref(), fields: &self.fields, frame: &self.frame };
        let fluid = rest::of_fluid(&fluid, measure);
        match self.grains.as_ref().zip(self.run.grains()) {
            Some((part, grains)) => fluid.or(rest::of_grains(&part.grains(grains, 0.0).view, measure)),
            None => fluid,
        }
    }

    fn row(&mut self) -> Vec<(String, Vec<Quantity>)> {
        let (run, time) = (self.run.as_ref(), self.time_s());
        let grains = self.grains.as_ref().zip(run.grains());
        let row = self.probes.row(&State {
            fluid: Some(Fluid { run, fields: &self.fields, frame: &self.frame }),
            grains: grains.map(|(part, grains)| part.grains(grains, time)),
            contacts: self.grains.as_ref().map(|grains| &grains.contacts),
        });
        if let Some(grains) = &mut self.grains {
            grains.contacts.restart();
        }
        row
    }

    fn write_fields(&mut self) -> Result<(), OutputError> {
        let covered = self.run.grains().map(|grains| {
            let cells = 0..self.plan.setup.cells();
            cells.map(|cell| u8::from(grains.is_covered(cell))).collect::<Vec<u8>>()
        });
        let (time_s, covered) = (self.time_s(), covered.as_deref());
        let shot = Shot { time_s, fields: &self.fields, frame: &self.frame, covered };
        self.files.snapshot(&shot, self.probes.iter().map(|listed| &listed.probe))
    }

    fn write_grains(&mut self) -> Result<(), OutputError> {
        let time = self.time_s();
        match (&mut self.grains, self.run.grains()) {
            (Some(part), Some(grains)) => part.snapshot(grains, time),
            _ => Ok(()),
        }
    }

    fn finish(&self, recorder: &Recorder) -> Result<(), OutputError> {
        let title = &self.plan.numbers.title;
        let grains = self.grains.as_ref().zip(self.run.grains());
        if let Some((part, grains)) = grains {
            part.tables(grains, self.time_s())?;
        }
        let plots = Plots {
            recorder,
            title,
            setup: &self.plan.setup,
            frame: &self.frame,
            fields: &self.fields,
            sections: &self.files.sections,
            has_grains: self.grains.is_some(),
        };
        series_plots::draw(recorder, &self.probes, title)?;
        plots.draw(&self.probes)?;
        let Some((part, grains)) = grains else { return Ok(()) };
        part.picture(grains, self.time_s(), recorder)
    }

    fn loads(&self) -> Vec<LoadSummary> {
        self.loads.summaries()
    }

    fn line(&self) -> String {
        let speed = self.plan.units.velocity_to_si(max_speed(&self.fields));
        format!("largest speed {speed:.4e} m/s")
    }

    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let Self {
            run,
            probes,
            files,
            grains,
            loads,
            mass: MassWatch { start: mass_at_start, end: _ },
            watch,
            scene: _,
            plan: _,
            fields: _,
            frame: _,
        } = self;
        if let Some(grains) = grains {
            grains.state(run.as_mut(), tape)?;
        }
        run.state(tape)?;
        probes.state(tape)?;
        files.state(tape)?;
        loads.state(tape)?;
        mass_at_start.state(tape)?;
        part(watch, tape)
    }

    fn parts(&self) -> Parts {
        let run = self.run.as_ref();
        let grains = self.grains.as_ref().and_then(|part| part.part(run, &self.plan.units, self.time_s()));
        Parts::Fluid(Box::new(books::part(self.plan, run, &self.fields, self.mass.start, grains)))
    }
}
