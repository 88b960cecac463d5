//! The fast backend gives the bits of the plain one among grains: see `backend_parity.rs`.

mod parity;

use std::sync::Arc;

use lahar::boundary::cut::cut_cells;
use lahar::coupling::{GrainWall, Suspension};
use lahar::dem::{self, Grain, Material, Materials, PairProperties, Period, Surface, V3, Wall};
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, FreeSurface, Precision, Setup, SolidMotion};
use lahar::solver::fast::Fast;
use lahar::solver::fast::instructions::Instructions;
use lahar::solver::plain::Plain;
use lahar::solver::run::Backend;
use lahar::units::Units;
use parity::{compare, compare_to, differences, noise, variants};

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

/// A fingerprint that left grains out would call runs equal whose grains differ.
#[test]
fn fingerprints_tell_grains_apart() {
    let start = |change: &dyn Fn(&mut Suspension)| {
        let mut setup = with_grains(false, GrainWall::HalfWay, Law::Newtonian { mu: 0.1 }, 1);
        let mut suspension =
            setup.grains.take().map(Arc::unwrap_or_clone).unwrap_or_else(|| panic!("grains"));
        change(&mut suspension);
        setup.grains = Some(Arc::new(suspension));
        [&Plain as &dyn Backend, &Fast::default()]
            .map(|backend| backend.start(&setup).unwrap_or_else(|error| panic!("{error}")).fingerprint())
    };
    let as_it_is = start(&|_| ());
    assert_eq!(as_it_is[0], as_it_is[1]);
    // Each too small to change a cell.
    let changes: [&dyn Fn(&mut Suspension); 4] = [
        &|s| s.dem.grains[3].position.x += 1e-12,
        &|s| s.dem.grains[3].velocity.y += 1e-12,
        &|s| s.dem.grains[3].spin.z += 1e-12,
        &|s| s.dem.grains[0].orientation *= dem::Orientation::from_euler_angles(1e-12, 0.0, 0.0),
    ];
    for (k, change) in changes.into_iter().enumerate() {
        let changed = start(change);
        assert!(changed[0] != as_it_is[0] && changed[0] == changed[1], "change {k}");
    }
}

/// A solid in its place beside grains, with films of less than a cell in between, with and without gas.
#[test]
fn parity_of_grains_beside_a_solid_in_place() {
    for gas in [false, true] {
        for wall in [GrainWall::HalfWay, GrainWall::CentralLinear] {
            let mut setup = with_grains(gas, wall, Law::Bingham { sigma0: 1e-5, mu: 0.08 }, 2);
            let inside = |p: [f64; 3]| {
                let ball = V3::new(9.5, 6.2, 2.4) - V3::from(p);
                ball.norm() < 2.8 || p[2] < 1.2 + 0.1 * p[1]
            };
            let solid = |cell: usize| inside(setup.coordinates(cell).map(|x| x as f64 + 0.5));
            setup.solids = (0..setup.cells()).map(|cell| u8::from(solid(cell))).collect();
            setup.solid_motion = vec![SolidMotion::default()];
            setup.cuts = cut_cells(&setup, inside).into();
            assert!(setup.cuts.len() > 200);
            compare(&format!("grains beside a solid, {wall:?}, gas {gas}"), &setup, 60, &variants());
        }
    }
}
