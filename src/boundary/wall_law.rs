//! The law by stress \[B3\]: the slip of a flat wall from the stress at the wall.

use crate::lane::Lane;
use crate::rheology::Flow;
use crate::rheology::relaxation::omega_of_shear_rate;

/// What the law by stress needs of a wall cell, along the traction; lattice units.
#[derive(Clone, Copy, Debug)]
pub struct WallStress<L = f64> {
    /// Shear stress σ_c of the cell on planes parallel to the wall.
    pub cell: L,
    /// Traction T ≥ 0 that a half-way wall would take.
    pub traction: L,
    /// f, the part of F − ∇p along it.
    pub force: L,
    /// Slip that the link correction takes away.
    pub floor: L,
    /// κ: share of the curvature that the odd departure carries, min(3/(8(τ⁺ − ½)), 2(τ⁻ − ½)).
    pub local: L,
    /// Density.
    pub rho: L,
    /// ω⁺ of the cell.
    pub omega: L,
    /// √(½ Q:Q) of the cell.
    pub magnitude: L,
    /// Largest slip over f.
    pub gain: L,
    /// u² of the cell and of the wall.
    pub squares: [L; 2],
}

/// Stresses closer than this, relative to the largest, are averaged by two points instead of a difference of Γ: the
/// difference would lose half its digits.
const CLOSE: f64 = 1e-4;

/// Half the distance of Gauss and Legendre's two points on an interval of length one.
const TWO_POINTS: f64 = 0.288_675_134_594_812_87;

/// Rounds of the root search: as many as halvings that leave nothing of a bracket; most cells need five.
const ROUNDS: usize = 60;

/// A root is found when a step is below this part of the bracket that the search began with. The last step is Newton's
/// and leaves its square, or a halving and leaves itself: 1e-9 of the traction.
const STEP: f64 = 1e-9;

/// Intervals between nodes, from the wall cell on, over which the integral of γ̇ is compared with the trapezoid rule as it
/// is; further in by the Euler–Maclaurin term. With one, sheared layers of two cells are off by 4 % (a yield surface
/// between nodes is no smooth end of an integral); with three, layers of half a cell to four are within 0.7 %.
const INTERVALS: usize = 3;

/// A fluid at a wall: its law under a stress ≥ 0, and what the collision makes of it.
pub struct Fluid<F, O> {
    thickens: bool,
    flow: F,
    odd_excess: O,
}

impl<F, O> Fluid<F, O> {
    /// `thickens`: whether the law does ([`crate::rheology::Rheology::thickens`]). `flow`: γ̇(σ), its slope and integral.
    /// `odd_excess`: τ⁻ − ½ that goes with an ω⁺ and u².
    #[inline(always)]
    pub const fn new(thickens: bool, flow: F, odd_excess: O) -> Self {
        Self { thickens, flow, odd_excess }
    }
}

/// The slip u_s along the traction.
///
/// For the wall stress s it solves s + (ρ/3) (S₁(s) + S₂ + m (s − σ_c − f/2) + u_f) = T, u_f the floor part; S₁ is what
/// the integral of γ̇ over the half cell at the wall has more than the scheme's half step, S₂ what its trapezoid
/// rule misses further in, m ≥ 0 how S₂ changes with the stress. Then
/// u_s = 3 (T − s)/ρ − u_f, at least 0 and at most 3T/ρ: the wall never returns more than arrives. Nor is it more than G f
/// where the fluid has a surface ([`WallStress::gain`]).
///
/// # Arguments
/// `wall`: the cell. `fluid`: what is in it.
/// # Returns
/// u_s ≥ 0, lattice units; 0 where f or T is not positive.
/// # Exactness
/// Bit-stable: lanes that have found their root keep it.
/// # Source
/// docs/method.md \[B3\]; derived there.
/// # Verified by
/// Claims `poiseuille-thesis-channel`, `poiseuille-scheme-closed-form`; mutant `wall-slip-explicit`.
#[inline(always)]
pub fn slip<L: Lane, F: Fn(L) -> Flow<L>, O: Fn(L, L) -> L>(wall: &WallStress<L>, fluid: &Fluid<F, O>) -> L {
    let zero = L::zero();
    let third = L::splat(1.0 / 3.0) * wall.rho;
    let driven = L::and(zero.less(wall.force), zero.less(wall.traction));
    let one = L::one();
    // Lanes at rest go through the motions with harmless numbers.
    let f = L::select(driven, wall.force, one);
    let t = L::select(driven, wall.traction, one);
    let ahead = Ahead::new(wall, f, fluid);
    let linear = one + third * ahead.slope;
    let start = wall.cell + L::splat(0.5) * f;
    let aim = t + third * (ahead.slope * start - ahead.missed - wall.floor);
    let top = L::larger(aim / linear, zero);
    // Up to the largest stress that can be the root nothing flows.
    let rigid = L::and((fluid.flow)(top).rate.less_equal(zero), wall.omega.less_equal(zero));
    let active = L::and(driven, L::not(rigid));
    if !L::any(active) {
        return zero;
    }
    let scale = L::larger(wall.cell.abs(), t);
    let half = HalfCell {
        f,
        close: (L::splat(0.5) * f).less_equal(L::splat(CLOSE) * scale),
        thickens: fluid.thickens,
        flow: &fluid.flow,
    };
    let s = half.root(active, [linear, third, aim], top, start);
    let most = t / third;
    let slip = L::smaller(L::larger((t - s) / third - wall.floor, zero), most);
    let slip = L::smaller(slip, wall.gain * f);
    L::select(active, slip, zero)
}

