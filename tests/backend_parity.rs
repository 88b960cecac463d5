//! The fast backend gives the bits of the plain one: every scene and random set-ups, every instruction set
//! this machine has, one and two threads.
//!
//! What is compared is the fingerprint (all populations, kinds, masses and parked mass), all fields, the
//! ledger, the loads and how the run ended. A mismatch found here so far: the plain backend took the
//! relaxation time of the step before as zero in clamped flows with a free surface.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use lahar::boundary::cut::cut_cells;
use lahar::collision::{CollisionChoice, OddRate};
use lahar::coupling::{GrainWall, Suspension};
use lahar::dem::{self, Grain, Material, Materials, PairProperties, Period, Surface, V3, Wall};
use lahar::plan::Plan;
use lahar::rheology::Law;
use lahar::scene;
use lahar::setup::{
    BodyForce, Course, ExcessRule, Face, FreeSurface, Precision, Refill, Setup, SolidMotion, SurfaceForce,
    WallRule, YieldTreatment,
};
use lahar::solver::choose::only_plain;
use lahar::solver::fast::Fast;
use lahar::solver::fast::instructions::Instructions;
use lahar::solver::plain::Plain;
use lahar::solver::run::{Backend, Run, Runaway};
use lahar::units::Units;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

/// Compares two runs after the same calls.
fn differences(plain: &dyn Run, fast: &dyn Run) -> Vec<&'static str> {
    let checks = [
        ("fingerprint", plain.fingerprint() == fast.fingerprint()),
        ("fields", plain.fields() == fast.fields()),
        ("ledger", plain.ledger() == fast.ledger()),
        ("loads", plain.loads() == fast.loads()),
        ("cells", plain.fluid_cells() == fast.fluid_cells()),
    ];
    checks.iter().filter(|(_, same)| !same).map(|&(what, _)| what).collect()
}

/// Runs a set-up on the plain backend and on every variant of the fast one.
fn compare(name: &str, setup: &Setup, steps: u64, variants: &[(Instructions, usize)]) {
    compare_to(&Plain, name, setup, steps, variants);
}

/// Runs a set-up on a reference and on every variant of the fast backend.
fn compare_to(
    reference: &dyn Backend,
    name: &str,
    setup: &Setup,
    steps: u64,
    variants: &[(Instructions, usize)],
) {
    let mut plain = reference.start(setup).unwrap_or_else(|error| panic!("{name}: {error}"));
    let ended = plain.advance(steps);
    // Whatever else a random flow may do, its mass is accounted for.
    let leaks = ended.as_ref().is_err_and(|stopped| matches!(stopped.what, Runaway::Ledger { .. }));
    assert!(!leaks, "{name}: {ended:?}");
    for &(instructions, threads) in variants {
        let setup = Setup { threads, ..setup.clone() };
        let fast = Fast { instructions: Some(instructions) };
        let mut fast = fast.start(&setup).unwrap_or_else(|error| panic!("{name}: {error}"));
        // In two calls: a run does not depend on how its steps are asked for.
        let half = steps / 2;
        let end = fast.advance(half).and_then(|()| fast.advance(steps - half));
        let variant = format!("{name}, {}, {threads} threads", instructions.name());
        assert_eq!(format!("{ended:?}"), format!("{end:?}"), "{variant}: end of the run");
        assert_eq!(differences(&*plain, &*fast), Vec::<&str>::new(), "{variant}");
    }
}

fn variants() -> Vec<(Instructions, usize)> {
    Instructions::available().into_iter().flat_map(|set| [(set, 1), (set, 2)]).collect()
}

fn scenes() -> Vec<PathBuf> {
    let mut found = Vec::new();
    for folder in ["scenes/verify", "scenes/show", "scenes/coupled"] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{error}"));
        found.extend(entries.filter_map(|entry| entry.ok().map(|entry| entry.path())));
    }
    found.retain(|path| path.extension().is_some_and(|e| e == "json"));
    found.sort();
    found
}

#[test]
fn parity_of_every_scene() {
    let paths = scenes();
    assert!(paths.len() >= 37, "{}", paths.len());
    let best = variants().last().map(|&(set, _)| set).into_iter();
    let best: Vec<_> = best.flat_map(|set| [(set, 1), (set, 2)]).collect();
    let all = variants();
    for path in paths {
        let name = path.display().to_string();
        let scene = scene::load_flow(&path).unwrap_or_else(|error| panic!("{error}"));
        let plan = Plan::with_memory(&scene, None).unwrap_or_else(|error| panic!("{error}"));
        let cells = plan.setup.cells() as u64;
        // About 3 million updates of the plain backend per scene; the big ones take the best set only.
        let steps = (3_000_000 / cells).clamp(2, 60);
        if only_plain(&plan.setup).is_none() {
            compare(&name, &plan.setup, steps, if cells > 100_000 { &best } else { &all });
        }
    }
}

