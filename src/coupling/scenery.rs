//! Walls as the gaps beside grains see them.

use crate::dem::bodies::Member;
use crate::dem::walls::{self, Near};
use crate::dem::{Dem, V3};

/// The point about which a wall turns, where it is now, m.
pub(super) fn pivot(dem: &Dem, wall: usize) -> V3 {
    let scenery = dem.scenery();
    scenery.walls[wall].motion.about + scenery.poses[wall].shift
}

/// Whether a member is driven and does not move: between such ones no gap changes.
pub(super) fn at_rest(m: &Member) -> bool {
    m.inverse_mass == 0.0 && m.velocity == V3::zeros() && m.spin == V3::zeros()
}

/// Points of a wall near a member, nearer to its surface than `reach` (m).
pub(super) fn near(dem: &Dem, wall: usize, m: &Member, reach: f64, found: &mut Vec<Near>) {
    let scenery = dem.scenery();
    walls::near(
        &scenery.walls[wall],
        &scenery.poses[wall],
        scenery.shifts[wall],
        &m.position,
        m.radius + reach,
        None,
        found,
    );
}
