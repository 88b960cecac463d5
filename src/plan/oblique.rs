//! Fluid at rest whose surface is oblique to the grid: how fast it keeps moving.

use super::figures::Basis;
use super::surface::Pool;
use crate::scene::Boundary;

/// Stress that drives such fluid, over the weight of a cell f Δx: largest u μ/(f Δx²) found is 0.041, in 190 tanks of 6 to 32
/// cells drawn at random, tilted by 0.3 to 45°, τ 0.51 to 1.5, f 1e-5 to 1e-3 in lattice units; with flow indices of 0.2 to 1.3 the
/// stress is 0.054 at most once it has settled, and 0.08 on the way. Twice the first, and a little (set after seeing).
const DRIVE: f64 = 0.1;

/// How far the surface rises over the box, cells, below which it is level.
const LEVEL: f64 = 0.01;

/// Largest speed, m/s, that fluid keeps where it has come to rest behind walls with its surface normal to a force that is
/// oblique to the grid: Δx γ̇(DRIVE f Δx). `None` where that can not be: without a surface, with a force along an axis, and
/// where nothing holds the fluid up.
///
/// The pressure at an oblique surface is off by a part of the weight of a cell \[F2\], and what that drives has the size of a
/// cell: a Newtonian fluid moves at DRIVE f Δx²/μ, and one with a larger yield stress not at all, but for
/// single cells that creep at up to 1e-3 of that.
///
/// # Source
/// docs/method.md \[F2\]; the form is derived, the factor measured.
/// # Verified by
/// Claim `pool-tilted-residual`; test `tilted_pools_move_no_faster_than_plan_says`.
pub(super) fn residual_speed(basis: &Basis) -> Option<f64> {
    let pool = basis.pool?;
    let force = basis.facts.forces.extremes[0];
    let weight = force[pool.up.index()].abs();
    let is_held = (0..3).filter(|&axis| axis != pool.up.index()).any(|axis| holds(basis, &pool, force, axis));
    let dx = basis.units.dx_m;
    let speed =
        |stress: f64| basis.facts.curves().map(|curve| curve.shear_rate_at(stress)).fold(0.0, f64::max) * dx;
    (is_held && weight > 0.0).then(|| speed(DRIVE * crate::scene::force::norm(force) * dx))
}

/// Whether a force along the bed meets a wall, or a solid.
fn holds(basis: &Basis, pool: &Pool, force: [f64; 3], axis: usize) -> bool {
    let downhill = usize::from(force[axis] > 0.0);
    let rise = (force[axis] / force[pool.up.index()]).abs() * basis.setup.extents[axis] as f64;
    let wall = !matches!(basis.facts.faces[axis][downhill], Boundary::Open | Boundary::Periodic);
    rise > LEVEL && (wall || !basis.setup.solids.is_empty())
}