fn law() -> impl Strategy<Value = Law> {
    prop_oneof![
        (0.005..0.5).prop_map(|mu| Law::Newtonian { mu }),
        (1e-6..1e-4, 0.005..0.5).prop_map(|(sigma0, mu)| Law::Bingham { sigma0, mu }),
        (1e-6..1e-4, 1e-3..0.1, 0.3..1.2).prop_map(|(sigma0, k, n)| Law::HerschelBulkley { sigma0, k, n }),
        (0.01..0.2, 0.5..1.5).prop_map(|(k, n)| Law::PowerLaw { k, n }),
        (1e-6..1e-4, 0.01..0.2, 0.5..1.2, 1e2..1e4).prop_map(|(sigma0, k, n, m)| Law::Papanastasiou {
            sigma0,
            k,
            n,
            m
        }),
    ]
}

fn faces(surface: bool) -> impl Strategy<Value = [Face; 2]> {
    let one = move || {
        prop_oneof![
            3 => Just(Face::NoSlip),
            1 => (-0.01..0.01, -0.01..0.01, -0.01..0.01).prop_map(|(x, y, z)| Face::Moving([x, y, z])),
            2 => Just(Face::FreeSlip),
            1 => Just(if surface { Face::Open } else { Face::NoSlip }),
        ]
    };
    prop_oneof![Just([Face::Periodic; 2]), (one(), one()).prop_map(|(a, b)| [a, b])]
}

fn extent() -> impl Strategy<Value = usize> {
    prop_oneof![2 => Just(1_usize), 1 => Just(8), 1 => Just(16), 6 => 2_usize..21]
}

