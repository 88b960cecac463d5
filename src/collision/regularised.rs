//! Recursive-regularised relaxation \[K4\]: a robust fallback.

use super::Collision;
use super::central_moment::{
    co_moving_odd_departure, induced, rebuild, relaxed_stress, third_equilibrium, third_force,
};
use crate::lane::Lane;
use crate::lattice::Q;
use crate::lattice::moments::Moments;
use crate::lattice::unroll::six;

/// Recursive-regularised operator: third and fourth non-equilibrium moments are rebuilt from the
/// second ones at every step, so no ghost mode survives a collision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Regularised;

impl Collision for Regularised {
    /// a* = e + A1 + ½ s: the recursion of the third Hermite moment from the relaxed stress.
    ///
    /// # Source
    /// docs/method.md \[K4\].
    /// # Verified by
    /// Claim `shear-wave-order-regularised`.
    #[inline(always)]
    fn collide<L: Lane>(&self, _h: &[L; Q], m: &Moments<L>, omega: L) -> [L; Q] {
        let p = relaxed_stress(m, omega);
        let third = six(
            #[inline(always)]
            |k| (third_equilibrium(m, k) + induced(&m.u, &p, k)) + L::splat(0.5) * third_force(m, k),
        );
        rebuild(m, &p, &third)
    }

    fn has_cubic_equilibrium(&self) -> bool {
        true
    }

    #[inline(always)]
    fn odd_departure<L: Lane>(&self, h: &[L; Q], m: &Moments<L>) -> [L; Q] {
        co_moving_odd_departure(h, m)
    }

    /// Third moments carry no memory: ω⁻ = 1.
    #[inline(always)]
    fn odd_omega<L: Lane>(&self, _omega: L, _square: L) -> L {
        L::one()
    }
}
