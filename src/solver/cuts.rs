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

/// Σe/Σ|e| of a solid, times Σ |e| of a cell: the mass that is taken off the cell so that the solid brings in nothing.
///
/// Mass that goes into a solid's cell at one link comes out of it at another one further on, so that links are not free
/// of mass one by one, and a cell's are not either; only all of a solid's are. What is left of their sum, of second
/// order, is taken off the cells in proportion to what each gets through its links: fluid at rest stays at rest. It is taken
/// off as density, w_i of it from each population, which has no momentum: taken off the links it feeds the momentum of
/// alternating sign that bounce-back keeps for ever (4e-11 of the speed per step past a cylinder at τ⁺ = 1, now 3e-14).
///
/// # Source
/// Derived here, docs/method.md \[B4\].
/// # Verified by
/// Claim `pipe-newtonian-cut`, tests `tilted_box_keeps_mass_and_rest`, `driven_flow_keeps_mass`.
#[inline]
pub(crate) fn taken(brought: &[f64], surplus: f64) -> f64 {
    brought.iter().fold(0.0, |sum, e| sum + e.abs()) * surplus
}

/// What a cut link brings in to a cell that is full of fluid \[B4\]: what comes back less what left.
///
/// # Arguments
/// `own`: post-collision populations of the cell. `behind`: the population of the cell straight behind. `rho`: density of
/// the cell.
#[inline]
pub(crate) fn cut_link<P: Physics>(
    physics: &P,
    own: &Cell,
    link: &CutLink,
    behind: Option<f64>,
    rho: f64,
) -> f64 {
    let out = usize::from(link.out);
    let opposite = own[opposite(out)];
    let back = central_linear(own[out], opposite, behind.unwrap_or(opposite), link.pull);
    physics.wall(back, out, rho, &link.velocity.map(|u| link.push * u)) - own[out]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_taken_is_what_a_solid_brings() {
        let cells: [&[f64]; 2] = [&[0.3, -0.1, 0.02], &[-0.4, 0.7]];
        let mut brought = Brought::new(1);
        cells.iter().flat_map(|links| *links).for_each(|&e| brought.add(1, e));
        let surplus = brought.surplus();
        assert_eq!(surplus[0], 0.0);
        let sum: f64 = cells.iter().map(|links| links.iter().sum::<f64>() - taken(links, surplus[1])).sum();
        // Five roundings of numbers below one.
        assert!(sum.abs() < 5.0 * f64::EPSILON, "{sum}");
        assert_eq!(taken(&[0.0, 0.0], surplus[1]), 0.0);
    }
}
