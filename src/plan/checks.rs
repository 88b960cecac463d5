//! What can only be judged in numbers.

use super::cells::{Cells, holds_a_cell};
use super::error::PlanProblem;
use super::judge::Flow;
use super::memory::{least_bytes_per_cell, predict};
use super::moving::{Leaving, first_leaving};
use super::ways::Ways;
use crate::scene::Scene;
use crate::setup::{BodyForce, Setup};
use crate::solver::layout::Layout;
use crate::units::Units;

/// Integers up to here are exact in f64.
const STEPS_MAX: f64 = 9e15;

/// What is certain of the bytes, against the available ones, before anything is allocated.
pub(super) fn least_memory(scene: &Scene, layout: Layout, available: Option<u64>) -> Result<(), PlanProblem> {
    let cells = super::cells::extents(&scene.domain).iter().map(|&n| n as u128).product::<u128>();
    fits(scene, cells, cells * u128::from(least_bytes_per_cell(scene, layout)), available)
}

/// All bytes of the run, against the available ones, before the run allocates any.
pub(super) fn memory(
    scene: &Scene,
    setup: &Setup,
    layout: Layout,
    available: Option<u64>,
) -> Result<(), PlanProblem> {
    let total = predict(setup, layout).total;
    fits(scene, setup.cells() as u128, u128::from(total), available)
}

fn fits(scene: &Scene, cells: u128, needed: u128, available: Option<u64>) -> Result<(), PlanProblem> {
    let Some(available) = available.filter(|&bytes| needed > u128::from(bytes)) else { return Ok(()) };
    let limit = |x: u128| u64::try_from(x).unwrap_or(u64::MAX);
    // Only axes of several cells get fewer of them.
    let axes = super::cells::extents(&scene.domain).iter().filter(|&&n| n > 1).count().max(1);
    let excess = needed as f64 / available.max(1) as f64;
    let spacing = scene.domain.spacing_m;
    // Half a unit in the last printed digit above, so that what is printed is not too little.
    let spacing_needed = spacing * libm::pow(excess, 1.0 / axes as f64) * 1.0005;
    Err(PlanProblem::OutOfMemory {
        cells: limit(cells),
        needed: limit(needed),
        available,
        spacing,
        spacing_needed,
    })
}

/// Every solid and layer must hold a cell centre.
pub(super) fn shapes(scene: &Scene) -> Result<(), (String, PlanProblem)> {
    let solids = scene.solids.iter().enumerate();
    let solids = solids.map(|(i, s)| (format!("solids[{i}].shape"), &s.name, &s.shape, s.invert));
    let layers = scene.layers.iter().enumerate();
    let layers = layers.map(|(i, l)| (format!("layers[{i}].shape"), &l.name, &l.shape, false));
    for (path, name, shape, invert) in solids.chain(layers) {
        if !holds_a_cell(shape, invert, &scene.domain) {
            let spacing = scene.domain.spacing_m;
            return Err((path, PlanProblem::NoCellCovered { name: name.clone(), spacing }));
        }
    }
    Ok(())
}

/// Moving solids must stay in their place.
pub(super) fn moving_solids(
    scene: &Scene,
    setup: &Setup,
    units: &Units,
) -> Result<(), (String, PlanProblem)> {
    if !setup.cuts.is_empty() && !setup.can_be_cut() {
        return Err(("numerics.solid_surface".to_owned(), PlanProblem::CutsInMotion));
    }
    let Some(Leaving { solid, at }) = first_leaving(setup) else { return Ok(()) };
    let name = scene.solids[solid].name.clone();
    let at_m = at.map(|x| x * units.dx_m);
    let of = |u: [f64; 3]| u != [0.0; 3];
    let key = if of(scene.solids[solid].spin_rad_per_s) { "spin_rad_per_s" } else { "velocity_m_per_s" };
    Err((format!("solids[{solid}].{key}"), PlanProblem::SolidLeaves { name, at_m }))
}

pub(super) fn some_fluid(cells: &Cells) -> Result<(), PlanProblem> {
    let solid = !cells.solids.is_empty() && cells.solids.iter().all(|&s| s != 0);
    if solid {
        return Err(PlanProblem::SolidEverywhere { cells: cells.solids.len() as u64 });
    }
    Ok(())
}

/// Steps to the end time, at least one.
pub(super) fn steps(scene: &Scene, dt: f64) -> Result<u64, PlanProblem> {
    let end = scene.stop.end_time_s;
    let steps = (end / dt).round();
    if !dt.is_finite() {
        return Err(PlanProblem::NotFinite { quantity: "the time step", found: dt });
    }
    if steps < 1.0 {
        return Err(PlanProblem::NoStep { end, dt });
    }
    if steps.is_nan() || steps > STEPS_MAX {
        return Err(PlanProblem::TooManySteps { steps, dt, end });
    }
    Ok(steps as u64)
}

/// Magnitudes that overflow once they are in lattice units.
pub(super) fn finite(setup: &Setup) -> Result<(), PlanProblem> {
    let finite = |quantity, values: &[f64]| match values.iter().find(|v| !v.is_finite()) {
        Some(&found) => Err(PlanProblem::NotFinite { quantity, found }),
        None => Ok(()),
    };
    for law in &setup.fluids {
        let what = if law.constant_tau().is_some() { "the viscosity" } else { "the law" };
        finite(what, &law.parameters())?;
    }
    match setup.force {
        BodyForce::Constant(f) => finite("the body force", &f),
        BodyForce::Oscillating { mean, amplitude, frequency, phase } => {
            finite("the body force", &mean)?;
            finite("the body force", &amplitude)?;
            finite("the oscillation", &[frequency, phase])
        }
        BodyForce::Stepped { before, after, .. } => {
            finite("the body force", &before)?;
            finite("the body force", &after)
        }
    }
}

/// Whether the widest place between walls has the cells that a flow needs. Measured in channels at the default step:
/// Newtonian fluid on 2 and 3 cells +12 and +6 % of the flux, on 4 +3 %; with a yield stress on 2, 3, 4 cells up to −100,
/// −20, −7 %.
pub(super) fn wide_enough(flow: &Flow, ways: impl FnOnce() -> Ways) -> Result<(), PlanProblem> {
    let (cells, law) = (flow.gap, &flow.facts.laws[0]);
    let least = if law.constant_tau().is_some() { 4.0 } else { 5.0 };
    if flow.scales.velocity == 0.0 || cells >= least {
        return Ok(());
    }
    Err(PlanProblem::GapTooNarrow { cells, least, law: law.name(), ways: ways() })
}
