//! The 48 symmetries of the cube: mirror images bit for bit (sums are grouped for that), exchanged
//! axes to rounding, for one collision and for whole runs with walls. The viscosity-independent wall
//! is out of scope of the first: it sums over its links in index order.

mod common;

use std::sync::Arc;

use common::{LAWS, Numbers, OPERATORS, Symmetry};
use lahar::collision::Collision;
use lahar::lattice::Q;
use lahar::lattice::moments::{deviator, magnitude, moments};
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, FlowPoint, Setup, SolidMotion, WallRule, YieldTreatment};
use lahar::solver::plain::Plain;
use lahar::solver::run::{Backend, Run};
use proptest::prelude::*;

/// Equal as numbers: a mirror image may turn +0 into −0.
fn same(a: f64, b: f64) -> bool {
    a == b
}

#[test]
fn exact_group_of_48() {
    let all = Symmetry::all();
    assert_eq!(all.len(), 48);
    assert_eq!(all.iter().filter(|s| s.is_mirror()).count(), 8);
    let h: [f64; Q] = std::array::from_fn(|i| i as f64);
    let mut images: Vec<Vec<u64>> =
        all.iter().map(|s| s.populations(&h).iter().map(|x| x.to_bits()).collect()).collect();
    images.sort();
    images.dedup();
    assert_eq!(images.len(), 48);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn collision_commutes_with_the_48_symmetries(seed in any::<u64>(), omega in 0.0_f64..1.99, size in -8.0_f64..-0.5) {
        let size = libm::exp(core::f64::consts::LN_10 * size);
        let mut numbers = Numbers::new(seed);
        let (h, force) = (numbers.populations(size), numbers.vector(0.01 * size));
        for operator in OPERATORS {
            let post = operator.collide(&h, &moments(&h, &force), omega);
            for symmetry in Symmetry::all() {
                let image = symmetry.populations(&h);
                let m = moments(&image, &symmetry.vector(force));
                let found = operator.collide(&image, &m, omega);
                let expected = symmetry.populations(&post);
                for i in 0..Q {
                    if symmetry.is_mirror() {
                        prop_assert!(same(found[i], expected[i]), "{operator:?} {symmetry:?} {i}: {} {}", found[i], expected[i]);
                    } else {
                        // Some sixty operations on sums below `size`, in another order.
                        let bound = 60.0 * f64::EPSILON * size;
                        prop_assert!((found[i] - expected[i]).abs() <= bound, "{operator:?} {symmetry:?} {i}: {:e}", found[i] - expected[i]);
                    }
                }
            }
        }
    }

    #[test]
    fn stress_is_isotropic(seed in any::<u64>()) {
        let mut numbers = Numbers::new(seed);
        let (h, force) = (numbers.populations(0.1), numbers.vector(1e-3));
        let q = magnitude(&deviator(&moments(&h, &force).q));
        for symmetry in Symmetry::all() {
            let image = moments(&symmetry.populations(&h), &symmetry.vector(force));
            // Some forty operations on numbers below 0.1.
            prop_assert!((magnitude(&deviator(&image.q)) - q).abs() <= 40.0 * f64::EPSILON * 0.1);
        }
    }
}

const EXTENTS: [usize; 3] = [5, 4, 6];

/// Every cell is sheared: the source of \[K6\] is divided over the directions by ratios of Q_ab², which
/// at Q = 0 would be ratios of rounding errors, different for every symmetry.
fn start(cell: [usize; 3]) -> FlowPoint {
    let mut numbers = Numbers::new((cell[0] + 10 * cell[1] + 100 * cell[2]) as u64);
    FlowPoint {
        velocity: numbers.vector(0.02),
        density: 1.0 + 0.01 * numbers.next(),
        gradient: std::array::from_fn(|_| numbers.vector(0.02)),
    }
}

/// A box with a no-slip, a moving and two free-slip faces, a periodic axis and a moving solid block.
fn walled(law: Law) -> Setup {
    let mut setup = Setup::periodic(EXTENTS, law);
    setup.wall_rule = WallRule::HalfWay;
    setup.faces[1] = [Face::NoSlip, Face::Moving([0.01, 0.0, 0.005])];
    setup.faces[2] = [Face::FreeSlip; 2];
    setup.solids = vec![0; setup.cells()];
    for cell in [[2, 1, 2], [2, 1, 3], [2, 2, 3]] {
        let at = setup.index(cell);
        setup.solids[at] = 1;
    }
    setup.solid_motion = vec![SolidMotion {
        velocity: [0.0, 0.002, -0.003],
        spin: [1e-3, -2e-3, 5e-4],
        centre: [2.5, 2.0, 3.0],
    }];
    setup.force = BodyForce::Constant([1e-5, -2e-5, 3e-5]);
    setup.initial = Some(Arc::new(start));
    setup
}

