//! The viscosity-independent wall \[B3\] and the residual force it needs.

use super::flat_wall::FlatWall;
use super::wall_law::WallStress;
use crate::lane::Lane;
use crate::lattice::moments::density_excess;
use crate::lattice::unroll::{directions, six};
use crate::lattice::{CS2, Q, W};
use crate::rheology::Law;

/// Largest slip over f below a free surface: beyond it a pool between walls shakes itself.
///
/// Of pools of 2 to 8 cells with plastic τ⁺ = 0.505 to 0.506 (1/(8μ) − κ/ρ of 58 to 74) all grew from rounding to 1e-2 m/s
/// with [K2] and three of four with [K3], in wall cells that move up and down in turn; with 20 two of four with [K2], with 10
/// none; without walls along the weight none at all. Set after seeing, with a margin. It binds below τ⁺ = 0.53, and leaves
/// (1 − 8/(1/(8μ) − κ/ρ))/(4h²) of the largest speed of a channel of half width h uncorrected there: 0.4 % at 8 cells and
/// τ⁺ = 0.505.
const CALM_GAIN: f64 = 8.0;

/// Largest slip over f, lattice units: [`CALM_GAIN`] at walls along which the weight of a fluid with a surface acts more than
/// across them, unless its yield stress is more than the weight of a cell, which it then holds; no bound at floors of up to
/// 45°, which press on the fluid, nor without a surface.
///
/// # Arguments
/// `weight`: the body force where there is a surface. `law`: the fluid. `flat`: the wall.
#[must_use]
pub(crate) fn largest_gain(weight: Option<&[f64; 3]>, law: &Law, flat: Option<FlatWall>) -> f64 {
    match (weight, flat) {
        (Some(weight), Some(flat)) if flat.runs_along(weight) && !holds(law, weight) => CALM_GAIN,
        _ => f64::INFINITY,
    }
}

/// Whether a yield stress is more than the weight of a cell.
fn holds(law: &Law, weight: &[f64; 3]) -> bool {
    let sigma0 = match *law {
        Law::Newtonian { .. } | Law::PowerLaw { .. } => 0.0,
        Law::Bingham { sigma0, .. }
        | Law::HerschelBulkley { sigma0, .. }
        | Law::Papanastasiou { sigma0, .. } => sigma0,
    };
    sigma0 * sigma0 > weight.iter().map(|f| f * f).sum::<f64>()
}

/// f min(1/(8μ) − κ/ρ, G), at least 0 and at most 3T/ρ: the slip \[B3\] of a fluid whose viscosity is the same everywhere.
///
/// f/(8μ) = |u″|/8 is what the curvature of the velocity profile adds over the half cell between node and wall, fκ/ρ
/// what the odd departure carries of it. For such a fluid the law by stress ([`super::wall_law::slip`]) is this in closed
/// form, since Γ = σ²/(2μ).
///
/// f is the less of two that are the same in steady flow: F − ∇p, and 2 (s − σ_c), by which the stress rises over the
/// cell if s = T − ρ (u_s + u_f)/3 is that of the wall. The first leaves inertia out, so that at small τ⁺, where 1/(8μ)
/// is large, a wave of pressure along the wall would drive it; the second is not zero in waves of fluid at rest.
///
/// G bounds how strongly the wall answers where the fluid has a surface: 8 at walls along which its weight acts, else infinite.
///
/// # Arguments
/// `wall`: the cell. `fluidity`: 1/μ.
/// # Returns
/// The slip along the traction, lattice units.
/// # Source
/// docs/method.md \[B3\].
/// # Verified by
/// Claims `poiseuille-newtonian-b3`, `poiseuille-newtonian-b3-large-tau`, `duct-waves-die`; mutant
/// `wall-slip-by-pressure`.
#[inline(always)]
pub fn newtonian_slip<L: Lane>(wall: &WallStress<L>, fluidity: L) -> L {
    let zero = L::zero();
    let third = L::splat(1.0 / 3.0) * wall.rho;
    let share = L::smaller(L::splat(0.125) * fluidity - wall.local / wall.rho, wall.gain);
    let twice = L::splat(2.0) * share;
    let rise = wall.traction - third * wall.floor - wall.cell;
    let by_stress = (twice * rise) / (L::one() + twice * third);
    let slip = L::smaller(by_stress, share * wall.force);
    let most = wall.traction / third;
    L::smaller(L::larger(slip, zero), L::larger(most, zero))
}

