use super::help::*;
use crate::dem::*;

/// 100 × the design speed on soft grains: the guard names the pair.
#[test]
fn guard_stops_deep_overlap() {
    let mut s = head_on(setup(soft(), elastic()), 5e-3, 50.0);
    s.design_speed_m_s = 0.5;
    let mut d = Dem::new(&s).unwrap();
    match d.step(10_000) {
        Err(DemError::Overlap { pair, step, time_s, share, limit, .. }) => {
            assert_eq!(pair, Touching::Grains(0, 1));
            assert_eq!(pair.to_string(), "grains 0 and 1");
            assert!(step > 0 && time_s > 0.0 && share > limit);
        }
        other => panic!("{other:?}"),
    }
    let mut s = setup(soft(), elastic());
    s.walls = vec![floor()];
    s.grains = vec![Grain::sphere(5e-3, V3::z() * 0.01, 0).moving(V3::z() * -50.0)];
    let stopped = Dem::new(&s).unwrap().step(10_000);
    assert!(
        matches!(&stopped, Err(DemError::Overlap { pair, .. }) if pair.to_string() == "grain 0 and wall `floor`"),
        "{stopped:?}"
    );
}

#[test]
fn guard_stops_nan_and_fast_spin() {
    let mut d = Dem::new(&head_on(setup(soft(), elastic()), 5e-3, 1.0)).unwrap();
    d.external_mut().0[1] = V3::x() * f64::NAN;
    assert!(matches!(d.step(5), Err(DemError::NotFinite { grain: 1, step: 1, .. })));
    let s = super::rotation::spinning(V3::new(1e6, 2e6, 1e6), 1e-5, Integrator::Verlet);
    assert!(matches!(Dem::new(&s).unwrap().step(1), Err(DemError::Spin { grain: 0, .. })));
}

#[test]
fn bad_materials_are_refused() {
    let fails = |s: Setup| Dem::new(&s).map(|_| ()).unwrap_err();
    for (e, nu) in [(0.0, 0.2), (-1.0, 0.2), (f64::NAN, 0.2)] {
        let s = setup(Material { young_pa: e, poisson: nu, ..soft() }, elastic());
        assert!(matches!(fails(s), DemError::Young { .. }));
    }
    for nu in [0.5, -1.0, 0.7, f64::NAN] {
        assert!(matches!(
            fails(setup(Material { poisson: nu, ..soft() }, elastic())),
            DemError::Poisson { .. }
        ));
    }
    let heavy = setup(Material { density_kg_m3: 0.0, ..soft() }, elastic());
    assert!(matches!(fails(heavy), DemError::Density { .. }));
    for pair in [
        PairProperties { friction: -0.1, ..elastic() },
        PairProperties { normal: NormalLaw::Tsuji { restitution: 0.0 }, ..elastic() },
        PairProperties { normal: NormalLaw::Tsuji { restitution: 1.1 }, ..elastic() },
        PairProperties { normal: NormalLaw::ViscoElastic { time_s: -1.0 }, ..elastic() },
    ] {
        assert!(matches!(fails(setup(soft(), pair)), DemError::PairProperty { .. }));
    }
    assert_eq!(fails(Setup::new(Materials::default())), DemError::NoMaterial);
}

/// Each setting at the last value that is taken, and at the first beyond it.
#[test]
fn settings_are_taken_within_their_bounds() {
    type Set = fn(&mut Setup, f64);
    let (zero, one) = (f64::MIN_POSITIVE, 1.0 - f64::EPSILON);
    let settings: [(Set, &[f64], &[f64]); 6] = [
        (|s, x| s.design_speed_m_s = x, &[1.0], &[0.0, -1.0, f64::INFINITY, f64::NAN]),
        (|s, x| s.steps_per_contact = x, &[10.0], &[9.9, f64::INFINITY, f64::NAN]),
        (|s, x| s.skin = x, &[zero, 2.0], &[0.0, 2.1, -0.1, f64::NAN]),
        (|s, x| s.overlap_limit = x, &[zero, one], &[0.0, 1.0, -0.1, f64::NAN]),
        (|s, x| s.start_overlap = x, &[0.0, one], &[-0.1, 1.0, f64::NAN]),
        (|s, x| s.gravity.y = x, &[-9.81], &[f64::INFINITY, f64::NAN]),
    ];
    for (k, (set, good, bad)) in settings.into_iter().enumerate() {
        let made = |x: f64| {
            let mut s = head_on(setup(soft(), elastic()), 5e-3, 1.0);
            set(&mut s, x);
            Dem::new(&s).map(|_| ())
        };
        for &x in good {
            assert_eq!(made(x), Ok(()), "setting {k}: {x}");
        }
        for &x in bad {
            let refused = made(x);
            assert!(matches!(refused, Err(DemError::Setting { .. })), "setting {k}: {x}: {refused:?}");
        }
    }
}

