//! Scene to plan: lattice numbers, what the run needs, what it does not, and what it costs.

mod cells;
mod checks;
mod choose;
mod cost;
pub mod coupled;
mod disk;
mod drawn;
mod error;
pub mod expected;
mod facts;
mod fastest;
mod figures;
mod film_error;
pub mod grains;
mod holding;
mod initial;
mod judge;
mod limits;
mod lower;
pub mod memory;
mod moving;
mod nearest_flow;
mod needs;
mod numbers;
mod oblique;
mod planned;
mod print;
mod print_target;
mod scale;
mod seek;
mod slits;
mod surface;
mod surface_checks;
mod swept;
pub mod target;
mod text;
mod time_step;
pub mod wall_error;
mod warning;
mod warnings;
mod ways;
pub mod work;

use std::fmt;

pub use disk::Files;
pub use error::{PlanError, PlanProblem};
pub use memory::available as available_memory;
pub use needs::Need;
pub use numbers::Numbers;
pub use oblique::Residual;
pub use planned::Planned;
pub use time_step::StepRule;
pub use warning::Warning;
pub use ways::{Way, Ways};

use self::cells::Cells;
use self::coupled::{Coupled, Findings};
use self::facts::Facts;
use self::figures::Basis;
use self::judge::{Flow, Judged};
use self::numbers::Given;
use self::seek::Refused;
use crate::scene::Scene;
use crate::setup::Setup;
pub use crate::solver::layout::Layout;
use crate::units::Units;

/// Everything a run needs, worked out before it starts.
#[derive(Clone)]
pub struct Plan {
    /// The scales between SI and lattice.
    pub units: Units,
    /// What the backend is asked to run.
    pub setup: Setup,
    /// Steps to the end time.
    pub steps: u64,
    /// The grains; `None` without any.
    pub grains: Option<coupled::Coupled>,
    /// What `lahar plan` prints.
    pub numbers: Numbers,
}

impl Plan {
    /// Plans a scene on this machine.
    ///
    /// # Errors
    /// The scene is too large, too fast, unstable, or has no fluid.
    pub fn new(scene: &Scene) -> Result<Self, PlanError> {
        Self::with_memory(scene, memory::available())
    }

    /// Plans a scene on this machine for a backend of this layout.
    ///
    /// # Errors
    /// As [`Plan::new`].
    pub(crate) fn for_layout(scene: &Scene, layout: Layout) -> Result<Self, PlanError> {
        Self::with_layout(scene, layout, memory::available())
    }

    /// Plans a scene as if `available` bytes of memory were free; `None` checks only that cells
    /// can be numbered.
    ///
    /// # Errors
    /// As [`Plan::new`].
    pub fn with_memory(scene: &Scene, available: Option<u64>) -> Result<Self, PlanError> {
        Self::with_layout(scene, Layout::default(), available)
    }

    /// Plans a scene for a backend of this layout, as if `available` bytes of memory were free.
    ///
    /// # Errors
    /// As [`Plan::new`].
    pub fn with_layout(scene: &Scene, layout: Layout, available: Option<u64>) -> Result<Self, PlanError> {
        // Ways out are named once they were tried; the attempts look for none themselves.
        let accepts = |changed: &Scene| Self::attempt(changed, layout, available, None).is_ok();
        Self::attempt(scene, layout, available, Some(&accepts))
    }