/// The law at a stress of either sign: γ̇ is odd, its slope and integral even.
#[inline(always)]
fn signed<L: Lane>(flow: &impl Fn(L) -> Flow<L>, s: L) -> Flow<L> {
    let mut at = flow(s.abs());
    at.rate = L::select(s.less(L::zero()), -at.rate, at.rate);
    at
}

/// Mean of γ̇ between two stresses whose laws are given, `to` − `from` = `over`; where `close`, by two points.
#[inline(always)]
fn mean<L: Lane>(
    flow: &impl Fn(L) -> Flow<L>,
    [from, to]: [L; 2],
    [at_from, at_to]: [&Flow<L>; 2],
    close: L::Mask,
) -> L {
    let over = to - from;
    let mut mean = (at_to.integral - at_from.integral) / over;
    if L::any(close) {
        let (middle, part) = (L::splat(0.5) * (from + to), L::splat(TWO_POINTS) * over);
        let points = signed(flow, middle - part).rate + signed(flow, middle + part).rate;
        mean = L::select(close, L::splat(0.5) * points, mean);
    }
    mean
}

/// S₂ and m = max(0, dS₂/dσ_c).
struct Ahead<L> {
    missed: L,
    slope: L,
}

impl<L: Lane> Ahead<L> {
    /// What the trapezoid rule that the bulk makes of γ̇ misses of its integral from the wall cell inwards, where the
    /// stress falls by f from node to node and no further than to zero; and 2f (τ⁻ − ½)/ρ, by which the node's velocity
    /// is not the one that the rule sums, taken at the last node instead of the first. A thickening law has no
    /// slope at rest to expand about: there the wall cell's own half step is taken off and m is zero.
    #[inline(always)]
    fn new<F: Fn(L) -> Flow<L>, O: Fn(L, L) -> L>(wall: &WallStress<L>, f: L, fluid: &Fluid<F, O>) -> Self {
        let (zero, half, twelfth) = (L::zero(), L::splat(0.5), L::splat(1.0 / 12.0));
        let flow = &fluid.flow;
        let own = signed(flow, wall.cell);
        let (mut missed, mut slope) = (zero, zero);
        let (mut s, mut at) = (wall.cell, own);
        let (mut last_s, mut last) = (wall.cell, own);
        // How much faster than the wall the last node is; the half cell at the wall has the rate of its node.
        let mut faster = half * own.rate;
        for _ in 0..INTERVALS {
            let next = s - f;
            let below = signed(flow, next);
            let inside = zero.less(s);
            let close = f.less_equal(L::splat(CLOSE) * s.abs());
            let mean = mean(flow, [next, s], [&below, &at], close);
            missed = missed + L::select(inside, mean - half * (at.rate + below.rate), zero);
            faster = faster + L::select(inside, mean, zero);
            let bend = (at.rate - below.rate) / f - half * (at.slope + below.slope);
            slope = slope + L::select(inside, bend, zero);
            (s, at) = (next, below);
            let positive = zero.less(s);
            last_s = L::select(positive, s, last_s);
            last = Flow::select(positive, &at, &last);
        }
        let below = signed(flow, s - f);
        let further = f.less_equal(s);
        let (fluidity, fluidity_bend) = apparent(&at, s);
        let rest = (twelfth * f) * fluidity - twelfth * (at.rate - below.rate);
        let rest_bend = (twelfth * f) * fluidity_bend - twelfth * (at.slope - below.slope);
        let (_, own_bend) = apparent(&own, wall.cell);
        let odd = |s: L, at: &Flow<L>, square: L| (fluid.odd_excess)(rate_of(wall.rho, s, at.rate), square);
        let [slow, carried] = wall.squares;
        let shift = odd(wall.cell, &own, slow) - odd(last_s, &last, carried + faster * faster);
        let shift = L::splat(2.0) * f / wall.rho * shift;
        missed = missed + L::select(further, rest, zero) + shift - f * (wall.local / wall.rho);
        if fluid.thickens {
            return Self { missed: missed - half * own.rate, slope: zero };
        }
        slope = slope + L::select(further, rest_bend, zero) - (L::splat(0.125) * f) * own_bend;
        Self { missed, slope: L::larger(slope, zero) }
    }
}