#[test]
fn bad_settings_and_places_are_refused() {
    let good = || head_on(setup(soft(), elastic()), 5e-3, 1.0);
    let fails = |s: Setup| Dem::new(&s).map(|_| ()).unwrap_err();
    let mut s = good();
    s.grains[1].position = s.grains[0].position + V3::x() * 9e-3;
    assert!(matches!(fails(s), DemError::StartOverlap { first: 0, second: 1, .. }));
    let mut s = good();
    s.walls = vec![floor()];
    assert!(matches!(fails(s), DemError::StartOverlapWall { .. }));
    let mut s = good();
    s.time_step_s = Some(1e-3);
    assert!(matches!(fails(s), DemError::TimeStep { .. }));
    for dt in [0.0, -1.0, f64::NAN] {
        let mut s = good();
        s.time_step_s = Some(dt);
        assert!(matches!(fails(s), DemError::Setting { .. }));
    }
    let limit = pace(&good()).unwrap().unwrap().shortest.seconds;
    let mut s = good();
    s.time_step_s = Some(limit / 9.9);
    assert!(matches!(fails(s), DemError::TimeStep { contact_s, .. } if contact_s == limit));
    let mut s = good();
    s.grains[0].radius = 0.0;
    assert!(matches!(fails(s), DemError::GrainValue { grain: 0, .. }));
    let mut s = good();
    s.grains[1].shape = Shape::Clump(0);
    assert!(matches!(fails(s), DemError::UnknownShape { grain: 1, .. }));
    let mut s = good();
    s.grains[1].material = 3;
    assert!(matches!(fails(s), DemError::UnknownMaterial { found: 3, count: 1 }));
    let mut s = good();
    s.period.0[1] = Some(0.015);
    assert!(matches!(fails(s), DemError::PeriodTooShort { axis: 'y', .. }));
    let mut s = good();
    s.walls = vec![Wall::fixed("w", Surface::Plane { point: V3::zeros(), normal: V3::zeros() }, 0)];
    assert!(matches!(fails(s), DemError::Wall { .. }));
    // Nothing in it: no time step can be suggested, but one can be given.
    let mut empty = setup(soft(), elastic());
    assert!(matches!(fails(empty.clone()), DemError::Setting { .. }));
    empty.time_step_s = Some(1.0);
    Dem::new(&empty).unwrap().step(3).unwrap();
}

/// Densities 1e-3 and 1e4, sizes 20:1, zero friction: the light small grain bounces off without a guard.
#[test]
fn hard_density_and_size_ratio() {
    let mut s = setup(Material { density_kg_m3: 1e4, ..soft() }, elastic());
    s.materials.list.push(Material { density_kg_m3: 1e-3, name: "light".into(), ..soft() });
    s.grains =
        vec![Grain::sphere(0.1, V3::zeros(), 0).moving(V3::x()), Grain::sphere(5e-3, V3::x() * 0.106, 1)];
    let mut d = Dem::new(&s).unwrap();
    let e0 = d.kinetic_energy();
    d.step(20_000).unwrap();
    assert!((d.bodies().velocity[1].x - 2.0).abs() < 1e-3, "{}", d.bodies().velocity[1].x);
    assert!((d.kinetic_energy() / e0 - 1.0).abs() < 1e-9);
}

