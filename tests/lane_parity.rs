//! Contract: an expression written over `Lane` gives, in each entry of a pack, the bits it gives for
//! `f64` alone (in single precision: for `f32` alone), whatever the other entries hold. Out of scope: `Dual`, which is not a pack, and the
//! payload of NaNs.

mod common;

use common::{LAWS, Numbers, OPERATORS, TREATMENTS};
use lahar::boundary::bounce_back::bounce_back;
use lahar::boundary::flat_wall::FlatWall;
use lahar::boundary::wall_law::{self, WallStress};
use lahar::boundary::wall_slip::{link_correction, newtonian_slip, stress_source};
use lahar::collision::Collision;
use lahar::lane::{Lane, Pack, Singles};
use lahar::lattice::Q;
use lahar::lattice::equilibrium::equilibrium;
use lahar::lattice::moments::{add_third, deviator, magnitude, moments, populations};
use lahar::rheology::relaxation::{self, SlowBranch};
use lahar::rheology::{Law, Prepared, Rheology};

/// A kernel from some numbers to some numbers, over any lane.
trait Kernel {
    fn run<L: Lane>(&self, x: &[L]) -> Vec<L>;
}

fn bits(x: f64) -> u64 {
    if x.is_nan() { u64::MAX } else { x.to_bits() }
}

fn compare_packs<const N: usize>(kernel: &impl Kernel, inputs: &[Vec<f64>], what: &str) {
    for group in inputs.windows(N) {
        let packed: Vec<Pack<N>> =
            (0..group[0].len()).map(|k| Pack(std::array::from_fn(|lane| group[lane][k]))).collect();
        let together = kernel.run(&packed);
        for (lane, input) in group.iter().enumerate() {
            let alone = kernel.run::<f64>(input);
            assert_eq!(alone.len(), together.len());
            for (k, (a, p)) in alone.iter().zip(&together).enumerate() {
                assert_eq!(
                    bits(*a),
                    bits(p.0[lane]),
                    "{what}: output {k}, lane {lane} of {N}: {a:e} {:e}",
                    p.0[lane]
                );
            }
        }
    }
}

fn compare_singles<const N: usize>(kernel: &impl Kernel, inputs: &[Vec<f64>], what: &str) {
    for group in inputs.windows(N) {
        let packed: Vec<Singles<N>> =
            (0..group[0].len()).map(|k| Singles(std::array::from_fn(|lane| group[lane][k] as f32))).collect();
        let together = kernel.run(&packed);
        for (lane, input) in group.iter().enumerate() {
            let alone = kernel.run(&input.iter().map(|&x| x as f32).collect::<Vec<f32>>());
            assert_eq!(alone.len(), together.len());
            for (k, (a, p)) in alone.iter().zip(&together).enumerate() {
                let (a, p) = (f64::from(*a), f64::from(p.0[lane]));
                assert_eq!(bits(a), bits(p), "{what}, f32: output {k}, lane {lane} of {N}: {a:e} {p:e}");
            }
        }
    }
}

fn compare(kernel: &impl Kernel, inputs: &[Vec<f64>], what: &str) {
    compare_singles::<4>(kernel, inputs, what);
    compare_packs::<2>(kernel, inputs, what);
    compare_packs::<4>(kernel, inputs, what);
    compare_packs::<8>(kernel, inputs, what);
}

const SPECIAL: [f64; 8] = [0.0, -0.0, 5e-324, -5e-324, f64::MIN_POSITIVE, 1e-300, f64::EPSILON, -1e-17];

/// Populations and a force: ordinary states of many sizes, and special ones.
fn states() -> Vec<Vec<f64>> {
    let mut numbers = Numbers::new(11);
    let mut states = Vec::new();
    for size in [0.4, 1e-2, 1e-8, 1e-160] {
        for _ in 0..10 {
            let mut x = numbers.populations(size).to_vec();
            x.extend(numbers.vector(1e-3 * size));
            states.push(x);
        }
    }
    for special in SPECIAL {
        states.push(vec![special; Q + 3]);
        states.push((0..Q + 3).map(|k| if k % 3 == 0 { special } else { 1e-3 * numbers.next() }).collect());
    }
    states
}

fn split<L: Lane>(x: &[L]) -> ([L; Q], [L; 3]) {
    (std::array::from_fn(|i| x[i]), std::array::from_fn(|a| x[Q + a]))
}

struct MomentsKernel;
impl Kernel for MomentsKernel {
    fn run<L: Lane>(&self, x: &[L]) -> Vec<L> {
        let (h, force) = split(x);
        let m = moments(&h, &force);
        let mut out = vec![m.d_rho, m.rho, magnitude(&deviator(&m.q))];
        out.extend(m.u);
        out.extend(m.q);
        out
    }
}

struct EquilibriumKernel;
impl Kernel for EquilibriumKernel {
    fn run<L: Lane>(&self, x: &[L]) -> Vec<L> {
        equilibrium(x[0], L::one() + x[0], &[x[1], x[2], x[3]]).to_vec()
    }
}

struct TransformKernel;
impl Kernel for TransformKernel {
    fn run<L: Lane>(&self, x: &[L]) -> Vec<L> {
        let six = |from: usize| std::array::from_fn(|k| x[from + k]);
        let mut h = populations(x[0], &[x[1], x[2], x[3]], &six(4), &six(10), &[x[16], x[17], x[18]]);
        add_third(&mut h, &six(2));
        h.to_vec()
    }
}

struct CollisionKernel(lahar::collision::CollisionChoice, f64);
impl Kernel for CollisionKernel {
    fn run<L: Lane>(&self, x: &[L]) -> Vec<L> {
        let (h, force) = split(x);
        let omega = L::splat(self.1);
        let m = moments(&h, &force);
        let mut out = self.0.collide(&h, &m, omega).to_vec();
        out.extend(self.0.odd_departure(&h, &m));
        out.extend([self.0.odd_omega(omega, m.square()), self.0.wanted_odd_excess(omega)]);
        out
    }
}