/// ω⁺ of a fluid that flows steadily at γ̇ under the stress s: 1/τ with q = |s| + ργ̇/6.
#[inline(always)]
fn rate_of<L: Lane>(rho: L, s: L, rate: L) -> L {
    let (s, rate) = (s.abs(), rate.abs());
    omega_of_shear_rate(rho, rate, s + (rho * L::splat(1.0 / 6.0)) * rate)
}

/// γ̇/σ and its slope; those of the law at rest at σ = 0.
#[inline(always)]
fn apparent<L: Lane>(at: &Flow<L>, s: L) -> (L, L) {
    let rests = s.abs().less_equal(L::zero());
    let safe = L::select(rests, L::one(), s);
    let ratio = L::select(rests, at.slope, at.rate / safe);
    (ratio, L::select(rests, L::zero(), (at.slope - ratio) / safe))
}

/// The half cell at the wall, where the stress rises by f/2.
struct HalfCell<'a, L: Lane, F> {
    f: L,
    close: L::Mask,
    thickens: bool,
    flow: &'a F,
}

impl<L: Lane, F: Fn(L) -> Flow<L>> HalfCell<'_, L, F> {
    /// S₁(s) and its slope: half the mean of γ̇ over the half cell, less half of what it is in the middle of the cell.
    #[inline(always)]
    fn excess(&self, s: L) -> (L, L) {
        let half = L::splat(0.5);
        let below = s - half * self.f;
        let (inner, wall) = (signed(self.flow, below), signed(self.flow, s));
        let value = half * mean(self.flow, [below, s], [&inner, &wall], self.close);
        let slope = (wall.rate - inner.rate) / self.f;
        if self.thickens { (value, slope) } else { (value - half * inner.rate, slope - half * inner.slope) }
    }

    /// The root s of linear·s + third·S₁(s) = aim in \[0, top\]: Newton's method, halving where it would leave the
    /// bracket or has become slow.
    #[inline(always)]
    fn root(&self, active: L::Mask, [linear, third, aim]: [L; 3], top: L, start: L) -> L {
        let half = L::splat(0.5);
        let (mut low, mut high) = (L::zero(), top);
        let mut s = L::smaller(L::larger(start, low), high);
        let (mut last, mut moving) = (top, active);
        for _ in 0..ROUNDS {
            let (value, slope) = self.excess(s);
            let off = (linear * s + third * value) - aim;
            let above = L::zero().less(off);
            high = L::select(above, s, high);
            low = L::select(above, low, s);
            let newton = s - off / (linear + third * slope);
            let inside = L::and(low.less_equal(newton), newton.less_equal(high));
            let quick = (newton - s).abs().less_equal(half * last.abs());
            let next = L::select(L::and(inside, quick), newton, half * (low + high));
            last = next - s;
            s = L::select(moving, next, s);
            moving = L::and(moving, (L::splat(STEP) * top).less(last.abs()));
            if !L::any(moving) {
                break;
            }
        }
        s
    }
}