/// A sphere rolls over the seams of a triangulated floor as over a plane: edges and corners hit exactly.
#[test]
fn mesh_floor_equals_plane() {
    let run = |mesh: bool, y: f64| {
        let pair = PairProperties { friction: 0.4, ..PairProperties::default() };
        let mut s = setup(soft(), pair);
        s.gravity = V3::new(3.0, 0.0, -9.81);
        let n = 40u32;
        let corner =
            |k: u32| V3::new(f64::from(k % (n + 1)) * 2e-3, f64::from(k / (n + 1)) * 2e-3 - 0.04, 0.0);
        let corners: Vec<V3> = (0..(n + 1) * (n + 1)).map(corner).collect();
        let faces: Vec<[u32; 3]> = (0..n * n)
            .flat_map(|k| {
                let a = k / n * (n + 1) + k % n;
                [[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]]
            })
            .collect();
        s.walls = if mesh {
            vec![Wall::fixed("mesh", Surface::Mesh(walls::Mesh::new(&corners, &faces).unwrap()), 0)]
        } else {
            vec![floor()]
        };
        s.grains = vec![Grain::sphere(5e-3, V3::new(0.01, y, 5e-3), 0)];
        let mut d = Dem::new(&s).unwrap();
        d.step(8000).unwrap();
        assert!(d.bodies().position[0].x > 0.03);
        (d.bodies().position[0], d.bodies().spin[0])
    };
    for y in [0.0, 7e-4] {
        let ((xa, wa), (xb, wb)) = (run(false, y), run(true, y));
        assert!((xa - xb).norm() < 1e-12, "{}", (xa - xb).norm());
        assert!((wa - wb).norm() < 1e-8 * wa.norm());
    }
}

/// A small frictional heap on fixed spheres comes to rest, stays there, and carries its weight.
#[test]
fn heap_rests() {
    let pair = PairProperties { normal: NormalLaw::Tsuji { restitution: 0.3 }, ..PairProperties::default() };
    let mut s = setup(firm(), pair);
    let r = 5e-3;
    for k in 0..64 {
        let (i, j) = (f64::from(k % 8), f64::from(k / 8));
        let at = V3::new((i - 3.5) * 2.0 * r, (j - 3.5) * 2.0 * r, -r);
        s.grains.push(Grain { driven: true, ..Grain::sphere(r, at, 0) });
    }
    for k in 0..18 {
        let (i, j, l) = (f64::from(k % 3), f64::from(k / 3 % 3), f64::from(k / 9));
        let at = V3::new((i - 1.1) * 2.1 * r, (j - 0.9) * 2.1 * r, (1.1 + 2.1 * l) * r);
        s.grains.push(Grain::sphere(r, at, 0));
    }
    s.gravity = V3::z() * -9.81;
    s.steps_per_contact = 30.0;
    let surface = Surface::Box {
        centre: V3::zeros(),
        half: V3::new(8.0 * r, 8.0 * r, 1.0),
        orientation: Orientation::identity(),
        side: Side::Inside,
    };
    s.walls = vec![Wall::fixed("box", surface, 0)];
    let mut d = Dem::new(&s).unwrap();
    let mut most = 0.0f64;
    for _ in 0..300 {
        d.step(1000).unwrap();
        most = most.max(d.kinetic_energy());
        if d.kinetic_energy() < 1e-13 * most {
            break;
        }
    }
    assert!(d.kinetic_energy() < 1e-13 * most, "{}", d.kinetic_energy() / most);
    let before = d.bodies().position.clone();
    d.step(10_000).unwrap();
    assert!(d.kinetic_energy() < 1e-13 * most);
    for (a, b) in before.iter().zip(&d.bodies().position) {
        assert!((a - b).norm() < 1e-8);
    }
    let held: f64 = (0..64).map(|i| -d.bodies().force[i].z).sum::<f64>() - d.force_on_wall(0).0.z;
    assert!((held / (d.ledger().mass * 9.81) - 1.0).abs() < 1e-6, "{held}");
}

fn square(half: f64) -> walls::Mesh {
    let c = |x: f64, y: f64| V3::new(x, y, 0.0);
    walls::Mesh::new(
        &[c(-half, -half), c(half, -half), c(half, half), c(-half, half)],
        &[[0, 1, 2], [0, 2, 3]],
    )
    .unwrap()
}

/// A floor of triangles that moves and tilts is the plane that moves and tilts.
#[test]
fn wall_moving_mesh_equals_plane() {
    let run = |surface: Surface| {
        let mut s = setup(firm(), PairProperties { friction: 0.4, ..PairProperties::default() });
        s.gravity = V3::z() * -9.81;
        let motion = WallMotion {
            velocity: V3::new(0.1, 0.0, 0.2),
            spin: V3::new(0.3, 0.8, 0.5),
            about: V3::new(-0.05, 0.0, 0.0),
        };
        s.walls = vec![Wall { name: "floor".into(), surface, material: 0, motion }];
        s.grains = vec![Grain::sphere(5e-3, V3::z() * 6e-3, 0)];
        let mut d = Dem::new(&s).unwrap();
        d.step(20_000).unwrap();
        assert!(!d.wall_contacts()[0].contacts.is_empty());
        (d.bodies().position[0], d.bodies().spin[0])
    };
    let (xa, wa) = run(Surface::Plane { point: V3::zeros(), normal: V3::z() });
    let (xb, wb) = run(Surface::Mesh(square(1.0)));
    assert!((xa - xb).norm() < 1e-9, "{}", (xa - xb).norm());
    assert!((wa - wb).norm() < 1e-6 * wa.norm());
}