#[test]
fn parity_of_moments_equilibrium_and_transform() {
    compare(&MomentsKernel, &states(), "moments");
    compare(&EquilibriumKernel, &states(), "equilibrium");
    compare(&TransformKernel, &states(), "transform");
}

#[test]
fn parity_of_every_collision() {
    for operator in OPERATORS {
        for omega in [0.0, 5e-324, 0.3, 1.0, 1.0 / 0.55, 1.999] {
            compare(&CollisionKernel(operator, omega), &states(), &format!("{operator:?} at ω = {omega}"));
        }
    }
}

/// Stress magnitudes around every threshold of a law: exactly σ0, its neighbours, zeros, denormals.
fn stresses(law: &Law) -> Vec<Vec<f64>> {
    let sigma0 = match *law {
        Law::Papanastasiou { sigma0, .. } => sigma0,
        _ => law.yield_stress(),
    };
    let mut numbers = Numbers::new(5);
    let mut q = vec![sigma0, sigma0.next_up(), sigma0.next_down().max(0.0), 1.5 * sigma0];
    q.extend(SPECIAL.map(f64::abs));
    q.push(-0.0);
    for decade in -14..=-1 {
        q.push(libm::exp(core::f64::consts::LN_10 * (f64::from(decade) + numbers.next())));
    }
    // Neighbours in a pack should be as unlike as possible.
    let half = q.len() / 2;
    let mixed = (0..q.len()).map(|k| if k % 2 == 0 { q[k / 2] } else { q[(half + k / 2) % q.len()] });
    mixed.map(|q| vec![q, 1.0 + 0.1 * numbers.next(), 1.0 + 0.9 * numbers.next()]).collect()
}

struct OmegaKernel(Prepared, lahar::setup::YieldTreatment);
impl Kernel for OmegaKernel {
    fn run<L: Lane>(&self, x: &[L]) -> Vec<L> {
        let (q, rho, previous) = (x[0], x[1], x[2]);
        let gamma_dot = self.0.shear_rate(rho, q);
        let omega = relaxation::omega(&self.0, self.1, rho, q, previous);
        vec![gamma_dot, self.0.stress(gamma_dot), self.0.tangent_viscosity(gamma_dot), omega]
    }
}

#[test]
fn parity_of_every_law_and_treatment() {
    for law in LAWS {
        for treatment in TREATMENTS {
            compare(
                &OmegaKernel(law.prepare(), treatment),
                &stresses(&law),
                &format!("{law:?} {treatment:?}"),
            );
        }
    }
}

struct WallKernel;
impl Kernel for WallKernel {
    fn run<L: Lane>(&self, x: &[L]) -> Vec<L> {
        let v = [x[1], x[2], x[3]];
        let mut out: Vec<L> = (1..Q).map(|i| bounce_back(x[0], i, L::one() + x[4], &v)).collect();
        let excess = std::array::from_fn(|i| x[i % x.len()]);
        out.extend(link_correction(&excess, |i| i % 3 == 1));
        // The face at the low end of the second axis.
        let walls = (1..Q).filter(|&i| lahar::lattice::C[i][1] == -1).fold(0, |links, i| links | 1 << i);
        if let Some(flat) = FlatWall::of(walls) {
            out.extend(flat.first_moment(&excess));
            out.extend(flat.vector(&flat.tangential(&v)));
        }
        let q = std::array::from_fn(|k| x[6 + k]);
        for wanted in [0.0, 0.02, 0.3] {
            out.extend(stress_source(&v, &q, L::splat(wanted), L::splat(1.0 / 0.55)));
        }
        out
    }
}

/// The law by stress, with stresses around the threshold of the law and forces over many decades.
struct SlipKernel(Prepared, lahar::setup::YieldTreatment);
impl Kernel for SlipKernel {
    fn run<L: Lane>(&self, x: &[L]) -> Vec<L> {
        let (q, rho) = (x[0], x[1]);
        let omega = relaxation::omega(&self.0, self.1, rho, q, x[2]);
        let slow = SlowBranch::of(&self.0, self.1);
        let mut out = Vec::new();
        for (force, traction, floor) in
            [(0.1, 1.0, 0.0), (1e-3, 1.1, 1e-9), (1e-6, 1.0, -1e-7), (2.0, 0.3, 0.0), (0.0, 1.0, 0.0)]
        {
            let wall = WallStress {
                squares: [L::splat(0.01) * q, L::zero()],
                cell: (L::one() - L::splat(0.5) * omega) * q,
                traction: L::splat(traction) * q,
                force: L::splat(force) * q,
                floor: L::splat(floor),
                local: L::splat(0.1) * omega,
                rho,
                omega,
                magnitude: q,
                gain: L::splat(0.02),
            };
            out.push(newtonian_slip(&wall, omega));
            let fluid = wall_law::Fluid::new(
                self.0.thickens(),
                |sigma| relaxation::flow(&self.0, self.1, slow.as_ref(), omega, sigma),
                |omega: L, square: L| L::splat(0.2) * omega + square,
            );
            out.push(wall_law::slip(&wall, &fluid));
        }
        out
    }
}

#[test]
fn parity_of_the_law_by_stress() {
    for law in LAWS {
        for treatment in TREATMENTS {
            compare(
                &SlipKernel(law.prepare(), treatment),
                &stresses(&law),
                &format!("{law:?} {treatment:?}"),
            );
        }
    }
}

#[test]
fn parity_of_walls_and_stress_source() {
    compare(&WallKernel, &states(), "walls");
}
