//! Grains in a fluid, from the scene to the files: each scene of the package has a plan, gravity goes where it should,
//! runs write what they say, and results do not depend on threads.

mod program;

use std::path::{Path, PathBuf};

use lahar::output::csv::Series;
use lahar::plan::Plan;
use lahar::plan::coupled::SubStepsFrom;
use lahar::run::summary::FluidPart;
use lahar::run::{Ended, Summary};
use lahar::scene::{self, Scene};
use lahar::setup::BodyForce;
use program::{lahar, root};

fn folder(name: &str) -> PathBuf {
    program::folder("coupled", name)
}

fn path_of(name: &str) -> PathBuf {
    root().join(format!("scenes/coupled/{name}.json"))
}

fn load(name: &str) -> Scene {
    scene::load_flow(&path_of(name)).unwrap_or_else(|error| panic!("{error}"))
}

fn plan(scene: &Scene) -> Plan {
    Plan::with_memory(scene, None).unwrap_or_else(|error| panic!("{error}"))
}

/// A scene as JSON, changed and read again.
fn changed(name: &str, change: impl Fn(&mut serde_json::Value)) -> Scene {
    let text = std::fs::read_to_string(path_of(name)).expect("a scene");
    let mut json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    change(&mut json);
    scene::flow_from_json(&json.to_string(), "changed.json", Path::new("."))
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Runs a scene with the command.
fn run(scene: &Path, out: &Path, more: &[&str]) -> Summary {
    let (scene, folder) = (scene.to_string_lossy(), out.to_string_lossy());
    let output = lahar(&[&["run", &scene, "--out", &folder, "--quiet"], more].concat());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    Summary::read(&out.join("summary.json")).unwrap_or_else(|error| panic!("{error}"))
}

fn fluid(summary: &Summary) -> &FluidPart {
    summary.fluid().expect("a part of the fluid")
}

#[test]
fn every_coupled_scene_has_a_plan() {
    let entries = std::fs::read_dir(root().join("scenes/coupled")).expect("a folder of scenes");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    assert!(paths.len() >= 12);
    for path in paths {
        let scene = scene::load_flow(&path).unwrap_or_else(|error| panic!("{error}"));
        let plan = plan(&scene);
        let n = plan.numbers.grains.as_ref().expect("numbers of the grains");
        let name = path.display();
        assert!(plan.numbers.mach <= 0.2 && n.speed_lattice <= 0.1 * (1.0 + 1e-12), "{name}: {n:?}");
        // 50 steps in a contact, or what the scene says; less by the rounding to whole sub-steps, never.
        assert!(n.steps_per_contact >= 50.0 * (1.0 - 1e-9) && n.radius_cells[0] >= 1.0, "{name}: {n:?}");
        assert!(n.lubrication.is_none_or(|rules| rules.limited_gap_cells <= 0.1 * (1.0 + 1e-9)), "{name}");
        let share: f64 = n.classes.iter().map(|class| class.volume_share).sum();
        assert!((share - 1.0).abs() < 1e-12 && n.classes.len() <= 6, "{name}");
        assert!(n.no_bagnold.is_none() || plan.numbers.reference_velocity_m_per_s == 0.0, "{name}: {n:?}");
    }
}

#[test]
fn exact_gravity_goes_where_it_should() {
    let force = |plan: &Plan| match plan.setup.force {
        BodyForce::Constant(force) => force,
        _ => panic!("a constant force"),
    };
    // Walls along z: the weight of the fluid becomes a pressure gradient on the grains.
    let closed = plan(&load("settling_sphere"));
    let g = closed.units.force_to_lattice(970.0 * 9.81);
    let suspension = closed.setup.grains.as_ref().expect("grains");
    assert_eq!(force(&closed), [0.0; 3]);
    assert_eq!((suspension.pressure_gradient, suspension.balanced), ([0.0, 0.0, g], [false; 3]));
    assert_eq!(suspension.dem.gravity.z, -9.81);
    // Periodic along z: the weight stays, and a gradient balances it.
    let array = plan(&load("array_settling"));
    let g = array.units.force_to_lattice(1000.0 * 9.81);
    let suspension = array.setup.grains.as_ref().expect("grains");
    assert_eq!(force(&array), [0.0, 0.0, -g]);
    assert_eq!((suspension.pressure_gradient, suspension.balanced), ([0.0; 3], [false, false, true]));
    // Not if the scene says so: gravity drives the flow.
    let chute =
        changed("array_settling", |json| json["grains"]["coupling"] = serde_json::json!({"balanced": false}));
    assert_eq!(plan(&chute).setup.grains.as_ref().expect("grains").balanced, [false; 3]);
    // A free surface: the fluid has its weight, whatever the walls.
    let pool = plan(&load("floating_sphere"));
    let suspension = pool.setup.grains.as_ref().expect("grains");
    assert_eq!(force(&pool)[2], -pool.units.force_to_lattice(1000.0 * 9.81));
    assert_eq!((suspension.pressure_gradient, suspension.balanced), ([0.0; 3], [false; 3]));
}

#[test]
fn sub_steps_and_rules_of_the_scene_reach_the_solver() {
    let scene = changed("settling_sphere", |json| {
        json["grains"]["coupling"] = serde_json::json!({ "wall": "central_linear", "refill": "neighbours", "lubrication": "off", "sub_steps": 40 });
    });
    let plan = plan(&scene);
    let suspension = plan.setup.grains.as_ref().expect("grains");
    assert_eq!(suspension.sub_steps, 40);
    assert_eq!(suspension.wall, lahar::coupling::GrainWall::CentralLinear);
    assert_eq!(suspension.refill, lahar::coupling::GrainRefill::Neighbours);
    assert!(suspension.lubrication.is_none());
    let n = plan.numbers.grains.as_ref().expect("numbers");
    assert_eq!((n.sub_steps_from, n.time_step_s), (SubStepsFrom::Given, plan.units.dt_s / 40.0));
}

/// What plan says about small and light grains: warnings with numbers in them.
#[test]
fn plan_warns_of_small_and_of_light_grains() {
    let small = changed("settling_sphere", |json| {
        json["grains"]["sets"][0]["place"]["list"][0]["radius_m"] = 0.004.into();
    });
    let warnings =
        plan(&small).numbers.warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
    assert!(warnings.contains("radius of 1.6 cells: expect its drag to be off by 13.0 %"), "{warnings}");
    let light = changed("floating_sphere", |json| {
        json["grains"]["materials"][0]["density_kg_per_m3"] = 400.0.into();
    });
    let warnings =
        plan(&light).numbers.warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
    assert!(warnings.contains("a grain has 0.4 of the fluid's density"), "{warnings}");
}

#[test]
fn plan_notes_that_held_grains_creep() {
    let creeps = |scene: &Scene| {
        let text = plan(scene).to_string();
        (text.contains(": held by the yield stress"), text.contains("creep on"))
    };
    assert_eq!(creeps(&load("bingham_held")), (true, false));
    let default = changed("bingham_held", |json| {
        json.as_object_mut().expect("an object").remove("numerics");
    });
    assert_eq!(creeps(&default), (true, true));
    assert_eq!(creeps(&load("bingham_sinking")), (false, false));
}

#[test]
fn plan_prints_grains_and_size_classes() {
    let output = lahar(&["plan", "scenes/coupled/debris_flow.json"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    for part in [
        "600, 600 of them clumps; 2400 spheres",
        "`x_max`, `z_max` open: fluid and grains that pass leave",
        "thresholds 40 and 450",
        "4 cells at ",
        " times the cost; ",
        "Ba ",
    ] {
        assert!(text.contains(part), "`{part}` in {text}");
    }
    let output = lahar(&["plan", "--json", "scenes/coupled/debris_flow.json"]);
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(json["grains"]["grains"], 600);
    assert_eq!(json["grains"]["classes"].as_array().map(Vec::len), Some(6));
}

/// A run writes fluid and grains; results do not depend on threads, and the books close.
#[test]
fn a_run_writes_fluid_and_grains() {
    let out = folder("floating");
    let summary = run(&path_of("floating_sphere"), &out, &["--until", "0.02", "--threads", "1"]);
    for file in [
        "run.pvd",
        "surface.pvd",
        "grains.pvd",
        "contacts.pvd",
        "grains_000000.vtp",
        "grains_final_sphere.csv",
        "plots/speed.svg",
        "plots/grains.svg",
        "plots/series_sphere.svg",
        "plots/series_depth.svg",
    ] {
        // Pictures of the fluid are written from two cells on.
        assert!(out.join(file).is_file() || file == "plots/speed.svg", "{file}");
    }
    let coupling = summary.coupling().expect("books of the grains");
    // Sums of roundings of each cell's populations.
    assert!(fluid(&summary).mass_residual.abs() < 1e-12, "{}", fluid(&summary).mass_residual);
    let parts = coupling.mass_over_links_kg - coupling.mass_covered_kg + coupling.mass_freed_kg;
    assert!(
        (parts - coupling.mass_from_grains_kg).abs()
            < 1e-12 * fluid(&summary).free_surface.as_ref().map_or(1.0, |s| s.mass_kg)
    );
    let grains = fluid(&summary).grains.as_ref().expect("books of the grains");
    assert_eq!((grains.grains.number, grains.grains.driven), (1, 0));
    let series = Series::read(&out.join("series.csv")).expect("a series");
    let column = |name: &str| series.columns.iter().position(|c| c.name == name).expect("a column");
    let (z, depth) = (column("sphere_z"), column("depth"));
    // Released 2 mm above the surface; it falls.
    assert!((series.rows[0][depth] + 0.002).abs() < 1e-12 && series.rows[0][z] == 0.038);
    assert!(series.rows.last().is_some_and(|row| row[z] < 0.0379));
    let again = folder("floating_two");
    let two = run(&path_of("floating_sphere"), &again, &["--until", "0.02", "--threads", "2"]);
    assert_eq!(fluid(&two).fingerprint, fluid(&summary).fingerprint);
    assert_eq!(fluid(&two).grains.as_ref().map(|g| &g.fingerprint), Some(&grains.fingerprint));
}

/// The parts of a force on a solid: a grain dropped on a block in a shallow pool pushes through contacts.
#[test]
fn forces_of_contacts_and_fluid_are_apart() {
    let out = folder("parts");
    let scene = serde_json::json!({
        "domain": { "size_m": [0.04, 0.04, 0.05], "spacing_m": 0.0025, "boundaries": {
            "x_min": "no_slip", "x_max": "no_slip", "y_min": "no_slip", "y_max": "no_slip", "z_min": "no_slip", "z_max": "open" } },
        "gravity": { "magnitude_m_per_s2": 9.81, "direction": [0, 0, -1] },
        "fluid": { "density_kg_per_m3": 1000.0, "rheology": { "newtonian": { "viscosity_pa_s": 0.5 } },
            "initial": { "fill_level": { "height_m": 0.018 } } },
        "solids": [ { "name": "block", "shape": { "box": { "min_m": [0.01, 0.01, 0.0], "max_m": [0.03, 0.03, 0.025] } } } ],
        "grains": {
            "materials": [ { "name": "stone", "density_kg_per_m3": 2500.0, "young_modulus_pa": 1e6, "poisson_ratio": 0.3 } ],
            "contact": { "law": { "tsuji": { "restitution": 0.3 } }, "friction": 0.3 },
            "coupling": { "lubrication": "off" },
            "sets": [ { "name": "stone", "place": { "list": [ { "position_m": [0.02, 0.02, 0.0315], "radius_m": 0.006 } ] } } ] },
        "stop": { "end_time_s": 0.3 },
        "output": { "probes": [ { "name": "block", "measure": { "force": { "solid": "block" } } } ] }
    });
    let path = out.join("parts.json");
    std::fs::write(&path, scene.to_string()).expect("a written scene");
    let summary = run(&path, &out, &[]);
    assert!(summary.stopped.is_none() && summary.ended == Ended::EndTime);
    let series = Series::read(&out.join("series.csv")).expect("a series");
    let column = |name: &str| series.columns.iter().position(|c| c.name == name).expect("a column");
    let last = series.rows.last().expect("rows");
    let weight = 2500.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.006f64 * 0.006 * 0.006 * 9.81;
    // It lies in air on the block and has come to rest: contacts carry its weight; 1 % for what still rocks.
    assert!(
        (last[column("block_contact_z")] / weight + 1.0).abs() < 0.01,
        "{} {weight}",
        last[column("block_contact_z")]
    );
    let most = series.rows.iter().map(|row| row[column("block_contact_peak")]).fold(0.0, f64::max);
    assert!(most > 1.5 * weight, "the impact: {most}");
    // The impulse of the contacts is that of the weight since release, since it started and ended at rest.
    let impulse = last[column("block_contact_impulse_z")] / (weight * summary.time_s);
    assert!((impulse + 1.0).abs() < 0.02, "{impulse}");
    assert!(out.join("plots/contact_block.svg").is_file() && out.join("plots/force_block.svg").is_file());
}

/// Contacts too soft for their load: exit code 3, and a message that names the grain.
#[test]
fn a_guard_of_the_grains_stops_a_run_by_name() {
    let out = folder("soft");
    let scene = changed("lubricated_approach", |json| {
        json["grains"]["materials"][0]["young_modulus_pa"] = 30.0.into();
        json["grains"]["coupling"] = serde_json::json!({ "lubrication": "off" });
        json["stop"]["end_time_s"] = 0.6.into();
    });
    let path = out.join("soft.json");
    std::fs::write(&path, serde_json::to_string(&scene).expect("JSON")).expect("a written scene");
    let output = lahar(&["run", &path.to_string_lossy(), "--out", &out.to_string_lossy(), "--quiet"]);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3), "{message}");
    for part in
        ["soft.json: stopped at step", "grain 0 of set `sphere`", "likely cause", "files written before stay"]
    {
        assert!(message.contains(part), "`{part}` in {message}");
    }
    let summary = Summary::read(&out.join("summary.json")).expect("a summary");
    assert!(summary.stopped.is_some() && summary.ended == Ended::Stopped && summary.grains().is_some());
}

/// A grain thrown out through the open top is gone and booked; the one that stays keeps its number.
#[test]
fn grains_that_pass_open_faces_leave() {
    let out = folder("leave");
    let scene = serde_json::json!({
        "domain": { "size_m": [0.05, 0.04, 0.05], "spacing_m": 0.0025, "boundaries": {
            "x_min": "no_slip", "x_max": "no_slip", "y_min": "no_slip", "y_max": "no_slip", "z_min": "no_slip", "z_max": "open" } },
        "gravity": { "magnitude_m_per_s2": 9.81, "direction": [0, 0, -1] },
        "fluid": { "density_kg_per_m3": 1000.0, "rheology": { "newtonian": { "viscosity_pa_s": 0.5 } },
            "initial": { "fill_level": { "height_m": 0.02 } } },
        "grains": {
            "materials": [ { "name": "stone", "density_kg_per_m3": 2500.0, "young_modulus_pa": 1e6, "poisson_ratio": 0.3 } ],
            "contact": { "law": { "tsuji": { "restitution": 0.3 } }, "friction": 0.3 },
            "sets": [
                { "name": "thrown", "place": { "list": [ { "position_m": [0.0125, 0.02, 0.04], "radius_m": 0.005 } ] },
                  "velocity_m_per_s": [0.0, 0.0, 1.5] },
                { "name": "lying", "place": { "list": [ { "position_m": [0.035, 0.02, 0.007], "radius_m": 0.006 } ] } } ] },
        "stop": { "end_time_s": 0.05 }
    });
    let path = out.join("leave.json");
    std::fs::write(&path, scene.to_string()).expect("a written scene");
    let summary = run(&path, &out, &[]);
    let grains = summary.grains().expect("books of the grains");
    assert_eq!((grains.number, grains.left), (1, 1));
    let mass = 2500.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.005f64 * 0.005 * 0.005;
    assert!((grains.left_kg / mass - 1.0).abs() < 1e-12, "{}", grains.left_kg);
    let table = std::fs::read_to_string(out.join("grains_final_lying.csv")).expect("a table");
    assert_eq!(table.lines().filter(|line| !line.starts_with('#')).count(), 2, "{table}");
    let gone = std::fs::read_to_string(out.join("grains_final_thrown.csv")).expect("a table");
    assert_eq!(gone.lines().filter(|line| !line.starts_with('#')).count(), 1, "{gone}");
}

/// A plate of four spheres in a slot has eight gaps of a tenth of a cell at once. Each by itself could be stepped
/// explicitly, all together only because they share what a step can take: the plate comes to rest.
#[test]
fn many_gaps_of_one_grain_share_what_a_step_can_take() {
    use lahar::coupling::Suspension;
    use lahar::dem::{self, V3};
    use lahar::rheology::Law;
    use lahar::setup::{Face, Setup};
    use lahar::solver::choose::Best;
    use lahar::solver::run::Backend;
    use lahar::units::Units;

    let ball = |x: f64, y: f64| dem::Sphere { centre: V3::new(x, y, 0.0), radius: 2.0 };
    let plate =
        dem::Clump::new("plate", &[ball(-2.1, -2.1), ball(2.1, -2.1), ball(-2.1, 2.1), ball(2.1, 2.1)])
            .unwrap_or_else(|error| panic!("{error}"));
    let grain = dem::Material { name: "grain".into(), density_kg_m3: 2.0, young_pa: 1.0, poisson: 0.25 };
    let mut grains = dem::Setup::new(dem::Materials::single(grain, dem::PairProperties::default()));
    let centre = V3::new(8.0, 8.0, 2.5);
    let start = dem::Grain::clump(0, plate.equivalent_radius(), centre, plate.frame, 0);
    grains.grains.push(start.moving(V3::new(0.0, 0.0, 0.01)).spinning(V3::new(0.002, 0.001, 0.0)));
    grains.clumps.push(plate);
    for (name, at, normal) in [("floor", 0.4, 1.0), ("lid", 4.6, -1.0)] {
        let surface = dem::Surface::Plane { point: V3::new(0.0, 0.0, at), normal: V3::new(0.0, 0.0, normal) };
        grains.walls.push(dem::Wall::fixed(name, surface, 0));
    }
    grains.period = dem::Period([Some(16.0), Some(16.0), None]);
    let mut suspension = Suspension::new(grains, Units::new(1.0, 1.0, 1.0));
    suspension.sub_steps = 8;
    let mut setup = Setup::periodic([16, 16, 5], Law::Newtonian { mu: 0.5 });
    setup.faces[2] = [Face::NoSlip; 2];
    setup.grains = Some(std::sync::Arc::new(suspension));
    let mut run = Best.start(&setup).unwrap_or_else(|error| panic!("{error}"));
    let energy =
        |run: &dyn lahar::solver::run::Run| run.grains().map_or(f64::NAN, |g| g.totals().kinetic_energy);
    let first = energy(run.as_ref());
    run.advance(100).unwrap_or_else(|error| panic!("{error:?}"));
    let last = energy(run.as_ref());
    // Squeezed film: friction over mass is 19 per step, so that nothing should be left; what rings between fluid and
    // gaps decays by a percent per step.
    assert!(last < 1e-3 * first, "{first:e} to {last:e}");
}

/// What lubrication does to a grain it does, reversed, to the wall: a sphere pressed towards a plane by its motion alone.
#[test]
fn exact_lubrication_pushes_the_wall_back() {
    use lahar::coupling::Suspension;
    use lahar::dem::{self, V3};
    use lahar::rheology::Law;
    use lahar::setup::{Face, Setup};
    use lahar::solver::choose::Best;
    use lahar::solver::run::Backend;
    use lahar::units::Units;

    let grain = dem::Material { name: "grain".into(), density_kg_m3: 1e3, young_pa: 1.0, poisson: 0.25 };
    let mut grains = dem::Setup::new(dem::Materials::single(grain, dem::PairProperties::default()));
    let ball = |x: f64, gap: f64| dem::Grain::sphere(3.0, V3::new(x, 8.2, 3.0 + gap), 0);
    let down = V3::new(1e-4, 0.0, -1e-3);
    grains.grains = vec![ball(4.3, 0.1).moving(down), ball(12.4, 0.3).moving(down)];
    let floor = dem::Surface::Plane { point: V3::zeros(), normal: V3::z() };
    grains.walls.push(dem::Wall::fixed("floor", floor, 0));
    grains.period = dem::Period([Some(16.0), Some(16.0), None]);
    let mut suspension = Suspension::new(grains, Units::new(1.0, 1.0, 1.0));
    suspension.sub_steps = 4;
    let mut setup = Setup::periodic([16, 16, 16], Law::Newtonian { mu: 0.5 });
    setup.faces[2] = [Face::NoSlip; 2];
    setup.grains = Some(std::sync::Arc::new(suspension));
    let mut run = Best.start(&setup).unwrap_or_else(|error| panic!("{error}"));
    for _ in 0..5 {
        run.advance(1).unwrap_or_else(|error| panic!("{error:?}"));
        let grains = run.grains().expect("grains");
        let on_wall = grains.lubrication_on_wall(0);
        let on_grains = grains
            .contact_loads()
            .iter()
            .fold([0.0; 3], |sum: [f64; 3], f| std::array::from_fn(|a| sum[a] + f[a]));
        assert!(on_wall.z < -0.5, "{on_wall}");
        // The grains' share is found from a change of momentum of 1e-4 of the momentum itself: 12 digits.
        for a in 0..3 {
            assert!((on_wall[a] + on_grains[a]).abs() < 1e-9 * on_wall.norm(), "{on_wall} {on_grains:?}");
        }
        assert_eq!(grains.lubrication_on_wall(1), V3::zeros());
    }
}
