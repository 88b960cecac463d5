//! What one cell does in one step. Everything here reads the previous array only.

use crate::boundary::flat_wall::FlatWall;
use crate::boundary::links::Links;
use crate::boundary::wall_law::WallStress;
use crate::boundary::wall_slip::{link_correction, local_curvature, pressure_slope, stress_source};
use crate::lane::Lane;
use crate::lattice::moments::{Moments, add_third, density_excess, deviator};
use crate::lattice::{C, Q, opposite};
use crate::solver::physics::Physics;
use crate::solver::run::Runaway;

/// Populations of one cell, f − w.
pub(crate) type Cell = [f64; Q];

/// A cell's moments and its even relaxation rate.
pub(crate) struct State<L = f64> {
    /// Moments before collision.
    pub m: Moments<L>,
    /// ω⁺.
    pub omega: L,
}

/// Moments and ω⁺ of a cell before collision \[L4\] \[Y1\]–\[Y4\].
#[inline(always)]
pub(crate) fn state<P: Physics>(physics: &P, h: &Cell, force: &[f64; 3], fluid: u8, previous: f64) -> State {
    let m = physics.moments(h, force);
    let omega = match physics.constant_omega() {
        Some(omega) => omega,
        None => physics.omega(fluid, m.rho, physics.stress_magnitude(&m), previous),
    };
    State { m, omega }
}

/// The guard: density and velocity are finite, density positive, speed within the limit.
#[inline(always)]
pub(crate) fn runaway(m: &Moments<f64>, limit: f64) -> Option<Runaway> {
    let speed2 = m.square();
    if speed2 <= limit * limit && m.rho > 0.0 {
        return None;
    }
    Some(if !(speed2.is_finite() && m.rho.is_finite()) {
        Runaway::NotFinite
    } else if m.rho <= 0.0 {
        Runaway::NoDensity { density: m.rho }
    } else {
        Runaway::TooFast { speed: speed2.sqrt(), limit }
    })
}

/// F − ∇p of a cell, the pressure from the densities around it \[B3\] \[K6\]. `is_fluid(cell)`: whether a
/// neighbour that is not solid has a density at all (gas has none).
pub(crate) fn residual_force(
    f: &[Cell],
    links: &Links,
    cell: usize,
    force: &[f64; 3],
    is_fluid: impl Fn(usize) -> bool,
) -> [f64; 3] {
    let rho = |at: usize| density_excess(&f[at]);
    std::array::from_fn(|axis| {
        let low = links.neighbour(cell, axis, false).filter(|&n| is_fluid(n)).map(rho);
        let high = links.neighbour(cell, axis, true).filter(|&n| is_fluid(n)).map(rho);
        force[axis] - pressure_slope(low, rho(cell), high)
    })
}

/// What a wall correction depends on besides the state of its cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Situation<L = f64> {
    /// F − ∇p of the cell.
    pub residual: [L; 3],
    /// Σ 6 w_i c_i (c_i·u_w) over the wall links.
    pub drag: [L; 3],
    /// Number of the fluid in it.
    pub fluid: u8,
    /// Whether \[K6\] acts.
    pub sourced: bool,
    /// Largest slip over the force of a fluid of one viscosity.
    pub gain: f64,
    /// Directions that lead into walls, one bit each.
    pub walls: u32,
    /// The wall, where the law by stress acts: at faces, in cells that are full.
    pub flat: Option<FlatWall>,
}

/// What the viscosity-independent wall subtracts from the populations leaving a boundary cell \[B3\].
#[inline(always)]
pub(crate) fn wall_correction<L: Lane, P: Physics>(
    physics: &P,
    h: &[L; Q],
    state: &State<L>,
    situation: &Situation<L>,
) -> [L; Q] {
    let rho = state.m.rho;
    let odd_omega = physics.odd_omega(state.omega, state.m.square());
    let local = local_curvature(state.omega, odd_omega);
    let mut excess = [L::zero(); Q];
    if situation.sourced {
        add_stress_source(physics, &mut excess, state, &situation.residual);
    }
    let keep = (L::splat(2.0) - odd_omega) - odd_omega * local;
    let departure = physics.odd_departure(h, &state.m);
    for i in 1..Q {
        excess[i] = excess[i] + keep * departure[i];
    }
    let walls = situation.walls;
    let mut correction = link_correction(
        &excess,
        #[inline(always)]
        |i| walls >> i & 1 != 0,
    );
    if let Some(flat) = situation.flat {
        let (slip, work) = slip_velocity(physics, flat, h, state, situation, &excess);
        for i in 1..Q {
            if walls >> i & 1 != 0 {
                correction[i] = correction[i] - physics.wall(L::zero(), i, rho, &slip);
            }
        }
        flat.add_third(&mut correction, &work);
    }
    correction
}

