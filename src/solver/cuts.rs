//! Mass over cut links \[B4\]: what they bring in, taken off again over each solid.

use crate::boundary::cut::{CutLink, central_linear};
use crate::free_surface::ledger::Sum;
use crate::lattice::opposite;
use crate::solver::cell::Cell;
use crate::solver::physics::Physics;

/// Σ e and Σ |e| over the cut links of each solid, e what a link brings in; in any order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Brought {
    by_body: Vec<[Sum; 2]>,
}

impl Brought {
    /// None yet; `bodies`: numbered solids.
    #[must_use]
    pub fn new(bodies: usize) -> Self {
        Self { by_body: vec![Default::default(); bodies + 1] }
    }

    /// What a link of a cell that is full of fluid brings in.
    #[inline]
    pub(crate) fn add(&mut self, body: u8, brought: f64) {
        if let Some([sum, size]) = self.by_body.get_mut(usize::from(body)) {
            sum.add(brought);
            size.add(brought.abs());
        }
    }

    /// Adds those of other cells.
    pub(crate) fn merge(&mut self, other: &Self) {
        for (own, other) in self.by_body.iter_mut().zip(&other.by_body) {
            own[0].merge(&other[0]);
            own[1].merge(&other[1]);
        }
    }

    /// Σ e / Σ |e| of each solid, −1 to 1; 0 where nothing was brought.
    #[must_use]
    pub(crate) fn surplus(&self) -> Vec<f64> {
        let share = |[sum, size]: &[Sum; 2]| {
            let size = size.value();
            if size == 0.0 { 0.0 } else { sum.value() / size }
        };
        self.by_body.iter().map(share).collect()
    }
}

/// e − |e| Σe/Σ|e|: what a link may bring in so that a solid brings in nothing.
///
/// Mass that goes into a solid's cell at one link comes out of it at another one further on, so that links are not free
/// of mass one by one, and a cell's are not either; only all of a solid's are. What is left of their sum, of second
/// order, is taken off in proportion to what each brings: fluid at rest stays at rest.
///
/// # Source
/// Derived here, docs/method.md \[B4\].
/// # Verified by
/// Claim `pipe-newtonian-cut`, test `tilted_box_keeps_mass_and_rest`.
#[inline(always)]
pub(crate) fn kept(brought: f64, surplus: f64) -> f64 {
    brought - surplus * brought.abs()
}

/// What a cut link brings in to a cell that is full of fluid \[B4\]: what comes back less what left.
///
/// # Arguments
/// `own`: post-collision populations of the cell. `correction`: what its wall correction takes from each that leaves.
/// `behind`: the population of the cell straight behind. `rho`: density of the cell.
#[inline]
pub(crate) fn cut_link<P: Physics>(
    physics: &P,
    own: &Cell,
    correction: Option<&Cell>,
    link: &CutLink,
    behind: Option<f64>,
    rho: f64,
) -> f64 {
    let out = usize::from(link.out);
    let opposite = own[opposite(out)];
    let leaving = own[out] - correction.map_or(0.0, |c| c[out]);
    let back = central_linear(leaving, opposite, behind.unwrap_or(opposite), link.pull);
    physics.wall(back, out, rho, &link.velocity.map(|u| link.push * u)) - own[out]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_of_a_solid_sums_to_nothing() {
        let links = [0.3, -0.1, 0.02, -0.4, 0.7];
        let mut brought = Brought::new(1);
        links.iter().for_each(|&e| brought.add(1, e));
        let surplus = brought.surplus();
        assert_eq!(surplus[0], 0.0);
        let sum: f64 = links.iter().map(|&e| kept(e, surplus[1])).sum();
        // Five roundings of numbers below one.
        assert!(sum.abs() < 5.0 * f64::EPSILON, "{sum}");
        assert_eq!(kept(0.0, surplus[1]), 0.0);
    }
}