/// A repeatable number in 0..1 from a cell and a seed.
fn noise(cell: usize, seed: u64) -> f64 {
    let mixed = (cell as u64).wrapping_add(seed).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = (mixed ^ (mixed >> 31)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (mixed >> 40) as f64 / (1_u64 << 24) as f64
}

fn recipes() -> impl Strategy<Value = Recipe> {
    let shape = ([extent(), extent(), extent()], any::<u64>());
    let scheme = (
        prop::sample::select(vec![
            CollisionChoice::Bgk,
            CollisionChoice::Trt(OddRate::STANDARD),
            CollisionChoice::default(),
            CollisionChoice::default(),
            CollisionChoice::Regularised,
        ]),
        0..4_u8,
        any::<bool>(),
        [-2e-5..2e-5, -2e-5..2e-5, -1e-4..1e-5_f64],
        0..3_u8,
    );
    let surface = any::<bool>();
    (surface, shape, law(), law(), scheme).prop_flat_map(|(surface, shape, one, other, scheme)| {
        let faces = [faces(surface), faces(surface), faces(surface)];
        (faces, Just((surface, shape, [one, other], scheme)))
    })
}

/// What a random set-up is made from: faces, then everything else.
type Recipe = ([[Face; 2]; 3], (bool, ([usize; 3], u64), [Law; 2], Scheme));

type Scheme = (CollisionChoice, u8, bool, [f64; 3], u8);

fn build((faces, (surface, (extents, seed), laws, scheme)): Recipe) -> Setup {
    let (collision, treatment, half_way, force, density) = scheme;
    let mut setup = Setup::periodic(extents, laws[0]);
    let cells = setup.cells();
    setup.faces = faces;
    for (axis, faces) in setup.faces.iter_mut().enumerate() {
        for face in faces {
            if let Face::Moving(velocity) = face {
                // Faces slide in their plane.
                velocity[axis] = 0.0;
            }
        }
    }
    setup.collision = collision;
    setup.force = BodyForce::Constant(force);
    if half_way {
        setup.wall_rule = WallRule::HalfWay;
    }
    setup.yielding = match treatment {
        0 => YieldTreatment::ImplicitClamped { tau_min: 0.52, tau_max: 4.0 },
        1 => YieldTreatment::LaggedClamped { tau_min: 0.52, tau_max: 4.0 },
        _ => YieldTreatment::Exact,
    };
    if density > 0 {
        let share = 0.06 * f64::from(density);
        setup.solids = (0..cells).map(|cell| u8::from(noise(cell / 3, seed) < share)).collect();
        setup.solid_motion =
            vec![SolidMotion { velocity: [0.0; 3], spin: [1e-4, 0.0, -2e-4], centre: [3.0, 2.0, 1.0] }];
        setup.loads = true;
        if seed.is_multiple_of(2) && seed % 7 >= 2 {
            // Only solids at rest lie in their place.
            setup.solid_motion = vec![SolidMotion::default()];
            setup.cuts_by_stress = seed.is_multiple_of(3) && !surface;
            // Each solid cell holds a block of its own size about its centre.
            let inside = |p: [f64; 3]| {
                let at = std::array::from_fn(|a| (p[a].floor() as usize).min(extents[a] - 1));
                let cell = setup.index(at);
                let half = 0.02 + 0.46 * noise(cell, seed ^ 9);
                setup.is_solid(cell) && (0..3).all(|a| (p[a] - at[a] as f64 - 0.5).abs() < half)
            };
            setup.cuts = cut_cells(&setup, inside).into();
        }
    }
    if seed % 7 < 2 {
        let swing = Course::Oscillating { mean: 0.2, amplitude: 0.9, frequency: 0.4, phase: 1.0 };
        let table = Course::Table([[3.0, -1.0], [9.5, 1.0], [14.0, 0.25]].into());
        setup.courses.faces = std::array::from_fn(|axis| {
            [swing.clone(), if axis == 1 { Course::Constant } else { table.clone() }]
        });
        setup.courses.solids = vec![if seed % 7 == 0 { swing } else { table }];
    }
    if surface {
        let level = 0.4 + 0.5 * noise(1, seed);
        let fill = |cell: usize| {
            let [x, _, z] = setup.coordinates(cell);
            let height = z as f64 + 0.3 * x as f64;
            let full = height < level * extents[2] as f64;
            let drop = noise(cell, seed ^ 7) > 0.93;
            if full || drop { (1.5 * noise(cell / 5, seed ^ 3)).min(1.0) } else { 0.0 }
        };
        let mut rules = FreeSurface::new((0..cells).map(fill).collect());
        if seed.is_multiple_of(3) {
            (rules.refill, rules.excess) = (Refill::WithStress, ExcessRule::AlongNormal);
        }
        if seed.is_multiple_of(5) {
            rules.force = SurfaceForce::Full;
        } else if seed % 5 == 1 {
            rules.force = SurfaceForce::ByFillAndInertia;
        }
        setup.free_surface = Some(rules);
    } else if seed.is_multiple_of(4) {
        setup.fluids = laws.to_vec();
        setup.fluid_of_cell = (0..cells).map(|cell| u8::from(noise(cell, seed ^ 5) < 0.5)).collect();
    }
    setup
}

#[test]
fn parity_of_random_set_ups() {
    let config = Config { cases: 200, failure_persistence: None, ..Config::default() };
    let mut runner = TestRunner::new_with_rng(
        config,
        proptest::test_runner::TestRng::deterministic_rng(proptest::test_runner::RngAlgorithm::ChaCha),
    );
    let variants = variants();
    let (surfaces, cuts) = (std::cell::Cell::new(0), std::cell::Cell::new([0; 2]));
    let outcome = runner.run(&recipes(), |recipe| {
        let setup = build(recipe);
        // Set-ups without any fluid are refused by both.
        if let Err(error) = Plain.start(&setup) {
            let same = Fast::default().start(&setup).err().map(|e| format!("{e:?}"));
            prop_assert_eq!(same, Some(format!("{:?}", error)));
            return Ok(());
        }
        surfaces.set(surfaces.get() + u32::from(setup.free_surface.is_some()));
        let mut cut = cuts.get();
        cut[usize::from(setup.free_surface.is_some())] += u32::from(!setup.cuts.is_empty());
        cuts.set(cut);
        compare("random", &setup, 24, &variants);
        Ok(())
    });
    if let Err(error) = outcome {
        panic!("{error}");
    }
    assert!(surfaces.get() > 50, "{} set-ups with a free surface", surfaces.get());
    assert!(
        cuts.get().iter().all(|&count| count > 15),
        "{:?} with cut links, without and with one",
        cuts.get()
    );
}

/// In single precision there is no plain run to compare with, but the bits are the same for every
/// instruction set and number of threads, and a closed box keeps its ledger.
#[test]
fn parity_of_single_precision_among_variants() {
    let config = Config { cases: 60, failure_persistence: None, ..Config::default() };
    let mut runner = TestRunner::new_with_rng(
        config,
        proptest::test_runner::TestRng::deterministic_rng(proptest::test_runner::RngAlgorithm::ChaCha),
    );
    let variants = variants();
    let surfaces = std::cell::Cell::new(0);
    let outcome = runner.run(&recipes(), |recipe| {
        let setup = build(recipe);
        if Plain.start(&setup).is_err() {
            return Ok(());
        }
        surfaces.set(surfaces.get() + u32::from(setup.free_surface.is_some()));
        for precision in [Precision::Single, Precision::SingleStorage] {
            let setup = Setup { precision, ..setup.clone() };
            let baseline = Fast { instructions: Some(Instructions::Baseline) };
            compare_to(&baseline, precision.name(), &setup, 24, &variants);
        }
        Ok(())
    });
    if let Err(error) = outcome {
        panic!("{error}");
    }
    assert!(surfaces.get() > 10, "{} set-ups with a free surface", surfaces.get());
}

/// A heap that falls apart in a closed box: mass in single precision stays within its roundings.
#[test]
fn ledger_of_single_precision_closes_within_its_roundings() {
    const STEPS: u64 = 400;
    let mut setup = Setup::periodic([24, 16, 20], Law::Bingham { sigma0: 1e-5, mu: 0.05 });
    setup.faces = [[Face::NoSlip; 2], [Face::Periodic; 2], [Face::NoSlip; 2]];
    setup.force = BodyForce::Constant([0.0, 0.0, -1e-4]);
    let fill = |cell: usize| {
        let [x, _, z] = setup.coordinates(cell);
        if x < 10 && z < 12 { 1.0 } else { 0.0 }
    };
    setup.free_surface = Some(FreeSurface::new((0..setup.cells()).map(fill).collect()));
    let mut conversions = 0;
    for precision in Precision::ALL {
        let setup = Setup { precision, ..setup.clone() };
        let mut run = Fast::default().start(&setup).unwrap_or_else(|error| panic!("{error}"));
        run.advance(STEPS).unwrap_or_else(|stopped| panic!("{}: {stopped:?}", precision.name()));
        let ledger = run.ledger().unwrap_or_default();
        conversions += ledger.conversions;
        // Per step and cell: roundings of populations that sum to at most |ρ − 1| + 3|u|, below a half here.
        let bound = STEPS as f64 * 0.5 * precision.roundings() * precision.rounding();
        let found = ledger.mass_residual.abs();
        assert!(found <= bound, "{}: {found:e} > {bound:e}", precision.name());
        // f32 was really used.
        assert_eq!(found > 1e-12, precision != Precision::Double, "{}: {found:e}", precision.name());
    }
    assert!(conversions > 300, "{conversions}: the heap did not move");
}

/// Five grains, two of them clumps, that move and turn in a box with walls above and below: with or without gas.
fn with_grains(gas: bool, wall: GrainWall, law: Law, seed: u64) -> Setup {
    let extents = [24, 20, 26];
    let [nx, ny, nz] = extents.map(|n| n as f64);
    let weight = [1e-6, 2e-6, -3e-5];
    let material = Material { name: "grain".into(), density_kg_m3: 1.3, young_pa: 0.5, poisson: 0.25 };
    let mut dem = dem::Setup::new(Materials::single(material, PairProperties::default()));
    dem.gravity = V3::from(weight);
    dem.design_speed_m_s = 0.03;
    dem.start_overlap = 1e-3;
    dem.period = Period([Some(nx), None, None]);
    let plane = |point: V3, normal: V3| Wall::fixed("wall", Surface::Plane { point, normal }, 0);
    dem.walls = vec![
        plane(V3::zeros(), V3::z()),
        plane(V3::new(0.0, 0.0, nz), -V3::z()),
        plane(V3::zeros(), V3::y()),
        plane(V3::new(0.0, ny, 0.0), -V3::y()),
    ];
    let sphere = |x: f64| dem::Sphere { centre: V3::new(x, 0.0, 0.0), radius: 1.0 };
    let pair = dem::Clump::new("pair", &[sphere(-0.6), sphere(0.6)]);
    dem.clumps.push(pair.unwrap_or_else(|error| panic!("{error}")));
    let places = [[5.0, 5.5, 6.0], [14.0, 6.0, 8.5], [8.0, 13.5, 15.0], [16.5, 16.9, 6.5], [18.5, 7.0, 19.0]];
    for (k, place) in places.into_iter().enumerate() {
        let off = |a: usize| 0.4 * noise(7 * k + a, seed);
        let centre = V3::from(place) + V3::new(off(0), off(1), off(2));
        let grain = if k < 2 {
            Grain::clump(0, 2.6, centre, dem::Orientation::from_euler_angles(off(0), off(1), off(2)), 0)
        } else {
            Grain::sphere(2.2 + 0.2 * k as f64, centre, 0)
        };
        let velocity = V3::new(0.02 * off(2), 0.02 * off(0), -0.008);
        dem.grains.push(grain.moving(velocity).spinning(V3::new(0.004, 0.0, 0.01 * off(1))));
    }
    let mut suspension = Suspension::new(dem, Units::new(1.0, 1.0, 1.0));
    suspension.sub_steps = 20;
    suspension.wall = wall;
    let mut setup = Setup::periodic(extents, law);
    setup.faces[1] = [Face::NoSlip, Face::FreeSlip];
    setup.faces[2] = [Face::NoSlip; 2];
    setup.speed_limit = 0.3;
    if gas {
        setup.force = BodyForce::Constant(weight);
        let level = |cell: usize| 14.3 + noise(cell % (24 * 20), seed) - (cell / (24 * 20)) as f64;
        let fill = (0..setup.cells()).map(|cell| level(cell).clamp(0.0, 1.0)).collect();
        setup.free_surface = Some(FreeSurface::new(fill));
    } else {
        suspension.pressure_gradient = weight.map(|w| -w);
        suspension.balanced = [true, false, false];
        setup.force = BodyForce::Constant([weight[0], 0.0, 0.0]);
    }
    setup.grains = Some(Arc::new(suspension));
    setup
}

#[test]
fn parity_of_grains_in_a_fluid() {
    let laws = [
        Law::Newtonian { mu: 0.1 },
        Law::Bingham { sigma0: 1e-5, mu: 0.08 },
        Law::HerschelBulkley { sigma0: 1e-5, k: 0.03, n: 0.5 },
    ];
    let best = variants().last().map(|&(set, _)| set);
    for (k, law) in laws.into_iter().enumerate() {
        for gas in [false, true] {
            for wall in [GrainWall::HalfWay, GrainWall::CentralLinear] {
                let setup = with_grains(gas, wall, law, k as u64);
                let name = format!("grains, {law:?}, {wall:?}, gas {gas}");
                let some: Vec<_> = match k {
                    0 => variants(),
                    _ => best.map(|set| (set, 2)).into_iter().collect(),
                };
                compare(&name, &setup, 60, &some);
            }
        }
    }
}

/// In single precision too, the bits do not depend on instruction set or number of threads.
#[test]
fn parity_of_grains_in_single_precision_among_variants() {
    let baseline = Fast { instructions: Some(Instructions::Baseline) };
    for precision in [Precision::Single, Precision::SingleStorage] {
        for gas in [false, true] {
            let setup =
                with_grains(gas, GrainWall::CentralLinear, Law::Bingham { sigma0: 1e-5, mu: 0.08 }, 1);
            let setup = Setup { precision, ..setup };
            compare_to(
                &baseline,
                &format!("grains, {}, gas {gas}", precision.name()),
                &setup,
                60,
                &variants(),
            );
        }
    }
}

#[test]
fn grains_that_leave_give_their_cells_back() {
    let setup = with_grains(true, GrainWall::HalfWay, Law::Newtonian { mu: 0.1 }, 3);
    let mut plain = Plain.start(&setup).unwrap_or_else(|error| panic!("{error}"));
    let mut fast = Fast::default().start(&setup).unwrap_or_else(|error| panic!("{error}"));
    let keep = [true, false, true, true, false];
    for run in [&mut plain, &mut fast] {
        run.advance(20).unwrap_or_else(|error| panic!("{error:?}"));
        run.leave(&keep);
        run.advance(40).unwrap_or_else(|error| panic!("{error:?}"));
        assert_eq!(run.grains().map(|grains| grains.grains()), Some(3));
        let ledger = run.ledger().unwrap_or_default();
        // A few thousand roundings per step of a mass of about 7000.
        assert!(ledger.mass_residual.abs() < 1e-13 && ledger.momentum_residual < 1e-10, "{ledger:?}");
    }
    assert_eq!(differences(&*plain, &*fast), Vec::<&str>::new());
}
