//! Grains that move as they are told: the fluid and the gaps around them push them as they push free ones, and a scene may
//! have no others.

mod program;

use lahar::coupling::Suspension;
use lahar::dem::{self, V3};
use lahar::output::csv::Series;
use lahar::rheology::Law;
use lahar::run::Summary;
use lahar::setup::{Face, Setup};
use lahar::solver::choose::Best;
use lahar::solver::run::{Backend, Run};
use lahar::units::Units;
use program::lahar;

/// Force on a sphere that approaches a plane over that in the unbounded fluid; `distance`: of its centre, in radii.
///
/// # Source
/// Brenner 1961, Chem. Eng. Sci. 16, 242.
fn brenner(distance: f64) -> f64 {
    let alpha = libm::acosh(distance);
    let sinh = libm::sinh;
    let term = |n: f64| {
        let odd = 2.0 * n + 1.0;
        let (s, flat) = (sinh(0.5 * odd * alpha), odd * sinh(alpha));
        let above = 2.0 * sinh(odd * alpha) + odd * sinh(2.0 * alpha);
        n * (n + 1.0) / ((2.0 * n - 1.0) * (2.0 * n + 3.0)) * (above / (4.0 * s * s - flat * flat) - 1.0)
    };
    // Terms fall like e^(−2nα); α is 0.2 at a distance of 1.02.
    4.0 / 3.0 * sinh(alpha) * (1..200).map(|n| term(f64::from(n))).sum::<f64>()
}

