//! Fluid at rest whose surface is oblique to the grid, or level with a face between cells: how fast it keeps moving.

use serde::Serialize;

use super::figures::Basis;
use super::surface::Pool;
use crate::scene::Boundary;
use crate::scene::force::norm;

/// Stress that drives such fluid, over the weight of a cell f Δx: largest u μ/(f Δx²) found is 0.041, in 190 tanks of 6 to 32
/// cells drawn at random, tilted by 0.3 to 45°, τ 0.51 to 1.5, f 1e-5 to 1e-3 in lattice units; with flow indices of 0.2 to 1.3 the
/// stress is 0.054 at most once it has settled, and 0.08 on the way. Twice the first, and a little (set after seeing).
const DRIVE: f64 = 0.1;

/// How far the surface rises over the box, cells, below which it is level.
const LEVEL: f64 = 0.01;

/// What keeps moving where fluid has come to rest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Residual {
    /// Largest speed, m/s; 0 where the yield stress holds the fluid, but for single cells that creep at up to 1e-3 of the motion
    /// without one.
    pub speed_m_per_s: f64,
    /// Whether the surface is oblique to the grid: then this is to be expected. A level surface moves so only where it lies
    /// within a hundredth of a cell of a face between cells.
    pub oblique: bool,
}

/// Largest speed that fluid keeps where it has come to rest: Δx γ̇(DRIVE f Δx). `None` where that can not be: without a surface,
/// at rest and level from the start, and where nothing holds the fluid.
///
/// The pressure at a surface that is oblique to the grid, and where cells of two layers are surface, is off by a part of the
/// weight of a cell \[F2\] \[F4\], and what that drives has the size of a cell: a Newtonian fluid moves at DRIVE f Δx²/μ, and one
/// with a larger yield stress not at all.
///
/// # Source
/// docs/method.md \[F2\], \[F4\]; the form is derived, the factor measured.
/// # Verified by
/// Claim `pool-tilted-residual`; test `tilted_pools_move_no_faster_than_plan_says`.
pub(super) fn residual(basis: &Basis) -> Option<Residual> {
    let pool = basis.pool?;
    let force = basis.facts.forces.extremes[0];
    let weight = force[pool.up.index()].abs();
    let solids = !basis.setup.solids.is_empty();
    let mut across = (0..3).filter(|&axis| axis != pool.up.index());
    let oblique = across.clone().any(|axis| is_held(basis, &pool, force, axis));
    let runs_off = across.any(|axis| basis.facts.faces[axis].contains(&Boundary::Open)) && !solids;
    let rests = oblique || !(pool.level || runs_off || flows_on(basis, &pool, force));
    let dx = basis.units.dx_m;
    let rate =
        |stress: f64| basis.facts.curves().map(|curve| curve.shear_rate_at(stress)).fold(0.0, f64::max);
    let speed_m_per_s = dx * rate(DRIVE * norm(force) * dx);
    (rests && weight > 0.0).then_some(Residual { speed_m_per_s, oblique })
}

/// How far a level surface rises over the box along an axis, cells.
fn rise(basis: &Basis, pool: &Pool, force: [f64; 3], axis: usize) -> f64 {
    (force[axis] / force[pool.up.index()]).abs() * basis.setup.extents[axis] as f64
}

/// Whether a force along the bed meets a wall, or a solid.
fn is_held(basis: &Basis, pool: &Pool, force: [f64; 3], axis: usize) -> bool {
    let downhill = usize::from(force[axis] > 0.0);
    let wall = !matches!(basis.facts.faces[axis][downhill], Boundary::Open | Boundary::Periodic);
    rise(basis, pool, force, axis) > LEVEL && (wall || !basis.setup.solids.is_empty())
}

/// Whether a force along the bed meets nothing.
fn flows_on(basis: &Basis, pool: &Pool, force: [f64; 3]) -> bool {
    (0..3).any(|axis| {
        axis != pool.up.index()
            && rise(basis, pool, force, axis) > LEVEL
            && !is_held(basis, pool, force, axis)
    })
}
