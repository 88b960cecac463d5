//! The limit of stability is where it is said to be, and no contact makes energy at the step that is chosen: pairs and grains at walls, spheres and clumps, all laws, from
//! elastic to hardly any restitution.

use super::help::*;
use crate::dem::packing::Random;
use crate::dem::*;

/// Share of its energy that the books of a collision may leave open, at half of what stops a run. The dashpot's work by the
/// trapezoidal rule is wrong by D²/3 of it, 0.3 % at D = 0.1; the elastic part of a contact of 20 steps by some (π/20)²/8 of
/// it, 0.3 %; what sticks loses its spring's energy when the contact opens, known to a step.
const BOOKS: f64 = 0.008;

/// Steps that are watched at most. A dashpot that needs shorter steps has stopped the impact long before.
const MOST: u64 = 4000;

fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * random.unit()
}

/// A collision, at random: its set-up and a line that describes it.
fn draw(random: &mut Random, k: usize) -> (Setup, String) {
    let e = libm::pow(10.0, -6.0 * random.unit());
    let young_pa = libm::pow(10.0, between(random, 5.5, 11.0));
    let (r, size) =
        (libm::pow(10.0, between(random, -4.0, -1.0)), libm::pow(10.0, between(random, -1.5, 0.0)));
    let v = 0.003 * (young_pa / 2650.0).sqrt() * between(random, 0.1, 1.0);
    let normal = match k % 4 {
        0 => NormalLaw::Tsuji { restitution: e },
        1 => {
            // From elastic to a dashpot that stops everything.
            let m = 2650.0 * r * r * r;
            let stiffness = young_pa * r.sqrt();
            NormalLaw::ViscoElastic {
                time_s: 0.1 / e.sqrt() / libm::pow(stiffness / m, 0.4) / libm::pow(v, 0.2),
            }
        }
        2 => NormalLaw::TsujiAlpha { alpha: 1.0 / e.sqrt() - 1.0 },
        _ => NormalLaw::Linear {
            stiffness_n_m: young_pa * r * between(random, 0.01, 1.0),
            restitution: e,
            tangential_ratio: between(random, 0.1, 3.0),
        },
    };
    let pair = PairProperties {
        normal,
        friction: if k.is_multiple_of(3) { 0.0 } else { between(random, 0.05, 2.0) },
        rolling_friction: if k.is_multiple_of(5) { between(random, 0.0, 0.5) } else { 0.0 },
        tangential_damping: between(random, 0.0, 2.0),
    };
    let mut s = setup(Material { young_pa, ..soft() }, pair);
    s.clumps = vec![Clump::tetrahedron(1.0, 1.5).unwrap()];
    let place = |random: &mut Random, radius: f64, x: f64, v: f64| {
        let across = V3::new(0.0, between(random, -1.0, 1.0) * v, between(random, -1.0, 1.0) * v);
        let spin = V3::from_fn(|_, _| between(random, -1.0, 1.0) * v / radius);
        let grain = if k.is_multiple_of(7) {
            Grain::clump(0, 0.5 * radius, V3::x() * x, random.orientation(), 0)
        } else {
            Grain::sphere(radius, V3::x() * x, 0)
        };
        grain.moving(V3::x() * v + across).spinning(spin)
    };
    s.grains = vec![place(random, r, -r, 0.5 * v)];
    if k % 6 == 1 {
        s.walls = vec![Wall::fixed("w", Surface::Plane { point: V3::zeros(), normal: -V3::x() }, 0)];
    } else {
        s.grains.push(place(random, size * r, size * r, -0.5 * v));
    }
    s.design_speed_m_s = 2.0 * v;
    s.start_overlap = 1e-6;
    s.steps_per_contact = if k.is_multiple_of(2) { 50.0 } else { 20.0 };
    (s, format!("{k}: e = {e:.1e}, {pair:?}"))
}

