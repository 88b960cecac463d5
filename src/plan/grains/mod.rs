//! Scene without fluid to plan: the set-up of the discrete element method, its time step, its cost.

mod beside;
mod materials;
mod meshes;
mod numbers;
mod place;
mod print;
pub(super) mod speed;
mod walls;
mod within;

use std::fmt;
use std::ops::Range;

pub use numbers::GrainNumbers;
pub(crate) use place::COLUMNS;
pub use walls::Walls;

use super::disk;
use super::error::{PlanError, PlanProblem};
use crate::dem::{self, DemError, Setup};
use crate::scene::Boundary;
use crate::scene::dry::{DryScene, IntegratorChoice};

const NO_CONTACT_TIME: PlanProblem =
    PlanProblem::GrainScale { quantity: "the duration of the shortest contact" };

/// Walls and grains of a scene, without a time step.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    pub setup: Setup,
    pub sets: Vec<(String, Range<usize>)>,
    pub walls: Walls,
    pub open: [[bool; 2]; 3],
}

/// Everything a dry run needs, worked out before it starts.
#[derive(Clone, Debug)]
pub struct GrainPlan {
    /// What the discrete element method is asked to run; its time step is set.
    pub setup: Setup,
    /// Names of the sets and the numbers of their grains.
    pub sets: Vec<(String, Range<usize>)>,
    /// Which walls of the set-up belong to which face or solid.
    pub walls: Walls,
    /// Faces through which grains leave, `[axis][low, high]`.
    pub open: [[bool; 2]; 3],
    /// Steps to the end time.
    pub steps: u64,
    /// What `lahar plan` prints.
    pub numbers: GrainNumbers,
}

impl GrainPlan {
    /// Plans a scene on this machine.
    ///
    /// # Errors
    /// Grains that overlap, do not fit, or are outside; a time step too long; files that cannot be read; too little
    /// memory.
    pub fn new(scene: &DryScene) -> Result<Self, PlanError> {
        Self::with_memory(scene, super::memory::available())
    }

    /// Plans a scene as if `available` bytes of memory were free; `None` does not look at memory.
    ///
    /// # Errors
    /// As [`GrainPlan::new`].
    pub fn with_memory(scene: &DryScene, available: Option<u64>) -> Result<Self, PlanError> {
        let placed = Self::placed(scene, available)?;
        let speed = speed::design(scene, &placed.setup);
        let mut plan = Self::finish(scene, placed, speed, None)?;
        let n = &mut plan.numbers;
        let written = disk::Grains { grains: n.grains, clumps: n.clumps, spheres: n.spheres };
        n.files = disk::dry(scene, written, plan.steps);
        n.warnings.extend(disk::warning(&n.files, disk::free()));
        Ok(plan)
    }

    /// Walls and grains, without a time step.
    ///
    /// # Errors
    /// Grains that do not fit or are outside; files that cannot be read; too little memory.
    pub(super) fn placed(scene: &DryScene, available: Option<u64>) -> Result<Placed, PlanError> {
        let at = |path: &str, problem| PlanError::new(&scene.file, path, problem);
        let (table, slippery) = materials::materials(scene);
        let mut setup = Setup::new(table);
        let (walls, pieces) = walls::walls(scene, slippery).map_err(|(path, problem)| at(&path, problem))?;
        setup.walls = pieces;
        let sets =
            place::place(scene, &mut setup, available).map_err(|(path, problem)| at(&path, problem))?;
        let faces = scene.domain.boundaries.by_axis();
        for axis in 0..3 {
            let periodic = faces[axis][0] == Boundary::Periodic;
            setup.period.0[axis] = periodic.then_some(scene.domain.size_m[axis]);
        }
        let open = faces.map(|pair| pair.map(|face| face == Boundary::Open));
        place::inside(scene, &setup, &sets, open).map_err(|(path, problem)| at(&path, problem))?;
        within::outside_solids(scene, &setup, &sets).map_err(|(path, problem)| at(&path, problem))?;
        setup.gravity = scene.gravity().into();
        numerics(scene, &mut setup);
        Ok(Placed { setup, sets, walls, open })
    }

