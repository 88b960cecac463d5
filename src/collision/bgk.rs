//! Single relaxation time \[K1\].

use super::Collision;
use super::forcing_guo::{even_source, odd_source};
use super::trt::raw_odd_departure;
use crate::lane::Lane;
use crate::lattice::Q;
use crate::lattice::equilibrium::equilibrium;
use crate::lattice::moments::Moments;
use crate::lattice::unroll::directions;

/// Bhatnagar-Gross-Krook operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bgk;

impl Collision for Bgk {
    /// f* = f − ω (f − f_eq) + (1 − ω/2) S
    ///
    /// # Source
    /// 004 Eqs 3.21, 3.28.
    /// # Verified by
    /// Claims `shear-wave-axis-bgk`, `poiseuille-newtonian-bgk-slip`.
    #[inline(always)]
    fn collide<L: Lane>(&self, h: &[L; Q], m: &Moments<L>, omega: L) -> [L; Q] {
        let heq = equilibrium(m.d_rho, m.rho, &m.u);
        let even = even_source(&m.u, &m.force);
        let odd = odd_source(&m.force);
        let weight = L::one() - L::splat(0.5) * omega;
        directions(
            #[inline(always)]
            |i| (h[i] - omega * (h[i] - heq[i])) + weight * (even[i] + odd[i]),
        )
    }

    fn has_cubic_equilibrium(&self) -> bool {
        false
    }

    #[inline(always)]
    fn odd_departure<L: Lane>(&self, h: &[L; Q], m: &Moments<L>) -> [L; Q] {
        raw_odd_departure(h, m)
    }

    #[inline(always)]
    fn odd_omega<L: Lane>(&self, omega: L, _square: L) -> L {
        omega
    }
}