/// A mesh as wide as the period is an endless floor: no bump where its ends meet.
#[test]
fn mesh_seam_of_periodic_floor() {
    let run = |mesh: bool| {
        let mut s = setup(soft(), PairProperties { friction: 0.4, ..PairProperties::default() });
        s.gravity = V3::new(3.0, 0.0, -9.81);
        s.period = Period([Some(0.04), Some(0.04), None]);
        let c = |x: f64, y: f64| V3::new(x, y, 0.0);
        let m = walls::Mesh::new(
            &[c(0.0, 0.0), c(0.04, 0.0), c(0.04, 0.04), c(0.0, 0.04)],
            &[[0, 1, 2], [0, 2, 3]],
        );
        s.walls = if mesh { vec![Wall::fixed("mesh", Surface::Mesh(m.unwrap()), 0)] } else { vec![floor()] };
        s.grains = vec![Grain::sphere(5e-3, V3::new(0.01, 0.02, 5e-3), 0)];
        let mut d = Dem::new(&s).unwrap();
        for _ in 0..12_000 {
            d.step(1).unwrap();
            assert!(d.wall_contacts().iter().all(|w| w.contacts.len() <= 1));
        }
        assert!(d.bodies().position[0].x > 0.09);
        d.bodies().position[0]
    };
    assert!((run(true) - run(false)).norm() < 1e-12);
}

proptest::proptest! {
    /// The nearest contact of a mesh is the nearest point of all triangles, wherever the sphere is.
    #[test]
    fn mesh_nearest_is_global(x in -2.0..2.0f64, y in -2.0..2.0f64, z in -2.0..2.0f64) {
        let corners: Vec<V3> = (0..8)
            .map(|k| V3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * 2.0 - V3::repeat(1.0))
            .collect();
        let faces = [
            [0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
            [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5],
        ];
        let cube = walls::Mesh::new(&corners, &faces).unwrap();
        let at = V3::new(x, y, z);
        let beyond = at.abs() - V3::repeat(1.0);
        let outside = beyond.sup(&V3::zeros()).norm();
        let exact = if outside > 0.0 { outside } else { -beyond.max() };
        let mut out = Vec::new();
        cube.near(&at, 10.0, None, &mut out);
        proptest::prop_assert!((out[0].distance - exact).abs() < 1e-12);
        if outside > 0.0 {
            // Seen from outside a convex body there is one local minimum only (the far side's faces apart).
            let facing = out.iter().filter(|n| n.distance < exact + 1e-9).count();
            proptest::prop_assert_eq!(facing, 1);
        }
    }

    /// Newton's third law of the kernel: a collision of two spheres of any sizes keeps momentum, angular momentum,
    /// and never gains energy.
    #[test]
    fn conserves_any_collision(size in 0.1..1.0f64, vx in -1.0..1.0f64, vy in -1.0..1.0f64, w in -100.0..100.0f64) {
        let mut s = setup(firm(), PairProperties { rolling_friction: 0.1, ..PairProperties::default() });
        let (a, b) = (5e-3, 5e-3 * size);
        s.grains = vec![
            Grain::sphere(a, V3::zeros(), 0).spinning(V3::new(w, 0.5 * w, -w)),
            Grain::sphere(b, V3::x() * (a + b), 0).moving(V3::new(-0.5, vx, vy)),
        ];
        let mut d = Dem::new(&s).unwrap();
        let (before, energy) = (d.ledger(), d.kinetic_energy());
        d.step(300).unwrap();
        let after = d.ledger();
        let scale = d.bodies().mass[0];
        proptest::prop_assert!((after.momentum - before.momentum).norm() < 1e-13 * scale);
        proptest::prop_assert!((after.angular_momentum - before.angular_momentum).norm() < 1e-13 * scale * a);
        proptest::prop_assert!(d.kinetic_energy() <= energy * (1.0 + 1e-6));
    }
}
