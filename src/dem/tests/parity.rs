use super::help::*;
use crate::dem::packing::{Lattice, Random, Region, lattice};
use crate::dem::*;

/// A pile of spheres and clumps falling into a drum with a mesh floor: everything that carries history.
fn busy() -> Setup {
    let pair = PairProperties { rolling_friction: 0.1, ..PairProperties::default() };
    let mut s = setup(firm(), pair);
    s.clumps = vec![Clump::tetrahedron(1.0, 1.5).unwrap()];
    let mut random = Random::new(2);
    let region = Region::Box { low: V3::new(-0.04, -0.04, 0.01), high: V3::new(0.04, 0.04, 0.08) };
    s.grains = lattice(Lattice::SimpleCubic, 5e-3, 0.011, &region)
        .unwrap()
        .into_iter()
        .enumerate()
        .map(|(i, p)| {
            let v = V3::from_fn(|_, _| random.normal());
            let g = if i % 2 == 0 {
                Grain::clump(0, 2.5e-3, p.centre, random.orientation(), 0)
            } else {
                Grain::sphere(4e-3, p.centre, 0)
            };
            g.moving(v)
        })
        .collect();
    let c = |x: f64, y: f64| V3::new(x, y, 0.0);
    let mesh =
        walls::Mesh::new(&[c(-1.0, -1.0), c(1.0, -1.0), c(1.0, 1.0), c(-1.0, 1.0)], &[[0, 1, 2], [0, 2, 3]])
            .unwrap();
    s.walls = vec![
        Wall::fixed("floor", Surface::Mesh(mesh), 0),
        Wall {
            name: "drum".into(),
            surface: Surface::Cylinder {
                point: V3::zeros(),
                axis: V3::z(),
                radius: 0.07,
                half_length: None,
                side: Side::Inside,
            },
            material: 0,
            motion: WallMotion { velocity: V3::zeros(), spin: V3::z() * 3.0, about: V3::zeros() },
        },
    ];
    s.gravity = V3::z() * -9.81;
    s.design_speed_m_s = 2.0;
    s
}

fn with_threads<T: Send>(n: usize, f: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(n).build().unwrap().install(f)
}

fn state(s: &Setup, steps: u64) -> (Checkpoint, u64) {
    let mut d = Dem::new(s).unwrap();
    d.step(steps).unwrap();
    (d.checkpoint(), d.list_renewals())
}

#[test]
fn parity_threads() {
    let s = busy();
    let one = with_threads(1, || state(&s, 4000));
    for n in [2, 5] {
        assert_eq!(one, with_threads(n, || state(&s, 4000)));
    }
}

/// A caller outside any pool gets the same bits (its steps are moved into the global one).
#[test]
fn parity_outside_the_pool() {
    let s = busy();
    let outside = std::thread::scope(|scope| scope.spawn(|| state(&s, 1000)).join());
    assert_eq!(outside.unwrap(), with_threads(1, || state(&s, 1000)));
}

/// Enough grains that every pass really is split among threads.
#[test]
fn parity_threads_many_grains() {
    let mut s = setup(firm(), PairProperties::default());
    let mut random = Random::new(8);
    let region = Region::Box { low: V3::zeros(), high: V3::repeat(0.13) };
    s.grains = lattice(Lattice::FaceCentred, 5e-3, 0.01005, &region)
        .unwrap()
        .into_iter()
        .map(|p| Grain::sphere(5e-3, p.centre, 0).moving(V3::from_fn(|_, _| 0.5 * random.normal())))
        .collect();
    let l = 0.15;
    s.period = Period([Some(l), None, Some(l)]);
    s.walls = vec![Wall::fixed("side", Surface::Plane { point: V3::zeros(), normal: V3::y() }, 0)];
    s.gravity = V3::y() * -9.81;
    s.design_speed_m_s = 3.0;
    assert!(s.grains.len() > 2000);
    let one = with_threads(1, || state(&s, 150));
    assert!(one.0.pairs.len() > 500);
    for n in [2, 8] {
        assert_eq!(one, with_threads(n, || state(&s, 150)));
    }
}

/// The skin decides how often lists are made, not what they give.
#[test]
fn parity_skin() {
    let mut s = busy();
    let (mut a, few) = state(&s, 4000);
    s.skin = 0.013;
    let (b, many) = state(&s, 4000);
    assert!(many > few + 5, "{few} {many}");
    // The books are summed in blocks of the list.
    a.books = b.books;
    assert_eq!(a, b);
}

#[test]
fn parity_restart() {
    for integrator in [Integrator::Verlet, Integrator::Gear] {
        let mut s = busy();
        s.integrator = integrator;
        let mut straight = Dem::new(&s).unwrap();
        straight.external_mut().0[3] = V3::x() * 1e-4;
        straight.step(2000).unwrap();
        let saved = straight.checkpoint();
        straight.step(2000).unwrap();
        let mut again = Dem::resume(&s, &saved).unwrap();
        assert_eq!(again.checkpoint().pairs, saved.pairs);
        again.step(2000).unwrap();
        let (mut a, b) = (straight.checkpoint(), again.checkpoint());
        a.books = b.books;
        assert_eq!(a, b);
        let mut short = saved.clone();
        short.position.pop();
        assert!(matches!(Dem::resume(&s, &short), Err(DemError::Checkpoint { .. })));
    }
}
