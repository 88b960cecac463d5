//! Which grains there are. Those that pass an open face are taken out and booked.

use crate::dem::{Dem, Setup, Shape, keep_marked};
use crate::plan::grains::GrainPlan;
use crate::run::view::{Left, View};
use crate::state::{State, StateError, Tape};

/// Largest share of the energy turned over that the books may leave unexplained. At the steps that are chosen single collisions
/// of every law stay below it (test `no_energy_is_made`).
pub(in crate::run) const UNEXPLAINED: f64 = 0.01;

/// Relative rounding of the energy of many grains: 1e-16 in each of a million terms, and ten times that.
const ROUNDING: f64 = 1e-9;

/// Books of energy that do not close.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::run) struct OpenBooks {
    /// J.
    pub unexplained_j: f64,
    /// Most energy that was seen to be stored, lost or brought in, J.
    pub turned_over_j: f64,
}

/// The grains still there, and those that have left.
pub(in crate::run) struct Population {
    /// The set-up of the grains still there.
    setup: Setup,
    /// Number at time 0 of each grain still there.
    ids: Vec<u32>,
    left: Left,
    /// Energy balance at time 0, J.
    start: f64,
    /// Most energy that was seen to be stored, lost or brought in, J.
    turned_over: f64,
    /// Faces through which grains leave, `[axis][low, high]`.
    open: [[bool; 2]; 3],
    /// Edge lengths of the box, m.
    size_m: [f64; 3],
}

/// Grains that are about to leave.
pub(in crate::run) struct Leaving {
    /// Whether each grain stays.
    pub stays: Vec<bool>,
    number: u64,
    mass_kg: f64,
    /// Energy balance before, J.
    before: f64,
}

impl Population {
    /// All grains of a plan in a box of edges `size_m`, m; `dem` at time 0.
    pub fn new(plan: &GrainPlan, size_m: [f64; 3], dem: &Dem) -> Self {
        Self {
            setup: plan.setup.clone(),
            ids: (0..dem.bodies().len() as u32).collect(),
            left: Left::default(),
            start: dem.energies().balance(),
            turned_over: 0.0,
            open: plan.open,
            size_m,
        }
    }

    /// Writes or reads which grains there are; after reading, of a population at time 0, which of all grains that is, if some have
    /// left.
    ///
    /// # Errors
    /// As [`State::state`].
    pub(crate) fn state(&mut self, tape: &mut Tape<'_>) -> Result<Option<Vec<bool>>, StateError> {
        let Self { setup, ids, left, start, turned_over, open: _, size_m: _ } = self;
        let all = ids.clone();
        ids.state(tape)?;
        left.state(tape)?;
        start.state(tape)?;
        turned_over.state(tape)?;
        if !tape.reads() || *ids == all {
            return Ok(None);
        }
        let keep: Vec<bool> = all.iter().map(|id| ids.binary_search(id).is_ok()).collect();
        if keep.iter().filter(|stays| **stays).count() != ids.len() {
            return Err(StateError::Malformed("its grains are none of the scene"));
        }
        keep_marked(&mut setup.grains, &keep);
        Ok(Some(keep))
    }

    /// The grains as they are at `time`, s.
    pub(crate) fn view<'a>(&'a self, dem: &'a Dem, time: f64) -> View<'a> {
        View { dem, setup: &self.setup, ids: &self.ids, left: self.left, start: self.start, time }
    }

    /// Looks at the books of energy; says what is wrong with them if they do not close.
    pub(crate) fn audit(&mut self, dem: &Dem) -> Option<OpenBooks> {
        let e = dem.energies();
        let unexplained = e.balance() + self.left.energy_j - self.start;
        let stored = e.mechanical() - e.potential;
        let now = stored + e.lost() + e.work_external.abs() + e.work_driven.abs();
        self.turned_over = self.turned_over.max(now);
        // What stands high above the origin has a large potential energy in which a small change is rounding.
        let rounding = ROUNDING * (e.potential.abs() + self.start.abs() + self.left.energy_j.abs());
        let closed = unexplained.abs() <= UNEXPLAINED * self.turned_over + rounding;
        (!closed).then_some(OpenBooks { unexplained_j: unexplained, turned_over_j: self.turned_over })
    }

    /// Whether grains can leave.
    pub(crate) fn has_open_faces(&self) -> bool {
        self.open.iter().flatten().any(|open| *open)
    }

    /// Whether grains have left and no free one is there any more.
    pub(crate) fn nothing_left(&self, dem: &Dem) -> bool {
        self.left.number > 0 && self.view(dem, 0.0).free().next().is_none()
    }

    /// Number at time 0 of a grain.
    pub(crate) fn number(&self, grain: usize) -> usize {
        self.ids.get(grain).map_or(grain, |&id| id as usize)
    }

    /// The free grains that are wholly beyond an open face; `None` if there is none.
    pub(crate) fn leaving(&self, dem: &Dem) -> Option<Leaving> {
        let b = dem.bodies();
        let stays = |i: usize| {
            let reach = reach(dem, &self.setup, i);
            let gone = |k: usize| {
                let x = b.position[i][k];
                let [low, high] = self.open[k];
                (low && x < -reach) || (high && x > self.size_m[k] + reach)
            };
            b.inverse_mass[i] == 0.0 || !(0..3).any(gone)
        };
        let stays: Vec<bool> = (0..b.len()).map(stays).collect();
        if !stays.contains(&false) {
            return None;
        }
        let gone = || stays.iter().enumerate().filter(|(_, stays)| !**stays);
        let (number, mass_kg) = (gone().count() as u64, gone().map(|(i, _)| b.mass[i]).sum());
        Some(Leaving { number, mass_kg, before: dem.energies().balance(), stays })
    }

    /// Walls of the set-up.
    pub(crate) fn walls(&self) -> usize {
        self.setup.walls.len()
    }

    /// Books grains that were taken out; `dem` is without them.
    pub(crate) fn book(&mut self, leaving: &Leaving, dem: &Dem) {
        keep_marked(&mut self.setup.grains, &leaving.stays);
        keep_marked(&mut self.ids, &leaving.stays);
        self.left.number += leaving.number;
        self.left.mass_kg += leaving.mass_kg;
        self.left.energy_j += leaving.before - dem.energies().balance();
    }
}

/// Largest distance of a point of a grain from its centre, m.
fn reach(dem: &Dem, setup: &Setup, i: usize) -> f64 {
    let b = dem.bodies();
    match setup.grains[i].shape {
        Shape::Sphere => b.radius[i],
        Shape::Clump(k) => {
            let clump = &setup.clumps[k];
            clump.reach * b.radius[i] / clump.equivalent_radius()
        }
    }
}