    /// One pass through all checks; `accepts` tries the changes of the scene that a refusal names.
    fn attempt(
        scene: &Scene,
        layout: Layout,
        available: Option<u64>,
        accepts: Option<&dyn Fn(&Scene) -> bool>,
    ) -> Result<Self, PlanError> {
        let at = |path: &str, problem| PlanError::new(&scene.file, path, problem);
        checks::least_memory(scene, layout, available).map_err(|problem| at("domain", problem))?;
        checks::shapes(scene).map_err(|(path, problem)| at(&path, problem))?;
        surface_checks::recesses(scene).map_err(|(path, problem)| at(&path, problem))?;
        let facts = Facts::of(scene);
        let cells = cells::fill(&facts);
        checks::some_fluid(&cells).map_err(|problem| at("solids", problem))?;
        surface_checks::surface(&facts, &cells).map_err(|(path, problem)| at(&path, problem))?;
        let mut scales = scale::scales(&facts, &cells);
        let started = coupled::start(&facts, &cells, &mut scales, available)?;
        let grains = started.as_ref().map_or(0.0, coupled::Started::fastest);
        let flow = Flow { facts: &facts, scales: &scales, gap: cells.gap, grains };
        let (dt, rule) =
            choose::choose(&flow, cells.pool.as_ref()).map_err(|problem| at("numerics", problem))?;
        let judged = Judged::at(&flow, dt);
        // Found here, where the cells are at hand, and reported after what is wrong with the set-up itself.
        let verdict = step(&judged, &flow, &cells, rule, accepts);
        let units = time_step::units(scene, dt);
        let steps = checks::steps(scene, dt).map_err(|problem| at("stop.end_time_s", problem))?;
        let mut given = scale::given_speeds(&facts, &cells);
        given.bodies += started.as_ref().map_or(0.0, |started| started.given);
        let (gap, fluid_cells, pool) = (cells.gap, cells.fluid_cells, cells.pool);
        // Not for the attempts, of which only the verdict counts.
        let drawn = if accepts.is_some() {
            [slits::warnings(scene, &cells), drawn::warnings(scene, &cells)].concat()
        } else {
            Vec::new()
        };
        let mut setup = lower::lower(&facts, &units, cells);
        let finished = started
            .map(|started| started.finish(&facts, &units, &scales, &mut setup, rule.path()))
            .transpose()?;
        setup.speed_limit = fastest::limit(&facts, &units, &given, setup.speed_limit);
        checks::memory(scene, &setup, layout, available).map_err(|problem| at("domain", problem))?;
        checks::finite(&setup).map_err(|problem| at("fluid", problem))?;
        checks::moving_solids(scene, &setup, &units).map_err(|(path, problem)| at(&path, problem))?;
        verdict.map_err(|(path, problem)| at(path, problem))?;
        let basis = Basis { facts: &facts, units: &units, setup: &setup, scales: &scales, steps, gap, pool };
        let mut numbers = shown(&Given { basis, judged, rule, fluid_cells, layout }, finished.as_ref());
        numbers.warnings.extend(drawn);
        let days = numbers.estimated_seconds / 86_400.0;
        numbers.warnings.extend((days > 1.0).then_some(Warning::Days { days }));
        let most = numbers.bytes_at_most.zip(available).filter(|(most, available)| most > available);
        numbers.warnings.extend(most.map(|(bytes, available)| Warning::MemoryLater { bytes, available }));
        Ok(Self { units, setup, steps, grains: finished.map(|(coupled, _)| coupled), numbers })
    }
}

/// Whether the gap and the time step will do; where not, with what would.
fn step(
    judged: &Judged,
    flow: &Flow,
    cells: &Cells,
    rule: StepRule,
    accepts: Option<&dyn Fn(&Scene) -> bool>,
) -> Result<(), (&'static str, PlanProblem)> {
    let found = |search: fn(&Refused) -> Ways| {
        accepts.map_or_else(Ways::default, |accepts| {
            search(&Refused { flow: *flow, cells, dt: judged.dt, rule, accepts })
        })
    };
    checks::wide_enough(flow, || found(seek::spacing)).map_err(|problem| ("domain.spacing_m", problem))?;
    judged.verdict(|| judged.stable_speed(), || found(seek::ways)).map_err(|problem| (rule.path(), problem))
}

/// Everything `lahar plan` shows.
fn shown(given: &Given, coupled: Option<&(Coupled, Findings)>) -> Numbers {
    let Basis { facts, units, setup, scales, pool, .. } = given.basis;
    let mut numbers = numbers::numbers(given);
    numbers.warnings = warnings::warnings(&numbers, &given.basis);
    let written = coupled.map(|(coupled, _)| {
        let n = &coupled.grains.numbers;
        disk::Grains { grains: n.grains, clumps: n.clumps, spheres: n.spheres }
    });
    numbers.files = disk::flow(facts.scene, setup, written, numbers.steps);
    numbers.warnings.extend(disk::warning(&numbers.files, disk::free()));
    if let Some((coupled, findings)) = coupled {
        let open = (setup.cells() as u64 - numbers.solid_cells) as f64 * units.dx_m * units.dx_m * units.dx_m;
        let mixture_m3 = pool.map_or(open, |pool| pool.volume);
        let grains = coupled::Given { facts, units, setup, coupled, findings, scales, mixture_m3 };
        let (grains, warnings) = coupled::numbers(&grains);
        numbers.estimated_seconds +=
            cost::of_grains(0.0, grains.sphere_updates) + cost::of_links(numbers.steps as f64, grains.links);
        numbers.warnings.extend(warnings);
        numbers.grains = Some(grains);
    }
    numbers
}

impl fmt::Debug for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Plan")
            .field("units", &self.units)
            .field("numbers", &self.numbers)
            .finish_non_exhaustive()
    }
}

impl fmt::Display for Plan {
    /// The table of `lahar plan`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        print::table(f, &self.numbers)
    }
}
