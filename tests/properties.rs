//! Properties that hold for arbitrary states, laws and set-ups.

mod common;

use std::sync::Arc;

use common::{LAWS, Numbers, OPERATORS, TREATMENTS};
use lahar::collision::{Collision, CollisionChoice, OddRate};
use lahar::lane::Dual;
use lahar::lattice::Q;
use lahar::lattice::moments::{density_excess, moments, momentum, populations, second, third};
use lahar::rheology::{Law, Rheology, relaxation};
use lahar::setup::{BodyForce, Face, FlowPoint, Setup, WallRule, YieldTreatment};
use lahar::solver::plain::Plain;
use lahar::solver::run::{Backend, Run};
use proptest::prelude::*;

fn ten_to(x: f64) -> f64 {
    libm::exp(core::f64::consts::LN_10 * x)
}

fn start(setup: &Setup) -> Box<dyn Run> {
    Plain.start(setup).expect("a consistent set-up")
}

fn arbitrary_flow(setup: &mut Setup, seed: u64, speed: f64) {
    let extents = setup.extents;
    setup.initial = Some(Arc::new(move |[i, j, k]| {
        let mut numbers = Numbers::new(seed ^ (i + extents[0] * (j + extents[1] * k)) as u64);
        numbers.next();
        FlowPoint {
            density: 1.0 + 0.2 * speed * numbers.next(),
            velocity: numbers.vector(2.0 * speed),
            gradient: std::array::from_fn(|_| numbers.vector(0.2 * speed)),
        }
    }));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn conserves_mass_and_momentum(seed in any::<u64>(), size in -9.0_f64..-0.5, omega in 0.0_f64..1.99) {
        let size = ten_to(size);
        let mut numbers = Numbers::new(seed);
        let (h, force) = (numbers.populations(size), numbers.vector(0.01 * size));
        let m = moments(&h, &force);
        // At most 60 operations on sums of populations below `size`.
        let bound = 60.0 * 0.5 * f64::EPSILON * size;
        for operator in OPERATORS {
            let post = operator.collide(&h, &m, omega);
            prop_assert!((density_excess(&post) - density_excess(&h)).abs() <= bound, "{operator:?}");
            let (before, after) = (momentum(&h), momentum(&post));
            for a in 0..3 {
                prop_assert!((after[a] - before[a] - force[a]).abs() <= bound, "{operator:?} {a}");
            }
        }
    }

    /// Two operators that differ in ω⁻ only differ by the change of ω⁻ times the odd departure, which
    /// has neither mass nor momentum.
    #[test]
    fn odd_departure_is_what_relaxes(seed in any::<u64>(), size in -9.0_f64..-0.5, tau in 0.52_f64..3.0) {
        let (size, omega) = (ten_to(size), 1.0 / tau);
        let mut numbers = Numbers::new(seed);
        let (h, force) = (numbers.populations(size), numbers.vector(0.01 * size));
        let m = moments(&h, &force);
        let (slow, fast) = (OddRate::fixed(0.25), OddRate::fixed(0.05));
        // At most 60 operations on sums of populations below `size`, for each of the two.
        let bound = 2.0 * 60.0 * 0.5 * f64::EPSILON * size;
        for [a, b] in [
            [CollisionChoice::Trt(slow), CollisionChoice::Trt(fast)],
            [CollisionChoice::CentralMoment(slow), CollisionChoice::CentralMoment(fast)],
        ] {
            let departure = a.odd_departure(&h, &m);
            prop_assert_eq!(departure, b.odd_departure(&h, &m));
            prop_assert!(density_excess(&departure).abs() <= bound);
            prop_assert!(momentum(&departure).iter().all(|j| j.abs() <= bound));
            let change: f64 = b.odd_omega(omega, 0.0) - a.odd_omega(omega, 0.0);
            let (post_a, post_b) = (a.collide(&h, &m, omega), b.collide(&h, &m, omega));
            for i in 0..Q {
                let found = post_a[i] - post_b[i];
                prop_assert!((found - change * departure[i]).abs() <= bound, "{a:?} {i}: {found:e}");
            }
        }
    }

    #[test]
    fn inverse_reproduces_moments(seed in any::<u64>(), size in -12.0_f64..1.0) {
        let size = ten_to(size);
        let mut numbers = Numbers::new(seed);
        let (m0, m1) = (size * numbers.next(), numbers.vector(size));
        let mut six = || -> [f64; 6] { std::array::from_fn(|_| size * numbers.next()) };
        let (m2, m3) = (six(), six());
        let m4 = numbers.vector(size);
        let h = populations(m0, &m1, &m2, &m3, &m4);
        // Sums of up to ten populations, each from up to six moments below `size`/2.
        let bound = 40.0 * 0.5 * f64::EPSILON * 3.0 * size;
        prop_assert!((density_excess(&h) - m0).abs() <= bound);
        for (found, wanted) in momentum(&h).iter().zip(m1) {
            prop_assert!((found - wanted).abs() <= bound);
        }
        for (found, wanted) in second(&h).iter().chain(&third(&h)).zip(m2.iter().chain(&m3)) {
            prop_assert!((found - wanted).abs() <= bound);
        }
        let plane = |from: usize| (h[from] + h[from + 1]) + (h[from + 2] + h[from + 3]);
        for (found, wanted) in [plane(7), plane(11), plane(15)].iter().zip(m4) {
            prop_assert!((found - wanted).abs() <= bound);
        }
    }
}

