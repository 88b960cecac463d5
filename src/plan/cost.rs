//! Speeds assumed for rough times. `lahar bench` measures them.

/// Cell updates per second: fast backend, one thread, a flow with a free surface on a processor with 256-bit
/// registers or better.
pub(super) const CELL_UPDATES_PER_SECOND: f64 = 1e7;

/// Sphere updates per second on one thread: the order of what `lahar bench` gives.
pub(super) const SPHERE_UPDATES_PER_SECOND: f64 = 2e6;

/// A speed in millions per second.
pub(super) fn millions(per_second: f64) -> f64 {
    per_second / 1e6
}
