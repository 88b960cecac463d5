//! Sums over the populations of one cell: density, velocity, non-equilibrium stress, third moments.

use super::{Q, SYMMETRIC};
use crate::lane::Lane;
use crate::lattice::unroll::{directions, six, three};

/// What a collision needs to know of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments<L> {
    /// ρ − 1.
    pub d_rho: L,
    /// Density ρ.
    pub rho: L,
    /// Velocity with half the force \[L4\].
    pub u: [L; 3],
    /// Body force of this step.
    pub force: [L; 3],
    /// Σ c c (f − f_eq) + ½(uF + Fu), with its trace; xx, yy, zz, xy, xz, yz.
    pub q: [L; 6],
}

impl<L: Lane> Moments<L> {
    /// u².
    #[inline(always)]
    #[must_use]
    pub fn square(&self) -> L {
        (self.u[0] * self.u[0] + self.u[1] * self.u[1]) + self.u[2] * self.u[2]
    }
}

/// δρ = Σ h_i \[L4\].
///
/// # Exactness
/// Grouped by axis pairs, then planes: mirror-exact.
/// # Source
/// 004 Eq 3.28.
/// # Verified by
/// Claim `conservation-collision`, property `conserves_mass_and_momentum`.
#[inline(always)]
pub fn density_excess<L: Lane>(h: &[L; Q]) -> L {
    let axes = ((h[1] + h[2]) + (h[3] + h[4])) + (h[5] + h[6]);
    let xy = (h[7] + h[8]) + (h[9] + h[10]);
    let xz = (h[11] + h[12]) + (h[13] + h[14]);
    let yz = (h[15] + h[16]) + (h[17] + h[18]);
    h[0] + (axes + ((xy + xz) + yz))
}

/// Σ c_i h_i: momentum without the force correction.
///
/// # Exactness
/// Mirror-exact: each component is (sum of the five populations with c_a = +1) − (those with −1).
/// # Source
/// 004 Eq 3.28.
/// # Verified by
/// Property `conserves_mass_and_momentum`.
#[inline(always)]
pub fn momentum<L: Lane>(h: &[L; Q]) -> [L; 3] {
    [
        five(h, 1, [7, 9], [11, 13]) - five(h, 2, [8, 10], [12, 14]),
        five(h, 3, [7, 10], [15, 17]) - five(h, 4, [8, 9], [16, 18]),
        five(h, 5, [11, 14], [15, 18]) - five(h, 6, [12, 13], [16, 17]),
    ]
}

/// The five populations with the same component of the velocity: an axis, two planes.
#[inline(always)]
fn five<L: Lane>(h: &[L; Q], a: usize, b: [usize; 2], c: [usize; 2]) -> L {
    h[a] + ((h[b[0]] + h[b[1]]) + (h[c[0]] + h[c[1]]))
}

/// Second raw moments Σ c_a c_b h_i: xx, yy, zz, xy, xz, yz.
///
/// # Exactness
/// Mirror-exact.
/// # Source
/// 004 Eq 3.27.
/// # Verified by
/// Claim `equilibrium-moments`.
#[inline(always)]
pub fn second<L: Lane>(h: &[L; Q]) -> [L; 6] {
    let xy = (h[7] + h[8]) + (h[9] + h[10]);
    let xz = (h[11] + h[12]) + (h[13] + h[14]);
    let yz = (h[15] + h[16]) + (h[17] + h[18]);
    [
        (h[1] + h[2]) + (xy + xz),
        (h[3] + h[4]) + (xy + yz),
        (h[5] + h[6]) + (xz + yz),
        (h[7] + h[8]) - (h[9] + h[10]),
        (h[11] + h[12]) - (h[13] + h[14]),
        (h[15] + h[16]) - (h[17] + h[18]),
    ]
}

/// Third raw moments Σ c_a² c_b h_i of the six kinds D3Q19 has, in the order of `THIRD`.
///
/// # Exactness
/// Mirror-exact.
/// # Source
/// docs/method.md \[K3\].
/// # Verified by
/// Property `inverse_reproduces_moments`.
#[inline(always)]
pub fn third<L: Lane>(h: &[L; Q]) -> [L; 6] {
    [
        (h[7] - h[8]) + (h[10] - h[9]),    // xxy
        (h[11] - h[12]) + (h[14] - h[13]), // xxz
        (h[7] - h[8]) + (h[9] - h[10]),    // yyx
        (h[15] - h[16]) + (h[18] - h[17]), // yyz
        (h[11] - h[12]) + (h[13] - h[14]), // zzx
        (h[15] - h[16]) + (h[17] - h[18]), // zzy
    ]
}

/// The six third moments (a, b): Σ c_a² c_b f.
pub(crate) const THIRD: [[usize; 2]; 6] = [[0, 1], [0, 2], [1, 0], [1, 2], [2, 0], [2, 1]];

/// Q = Π^neq + ½(uF + Fu), with its trace \[Y1\].
///
/// Π^neq_ab = Σ c_a c_b h − δρ δ_ab/3 − ρ u_a u_b
///
/// # Source
/// docs/method.md \[Y1\]; docs/errata.md 5 (force correction), 1 (equilibrium subtracted).
/// # Verified by
/// Claims `shear-rate-couette`, `shear-rate-uniform-acceleration`.
#[inline(always)]
pub fn non_equilibrium<L: Lane>(pi: &[L; 6], d_rho: L, rho: L, u: &[L; 3], force: &[L; 3]) -> [L; 6] {
    let p = L::splat(1.0 / 3.0) * d_rho;
    six(
        #[inline(always)]
        |k| {
            let [a, b] = SYMMETRIC[k];
            if a == b {
                ((pi[a] - p) - rho * (u[a] * u[a])) + u[a] * force[a]
            } else {
                (pi[k] - rho * (u[a] * u[b])) + L::splat(0.5) * (u[a] * force[b] + u[b] * force[a])
            }
        },
    )
}