/// A sphere of radius 3 cells driven towards a floor, and nothing else: what fluid and gap do to it together is on average within
/// 5 % of the exact force from 1.2 radii down to 1.02, the error of the lubrication's cut-off (`Lubrication::default`), and within
/// 10 % in any step: single ones in which its surface crosses cells stand out by 4 %, and at the end the ln(1/h) next to the 1/h
/// is missing, 2 %.
#[test]
fn reference_sphere_driven_to_a_wall() {
    for (distance, exact) in [(1.05, 21.586), (1.1, 11.459), (1.2, 6.341)] {
        assert!((brenner(distance) / exact - 1.0).abs() < 5e-5, "{}", brenner(distance));
    }
    let out = program::folder("driven", "wall");
    let (radius, speed) = (0.003, 0.02);
    let scene = serde_json::json!({
        "domain": { "size_m": [0.024, 0.024, 0.021], "spacing_m": 0.001,
            "boundaries": { "z_min": "no_slip", "z_max": "no_slip" } },
        "fluid": { "density_kg_per_m3": 1000.0, "rheology": { "newtonian": { "viscosity_pa_s": 1.0 } } },
        "grains": {
            "materials": [ { "name": "m", "density_kg_per_m3": 1000.0, "young_modulus_pa": 1e6, "poisson_ratio": 0.3 } ],
            "contact": { "law": { "tsuji": { "restitution": 0.6 } }, "friction": 0.3 },
            "coupling": { "wall": "central_linear" },
            "sets": [ { "name": "a", "driven": true, "velocity_m_per_s": [0, 0, -speed],
                "place": { "list": [ { "position_m": [0.0122, 0.0117, 1.35 * radius], "radius_m": radius } ] } } ] },
        "stop": { "end_time_s": 0.33 * radius / speed },
        "output": { "series": { "count": 66 },
            "grain_probes": [ { "name": "s", "measure": { "grain": { "set": "a" } } },
                { "name": "d", "measure": { "fluid_force": { "set": "a" } } } ] }
    });
    let path = out.join("scene.json");
    std::fs::write(&path, scene.to_string()).expect("a written scene");
    let output = lahar(&["run", &path.to_string_lossy(), "--out", &out.to_string_lossy(), "--quiet"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let summary = Summary::read(&out.join("summary.json")).expect("a summary");
    let grains = summary.fluid().and_then(|part| part.grains.as_ref()).expect("books of the grains");
    assert_eq!((grains.grains.number, grains.grains.driven), (0, 1));
    let series = Series::read(&out.join("series.csv")).expect("a series");
    let column = |name: &str| series.columns.iter().position(|c| c.name == name).expect("a column");
    let (z, force, contact) = (column("s_z"), column("d_force_z"), column("d_contact_z"));
    let stokes = 6.0 * std::f64::consts::PI * radius * speed;
    let near = series.rows.iter().filter(|row| row[z] / radius < 1.201);
    let errors: Vec<f64> =
        near.map(|row| (row[force] + row[contact]) / stokes / brenner(row[z] / radius) - 1.0).collect();
    assert!(errors.len() > 30 && errors.iter().all(|error| error.abs() < 0.1), "{errors:?}");
    let mean = errors.iter().map(|error| error.abs()).sum::<f64>() / errors.len() as f64;
    assert!(mean < 0.05, "{mean}");
}

/// Two spheres and a floor that move against each other, in lattice units.
fn meeting(driven: [bool; 2]) -> Box<dyn Run> {
    let grain = dem::Material { name: "grain".into(), density_kg_m3: 1e3, young_pa: 1.0, poisson: 0.25 };
    let mut grains = dem::Setup::new(dem::Materials::single(grain, dem::PairProperties::default()));
    let ball = |z: f64| dem::Grain::sphere(3.0, V3::new(8.1, 8.2, z), 0);
    grains.grains = vec![
        ball(3.1).moving(V3::new(1e-4, 0.0, -1e-3)).spinning(V3::new(0.0, 1e-4, 0.0)),
        ball(9.4).moving(V3::new(0.0, 2e-4, -2e-3)),
    ];
    for (grain, driven) in grains.grains.iter_mut().zip(driven) {
        grain.driven = driven;
    }
    let floor = dem::Surface::Plane { point: V3::zeros(), normal: V3::z() };
    grains.walls.push(dem::Wall::fixed("floor", floor, 0));
    grains.period = dem::Period([Some(16.0), Some(16.0), None]);
    let mut suspension = Suspension::new(grains, Units::new(1.0, 1.0, 1.0));
    suspension.sub_steps = 4;
    let mut setup = Setup::periodic([16, 16, 16], Law::Newtonian { mu: 0.5 });
    setup.faces[2] = [Face::NoSlip; 2];
    setup.grains = Some(std::sync::Arc::new(suspension));
    Best.start(&setup).unwrap_or_else(|error| panic!("{error}"))
}

/// What gaps do to grains they do, reversed, to what is on the other side, whoever is driven; and grains so heavy that a few
/// steps do not slow them feel the same in the first step as driven ones.
#[test]
fn exact_gaps_push_both_sides() {
    let mut first = Vec::new();
    for driven in [[false, false], [true, false], [false, true], [true, true]] {
        let mut run = meeting(driven);
        for step in 0..3 {
            run.advance(1).unwrap_or_else(|error| panic!("{error:?}"));
            let grains = run.grains().expect("grains");
            let on_wall = grains.lubrication_on_wall(0);
            let loads = grains.contact_loads();
            for a in 0..3 {
                let sum = on_wall[a] + loads[0][a] + loads[1][a];
                // A free grain's share comes from a change of momentum of 1e-4 of the momentum itself: 12 digits.
                assert!(sum.abs() < 1e-9 * on_wall.norm(), "{driven:?}: {on_wall} {loads:?}");
            }
            // So is the angular momentum about the origin, about which the floor turns.
            let (_, turned) = grains.lubrication_wrench(0);
            let mut sum = turned;
            for (grain, load) in loads.iter().enumerate() {
                let centre = V3::from(grains.centre(grain));
                sum += V3::new(load[3], load[4], load[5]) + centre.cross(&V3::new(load[0], load[1], load[2]));
            }
            // Centres move by a thousandth of a cell in a step, and forces are known at its sub-steps.
            assert!(sum.norm() < 1e-3 * turned.norm() && turned.norm() > 1.0, "{driven:?}: {sum} {turned}");
            if step == 0 {
                first.push((on_wall, loads.to_vec()));
            }
        }
    }
    let (wall, free) = &first[0];
    // 6πμR²(1/h − 1/h_c) with the upper sphere twice as fast, R/2 between the two.
    assert!(wall.z < -0.5 && free[1][2] > 0.03, "{wall} {free:?}");
    for (on_wall, loads) in &first[1..] {
        assert!((on_wall - wall).norm() < 0.01 * wall.norm(), "{on_wall} {wall}");
        for (load, free) in loads.iter().zip(free) {
            // Forces to the slowing of free grains in four sub-steps; torques too.
            for part in [0..3, 3..6] {
                let norm = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
                let off: Vec<f64> = part.clone().map(|a| load[a] - free[a]).collect();
                assert!(norm(&off) < 0.02 * norm(&free[part.clone()]), "{loads:?} {free:?}");
            }
        }
    }
}
