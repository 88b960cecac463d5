//! Central-moment relaxation about the co-moving state \[K3\], the default for yield stress.

use super::{Collision, OddRate};
use crate::lane::Lane;
use crate::lattice::moments::{Moments, THIRD, deviator, momentum, populations, third};
use crate::lattice::unroll::{six, three};
use crate::lattice::{Q, SYMMETRIC, pair};

/// Central-moment operator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CentralMoment {
    /// How ω⁻ follows ω⁺.
    pub odd: OddRate,
}

impl Collision for CentralMoment {
    /// Second moments relax with ω⁺ (their trace with 1), third moments with ω⁻ towards what the
    /// second ones induce in the co-moving frame, fourth moments follow.
    ///
    /// # Source
    /// docs/method.md \[K3\].
    /// # Verified by
    /// Claims `poiseuille-newtonian-magic`, `poiseuille-bingham`, `central-moment-galilean`.
    #[inline(always)]
    fn collide<L: Lane>(&self, h: &[L; Q], m: &Moments<L>, omega: L) -> [L; Q] {
        let keep_odd = L::one() - self.odd_omega(omega, m.square());
        let p = relaxed_stress(m, omega);
        let a = third_hermite(h);
        let relaxed = third_post(m, &a, &p, keep_odd);
        rebuild(m, &p, &relaxed)
    }

    fn has_cubic_equilibrium(&self) -> bool {
        true
    }