/// A law of each kind with parameters over many decades.
fn any_law() -> impl Strategy<Value = Law> {
    (0_usize..5, -8.0_f64..0.0, -4.0_f64..1.0, 0.2_f64..2.0, 1.0_f64..6.0).prop_map(|(kind, s, k, n, m)| {
        let (sigma0, k, m) = (ten_to(s), ten_to(k), ten_to(m));
        match kind {
            0 => Law::Newtonian { mu: k },
            1 => Law::Bingham { sigma0, mu: k },
            2 => Law::HerschelBulkley { sigma0, k, n },
            3 => Law::PowerLaw { k, n },
            _ => Law::Papanastasiou { sigma0, k, n: n.min(1.0), m },
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// \[Y3\] over twelve decades of stress: the equation holds, the rate grows with the stress, and a
    /// cell yields exactly when q > σ0.
    #[test]
    fn solve_is_monotone_and_unique(law in any_law(), rho in 0.8_f64..1.2) {
        let sigma0 = law.yield_stress();
        let law = law.prepare();
        let mut last = (0.0, 0.0);
        for step in 0..=48 {
            let excess = ten_to(-11.0 + 0.25 * f64::from(step));
            let q = sigma0 + excess;
            let gamma_dot: f64 = law.shear_rate(rho, q);
            prop_assert!(gamma_dot.is_finite() && gamma_dot >= 0.0, "{law:?} {q:e}: {gamma_dot:e}");
            prop_assert_eq!(gamma_dot > 0.0, q > sigma0);
            if gamma_dot > 0.0 {
                let residual = law.stress(gamma_dot) + rho / 6.0 * gamma_dot - q;
                // The solve leaves rounding of a sum of logarithms, |ln| ≤ 50 each; the stress adds
                // |ln γ̇| ≤ 150 half-units to the power-law term. Papanastasiou's Newton stops at a step
                // below 1e-8 and leaves its square.
                prop_assert!(residual.abs() <= 300.0 * f64::EPSILON * q, "{law:?} {q:e}: {:e}", residual / q);
            }
            // Growing with q, by more than rounding can undo: q − σ0 grows by 78 % per step.
            if q > last.0 {
                prop_assert!(gamma_dot > last.1 || excess < 1e-3 * f64::EPSILON.sqrt() * sigma0, "{law:?} {q:e}");
            }
            last = (q, gamma_dot);
            let omega: f64 = relaxation::omega_of_shear_rate(rho, gamma_dot, q);
            prop_assert!((0.0..2.0).contains(&omega), "{law:?} {q:e}: {omega}");
        }
        // At and below the yield stress the cell is rigid.
        for q in [sigma0, 0.5 * sigma0, 0.0] {
            prop_assert_eq!(law.shear_rate(rho, q), 0.0);
            if law.constant_tau().is_none() {
                let rigid = relaxation::omega(&law, YieldTreatment::Exact, rho, q, 1.0);
                prop_assert!(rigid == 0.0, "{:?} {}: {}", law, q, rigid);
            }
        }
    }

    /// ω⁺ lies in \[0, 2) and inside the clamps; at 2 where a thickening law's viscosity is below a rounding of τ⁺.
    #[test]
    fn omega_stays_in_range(law in any_law(), rho in 0.8_f64..1.2, q in -14.0_f64..1.0, previous in 0.0_f64..1.99) {
        let (q, law) = (ten_to(q), law.prepare());
        for treatment in TREATMENTS {
            let omega: f64 = relaxation::omega(&law, treatment, rho, q, previous);
            let vanishing = law.thickens() && omega == 2.0;
            prop_assert!((0.0..2.0).contains(&omega) || vanishing, "{law:?} {treatment:?} {q:e}: {omega}");
            if let (YieldTreatment::ImplicitClamped { tau_min, tau_max } | YieldTreatment::LaggedClamped { tau_min, tau_max }, None) = (treatment, law.constant_tau()) {
                prop_assert!(omega >= 1.0 / tau_max && omega <= 1.0 / tau_min);
            }
        }
    }

    /// Derivatives of the whole local solve and collision against central differences.
    #[test]
    fn dual_derivative_is_the_difference_quotient(seed in any::<u64>(), which in 0_usize..6, law in 0_usize..7) {
        let mut numbers = Numbers::new(seed);
        let (operator, law) = (OPERATORS[which], LAWS[law].prepare());
        let (h, direction) = (numbers.populations(0.1), numbers.populations(0.1));
        let force = numbers.vector(1e-3);
        let step = 1e-6;
        let kernel = |t: f64| -> [f64; Q] {
            let h: [f64; Q] = std::array::from_fn(|i| h[i] + t * direction[i]);
            let m = moments(&h, &force);
            let q = lahar::lattice::moments::magnitude(&lahar::lattice::moments::deviator(&m.q));
            operator.collide(&h, &m, relaxation::omega(&law, YieldTreatment::Exact, m.rho, q, 0.0))
        };
        let dual: [Dual; Q] = std::array::from_fn(|i| Dual { value: h[i], slope: direction[i] });
        let m = moments(&dual, &force.map(Dual::constant));
        let q = lahar::lattice::moments::magnitude(&lahar::lattice::moments::deviator(&m.q));
        // Away from the kink at σ0 and from the cusp at Q = 0, where a difference says nothing.
        prop_assume!(q.value > 4e-4);
        let omega = relaxation::omega(&law, YieldTreatment::Exact, m.rho, q, Dual::constant(0.0));
        let post = operator.collide(&dual, &m, omega);
        let (plus, minus, here) = (kernel(step), kernel(-step), kernel(0.0));
        for i in 0..Q {
            prop_assert_eq!(post[i].value, here[i]);
            let quotient = (plus[i] - minus[i]) / (2.0 * step);
            // Third derivatives below 1e3 of 0.1 give step² · 1e2; rounding of 0.01 over the step.
            let bound = 1e-10 + 1e-17 / step;
            prop_assert!((post[i].slope - quotient).abs() <= bound, "{operator:?} {law:?} {i}: {} {quotient}", post[i].slope);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// Collision and streaming together, in a periodic box, under every law and treatment.
    #[test]
    fn conserves_mass_and_momentum_in_a_periodic_box(seed in any::<u64>(), which in 0_usize..6, law in 0_usize..7, treatment in 0_usize..3) {
        let mut setup = Setup::periodic([5, 4, 3], LAWS[law]);
        setup.collision = OPERATORS[which];
        setup.yielding = TREATMENTS[treatment];
        arbitrary_flow(&mut setup, seed, 0.02);
        let force = [1e-5, -2e-5, 3e-5];
        setup.force = BodyForce::Constant(force);
        let mut run = start(&setup);
        let before = run.totals();
        let steps = 20;
        run.advance(steps).expect("a slow flow");
        let after = run.totals();
        let cells = setup.cells() as f64;
        // Per cell and step 60 operations on sums below 0.05.
        let bound = 60.0 * 0.5 * f64::EPSILON * 0.05 * steps as f64 * cells;
        prop_assert!((after.mass_excess - before.mass_excess).abs() <= bound);
        for ((now, then), force) in after.momentum.iter().zip(before.momentum).zip(force) {
            prop_assert!((now - then - force * steps as f64 * cells).abs() <= bound);
        }
    }
}

/// More than one chunk of 4096 cells, walls, a solid block, two fluids, every yield treatment.
fn large(yielding: YieldTreatment, wall_rule: WallRule) -> Setup {
    let mut setup = Setup::periodic([24, 20, 19], Law::HerschelBulkley { sigma0: 1e-5, k: 0.05, n: 0.5 });
    setup.fluids.push(Law::Bingham { sigma0: 2e-5, mu: 0.1 });
    setup.faces[1] = [Face::NoSlip, Face::Moving([0.02, 0.0, 0.01])];
    setup.faces[2] = [Face::FreeSlip, Face::NoSlip];
    let cells = setup.cells();
    setup.fluid_of_cell = (0..cells).map(|cell| u8::from(setup.coordinates(cell)[1] > 9)).collect();
    setup.solids = (0..cells)
        .map(|cell| {
            let [i, j, k] = setup.coordinates(cell);
            u8::from((8..13).contains(&i) && (4..8).contains(&j) && (5..14).contains(&k))
        })
        .collect();
    setup.solid_motion = vec![lahar::setup::SolidMotion::default()];
    setup.force = BodyForce::Oscillating {
        mean: [1e-5, 0.0, 0.0],
        amplitude: [0.0, 0.0, 2e-5],
        frequency: 0.1,
        phase: 0.3,
    };
    setup.yielding = yielding;
    setup.wall_rule = wall_rule;
    setup.stress_source = wall_rule == WallRule::ViscosityIndependent;
    arbitrary_flow(&mut setup, 7, 0.01);
    setup
}

#[test]
fn exact_fingerprint_at_any_number_of_threads() {
    for treatment in TREATMENTS {
        for rule in [WallRule::HalfWay, WallRule::ViscosityIndependent] {
            let mut setup = large(treatment, rule);
            assert!(setup.cells() > 2 * 4096);
            let mut prints = Vec::new();
            for threads in [1, 1, 2, 3] {
                setup.threads = threads;
                let mut run = start(&setup);
                run.advance(6).expect("a slow flow");
                // Interrupting a run must not show either.
                run.advance(4).expect("a slow flow");
                prints.push(run.fingerprint());
            }
            assert!(prints.iter().all(|p| *p == prints[0]), "{treatment:?} {rule:?}: {prints:#?}");
            assert!(prints[0].max_speed > 0.0);
        }
    }
}

#[test]
fn exact_fingerprint_of_an_interrupted_run() {
    let setup = large(TREATMENTS[2], WallRule::ViscosityIndependent);
    let (mut whole, mut parts) = (start(&setup), start(&setup));
    whole.advance(7).expect("a slow flow");
    for _ in 0..7 {
        parts.advance(1).expect("a slow flow");
        let _ = (parts.fields(), parts.totals());
    }
    assert_eq!(whole.fingerprint(), parts.fingerprint());
}

#[test]
fn fingerprint_sees_one_bit() {
    let base = large(TREATMENTS[0], WallRule::HalfWay);
    let mut other = base.clone();
    let flow = base.initial.clone().expect("it has one");
    other.initial = Some(Arc::new(move |cell| {
        let mut point = flow(cell);
        if cell == [0, 0, 0] {
            point.velocity[0] = point.velocity[0].next_up();
        }
        point
    }));
    assert_ne!(start(&base).fingerprint().hash, start(&other).fingerprint().hash);
}

/// A one-cell-thick periodic axis costs one cell: bytes per cell are those of a cube but for the
/// boundary records and the axis tables.
#[test]
fn thin_boxes_cost_what_their_cells_cost() {
    let law = Law::Newtonian { mu: 0.1 };
    let per_cell = |setup: &Setup| {
        let run = start(setup);
        assert_eq!(run.fluid_cells(), setup.cells() as u64);
        run.allocated_bytes() as f64 / setup.cells() as f64
    };
    let cube = per_cell(&Setup::periodic([32, 32, 32], law));
    // Two arrays of 19 numbers and a 4-byte mark; the axis tables add 24 bytes per line of cells.
    assert!((308.0..309.0).contains(&cube), "{cube}");
    for extents in [[1024, 32, 1], [1, 1024, 32], [4096, 1, 1], [1, 4096, 1], [1, 1, 4096]] {
        let thin = per_cell(&Setup::periodic(extents, law));
        let lines = 24.0 * extents.iter().sum::<usize>() as f64 / extents.iter().product::<usize>() as f64;
        assert_eq!(thin, 308.0 + lines, "{extents:?}");
    }
    // A channel has two boundary cells whatever its height; its records are the only addition.
    let bytes = |n: usize| start(&Setup::channel(n, law, 1e-6)).allocated_bytes();
    assert_eq!(bytes(2000) - bytes(1000), 1000 * (308 + 24));
    // Options cost bytes only where they are asked for.
    let mut lagged = Setup::periodic([16; 3], Law::Bingham { sigma0: 1e-5, mu: 0.1 });
    let exact = start(&lagged).allocated_bytes();
    lagged.yielding = TREATMENTS[2];
    assert_eq!(start(&lagged).allocated_bytes() - exact, 8 * 16 * 16 * 16);
}

/// A quasi-two-dimensional run is the three-dimensional one of a flow without variation along z.
#[test]
fn exact_thin_run_equals_a_thick_one() {
    let law = Law::HerschelBulkley { sigma0: 1e-5, k: 0.05, n: 0.5 };
    let mut thin = Setup::periodic([6, 8, 1], law);
    thin.faces[1] = [Face::NoSlip; 2];
    thin.collision = CollisionChoice::CentralMoment(OddRate::default());
    thin.force = BodyForce::Constant([1e-5, 0.0, 0.0]);
    thin.initial = Some(Arc::new(|[i, j, _]| {
        let mut numbers = Numbers::new((i + 10 * j) as u64);
        FlowPoint { density: 1.0, velocity: numbers.vector(0.02), gradient: [[0.0; 3]; 3] }
    }));
    let mut thick = thin.clone();
    thick.extents[2] = 3;
    let (mut a, mut b) = (start(&thin), start(&thick));
    a.advance(25).expect("a slow flow");
    b.advance(25).expect("a slow flow");
    for cell in 0..thick.cells() {
        let [i, j, _] = thick.coordinates(cell);
        assert_eq!(a.populations(thin.index([i, j, 0])), b.populations(cell));
    }
}

/// One eighth of a mirror-symmetric vortex between free-slip faces is the whole vortex, bit for bit.
#[test]
fn exact_free_slip_octant_equals_the_periodic_box() {
    let n = 8;
    let k = core::f64::consts::TAU / n as f64;
    // The sines of the right half are taken from the left one, so that the start is symmetric to the bit.
    let wave = move |j: usize| {
        let (m, sign) = if j < n / 2 { (j, 1.0) } else { (n - 1 - j, -1.0) };
        let x = k * (m as f64 + 0.5);
        (sign * libm::sin(x), libm::cos(x))
    };
    let flow = move |cell: [usize; 3]| {
        let [x, y, z] = cell.map(wave);
        let u = 0.05;
        FlowPoint {
            density: 1.0,
            velocity: [u * x.0 * y.1 * z.1, -(u * x.1 * y.0 * z.1), 0.0],
            gradient: [[0.0; 3]; 3],
        }
    };
    let law = Law::Bingham { sigma0: 1e-5, mu: 0.05 };
    let mut whole = Setup::periodic([n; 3], law);
    whole.initial = Some(Arc::new(flow));
    let mut octant = Setup::periodic([n / 2; 3], law);
    octant.faces = [[Face::FreeSlip; 2]; 3];
    octant.initial = Some(Arc::new(flow));
    let (mut a, mut b) = (start(&whole), start(&octant));
    [&mut a, &mut b].into_iter().for_each(|run| run.advance(30).expect("a slow flow"));
    for cell in 0..octant.cells() {
        let at = whole.index(octant.coordinates(cell));
        assert_eq!(a.populations(at), b.populations(cell), "{:?}", octant.coordinates(cell));
    }
}