    /// Time step and checks; `speed` is that of the fastest impact to be expected, m/s; `idle_step_s`: the step where nothing
    /// can be pushed, s; without one such a scene is refused.
    ///
    /// # Errors
    /// Grains that overlap; a time step too long.
    pub(super) fn finish(
        scene: &DryScene,
        placed: Placed,
        speed: f64,
        idle_step_s: Option<f64>,
    ) -> Result<Self, PlanError> {
        let at = |path: &str, problem| PlanError::new(&scene.file, path, problem);
        let Placed { mut setup, sets, walls, open } = placed;
        let given = scene.grains.numerics.design_speed_m_per_s;
        if !speed.is_finite() {
            return Err(at(
                "grains",
                PlanProblem::GrainScale { quantity: "the speed of the fastest impact" },
            ));
        }
        // Where nothing can be pushed, no speed is too low.
        let idle_step_s = idle_step_s.filter(|_| setup.grains.iter().all(|grain| grain.driven));
        let least = idle_step_s.map(|_| 1.0);
        let Some(design) = given.or(Some(speed).filter(|&v| v > 0.0)).or(least) else {
            return Err(at("grains.numerics", PlanProblem::NoDesignSpeed));
        };
        setup.design_speed_m_s = design;
        let refused = |error: DemError| refusal(scene, &sets, error);
        let pace = match dem::pace(&setup) {
            // Any step is short enough for it, so only a time that is no time is refused.
            Err(DemError::TimeStep { .. } | DemError::Unstable { .. }) => Err(at("grains", NO_CONTACT_TIME)),
            other => other.map_err(refused),
        };
        let Some(pace) = pace?.or(idle_step_s.map(dem::Pace::idle)) else {
            return Err(at("grains.sets", PlanProblem::NothingMoves));
        };
        if !(pace.suggested_s > 0.0 && pace.suggested_s.is_finite()) {
            return Err(at("grains", NO_CONTACT_TIME));
        }
        let dt = scene.grains.numerics.time_step_s.unwrap_or(pace.suggested_s);
        setup.time_step_s = Some(dt);
        let steps = count_steps(scene, dt).map_err(|problem| at("stop.end_time_s", problem))?;
        // The checks that need neighbours: overlaps, the time step, periods.
        let dem = dem::Dem::new(&setup).map_err(refused)?;
        let numbers = numbers::numbers(scene, &setup, &dem, &pace, steps, speed);
        Ok(Self { setup, sets, walls, open, steps, numbers })
    }

    /// What people call a grain: set and number within it.
    #[must_use]
    pub fn name(&self, grain: usize) -> String {
        name(&self.sets, grain)
    }
}

impl fmt::Display for GrainPlan {
    /// The table of `lahar plan`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        print::table(f, &self.numbers)
    }
}

pub(super) fn name(sets: &[(String, Range<usize>)], grain: usize) -> String {
    let of = sets.iter().find(|(_, range)| range.contains(&grain));
    of.map_or_else(
        || format!("grain {grain}"),
        |(set, range)| format!("grain {} of set `{set}`", grain - range.start),
    )
}

fn numerics(scene: &DryScene, setup: &mut Setup) {
    let n = &scene.grains.numerics;
    setup.integrator = match n.integrator {
        IntegratorChoice::Verlet => dem::Integrator::Verlet,
        IntegratorChoice::Gear => dem::Integrator::Gear,
        IntegratorChoice::GearConservative => dem::Integrator::GearConservative,
    };
    let set = |target: &mut f64, value: Option<f64>| *target = value.unwrap_or(*target);
    set(&mut setup.steps_per_contact, n.steps_per_contact);
    set(&mut setup.overlap_limit, n.overlap_limit);
    set(&mut setup.start_overlap, n.start_overlap);
    set(&mut setup.skin, n.skin);
    setup.turn_spheres = true;
}

/// Steps to the end: whole numbers that 64-bit floating point holds exactly.
fn count_steps(scene: &DryScene, dt: f64) -> Result<u64, PlanProblem> {
    let end = scene.stop.end_time_s;
    let steps = (end / dt).round();
    if steps < 1.0 {
        return Err(PlanProblem::NoGrainStep { end, dt });
    }
    if steps > 9e15 {
        return Err(PlanProblem::TooManySteps { steps, dt, end });
    }
    Ok(steps as u64)
}

/// The refusals of the discrete element method, with names and paths of the scene.
pub(super) fn refusal(scene: &DryScene, sets: &[(String, Range<usize>)], error: DemError) -> PlanError {
    let (path, problem) = match error {
        DemError::StartOverlap { first, second, overlap_m, allowed_m } => {
            let (first, second) = (name(sets, first), name(sets, second));
            ("grains.sets", PlanProblem::GrainsOverlap { first, second, overlap_m, allowed_m })
        }
        DemError::StartOverlapWall { grain, wall, overlap_m, allowed_m } => {
            let (first, second) = (name(sets, grain), format!("wall `{wall}`"));
            ("grains.sets", PlanProblem::GrainsOverlap { first, second, overlap_m, allowed_m })
        }
        DemError::TimeStep { found_s, pair, contact_s, speed_m_s, steps, limit_s } => (
            "grains.numerics.time_step_s",
            PlanProblem::GrainTimeStep { found_s, pair, contact_s, speed_m_s, steps, limit_s },
        ),
        DemError::Unstable { found_s, pair, motion, speed_m_s, limit_s, advised_s } => (
            "grains.numerics.time_step_s",
            PlanProblem::GrainStepUnstable { found_s, pair, motion, speed_m_s, limit_s, advised_s },
        ),
        DemError::PeriodTooShort { axis, length_m, needed_m } => {
            ("domain.size_m", PlanProblem::GrainPeriod { axis, length_m, needed_m })
        }
        other => ("grains", PlanProblem::Grains { what: other.to_string() }),
    };
    PlanError::new(&scene.file, path, problem)
}