/// Density, velocity and non-equilibrium tensor of one cell \[L4\] \[Y1\].
///
/// ρ = Σ f, ρu = Σ c f + F/2
///
/// # Source
/// 004 Eqs 3.28–3.29.
/// # Verified by
/// Claims `shear-rate-uniform-acceleration`, `conservation-collision`.
#[inline(always)]
pub fn moments<L: Lane>(h: &[L; Q], force: &[L; 3]) -> Moments<L> {
    let d_rho = density_excess(h);
    let rho = L::one() + d_rho;
    let j = momentum(h);
    let u = three(
        #[inline(always)]
        |a| (j[a] + L::splat(0.5) * force[a]) / rho,
    );
    let q = non_equilibrium(&second(h), d_rho, rho, &u, force);
    Moments { d_rho, rho, u, force: *force, q }
}

/// Trace-free part of a symmetric tensor.
///
/// # Source
/// docs/method.md \[Y1\].
/// # Verified by
/// Property `stress_is_isotropic`.
#[inline(always)]
pub fn deviator<L: Lane>(q: &[L; 6]) -> [L; 6] {
    let third = L::splat(1.0 / 3.0) * ((q[0] + q[1]) + q[2]);
    [q[0] - third, q[1] - third, q[2] - third, q[3], q[4], q[5]]
}

/// q = √(½ Q:Q) of a symmetric tensor \[Y1\].
///
/// # Source
/// docs/method.md \[Y1\]; docs/errata.md 3, 4 (which factor goes with which tensor).
/// # Verified by
/// Claim `shear-rate-couette`.
#[inline(always)]
pub fn magnitude<L: Lane>(q: &[L; 6]) -> L {
    let diagonal = (q[0] * q[0] + q[1] * q[1]) + q[2] * q[2];
    let mixed = (q[3] * q[3] + q[4] * q[4]) + q[5] * q[5];
    (L::splat(0.5) * diagonal + mixed).sqrt()
}

/// Populations from their 19 raw moments: `m0` (density excess), first, second, third, fourth
/// (aabb: xxyy, xxzz, yyzz). The rest population is set last, as density minus the others.
///
/// # Exactness
/// Mirror-exact; Σ h equals `m0` to the rounding of one subtraction.
/// # Source
/// docs/method.md \[K3\].
/// # Verified by
/// Property `inverse_reproduces_moments`.
#[inline(always)]
pub fn populations<L: Lane>(m0: L, m1: &[L; 3], m2: &[L; 6], m3: &[L; 6], m4: &[L; 3]) -> [L; Q] {
    let x = axis(m2[0], [m4[0], m4[1]], m1[0], [m3[2], m3[4]]);
    let y = axis(m2[1], [m4[0], m4[2]], m1[1], [m3[0], m3[5]]);
    let z = axis(m2[2], [m4[1], m4[2]], m1[2], [m3[1], m3[3]]);
    let xy = plane(m4[0], m3[2], m3[0], m2[3]);
    let xz = plane(m4[1], m3[4], m3[1], m2[4]);
    let yz = plane(m4[2], m3[5], m3[3], m2[5]);
    let mut h = [
        L::zero(),
        x[0],
        x[1],
        y[0],
        y[1],
        z[0],
        z[1],
        xy[0],
        xy[1],
        xy[2],
        xy[3],
        xz[0],
        xz[1],
        xz[2],
        xz[3],
        yz[0],
        yz[1],
        yz[2],
        yz[3],
    ];
    h[0] = m0 - density_excess(&h);
    h
}

/// f(s, r) = ¼ (m_aabb + s m_bba + r m_aab + s r m_ab) for the four diagonals (s, r) of one plane.
///
/// # Source
/// docs/method.md \[K3\].
/// # Verified by
/// Property `inverse_reproduces_moments`.
#[inline(always)]
fn plane<L: Lane>(aabb: L, bba: L, aab: L, ab: L) -> [L; 4] {
    let quarter = L::splat(0.25);
    let even_plus = aabb + ab;
    let even_minus = aabb - ab;
    [
        quarter * (even_plus + (bba + aab)),
        quarter * (even_plus - (bba + aab)),
        quarter * (even_minus + (bba - aab)),
        quarter * (even_minus - (bba - aab)),
    ]
}

/// f(s) = ½ (m_aa − m_aabb − m_aacc + s (m_a − m_bba − m_cca)) for the two directions of one axis.
///
/// # Source
/// docs/method.md \[K3\].
/// # Verified by
/// Property `inverse_reproduces_moments`.
#[inline(always)]
fn axis<L: Lane>(aa: L, fourth: [L; 2], a: L, third: [L; 2]) -> [L; 2] {
    let half = L::splat(0.5);
    let even = aa - (fourth[0] + fourth[1]);
    let odd = a - (third[0] + third[1]);
    [half * (even + odd), half * (even - odd)]
}

/// Adds `delta` to the six third moments without touching density, momentum, second and fourth moments.
///
/// # Source
/// docs/method.md \[K6\] needs it; same inverse as [`populations`].
/// # Verified by
/// Property `inverse_reproduces_moments`.
#[inline(always)]
pub fn add_third<L: Lane>(h: &mut [L; Q], delta: &[L; 6]) {
    let zero = L::zero();
    let change = populations(zero, &[zero; 3], &[zero; 6], delta, &[zero; 3]);
    *h = directions(
        #[inline(always)]
        |i| if i == 0 { h[0] } else { h[i] + change[i] },
    );
}