/// The slip of a flat wall, along the traction, and by axis along it u_w times the stress at the wall, the work that a moving
/// wall does \[B3\]. `excess`: by link, what the link correction takes away.
#[inline(always)]
fn slip_velocity<L: Lane, P: Physics>(
    physics: &P,
    flat: FlatWall,
    h: &[L; Q],
    state: &State<L>,
    situation: &Situation<L>,
    excess: &[L; Q],
) -> ([L; 3], [L; 2]) {
    let (rho, omega) = (state.m.rho, state.omega);
    let mut post = physics.collide(h, &state.m, omega);
    if situation.sourced {
        add_stress_source(physics, &mut post, state, &situation.residual);
    }
    let impulse = flat.first_moment(&post);
    let drag = flat.tangential(&situation.drag);
    let two = L::splat(2.0);
    let traction = [two * impulse[0] - rho * drag[0], two * impulse[1] - rho * drag[1]];
    let size = (traction[0] * traction[0] + traction[1] * traction[1]).sqrt();
    let acts = L::zero().less(size);
    let safe = L::select(acts, size, L::one());
    let e = [traction[0] / safe, traction[1] / safe];
    let along = |v: [L; 2]| e[0] * v[0] + e[1] * v[1];
    let stress = along(flat.traction(&deviator(&state.m.q)));
    let wall = WallStress {
        cell: (L::one() - L::splat(0.5) * omega) * stress,
        traction: size,
        force: along(flat.tangential(&situation.residual)),
        floor: L::splat(3.0) / rho * along(flat.first_moment(excess)),
        local: local_curvature(omega, physics.odd_omega(omega, state.m.square())),
        rho,
        omega,
        magnitude: physics.stress_magnitude(&state.m),
        gain: L::splat(situation.gain),
        // The drag of the five links of a flat wall is u_w/3.
        squares: [state.m.square(), L::splat(9.0) * (drag[0] * drag[0] + drag[1] * drag[1])],
    };
    let slip = physics.slip(situation.fluid, &wall);
    let slips = [e[0] * slip, e[1] * slip];
    let third = L::splat(1.0 / 3.0) * rho;
    // The drag of the five links of a flat wall is u_w/3.
    let part = L::splat(if physics.carries_work() { 3.0 } else { 0.0 });
    let work = [0, 1].map(|a| (part * drag[a]) * (traction[a] - third * slips[a]));
    (flat.vector(&slips), work)
}

/// Adds the source of \[K6\] to post-collision populations.
#[inline(always)]
pub(crate) fn add_stress_source<L: Lane, P: Physics>(
    physics: &P,
    post: &mut [L; Q],
    state: &State<L>,
    residual: &[L; 3],
) {
    let wanted = physics.wanted_odd_excess(state.omega);
    let odd_omega = physics.odd_omega(state.omega, state.m.square());
    add_third(post, &stress_source(residual, &deviator(&state.m.q), wanted, odd_omega));
}

/// What a wall sends back in direction `i` \[B1\] \[B3\]; `own`: post-collision populations of the cell.
#[inline(always)]
pub(crate) fn wall_link<P: Physics>(
    physics: &P,
    own: &Cell,
    correction: Option<&Cell>,
    i: usize,
    rho: f64,
    velocity: &[f64; 3],
) -> f64 {
    let out = opposite(i);
    debug_assert_eq!(C[out][0], -C[i][0]);
    let leaving = own[out] - correction.map_or(0.0, |c| c[out]);
    physics.wall(leaving, out, rho, velocity)
}
