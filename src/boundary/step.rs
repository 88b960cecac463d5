//! One step along an axis from a cell: to another cell, or out of the box.

use crate::setup::{Face, Setup};

/// Where a step leads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Step {
    /// Coordinate of the next cell along the axis, through a periodic face where there is one.
    To(usize),
    /// Through this face: its side, 0 low and 1 high, and what it is; never periodic.
    Out(usize, Face),
}

/// The step from `at` upstream of a velocity of −1 or 1 along an axis.
#[inline]
#[must_use]
pub(crate) fn upstream(setup: &Setup, at: [usize; 3], axis: usize, velocity: i32) -> Step {
    let (n, x) = (setup.extents[axis], at[axis]);
    // Velocity −1 comes from the higher coordinate.
    let (leaves, side, next) =
        if velocity == 1 { (x == 0, 0, x.wrapping_sub(1)) } else { (x + 1 == n, 1, x + 1) };
    match setup.faces[axis][side] {
        _ if !leaves => Step::To(next),
        Face::Periodic => Step::To(if side == 0 { n - 1 } else { 0 }),
        face => Step::Out(side, face),
    }
}