    #[inline(always)]
    fn odd_departure<L: Lane>(&self, h: &[L; Q], m: &Moments<L>) -> [L; Q] {
        co_moving_odd_departure(h, m)
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

/// P = (1 − ω⁺) dev Q: the trace is relaxed at rate 1.
///
/// # Source
/// docs/method.md \[K3\].
/// # Verified by
/// Claim `sound-wave-damping`.
#[inline(always)]
pub(crate) fn relaxed_stress<L: Lane>(m: &Moments<L>, omega: L) -> [L; 6] {
    let keep = L::one() - omega;
    let q = deviator(&m.q);
    six(
        #[inline(always)]
        |k| keep * q[k],
    )
}

/// Third moments in Hermite form, a = m_aab − m_b/3, of the pre-collision populations.
///
/// # Source
/// docs/method.md \[K3\].
/// # Verified by
/// Property `inverse_reproduces_moments`.
#[inline(always)]
pub(crate) fn third_hermite<L: Lane>(h: &[L; Q]) -> [L; 6] {
    let m3 = third(h);
    let j = momentum(h);
    six(
        #[inline(always)]
        |k| m3[k] - L::splat(1.0 / 3.0) * j[THIRD[k][1]],
    )
}

/// e = ρ u_a² u_b: third Hermite moment of the equilibrium.
///
/// # Source
/// docs/method.md \[K3\].
/// # Verified by
/// Claim `central-moment-galilean`.
#[inline(always)]
pub(crate) fn third_equilibrium<L: Lane>(m: &Moments<L>, k: usize) -> L {
    let [a, b] = THIRD[k];
    m.rho * ((m.u[a] * m.u[a]) * m.u[b])
}

/// s = 2 u_a u_b F_a + u_a² F_b: third Hermite moment of the force source.
///
/// # Source
/// docs/method.md \[K3\].
/// # Verified by
/// Claim `central-moment-galilean`.
#[inline(always)]
pub(crate) fn third_force<L: Lane>(m: &Moments<L>, k: usize) -> L {
    let [a, b] = THIRD[k];
    L::splat(2.0) * ((m.u[a] * m.u[b]) * m.force[a]) + (m.u[a] * m.u[a]) * m.force[b]
}

/// 2 u_a T_ab + u_b T_aa: what a second-order tensor at rest in the co-moving frame induces.
///
/// # Source
/// docs/method.md \[K3\] (A0 with T = Q, A1 with T = P).
/// # Verified by
/// Claim `central-moment-galilean`.
#[inline(always)]
pub(crate) fn induced<L: Lane>(u: &[L; 3], tensor: &[L; 6], k: usize) -> L {
    let [a, b] = THIRD[k];
    L::splat(2.0) * (u[a] * tensor[pair(a, b)]) + u[b] * tensor[a]
}

/// A − A0, with A = a − e + ½ s: the part of a third moment that is not induced by the stress.
///
/// # Source
/// docs/method.md \[K3\].
/// # Verified by
/// Claims `poiseuille-newtonian-magic`, `central-moment-galilean`.
#[inline(always)]
pub(crate) fn third_departure<L: Lane>(m: &Moments<L>, a: L, k: usize) -> L {
    let departure = (a - third_equilibrium(m, k)) + L::splat(0.5) * third_force(m, k);
    departure - induced(&m.u, &m.q, k)
}

/// a* = e + A1 + (1 − ω⁻)(A − A0) + ½ s.
///
/// # Source
/// docs/method.md \[K3\].
/// # Verified by
/// Claims `poiseuille-newtonian-magic`, `central-moment-galilean`.
#[inline(always)]
pub(crate) fn third_post<L: Lane>(m: &Moments<L>, a: &[L; 6], p: &[L; 6], keep_odd: L) -> [L; 6] {
    six(
        #[inline(always)]
        |k| {
            let half_s = L::splat(0.5) * third_force(m, k);
            let own = third_departure(m, a[k], k);
            ((third_equilibrium(m, k) + induced(&m.u, p, k)) + keep_odd * own) + half_s
        },
    )
}

/// The departures of all third moments as populations.
///
/// # Source
/// docs/method.md \[K3\], \[B3\].
/// # Verified by
/// Claim `poiseuille-newtonian-b3`; property `odd_departure_is_what_relaxes`.
#[inline(always)]
pub(crate) fn co_moving_odd_departure<L: Lane>(h: &[L; Q], m: &Moments<L>) -> [L; Q] {
    let zero = L::zero();
    let a = third_hermite(h);
    let own = six(
        #[inline(always)]
        |k| third_departure(m, a[k], k),
    );
    populations(zero, &[zero; 3], &[zero; 6], &own, &[zero; 3])
}

/// Post-collision populations from second moments ρuu + P + ½(uF + Fu), third Hermite moments and
/// the fourth moments they imply.
///
/// # Source
/// docs/method.md \[K3\].
/// # Verified by
/// Property `conserves_mass_and_momentum`; claim `poiseuille-newtonian-magic`.
#[inline(always)]
pub(crate) fn rebuild<L: Lane>(m: &Moments<L>, p: &[L; 6], third: &[L; 6]) -> [L; Q] {
    let (u, force) = (&m.u, &m.force);
    let (half, one_third) = (L::splat(0.5), L::splat(1.0 / 3.0));
    let pressure = one_third * m.d_rho;
    let m1 = three(
        #[inline(always)]
        |a| m.rho * u[a] + half * force[a],
    );
    let m2 = six(
        #[inline(always)]
        |k| {
            let [a, b] = SYMMETRIC[k];
            let convected = m.rho * (u[a] * u[b]) + p[k];
            let forced = half * (u[a] * force[b] + u[b] * force[a]);
            if a == b { (pressure + convected) + forced } else { convected + forced }
        },
    );
    let m3 = six(
        #[inline(always)]
        |k| third[k] + one_third * m1[THIRD[k][1]],
    );
    let m4 = three(
        #[inline(always)]
        |k| {
            let [a, b] = SYMMETRIC[3 + k];
            let (uu_a, uu_b) = (u[a] * u[a], u[b] * u[b]);
            let induced = (uu_a * p[b] + uu_b * p[a]) + L::splat(4.0) * ((u[a] * u[b]) * p[pair(a, b)]);
            let isotropic = one_third * ((m2[a] + m2[b]) - L::splat(2.0) * pressure) + one_third * pressure;
            (m.rho * (uu_a * uu_b) + induced) + isotropic
        },
    );
    populations(m.d_rho, &m1, &m2, &m3, &m4)
}
