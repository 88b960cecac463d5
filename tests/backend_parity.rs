//! The fast backend gives the bits of the plain one: every scene and random set-ups, every instruction set
//! this machine has, one and two threads.
//!
//! What is compared is the fingerprint (all populations, kinds, masses and parked mass), all fields, the
//! ledger, the loads and how the run ended. A mismatch found here so far: the plain backend took the
//! relaxation time of the step before as zero in clamped flows with a free surface.

mod parity;

use std::path::{Path, PathBuf};

use lahar::boundary::cut::cut_cells;
use lahar::collision::{CollisionChoice, OddRate};
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
use lahar::solver::run::Backend;
use parity::{compare, compare_to, noise, variants};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

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
    // Every set once, with one thread or two in turns; the best with both.
    let turns = variants()
        .into_iter()
        .enumerate()
        .filter(|(k, _)| k % 4 == 0 || k % 4 == 3)
        .map(|(_, variant)| variant);
    let mut all: Vec<_> = turns.filter(|variant| !best.contains(variant)).collect();
    all.extend(&best);
    for path in paths {
        let name = path.display().to_string();
        let scene = scene::load_flow(&path).unwrap_or_else(|error| panic!("{error}"));
        let plan = Plan::with_memory(&scene, None).unwrap_or_else(|error| panic!("{error}"));
        let cells = plan.setup.cells() as u64;
        // About a million updates of the plain backend per scene; the big ones take the best set only.
        let steps = (1_000_000 / cells).clamp(4, 60);
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
    let halves = halves();
    let (surfaces, cuts, count) =
        (std::cell::Cell::new(0), std::cell::Cell::new([0; 2]), std::cell::Cell::new(0));
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
        count.set(count.get() + 1);
        compare("random", &setup, 24, &halves[count.get() % 2]);
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

/// Each instruction set in both, in one with one thread and in the other with two.
fn halves() -> [Vec<(Instructions, usize)>; 2] {
    let half = |odd: usize| {
        let variants = variants().into_iter().enumerate();
        variants.filter(|(k, _)| (k / 2 + k) % 2 == odd).map(|(_, variant)| variant).collect()
    };
    [half(0), half(1)]
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
    let halves = halves();
    let (surfaces, count) = (std::cell::Cell::new(0), std::cell::Cell::new(0));
    let outcome = runner.run(&recipes(), |recipe| {
        let setup = build(recipe);
        if Plain.start(&setup).is_err() {
            return Ok(());
        }
        surfaces.set(surfaces.get() + u32::from(setup.free_surface.is_some()));
        for precision in [Precision::Single, Precision::SingleStorage] {
            let setup = Setup { precision, ..setup.clone() };
            let baseline = Fast { instructions: Some(Instructions::Baseline) };
            count.set(count.get() + 1);
            compare_to(&baseline, precision.name(), &setup, 24, &halves[count.get() / 2 % 2]);
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