/// The image of a set-up.
fn image_of(setup: &Setup, symmetry: Symmetry) -> Setup {
    let mut image = setup.clone();
    image.extents = symmetry.extents(setup.extents);
    for axis in 0..3 {
        let moved = setup.faces[axis].map(|face| match face {
            Face::Moving(u) => Face::Moving(symmetry.vector(u)),
            other => other,
        });
        image.faces[symmetry.axes[axis]] =
            if symmetry.signs[axis] > 0 { moved } else { [moved[1], moved[0]] };
    }
    for cell in 0..setup.cells() {
        let to = image.index(symmetry.cell(setup.coordinates(cell), setup.extents));
        image.solids[to] = setup.solids[cell];
    }
    for (motion, from) in image.solid_motion.iter_mut().zip(&setup.solid_motion) {
        motion.velocity = symmetry.vector(from.velocity);
        // Angular velocity is an axial vector: it takes the sign of the transformation.
        let parity = f64::from(symmetry.signs.iter().product::<i32>())
            * if [[0, 1, 2], [1, 2, 0], [2, 0, 1]].contains(&symmetry.axes) { 1.0 } else { -1.0 };
        motion.spin = symmetry.vector(from.spin).map(|w| parity * w);
        for a in 0..3 {
            let c = from.centre[a];
            motion.centre[symmetry.axes[a]] =
                if symmetry.signs[a] > 0 { c } else { setup.extents[a] as f64 - c };
        }
    }
    if let BodyForce::Constant(force) = setup.force {
        image.force = BodyForce::Constant(symmetry.vector(force));
    }
    let extents = setup.extents;
    let flow = setup.initial.clone().expect("the test flow has an initial state");
    image.initial = Some(Arc::new(move |cell| {
        // The pre-image of a cell: search is simplest and the box is small.
        let index = (0..extents.iter().product::<usize>())
            .map(|k| [k % extents[0], k / extents[0] % extents[1], k / (extents[0] * extents[1])])
            .find(|&from| symmetry.cell(from, extents) == cell)
            .expect("symmetries are one to one");
        let point = flow(index);
        FlowPoint {
            velocity: symmetry.vector(point.velocity),
            gradient: symmetry.tensor(point.gradient),
            ..point
        }
    }));
    image
}

fn advanced(setup: &Setup, steps: u64) -> Box<dyn Run> {
    let mut run = Plain.start(setup).expect("a consistent set-up");
    run.advance(steps).expect("a slow flow");
    run
}

fn check(setup: &Setup, what: &str) {
    let steps = 12;
    let run = advanced(setup, steps);
    for symmetry in Symmetry::all() {
        let image = image_of(setup, symmetry);
        let other = advanced(&image, steps);
        for cell in 0..setup.cells() {
            let to = image.index(symmetry.cell(setup.coordinates(cell), setup.extents));
            let expected = symmetry.populations(&run.populations(cell));
            let found = other.populations(to);
            for i in 0..Q {
                if symmetry.is_mirror() {
                    assert!(
                        same(found[i], expected[i]),
                        "{what} {symmetry:?} cell {cell} direction {i}: {:e} {:e}",
                        found[i],
                        expected[i]
                    );
                } else {
                    // 12 steps of some hundred operations on populations below 0.05, with the
                    // sensitivity of a yield-stress law, whose rate may change by 1/(n q) per unit q.
                    let bound = 12.0 * 100.0 * f64::EPSILON * 0.05 * 10.0;
                    assert!(
                        (found[i] - expected[i]).abs() <= bound,
                        "{what} {symmetry:?} cell {cell} direction {i}: {:e}",
                        found[i] - expected[i]
                    );
                }
            }
        }
    }
}

#[test]
fn walled_flows_commute_with_the_48_symmetries() {
    for operator in OPERATORS {
        let mut setup = walled(Law::Newtonian { mu: 0.1 });
        setup.collision = operator;
        check(&setup, &format!("{operator:?}"));
    }
    for law in LAWS {
        check(&walled(law), &format!("{law:?}"));
    }
}

#[test]
fn walled_flows_commute_with_every_option() {
    let law = Law::HerschelBulkley { sigma0: 1e-4, k: 0.05, n: 0.5 };
    let mut setup = walled(law);
    setup.stress_source = true;
    check(&setup, "stress source");
    setup.yielding = YieldTreatment::LaggedClamped { tau_min: 0.51, tau_max: 1.5 };
    check(&setup, "lagged");
    setup.wall_rule = WallRule::ViscosityIndependent;
    check(&setup, "viscosity-independent wall");
    setup.yielding = YieldTreatment::Exact;
    check(&setup, "viscosity-independent wall, exact yield");
}
