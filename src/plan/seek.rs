//! The search for what would do where a time step is refused.

use super::cells::Cells;
use super::checks;
use super::choose::choose;
use super::facts::Facts;
use super::judge::Flow;
use super::scale::{Scales, scales};
use super::text::{rounded_down, rounded_up};
use super::time_step::StepRule;
use super::ways::{Way, Ways};
use crate::scene::{Operator, Rheology, Scene};

/// Most cells of a scene that is planned only to see whether it has a plan: about a second.
const CELLS_TRIED: f64 = 4e6;
/// The same with a finer spacing, where the scene has few: some hundredths of a second.
const FINER_CELLS_TRIED: f64 = 2e5;
/// Plans tried for one kind of change.
const TRIES: usize = 3;
/// Finest spacing that is looked at, as a part of the given one.
const FINEST: usize = 64;
/// Steps of a viscosity: a quarter of an octave each, up to a millionfold.
const VISCOSITIES: u32 = 80;

/// Where a refused time step comes from, and how a changed scene is tried.
pub(super) struct Refused<'a> {
    pub flow: Flow<'a>,
    pub cells: &'a Cells,
    pub dt: f64,
    pub rule: StepRule,
    /// Whether a changed scene has a plan.
    pub accepts: &'a dyn Fn(&Scene) -> bool,
}

/// What would be accepted: another value of the key that fixes the step, no such key, another operator; where none of them
/// helps, or the step is chosen anyway, a spacing and a viscosity.
pub(super) fn ways(refused: &Refused) -> Ways {
    let mut found: Vec<Way> = Vec::new();
    if !refused.rule.chosen() {
        found.extend(other_value(refused));
        found.extend(left_out(refused));
    }
    found.extend(other_operator(refused));
    if found.is_empty() {
        found.extend(finer(refused));
        found.extend(more_viscous(refused));
    }
    Ways(found)
}

/// Only a spacing: for what no time step mends.
pub(super) fn spacing(refused: &Refused) -> Ways {
    Ways(finer(refused).into_iter().collect())
}

/// The same key with a value whose step is admissible.
fn other_value(refused: &Refused) -> Option<Way> {
    let scene = refused.flow.facts.scene;
    let dt = refused.flow.nearest_step(refused.dt)?;
    let mut changed = scene.clone();
    let exact = value_at(refused, dt)?;
    // Printed with three digits where that still does.
    let values = [rounded_up(exact, 3), rounded_down(exact, 3), exact];
    let value = values.into_iter().find(|&value| {
        set_step(&mut changed, refused.rule, value);
        (refused.accepts)(&changed)
    })?;
    let unit = if refused.rule == StepRule::Given { "s" } else { "" };
    Some(Way::Set { path: refused.rule.path().to_owned(), value, unit })
}

/// The value of the key that fixes the step, for a step.
fn value_at(refused: &Refused, dt: f64) -> Option<f64> {
    let numerics = &refused.flow.facts.scene.numerics;
    let ratio = dt / refused.dt;
    match refused.rule {
        StepRule::Given => Some(dt),
        StepRule::RelaxationTime => numerics.relaxation_time.map(|tau| 0.5 + (tau - 0.5) * ratio),
        StepRule::TargetMach => numerics.target_mach.map(|mach| mach * ratio),
        _ => None,
    }
}

fn set_step(scene: &mut Scene, rule: StepRule, value: f64) {
    let numerics = &mut scene.numerics;
    (numerics.time_step_s, numerics.relaxation_time, numerics.target_mach) = (None, None, None);
    match rule {
        StepRule::Given => numerics.time_step_s = Some(value),
        StepRule::RelaxationTime => numerics.relaxation_time = Some(value),
        StepRule::TargetMach => numerics.target_mach = Some(value),
        _ => {}
    }
}

fn left_out(refused: &Refused) -> Option<Way> {
    let mut changed = refused.flow.facts.scene.clone();
    let numerics = &mut changed.numerics;
    (numerics.time_step_s, numerics.relaxation_time, numerics.target_mach) = (None, None, None);
    (refused.accepts)(&changed).then(|| Way::LeaveOut { path: refused.rule.path() })
}

