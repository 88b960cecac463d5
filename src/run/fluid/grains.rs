//! The grains in a fluid: which there are, their files, their books.

use std::sync::Arc;

use crate::coupling::Immersed;
use crate::output::OutputError;
use crate::plan::coupled::Coupled;
use crate::run::grains::books::{self, fingerprint};
use crate::run::grains::files::Files;
use crate::run::grains::pictures;
use crate::run::grains::population::Population;
use crate::run::grains::stop;
use crate::run::measure::contacts::Contacts;
use crate::run::measure::grains::Grains;
use crate::run::recorder::Recorder;
use crate::run::stop::StopReport;
use crate::run::summary::{CoupledPart, CouplingPart};
use crate::solver::run::Run;
use crate::state::{State, StateError, Tape};
use crate::units::Units;

/// The grains in a fluid.
pub(super) struct InFluid<'a> {
    coupled: &'a Coupled,
    pub population: Population,
    files: Files<'a>,
    /// Forces on the solids.
    pub contacts: Contacts<'a>,
}

impl<'a> InFluid<'a> {
    /// The grains at time 0.
    pub fn new(coupled: &'a Coupled, grains: &Immersed, recorder: &Recorder) -> Self {
        let (plan, size_m) = (&coupled.grains, coupled.scene.domain.size_m);
        Self {
            coupled,
            population: Population::new(plan, size_m, grains.dem()),
            files: Files::new(plan, size_m, Arc::clone(recorder.folder())),
            contacts: Contacts::new(&plan.walls),
        }
    }

    /// Writes or reads everything but what the run itself keeps; takes out of that the grains that had left.
    ///
    /// # Errors
    /// As [`State::state`].
    pub(crate) fn state(&mut self, run: &mut dyn Run, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let Self { population, files, contacts, coupled: _ } = self;
        if let Some(keep) = population.state(tape)? {
            run.leave(&keep);
        }
        files.state(tape)?;
        contacts.state(tape)
    }

    /// The grains as they are at `time`, s.
    pub(crate) fn grains<'b>(&'b self, grains: &'b Immersed, time: f64) -> Grains<'b> {
        Grains { view: self.population.view(grains.dem(), time), plan: &self.coupled.grains }
    }

    /// Takes out the free grains that are wholly beyond an open face.
    pub(crate) fn take_out(&mut self, run: &mut dyn Run) {
        let leaving = run.grains().and_then(|grains| self.population.leaving(grains.dem()));
        let Some(leaving) = leaving else { return };
        run.leave(&leaving.stays);
        if let Some(grains) = run.grains() {
            self.population.book(&leaving, grains.dem());
        }
    }

    /// Looks at the books of energy of the grains after a step of the fluid; a report if they do not close.
    pub(crate) fn audit(
        &mut self,
        file: &str,
        grains: &Immersed,
        (step, time_s): (u64, f64),
    ) -> Option<StopReport> {
        let open = self.population.audit(grains.dem())?;
        let (plan, state) = (&self.coupled.grains, (grains.dem(), step, time_s));
        Some(stop::open_books(file, plan, &self.population, state, &open))
    }

    /// Writes grains, contacts and walls.
    pub(crate) fn snapshot(&mut self, grains: &Immersed, time: f64) -> Result<(), OutputError> {
        self.files.snapshot(&self.population.view(grains.dem(), time))
    }

    /// Tables a scene can start from.
    pub(crate) fn tables(&self, grains: &Immersed, time: f64) -> Result<(), OutputError> {
        self.files.tables(&self.population.view(grains.dem(), time))
    }

    /// The grains seen from the side.
    pub(crate) fn picture(
        &self,
        grains: &Immersed,
        time: f64,
        recorder: &Recorder,
    ) -> Result<(), OutputError> {
        let view = self.population.view(grains.dem(), time);
        pictures::picture(recorder, &self.coupled.grains, self.coupled.scene.domain.size_m, &view)
    }

    /// The books at a time, s.
    pub(crate) fn part(&self, run: &dyn Run, units: &Units, time: f64) -> Option<CoupledPart> {
        let grains = run.grains()?;
        let view = self.population.view(grains.dem(), time);
        Some(CoupledPart {
            grains: books::part(&view),
            coupling: coupling(run, grains, units),
            unexplained_j: view.unexplained(),
            fingerprint: fingerprint(grains.dem()).hash,
        })
    }
}

/// What went between grains and fluid.
fn coupling(run: &dyn Run, grains: &Immersed, units: &Units) -> CouplingPart {
    let mass = units.rho0_kg_per_m3 * units.dx_m * units.dx_m * units.dx_m;
    let momentum = mass * units.velocity_unit();
    let vector = |v: [f64; 3]| v.map(|x| x * momentum);
    let (books, ledger) = (grains.books(), run.ledger().unwrap_or_default());
    let [links, covered, freed] = books.masses().map(|m| m * mass);
    let [link_momentum, covered_momentum, freed_momentum] = books.momenta().map(vector);
    CouplingPart {
        sub_steps: grains.config().sub_steps,
        covered_cells: grains.covered_cells(None),
        cells_covered: books.covered,
        cells_freed: books.freed,
        mass_from_grains_kg: ledger.mass_from_grains * mass,
        mass_over_links_kg: links,
        mass_covered_kg: covered,
        mass_freed_kg: freed,
        from_grains_n_s: vector(ledger.from_grains),
        over_links_n_s: link_momentum,
        covered_n_s: covered_momentum,
        freed_n_s: freed_momentum,
        gradient_pa_per_m: grains.gradient().map(|g| units.force_to_si(g)),
    }
}
