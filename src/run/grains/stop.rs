//! What stopped the discrete element method, with the names of the scene.

use super::population::{OpenBooks, Population, UNEXPLAINED};
use crate::dem::{Dem, DemError, Touching, V3};
use crate::plan::grains::GrainPlan;
use crate::run::stop::{StopPlace, StopReport};

/// A report about a run of the scene `file`.
pub(super) fn report(
    file: &str,
    plan: &GrainPlan,
    grains: &Population,
    dem: &Dem,
    error: &DemError,
) -> StopReport {
    let name = |grain: usize| plan.name(grains.number(grain));
    let position = |grain: usize| dem.bodies().position.get(grain).map(|x: &V3| [x.x, x.y, x.z]);
    let stopped = |step, time_s, who, position_m, found, cause| {
        let place = StopPlace::Grains { who, position_m };
        StopReport { file: file.to_owned(), step, time_s, place, found, cause }
    };
    match error {
        DemError::Overlap { step, time_s, pair, overlap_m, share, limit } => {
            let who = match pair {
                Touching::Grains(first, second) => format!("{} and {}", name(*first), name(*second)),
                Touching::Wall { grain, wall } => format!("{} and wall `{wall}`", name(*grain)),
            };
            let found = format!(
                "overlap of {overlap_m:.4e} m, {share:.3} of the smaller radius; the limit is {limit}"
            );
            let cause = if *step < 10 {
                "an impact much faster than `grains.numerics.design_speed_m_per_s`, or material too soft for it"
            } else {
                "an impact too fast or a load too high for this Young's modulus; stiffer material, or a smaller \
                 time step if the design speed was too low"
            };
            stopped(*step, *time_s, who, position(pair.grain()), found, cause)
        }
        DemError::NotFinite { step, time_s, grain } => {
            let found = "position or velocity is not a finite number".to_owned();
            let cause =
                "forces beyond the range of 64-bit numbers: check radius, density and Young's modulus";
            stopped(*step, *time_s, name(*grain), None, found, cause)
        }
        DemError::Spin { step, time_s, grain, spin_rad_s, step_s } => {
            let found = format!("spin of {spin_rad_s:.3e} rad/s, too fast for steps of {step_s:.3e} s");
            let cause = "a very uneven clump in a fast collision; a smaller `grains.numerics.time_step_s`";
            stopped(*step, *time_s, name(*grain), position(*grain), found, cause)
        }
        other => refused(file, other),
    }
}

/// A report about books of energy that do not close; `time_s`: s.
pub(in crate::run) fn open_books(
    file: &str,
    plan: &GrainPlan,
    grains: &Population,
    (dem, step, time_s): (&Dem, u64, f64),
    books: &OpenBooks,
) -> StopReport {
    let b = dem.bodies();
    let energy = |i: &usize| b.translational_energy(*i) + b.rotational_energy(*i);
    // NaN counts as largest, and is where to look.
    let fastest = (0..b.len()).max_by(|i, j| energy(i).total_cmp(&energy(j))).unwrap_or(0);
    let position = b.position.get(fastest).map(|x: &V3| [x.x, x.y, x.z]);
    let OpenBooks { unexplained_j, turned_over_j } = books;
    StopReport {
        file: file.to_owned(),
        step,
        time_s,
        place: StopPlace::Grains {
            who: format!("{}, which has the most kinetic energy", plan.name(grains.number(fastest))),
            position_m: position,
        },
        found: format!(
            "{unexplained_j:.3e} J that no force explains, {:.3} of the {turned_over_j:.3e} J turned over so far; the limit \
             is {UNEXPLAINED}",
            unexplained_j.abs() / turned_over_j
        ),
        cause: "steps too long for the stiffness or the damping of a contact, or impacts faster than the design speed; a \
                smaller `grains.numerics.time_step_s` (with fluid: more `grains.coupling.sub_steps`), more \
                `steps_per_contact`, or a higher `design_speed_m_per_s`",
    }
}

/// A report without a state.
pub(super) fn refused(file: &str, error: &DemError) -> StopReport {
    StopReport {
        file: file.to_owned(),
        step: 0,
        time_s: 0.0,
        place: StopPlace::Grains { who: "grains".to_owned(), position_m: None },
        found: error.to_string(),
        cause: "see the message",
    }
}
