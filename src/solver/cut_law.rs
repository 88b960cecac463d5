//! What the viscosity-independent wall takes off the links of a cut cell \[B4\].

use crate::boundary::cut::push;
use crate::boundary::wall_law::CutStress;
use crate::boundary::wall_slip::local_curvature;
use crate::lane::Lane;
use crate::lattice::moments::{density_excess, deviator};
use crate::lattice::unroll::{directions, three};
use crate::lattice::{C, Q, W, pair};
use crate::setup::CutCell;
use crate::solver::cell::State;
use crate::solver::physics::Physics;

/// Part of the way that the remembered stress goes to that of the step: fifty steps, longer than a pressure wave takes
/// over the cells that F − ∇p is made from, shorter than the flow takes to change.
const FOLLOWS: f64 = 0.02;

/// What a cut cell remembers of its stress: the traction along the wall and how it grows towards it.
pub(crate) type Memory<L = f64> = [L; 4];

/// What does not change of a cut cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CutShape<L = f64> {
    /// Shares of the links that lead into walls; −1 on the others.
    pub shares: [L; Q],
    /// Unit normal, into the solid.
    pub normal: [L; 3],
    /// See [`CutCell::curvature`].
    pub curvature: [L; 6],
    /// Mean velocity of the walls.
    pub wall: [L; 3],
}

impl CutShape {
    /// Of a cut cell. `walls`: bits of the directions that lead into walls. `wall`: their mean velocity.
    #[must_use]
    pub fn new(cut: &CutCell, walls: u32, wall: [f64; 3]) -> Self {
        let shares = std::array::from_fn(|i| if walls >> i & 1 != 0 { cut.shares[i] } else { -1.0 });
        Self { shares, normal: cut.normal, curvature: cut.curvature, wall }
    }
}

/// What to subtract from the populations that leave a cut cell that is full of fluid, and what it remembers then.
///
/// A steady link asks for e⁻ + q g⁺ − (τ⁻ − ½) g⁻ = 0 at the cell, g what the collision changes. The last term should be
/// that of the curvature. In a fluid of one viscosity the odd departure carries it, with 4/3 (τ⁺ − ½)(τ⁻ − ½) for q²; in
/// others it is taken off, and the slip of the law by stress is put in its place.
///
/// # Arguments
/// `h`: populations before collision. `residual`: F − ∇p. `by_stress`: number of the fluid, where the law by
/// stress acts (not below a free surface). `memory`: of the step before.
/// # Source
/// docs/method.md \[B4\].
/// # Verified by
/// Claims `pipe-newtonian-cut`, `pipe-bingham-cut`, `pipe-herschel-bulkley-cut`.
#[inline(always)]
pub(crate) fn cut_correction<L: Lane, P: Physics>(
    physics: &P,
    h: &[L; Q],
    state: &State<L>,
    shape: &CutShape<L>,
    residual: &[L; 3],
    by_stress: Option<u8>,
    memory: Memory<L>,
) -> ([L; Q], Memory<L>) {
    let odd_omega = physics.odd_omega(state.omega);
    let departure = physics.odd_departure(h, &state.m);
    let local = local_curvature(state.omega, odd_omega);
    let keep = (L::splat(2.0) - odd_omega) - odd_omega * local;
    let mut correction = without_mean(&shape.shares, &departure, keep);
    let Some(fluid) = by_stress.filter(|&fluid| physics.thins_or_yields(fluid)) else {
        return (correction, memory);
    };
    let (along, wall, memory) = stress(state, shape, residual, memory);
    let distances = directions(
        #[inline(always)]
        |i| shape.shares[i] * along_normal(i, &shape.normal),
    );
    let slips = physics.cut_slips(fluid, &wall, &distances);
    let u = &state.m.u;
    let moves = three(
        #[inline(always)]
        |a| along[a] * (u[a] - shape.wall[a]),
    );
    let most = L::larger((moves[0] + moves[1]) + moves[2], L::zero());
    let carried = wall.gradient * (local / state.m.rho);
    for i in 1..Q {
        let share = shape.shares[i];
        let steep = along_normal(i, &shape.normal);
        let slip = push(share) * L::smaller(slips[i] - carried * (steep * steep), most);
        let back = physics.wall(L::zero(), i, state.m.rho, &along.map(|e| e * slip));
        let wanted = L::and(L::zero().less_equal(share), L::zero().less(wall.stress));
        correction[i] = correction[i] - L::select(wanted, back, L::zero());
    }
    (correction, memory)
}

/// (1 + κ) (keep d_i − w_i m) on the links into walls, m such that no mass passes them.
#[inline(always)]
fn without_mean<L: Lane>(shares: &[L; Q], departure: &[L; Q], keep: L) -> [L; Q] {
    let pushes = directions(
        #[inline(always)]
        |i| L::select(shares[i].less(L::zero()), L::zero(), push(shares[i])),
    );
    let sum = density_excess(&directions(
        #[inline(always)]
        |i| pushes[i] * departure[i],
    ));
    let weight = density_excess(&directions(
        #[inline(always)]
        |i| pushes[i] * L::splat(W[i]),
    ));
    let mean = sum / L::select(L::zero().less(weight), weight, L::one());
    directions(
        #[inline(always)]
        |i| pushes[i] * (keep * (departure[i] - L::splat(W[i]) * mean)),
    )
}

/// |c_i · n|
#[inline(always)]
fn along_normal<L: Lane>(i: usize, normal: &[L; 3]) -> L {
    let parts = three(
        #[inline(always)]
        |a| L::splat(f64::from(C[i][a])) * normal[a],
    );
    ((parts[0] + parts[1]) + parts[2]).abs()
}

/// Direction of the traction that the fluid puts on the wall, the stress along it and how that grows towards the wall,
/// and what is remembered.
///
/// Along the normal the stress grows by the driving force less what the bend of the wall spreads it over:
/// f = (F − ∇p)·ê − s (tr W + ê·W ê), W the curvature.
#[inline(always)]
fn stress<L: Lane>(
    state: &State<L>,
    shape: &CutShape<L>,
    residual: &[L; 3],
    memory: Memory<L>,
) -> ([L; 3], CutStress<L>, Memory<L>) {
    let dot = |a: &[L; 3], b: &[L; 3]| (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
    let times = |t: &[L; 6], v: &[L; 3]| {
        three(
            #[inline(always)]
            |a| (t[pair(a, 0)] * v[0] + t[pair(a, 1)] * v[1]) + t[pair(a, 2)] * v[2],
        )
    };
    let (zero, one, follows) = (L::zero(), L::one(), L::splat(FOLLOWS));
    let (n, bend) = (&shape.normal, &shape.curvature);
    let on_wall = times(&deviator(&state.m.q), n);
    let through = dot(&on_wall, n);
    let share = one - L::splat(0.5) * state.omega;
    let traction = three(
        #[inline(always)]
        |a| {
            let now = share * (on_wall[a] - through * n[a]);
            memory[a] + follows * (now - memory[a])
        },
    );
    let s = dot(&traction, &traction).sqrt();
    let safe = L::select(zero.less(s), s, one);
    let along = traction.map(|t| t / safe);
    let bent = ((bend[0] + bend[1]) + bend[2]) + dot(&along, &times(bend, &along));
    let now = dot(residual, &along) - s * bent;
    let gradient = memory[3] + follows * (now - memory[3]);
    let wall = CutStress { stress: s, gradient, omega: state.omega };
    (along, wall, [traction[0], traction[1], traction[2], gradient])
}