/// How much of the curvature term the odd departure of the cell carries: min(3/(8(τ⁺ − ½)), 2(τ⁻ − ½)).
///
/// In steady flow the departure measures the stress gradient, so that ω⁻ d (2(τ⁻ − ½) − 3/(8(τ⁺ − ½)))
/// corrects position and slip at once and includes the inertia that F − ∇p leaves out: for a Newtonian
/// fluid at Λ = 3/16 it is zero, as it should be. The second bound keeps the factor from turning
/// negative, so that the wall damps the departure at least as much as plain bounce-back; what is left of
/// the curvature is taken from the law by stress ([`super::wall_law::slip`]).
///
/// # Arguments
/// `omega`, `odd_omega`: the cell's ω⁺ and ω⁻; ω⁺ = 0 (rigid) gives 0.
/// # Source
/// docs/method.md \[B3\], extended to unsteady flow.
/// # Verified by
/// Claims `couette-start-up`, `poiseuille-newtonian-b3`.
#[inline(always)]
pub(crate) fn local_curvature<L: Lane>(omega: L, odd_omega: L) -> L {
    let half = L::splat(0.5);
    // 1/(τ⁺ − ½) = ω/(1 − ω/2): finite at ω = 0.
    let curvature = L::splat(3.0 / 8.0) * (omega / (L::one() - half * omega));
    L::smaller(curvature, L::splat(2.0) * (L::one() / odd_omega - half))
}

/// What a steady half-way link returns too much, less its weighted mean over the links that hit the
/// wall; zero on the other links.
///
/// That is (2 − ω⁻) d_i + s_i for a straight profile, d the odd departure
/// ([`crate::collision::Collision::odd_departure`]), s a source added after collision \[K6\]. For a
/// lattice-aligned wall the sum over the links is the slip 2(τ⁻ − ½) f_t/ρ of the method, and the creep
/// 2θF/ρ of a rigid cell. Taken link by link it holds for walls of any orientation and for moving
/// walls, and needs no wall normal and no pressure gradient. The mean is removed so that no mass passes
/// the wall.
///
/// # Arguments
/// `excess`: by direction. `is_wall(i)`: whether the link along c_i hits the wall.
/// # Returns
/// What to subtract from the population that leaves along c_i before it comes back \[B1\].
/// # Exactness
/// Mirror-exact.
/// # Source
/// docs/method.md \[B3\], first term, derived link by link from f_i(x + c_i, t + 1) = f_i*(x, t) at steady state.
/// # Verified by
/// Claims `poiseuille-newtonian-b3`, `resting-layer-creep`.
#[inline(always)]
pub fn link_correction<L: Lane>(excess: &[L; Q], is_wall: impl Fn(usize) -> bool) -> [L; Q] {
    let hits = directions(
        #[inline(always)]
        |i| if i > 0 && is_wall(i) { excess[i] } else { L::zero() },
    );
    // Weights in units of 1/36, so that their sum does not depend on the order.
    let parts = |i: usize| if i <= 6 { 2_i32 } else { 1 };
    let mut weight = 0;
    for i in 1..Q {
        if is_wall(i) {
            weight += parts(i);
        }
    }
    let mean = density_excess(&hits) * L::splat(if weight > 0 { 36.0 / f64::from(weight) } else { 0.0 });
    directions(
        #[inline(always)]
        |i| if i > 0 && is_wall(i) { excess[i] - L::splat(W[i]) * mean } else { L::zero() },
    )
}

/// ∂p from the densities of the two neighbours along one axis; one-sided where one is missing,
/// zero where both are.
///
/// # Source
/// docs/method.md \[B3\], \[K6\]: p = c_s² ρ.
/// # Verified by
/// Claim `resting-layer-creep`.
#[must_use]
pub(crate) fn pressure_slope(low: Option<f64>, here: f64, high: Option<f64>) -> f64 {
    match (low, high) {
        (Some(a), Some(b)) => 0.5 * CS2 * (b - a),
        (Some(a), None) => CS2 * (here - a),
        (None, Some(b)) => CS2 * (b - here),
        (None, None) => 0.0,
    }
}

/// (2/3) f_a (1 − τ_w/τ⁻) for each third moment a_abb, where the floor θ acts \[K6\].
///
/// The design gives the source for one shear-normal direction b. Here it is divided over the two
/// directions b ≠ a in proportion to Q_ab², so that the direction in which the component a is
/// sheared gets it.
///
/// # Arguments
/// `residual`: f = F − ∇p. `q`: deviator of the non-equilibrium tensor. `excess_wanted`: τ_w − ½.
/// `odd_omega`: ω⁻.
/// # Returns
/// Additions to the six third moments, order of `crate::lattice::moments::THIRD`.
/// # Source
/// docs/method.md \[K6\].
/// # Verified by
/// Claim `resting-layer-creep`.
#[inline(always)]
pub fn stress_source<L: Lane>(residual: &[L; 3], q: &[L; 6], excess_wanted: L, odd_omega: L) -> [L; 6] {
    use crate::lattice::moments::THIRD;
    use crate::lattice::pair;
    let half = L::splat(0.5);
    let share = L::one() - (half + excess_wanted) * odd_omega;
    let share = L::select(L::zero().less(share), share, L::zero());
    six(
        #[inline(always)]
        |k| {
            // Moment (b, a): Σ c_b² c_a f.
            let [b, a] = THIRD[k];
            let c = 3 - a - b;
            let (own, other) = (q[pair(a, b)] * q[pair(a, b)], q[pair(a, c)] * q[pair(a, c)]);
            let total = own + other;
            let sheared = L::zero().less(total);
            let weight = L::select(sheared, own / L::select(sheared, total, L::one()), L::zero());
            L::splat(2.0 / 3.0) * ((weight * residual[a]) * share)
        },
    )
}
