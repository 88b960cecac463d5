//! Which spacing to choose where random scenes tell the error of a scene and the table of work and precision does not.

use serde::Serialize;

use super::Plan;
use super::expected::{Expectation, FLOOR, Interval};
use super::facts::Facts;
use super::numbers::Numbers;
use super::seek::gcd;
use crate::scene::Scene;

/// What random scenes say about a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Swept {
    /// Why the table of work and precision says nothing.
    pub why: String,
    /// Errors to expect of the scene as written.
    pub as_written: Vec<Interval>,
    /// Whether a spacing was found that reaches the target; if not, `spacing_m` is the finest that was tried.
    pub reached: bool,
    /// m.
    pub spacing_m: f64,
    /// `domain.size_m`: axes of one cell stay one cell thick, m.
    pub size_m: [f64; 3],
    /// As `plan` chooses it, s.
    pub time_step_s: f64,
    /// Errors to expect then.
    pub expected: Vec<Interval>,
    /// Cell updates of this scene then.
    pub cell_updates: f64,
}

/// Parts of an edge, over those as written, that are tried: whole octaves and their halves.
const FINER: [f64; 14] = [0.25, 0.375, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0, 8.0, 12.0];
/// Most cells of a recommendation that is planned to see whether it can be run.
const CELLS_PLANNED: f64 = 2e7;

/// Greatest number of cells that divides all edges of more than one cell.
pub(super) fn common(numbers: &Numbers) -> usize {
    numbers.extents.into_iter().filter(|&n| n > 1).fold(0, gcd).max(1)
}

/// The scene with its edges divided into other cells; `None` where those are too many to be planned for a try.
pub(super) fn at(scene: &Scene, numbers: &Numbers, common: usize, parts: usize) -> Option<Scene> {
    let spacing = numbers.spacing_m * common as f64 / parts as f64;
    let mut changed = scene.clone();
    changed.domain.spacing_m = spacing;
    for (size, n) in changed.domain.size_m.iter_mut().zip(numbers.extents) {
        // Axes of one cell stay one cell thick.
        *size = if n > 1 { *size } else { spacing };
    }
    let total: f64 = changed.domain.size_m.iter().map(|size| size / spacing).product();
    (total <= CELLS_PLANNED).then_some(changed)
}

/// Whether errors are within a share, besides what the random scenes themselves were short of their steady states.
pub(super) fn reaches(errors: &[Interval], share: f64) -> bool {
    errors.iter().all(|error| error.most() <= share + FLOOR)
}

/// The coarsest spacing with a plan whose expected errors are within a share; `None` where no scene like this was measured.
pub(super) fn search(facts: &Facts, numbers: &Numbers, share: f64) -> Option<Swept> {
    let Expectation::Measured { errors, .. } = &numbers.expected else { return None };
    let common = common(numbers);
    let mut finest = None;
    for factor in FINER {
        let parts = (factor * common as f64).ceil().max(1.0) as usize;
        let Some(mut changed) = at(facts.scene, numbers, common, parts) else { break };
        // The step follows the spacing.
        (changed.numerics.time_step_s, changed.numerics.relaxation_time) = (None, None);
        let Ok(plan) = Plan::new(&changed) else { continue };
        let expected = plan.numbers.expected.errors().to_vec();
        let within = !expected.is_empty() && reaches(&expected, share);
        let n = &plan.numbers;
        let found = Swept {
            why: String::new(),
            as_written: errors.clone(),
            reached: within,
            spacing_m: changed.domain.spacing_m,
            size_m: changed.domain.size_m,
            time_step_s: n.time_step_s,
            cell_updates: n.cell_updates,
            expected,
        };
        if within {
            return Some(found);
        }
        // Outside of what was measured nothing is recommended.
        finest = if found.expected.is_empty() { finest } else { Some(found) };
    }
    finest
}
