//! Loads on numbered solids by momentum exchange \[C7\], for any backend.

use crate::free_surface::ledger::{Sum, VectorSum};
use crate::lattice::{C, opposite};
use crate::setup::Setup;
use crate::solver::run::Load;
use crate::vector::cross;

/// What the links of a step bring to one solid. The sums do not depend on the order of their terms.
#[derive(Clone, Debug, Default)]
pub(crate) struct LoadSums {
    force: VectorSum,
    torque: VectorSum,
    wetted: [[Sum; 2]; 3],
}

/// A link to a solid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pull {
    /// Arriving direction: the solid lies along −c_i.
    pub i: usize,
    /// What the link brought to the fluid, c_i (f_i + f_ī*).
    pub brought: [f64; 3],
    /// Share of the cell that is wet.
    pub share: f64,
}

impl LoadSums {
    /// Adds one link: the solid gets what the fluid loses, in the middle of the link.
    ///
    /// # Arguments
    /// `arm`: middle of the link less the centre of the solid, cells.
    pub(crate) fn add(&mut self, pull: &Pull, arm: [f64; 3]) {
        let force = pull.brought.map(|p| -p);
        self.force.add(&force);
        self.torque.add(&cross(arm, force));
        // The wall lies along −c_i; axis links are the cell faces.
        let c = C[pull.i];
        let length: i32 = c.iter().map(|c| c * c).sum();
        if length == 1 {
            let axis = c.iter().position(|&c| c != 0).unwrap_or(0);
            self.wetted[axis][usize::from(c[axis] > 0)].add(pull.share);
        }
    }

    /// Adds the sums of other cells.
    pub(crate) fn merge(&mut self, other: &Self) {
        self.force.merge(&other.force);
        self.torque.merge(&other.torque);
        for axis in 0..3 {
            for side in 0..2 {
                self.wetted[axis][side].merge(&other.wetted[axis][side]);
            }
        }
    }

    /// Brings a load up to date with the sums of a step.
    pub(crate) fn enter(&self, load: &mut Load) {
        load.force = self.force.value();
        load.torque = self.torque.value();
        load.wetted = self.wetted.map(|sides| sides.map(|sum| sum.value()));
        for a in 0..3 {
            load.impulse[a] += load.force[a];
        }
    }
}

/// The part of what a link brings that counts into some of its owners; the parts of all add up exactly.
///
/// # Arguments
/// `owners`: by axis, see [`crate::boundary::owners::owners`].
pub(crate) fn owned(brought: &[f64; 3], owners: &[[u8; 2]; 3], counts: impl Fn(u8) -> bool) -> [f64; 3] {
    std::array::from_fn(|a| match owners[a].map(&counts) {
        [true, true] => brought[a],
        [false, false] => 0.0,
        _ => 0.5 * brought[a],
    })
}

/// Adds what one link brings to the loads of the solids that own it.
///
/// # Arguments
/// `owners`: as in [`owned`]; solids without sums are left out.
pub(crate) fn book_pull(
    loads: &mut [LoadSums],
    setup: &Setup,
    at: [usize; 3],
    owners: [[u8; 2]; 3],
    pull: &Pull,
) {
    let all = owners.as_flattened();
    for (n, &body) in all.iter().enumerate() {
        let Some(load) = usize::from(body).checked_sub(1).and_then(|k| loads.get_mut(k)) else { continue };
        if all[..n].contains(&body) {
            continue;
        }
        let own = owned(&pull.brought, &owners, |owner| owner == body);
        load.add(&Pull { brought: own, ..*pull }, arm(setup, at, pull.i, body));
    }
}

/// Number of solids whose loads a run records.
#[must_use]
pub(crate) fn recorded(setup: &Setup) -> usize {
    if setup.loads { setup.solid_motion.len() } else { 0 }
}

/// Middle of the link that population `i` arrives through at cell `at`, less the centre of solid `body`.
#[must_use]
pub(crate) fn arm(setup: &Setup, at: [usize; 3], i: usize, body: u8) -> [f64; 3] {
    let centre = setup.solid_motion.get(usize::from(body).wrapping_sub(1)).map_or([0.0; 3], |m| m.centre);
    let towards = C[opposite(i)];
    std::array::from_fn(|a| (at[a] as f64 + 0.5 + 0.5 * f64::from(towards[a])) - centre[a])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_force_torque_and_area_of_one_link() {
        // The solid lies at smaller x; what the fluid gets, it loses.
        let pull = Pull { i: 1, brought: [0.5, 0.0, 0.25], share: 0.75 };
        let mut sums = LoadSums::default();
        sums.add(&pull, [2.0, 3.0, -1.0]);
        let mut load = Load::default();
        sums.enter(&mut load);
        assert_eq!(load.force, [-0.5, 0.0, -0.25]);
        // r × F by hand: (3·(−¼) − 0, (−1)(−½) − 2·(−¼), 0 − 3·(−½)).
        assert_eq!(load.torque, [-0.75, 1.0, 1.5]);
        assert_eq!(load.impulse, load.force);
        assert_eq!(load.wetted[0], [0.0, 0.75]);
        let mut twice = sums.clone();
        twice.merge(&sums);
        twice.enter(&mut load);
        assert_eq!((load.force, load.impulse), ([-1.0, 0.0, -0.5], [-1.5, 0.0, -0.75]));
    }
}
