//! Flows that are let go: a heap and a dam.

use super::trial::{Outcome, Trial, over, put};
use crate::claim::VerifyError;
use crate::claims::columns::{depths, front};
use crate::claims::dam_break::newtonian::{Block, THRESHOLD, spread_time, viscous};
use crate::claims::slump::scene::{Heap, View};
use crate::claims::slump::shear::HEAP;
use crate::claims::slump::twin::misplaced;
use crate::exact::thin_layer::Geometry;
use lahar::plan::work::{Case, Operator, Scheme, Walls};
use lahar::setup::Setup;
use lahar::solver::run::Backend;

/// Time at which heaps are compared, μ/(ρ g H): most of the way is done.
const TIME: f64 = 80.0;

/// N of the heap that the others are compared with.
pub(super) const FINEST: [f64; 2] = [12.0, 18.0];

/// The heap of the study `slump`; compression goes with the square of the time step.
pub(super) fn heap(step: f64) -> Heap {
    Heap { compression: HEAP.compression * step * step, ..HEAP }
}

pub(super) fn slump_setup(trial: &Trial) -> Setup {
    let heap = heap(trial.step);
    let mut setup = heap.setup(trial.n);
    put(trial.scheme, heap.viscosity(trial.n), &mut setup);
    setup
}

/// The heap at [`TIME`].
fn spread(trial: &Trial, backend: &dyn Backend, budget: f64) -> Result<(View, u64, f64), VerifyError> {
    let heap = heap(trial.step);
    let steps = (TIME * heap.unit_of_time(trial.n)).round() as u64;
    let mut run = backend.start(&slump_setup(trial))?;
    let updates = stretch(run.as_mut(), steps, budget)?;
    Ok((View::of(&heap, run.as_ref(), trial.n), steps, updates))
}

/// Runs a number of steps in twenty stretches and counts the updates.
fn stretch(run: &mut dyn lahar::solver::run::Run, steps: u64, budget: f64) -> Result<f64, VerifyError> {
    let mut updates = 0.0;
    for part in 1..=20 {
        let more = steps * part / 20 - run.step();
        updates += more as f64 * run.fluid_cells() as f64;
        if updates > budget {
            return Err(over(run.step()));
        }
        run.advance(more)?;
    }
    Ok(updates)
}

/// Depth of a heap at r, linear between its rings.
fn depth(view: &View, r: f64) -> f64 {
    let next = view.r.iter().position(|&s| s > r).unwrap_or(view.r.len());
    match (next.checked_sub(1), view.r.get(next)) {
        (None, _) => view.h[0],
        (Some(_), None) => 0.0,
        (Some(i), Some(s)) => view.h[i] + (view.h[next] - view.h[i]) * (r - view.r[i]) / (s - view.r[i]),
    }
}

/// The heap that the others are compared with: the default scheme on the finest grid.
fn finest(backend: &dyn Backend, n: f64) -> Result<View, VerifyError> {
    let scheme = Scheme { operator: Operator::CentralMoment, walls: Walls::Independent };
    let trial = Trial { case: Case::Slump, scheme, n, step: 1.0 };
    Ok(spread(&trial, backend, f64::INFINITY)?.0)
}

pub(super) fn slump(trial: &Trial, backend: &dyn Backend, budget: f64) -> Result<Outcome, VerifyError> {
    let reference = reference(backend, budget)?;
    let (view, steps, updates) = spread(trial, backend, budget)?;
    Ok(Outcome { error: misplaced(&view, |r| depth(&reference, r)), steps, updates })
}

/// The finest heap, computed once per process and size: a backend's bits do not depend on when it runs.
fn reference(backend: &dyn Backend, budget: f64) -> Result<View, VerifyError> {
    use std::sync::Mutex;
    static SEEN: Mutex<Vec<(&'static str, u64, View)>> = Mutex::new(Vec::new());
    let n = FINEST[usize::from(budget > super::points::BUDGET[0])];
    let mut seen = SEEN.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let key = (backend.name(), n.to_bits());
    if let Some((.., view)) = seen.iter().find(|(name, bits, _)| (*name, *bits) == key) {
        return Ok(view.clone());
    }
    let view = finest(backend, n)?;
    seen.push((key.0, key.1, view.clone()));
    Ok(view)
}

/// The planar block of the study `dam-break`.
pub(super) fn block(n: f64, step: f64) -> Block {
    let standard = viscous(Geometry::Planar, n as usize);
    Block { viscosity: standard.viscosity * step, weight: standard.weight * step * step, ..standard }
}

pub(super) fn dam_setup(trial: &Trial) -> (Block, Setup) {
    let block = block(trial.n, trial.step);
    let mut setup = block.setup();
    put(trial.scheme, block.viscosity, &mut setup);
    (block, setup)
}

pub(super) fn dam_break(trial: &Trial, backend: &dyn Backend, budget: f64) -> Result<Outcome, VerifyError> {
    let (block, setup) = dam_setup(trial);
    let time = spread_time(&block, &setup, 2.5).round();
    let mut run = backend.start(&setup)?;
    let updates = stretch(run.as_mut(), time as u64, budget)?;
    let threshold = THRESHOLD * trial.n;
    let found = front(&depths(&setup, &run.fields(), 0), threshold);
    let expected = block.twin(&[time], threshold)?[0];
    Ok(Outcome { error: (found / expected - 1.0).abs(), steps: time as u64, updates })
}

/// The dam, many cells wide.
pub(super) fn wide_dam(trial: &Trial, across: usize) -> Setup {
    let (_, mut setup) = dam_setup(trial);
    let [nx, _, _] = setup.extents;
    let fill = setup.free_surface.as_ref().map(|surface| surface.fill.clone());
    setup.extents[1] = across;
    let wide: Option<Vec<f64>> = fill.map(|fill| {
        let at = |cell| {
            let [i, _, k] = setup.coordinates(cell);
            fill[i + nx * k]
        };
        (0..setup.cells()).map(at).collect()
    });
    if let (Some(surface), Some(wide)) = (&mut setup.free_surface, wide) {
        surface.fill = wide.into();
    }
    setup
}