fn other_operator(refused: &Refused) -> Option<Way> {
    let mut changed = refused.flow.facts.scene.clone();
    let given = changed.numerics.collision.operator?;
    changed.numerics.collision = crate::scene::Collision::default();
    changed.numerics.collision.operator = Some(Operator::CentralMoment);
    (given != Operator::CentralMoment && (refused.accepts)(&changed))
        .then_some(Way::Choose { path: "numerics.collision.operator", choice: "central_moment" })
}

/// Whether `plan` would find a step at first sight: with these scales, before anything is painted.
fn promising(changed: &Scene, scales: &Scales, cells: &Cells, gap: f64) -> bool {
    let facts = Facts::of(changed);
    let flow = Flow { facts: &facts, scales, gap, grains: 0.0 };
    checks::wide_enough(&flow, Ways::default).is_ok()
        && choose(&flow, cells.pool.as_ref()).is_ok_and(|(dt, _)| flow.allows(dt, 1.0))
}

/// The coarsest spacing that does, of those that divide every edge into whole cells.
fn finer(refused: &Refused) -> Option<Way> {
    let (scene, cells) = (refused.flow.facts.scene, refused.cells);
    let common = cells.extents.into_iter().fold(0, gcd);
    let total = cells.extents.iter().map(|&n| n as f64).product::<f64>();
    let most = (8.0 * total).clamp(FINER_CELLS_TRIED, CELLS_TRIED);
    let mut tries = 0;
    for parts in common + 1..=FINEST * common {
        let share = parts as f64 / common as f64;
        if total * share * share * share > most || tries == TRIES {
            return None;
        }
        let mut changed = scene.clone();
        changed.domain.spacing_m = scene.domain.spacing_m / share;
        if promising(&changed, refused.flow.scales, cells, refused.flow.gap * share) {
            tries += 1;
            if (refused.accepts)(&changed) {
                let path = "domain.spacing_m".to_owned();
                return Some(Way::Set { path, value: changed.domain.spacing_m, unit: "m" });
            }
        }
    }
    None
}

/// The least viscosity that does; the law is otherwise the same.
fn more_viscous(refused: &Refused) -> Option<Way> {
    let (facts, cells) = (refused.flow.facts, refused.cells);
    let total = cells.extents.iter().map(|&n| n as f64).product::<f64>();
    if !facts.scene.layers.is_empty() || total > CELLS_TRIED {
        return None;
    }
    let mut tries = 0;
    for step in 1..=VISCOSITIES {
        let mut changed = facts.scene.clone();
        let factor = libm::exp2(f64::from(step) / 4.0);
        let (key, value, unit) = thicken(&mut changed.fluid.rheology, factor);
        let scales = scales(&Facts::of(&changed), cells);
        if tries < TRIES && promising(&changed, &scales, cells, refused.flow.gap) {
            tries += 1;
            if (refused.accepts)(&changed) {
                return Some(Way::Set { path: format!("fluid.rheology.{key}"), value, unit });
            }
        }
    }
    None
}

/// Multiplies the viscous part of a law; its key, the new value and its unit.
fn thicken(law: &mut Rheology, factor: f64) -> (&'static str, f64, &'static str) {
    let times = |value: &mut f64| {
        *value = rounded_up(*value * factor, 3);
        *value
    };
    match law {
        Rheology::Newtonian { viscosity_pa_s: mu } => ("newtonian.viscosity_pa_s", times(mu), "Pa s"),
        Rheology::Bingham { plastic_viscosity_pa_s: mu, .. } => {
            ("bingham.plastic_viscosity_pa_s", times(mu), "Pa s")
        }
        Rheology::HerschelBulkley { consistency_pa_s_n: k, .. } => {
            ("herschel_bulkley.consistency_pa_s_n", times(k), "Pa sⁿ")
        }
        Rheology::PowerLaw { consistency_pa_s_n: k, .. } => {
            ("power_law.consistency_pa_s_n", times(k), "Pa sⁿ")
        }
        Rheology::Papanastasiou { consistency_pa_s_n: k, .. } => {
            ("papanastasiou.consistency_pa_s_n", times(k), "Pa sⁿ")
        }
    }
}

/// Greatest common divisor.
pub(super) fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}