/// Of 400 collisions none has more energy at any step than it had at the start, to rounding of 4000 steps, nor leaves more of
/// it unexplained than [`BOOKS`].
#[test]
fn no_energy_is_made() {
    let mut random = Random::new(2004);
    let mut worst = 0.0f64;
    for k in 0..400 {
        let (mut s, words) = draw(&mut random, k);
        let pace = pace(&s).unwrap().unwrap();
        s.time_step_s = Some(pace.suggested_s);
        let mut d = Dem::new(&s).unwrap_or_else(|error| panic!("{words}: {error}"));
        let start = d.energies();
        let (mut made, mut open) = (0.0f64, 0.0f64);
        while d.steps() < MOST && d.time() < 6.0 * pace.shortest.seconds {
            d.step(1).unwrap_or_else(|error| panic!("{words}: {error}"));
            let e = d.energies();
            made = made.max(e.mechanical() / start.mechanical() - 1.0);
            open = open.max((e.balance() / start.balance() - 1.0).abs());
        }
        assert!(made < 1e-12, "{words}: {made}");
        assert!(open < BOOKS, "{words}: {open}");
        worst = worst.max(open);
    }
    // The bound is not idle.
    assert!(worst > 0.1 * BOOKS, "{worst}");
}

/// A sphere that rests on a floor by a linear spring and dashpot, pushed a little: just below the limit the push fades (a strong
/// dashpot takes longer than 4000 steps for it), just above it grows.
#[test]
fn limit_of_verlet_and_gear() {
    let swing = |integrator, ratio: f64, over: f64| {
        let restitution = restitution::cut_off(ratio);
        let normal = NormalLaw::Linear { stiffness_n_m: 1e4, restitution, tangential_ratio: 1.0 };
        let mut s = setup(soft(), PairProperties { normal, ..elastic() });
        (s.walls, s.gravity, s.integrator) = (vec![floor()], V3::z() * -9.81, integrator);
        let mass = 2650.0 * 4.0 / 3.0 * std::f64::consts::PI * 125e-9;
        let depth = mass * 9.81 / 1e4;
        s.grains = vec![Grain::sphere(5e-3, V3::z() * (5e-3 - 1.001 * depth), 0)];
        (s.start_overlap, s.design_speed_m_s) = (0.1, 1.0);
        let pace = pace(&s).unwrap().unwrap();
        // The limit is that of two such spheres, which have half the mass together: ω and c/m go with its root.
        let limit = pace.stable.limit_s * 2f64.sqrt();
        s.time_step_s = Some(pace.suggested_s);
        let mut d = Dem::new(&s).unwrap();
        d.step_setting.dt = over * limit;
        d.start_gear();
        d.step(4000).unwrap();
        (d.bodies().position[0].z - (5e-3 - depth)).abs() / (1e-3 * depth)
    };
    for ratio in [0.7, 2.0, 16.0] {
        // The characteristic polynomial of Verlet has no root beyond the circle below the limit, and one above it.
        assert!(swing(Integrator::Verlet, ratio, 0.99) < 0.9, "{ratio}");
        assert!(swing(Integrator::Verlet, ratio, 1.01) > 2.0, "{ratio}");
        // That of Gear's scheme was searched for it; its line lies inside by up to two fifths.
        for integrator in [Integrator::Gear, Integrator::GearConservative] {
            assert!(swing(integrator, ratio, 0.99) < 0.9, "{ratio}");
            assert!(swing(integrator, ratio, 1.4) > 2.0, "{ratio}");
        }
    }
}

/// A step beyond the limit is refused with one that would do, and that one is taken; one in between is taken as given.
#[test]
fn unstable_steps_are_refused() {
    let normal = NormalLaw::Tsuji { restitution: 1e-3 };
    let mut s = head_on(setup(soft(), PairProperties { normal, ..elastic() }), 5e-3, 1.0);
    let pace = pace(&s).unwrap().unwrap();
    assert!(pace.stable.limit_s < pace.shortest.seconds / 10.0);
    s.time_step_s = Some(1.01 * pace.stable.limit_s);
    let error = Dem::new(&s).map(|_| ()).unwrap_err();
    let DemError::Unstable { limit_s, advised_s, .. } = error else { panic!("{error}") };
    assert_eq!((limit_s, advised_s), (pace.stable.limit_s, pace.suggested_s));
    assert!(advised_s < 0.2 * limit_s);
    for dt in [0.99 * limit_s, advised_s] {
        s.time_step_s = Some(dt);
        assert_eq!(Dem::new(&s).unwrap().time_step(), dt);
    }
    // Without a step: 50 in a contact would be too long.
    s.time_step_s = None;
    assert_eq!(Dem::new(&s).unwrap().time_step(), advised_s);
}
