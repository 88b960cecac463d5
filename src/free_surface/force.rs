//! The body force in interface cells \[F3\].

use crate::setup::SurfaceForce;

/// Share of the new value in the smoothed acceleration: a memory of about 16 steps, several times what
/// a sound wave needs to cross an interface cell and short against any flow.
pub(crate) const SMOOTHING: f64 = 1.0 / 16.0;

/// The largest acceleration that counts, cells per step²: within the memory of 16 steps it changes a velocity by 0.16 of the
/// 0.4 cells per step that stop a run; what is faster is no flow that the grid resolves.
pub(crate) const LARGEST: f64 = 0.01;

/// Force of an interface cell.
///
/// Full: F. By fill: φF. With inertia: φF + (1 − φ) a min(1, 0.01/|a|)·ρ₀ with ρ₀ = 1, a the
/// smoothed acceleration of the liquid neighbours.
///
/// # Arguments
/// `force`: F of the bulk. `fill`: φ, 0 to 1. `acceleration`: a, cells per step².
/// # Source
/// docs/method.md \[F3\].
/// # Verified by
/// Claims `pool-at-rest`, `falling-drop-*`.
#[inline(always)]
#[must_use]
pub(crate) fn interface_force(
    rule: SurfaceForce,
    force: &[f64; 3],
    fill: f64,
    acceleration: &[f64; 3],
) -> [f64; 3] {
    match rule {
        SurfaceForce::Full => *force,
        SurfaceForce::ByFill => force.map(|f| fill * f),
        SurfaceForce::ByFillAndInertia => {
            let square = |v: &[f64; 3]| (v[0] * v[0] + v[1] * v[1]) + v[2] * v[2];
            let rate = square(acceleration);
            let limit = if rate > LARGEST * LARGEST { LARGEST / rate.sqrt() } else { 1.0 };
            std::array::from_fn(|a| fill * force[a] + ((1.0 - fill) * limit) * acceleration[a])
        }
    }
}

/// a ← a + (Δu − a)/16.
///
/// # Source
/// docs/method.md \[F3\].
/// # Verified by
/// Claim `falling-drop-by-fill-and-inertia`.
#[inline(always)]
#[must_use]
pub(crate) fn smooth(acceleration: &[f64; 3], change: &[f64; 3]) -> [f64; 3] {
    std::array::from_fn(|a| acceleration[a] + SMOOTHING * (change[a] - acceleration[a]))
}
