//! Arrays built entry by entry, written out instead of looped.
//!
//! A kernel is inlined into functions compiled for wider registers than the rest of the crate. What a
//! closure or a library function keeps out of line there is compiled for the narrow ones and costs
//! an order of magnitude; hence `inline(always)` all the way, and no loop that the optimiser may leave
//! rolled (with the direction as a run-time number, every lattice velocity would be looked up).

use super::Q;

/// `[f(0), f(1), f(2)]`.
#[inline(always)]
pub(crate) fn three<T>(f: impl Fn(usize) -> T) -> [T; 3] {
    [f(0), f(1), f(2)]
}

/// `[f(0), …, f(5)]`.
#[inline(always)]
pub(crate) fn six<T>(f: impl Fn(usize) -> T) -> [T; 6] {
    [f(0), f(1), f(2), f(3), f(4), f(5)]
}

/// `[f(0), …, f(18)]`: one entry per lattice direction.
#[inline(always)]
pub(crate) fn directions<T>(mut f: impl FnMut(usize) -> T) -> [T; Q] {
    [
        f(0),
        f(1),
        f(2),
        f(3),
        f(4),
        f(5),
        f(6),
        f(7),
        f(8),
        f(9),
        f(10),
        f(11),
        f(12),
        f(13),
        f(14),
        f(15),
        f(16),
        f(17),
        f(18),
    ]
}
