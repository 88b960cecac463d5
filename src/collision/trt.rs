//! Two relaxation times \[K2\].

use super::forcing_guo::{even_source, odd_source};
use super::{Collision, OddRate};
use crate::lane::Lane;
use crate::lattice::equilibrium::equilibrium;
use crate::lattice::moments::Moments;
use crate::lattice::unroll::directions;
use crate::lattice::{Q, opposite};

/// Two-relaxation-time operator: even populations with ω⁺, odd ones with ω⁻.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trt {
    /// How ω⁻ follows ω⁺.
    pub odd: OddRate,
}

impl Collision for Trt {
    /// f* = f − ω⁺(f⁺ − f_eq⁺) − ω⁻(f⁻ − f_eq⁻) + (1 − ω⁺/2) S⁺ + (1 − ω⁻/2) S⁻
    ///
    /// # Source
    /// docs/method.md \[K2\].
    /// # Verified by
    /// Claims `shear-wave-axis-trt`, `poiseuille-newtonian-magic`.
    #[inline(always)]
    fn collide<L: Lane>(&self, h: &[L; Q], m: &Moments<L>, omega: L) -> [L; Q] {
        let half = L::splat(0.5);
        let odd_omega = self.odd_omega(omega, m.square());
        let heq = equilibrium(m.d_rho, m.rho, &m.u);
        let even = even_source(&m.u, &m.force);
        let odd = odd_source(&m.force);
        let even_weight = L::one() - half * omega;
        let odd_weight = L::one() - half * odd_omega;
        directions(
            #[inline(always)]
            |i| {
                let j = opposite(i);
                let (a, b) = (h[i] - heq[i], h[j] - heq[j]);
                let relaxed = omega * (half * (a + b)) + odd_omega * (half * (a - b));
                (h[i] - relaxed) + (even_weight * even[i] + odd_weight * odd[i])
            },
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
    fn odd_omega<L: Lane>(&self, omega: L, square: L) -> L {
        self.odd.odd_omega(omega, square)
    }

    #[inline(always)]
    fn wanted_odd_excess<L: Lane>(&self, omega: L) -> L {
        self.odd.excess(omega)
    }
}

/// ½[(f − f_eq)_i − (f − f_eq)_ī] + ½ S_i⁻: odd departure of the raw populations.
///
/// # Source
/// docs/method.md \[K2\], \[B3\].
/// # Verified by
/// Claim `poiseuille-newtonian-b3`; property `odd_departure_is_what_relaxes`.
#[inline(always)]
pub(crate) fn raw_odd_departure<L: Lane>(h: &[L; Q], m: &Moments<L>) -> [L; Q] {
    let half = L::splat(0.5);
    let heq = equilibrium(m.d_rho, m.rho, &m.u);
    let source = odd_source(&m.force);
    directions(
        #[inline(always)]
        |i| {
            let j = opposite(i);
            half * (((h[i] - heq[i]) - (h[j] - heq[j])) + source[i])
        },
    )
}
