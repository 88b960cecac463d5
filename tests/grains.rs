//! Scenes without fluid: each one of the package has a plan and runs, results do not depend on threads, what is
//! written can be read back, and grains that leave are booked.

mod program;

use std::path::{Path, PathBuf};

use lahar::dem::Dem;
use lahar::output::csv::Series;
use lahar::plan::PlanProblem;
use lahar::plan::grains::GrainPlan;
use lahar::run::summary::DryPart;
use lahar::run::{Ended, Summary, fingerprint};
use lahar::scene;
use lahar::scene::dry::DryScene;
use program::{lahar, root};

/// The rate of loss in a damped contact starts like δ^{1/4}, which the books' trapezoid resolves to about
/// (1/steps per contact)^{5/4}: 7.5e-3 of what is lost at 50 steps.
const BOOKS: f64 = 7.5e-3;

fn folder(name: &str) -> PathBuf {
    program::folder("grains", name)
}

fn dry(path: &Path) -> DryScene {
    scene::load_dry(path).unwrap_or_else(|error| panic!("{error}"))
}

fn part(summary: &Summary) -> &DryPart {
    summary.dry().expect("a part of dry grains")
}

fn scenes() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(root().join("scenes/grains")).expect("a folder of scenes");
    let mut scenes: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    scenes.sort();
    assert!(scenes.len() >= 7);
    scenes
}

/// Runs a scene with the command.
fn run(scene: &Path, out: &Path, more: &[&str]) -> Summary {
    let (scene, folder) = (scene.to_string_lossy(), out.to_string_lossy());
    let output = lahar(&[&["run", &scene, "--out", &folder, "--quiet"], more].concat());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    Summary::read(&out.join("summary.json")).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn every_scene_of_grains_has_a_plan() {
    for path in scenes() {
        let plan = GrainPlan::new(&dry(&path)).unwrap_or_else(|error| panic!("{error}"));
        let n = &plan.numbers;
        assert!(plan.steps > 0 && n.grains > 0 && n.steps_per_contact >= 20.0 * (1.0 - 1e-12), "{n:?}");
        let fluid = n.passes.iter().find(|pass| pass.pass == "fluid").expect("a line about the fluid");
        assert!(!fluid.needed);
    }
}

/// 200 steps of every scene with 1 and 2 threads, straight through the library.
#[test]
fn threads_do_not_change_a_bit_of_any_scene() {
    for path in scenes() {
        let plan = GrainPlan::new(&dry(&path)).unwrap_or_else(|error| panic!("{error}"));
        let after = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            pool.install(|| {
                let mut dem = Dem::new(&plan.setup).expect("a checked set-up");
                dem.step(200).expect("a quiet start");
                fingerprint(&dem)
            })
        };
        assert_eq!(after(1), after(2), "{}", path.display());
    }
}

#[test]
fn a_run_writes_what_it_says_and_its_table_starts_another_run() {
    let out = folder("stacked");
    let summary = run(&root().join("scenes/grains/stacked_spheres.json"), &out, &["--until", "0.02"]);
    assert!(summary.stopped.is_none() && summary.ended == Ended::EndTime, "{summary:?}");
    assert!(part(&summary).energy_residual.abs() < BOOKS, "{}", part(&summary).energy_residual);
    for file in
        ["grains.pvd", "contacts.pvd", "grains_000000.vtp", "plots/grains.svg", "plots/series_energy.svg"]
    {
        assert!(out.join(file).is_file(), "{file}");
    }
    let series = Series::read(&out.join("series.csv")).expect("a series");
    assert!(series.rows.len() >= 4 && series.columns[1].name == "energy_kinetic");
    // The final table, put in place of the lattice, gives the same places back to the bit.
    let mut scene: serde_json::Value =
        serde_json::from_str(include_str!("../scenes/grains/stacked_spheres.json")).expect("JSON");
    scene["grains"]["sets"][0]["place"] = serde_json::json!({ "csv": { "file": "grains_final_stack.csv" } });
    scene["grains"]["numerics"]["start_overlap"] = 0.01.into();
    let path = out.join("again.json");
    std::fs::write(&path, scene.to_string()).expect("a written scene");
    let plan = GrainPlan::new(&dry(&path)).unwrap_or_else(|error| panic!("{error}"));
    let table = Series::read(&out.join("grains_final_stack.csv")).expect("a table");
    assert_eq!(plan.setup.grains.len(), table.rows.len());
    for (grain, row) in plan.setup.grains.iter().zip(&table.rows) {
        let read = [grain.position.x, grain.position.y, grain.position.z, grain.radius, grain.velocity.x];
        assert_eq!(read[..], row[..5]);
    }
}

/// A drum with clumps: which files there are, with how many points and arrays.
#[test]
fn exact_counts_in_vtp_files() {
    let out = folder("vtp");
    let drum = r#"{ "name": "drum", "invert": true, "spin_rad_per_s": [0, 3, 0],
        "shape": { "cylinder": { "point_m": [0.05, 0, 0.05], "direction": [0, 1, 0], "radius_m": 0.05 } } }"#;
    let grains = r#""clumps": [{ "name": "t", "members": { "tetrahedron": { "edge_over_radius": 1.2 } } }],
        "sets": [{ "name": "s", "clump": "t", "place": { "lattice": { "kind": "simple_cubic", "radius_m": 0.004,
        "region": { "box": { "min_m": [0.03, 0.03, 0.02], "max_m": [0.07, 0.07, 0.05] } } } } }]"#;
    let faces = r#""x_min": "open", "x_max": "open", "z_min": "no_slip", "z_max": "open""#;
    let domain = format!(r#"{{ "size_m": [0.1, 0.1, 0.1], "boundaries": {{ {faces} }} }}"#);
    let more = format!(
        r#""solids": [{drum}], "gravity": {{ "magnitude_m_per_s2": 9.81, "direction": [0, 0, -1] }},"#
    );
    let path = out.join("drum.json");
    std::fs::write(&path, text(&domain, grains, &more)).expect("a written scene");
    let grains = part(&run(&path, &out, &["--until", "0.05"])).grains.number;
    // The header says how many points there are and which arrays; `tests/output.rs` has the format itself checked.
    let points = |name: &str| {
        let bytes = std::fs::read(out.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
        let text = String::from_utf8_lossy(&bytes);
        let between = |from: &str, to: &str| {
            let rest = text.split_once(from).unwrap_or_else(|| panic!("{name}: no {from}")).1;
            rest.split_once(to).unwrap_or_else(|| panic!("{name}: no {to}")).0.to_owned()
        };
        let arrays = |part: &str| {
            let part = between(&format!("<{part}"), &format!("</{part}>"));
            part.matches("<DataArray").count()
        };
        let count: usize = between("NumberOfPoints=\"", "\"").parse().expect("a number");
        (count, arrays("PointData"), arrays("CellData"))
    };
    assert_eq!(points("grains_000001.vtp"), (grains, 9, 0));
    assert_eq!(points("spheres_000001.vtp"), (4 * grains, 4, 0));
    assert_eq!(points("contacts_000001.vtp").2, 3);
    // Two rings of 65 points; a drum that turns about its axis is written once.
    assert_eq!(points("walls_000000.vtp"), (130, 0, 1));
    assert!(!out.join("walls_000001.vtp").exists());
}

/// A scene in one line of text.
fn text(domain: &str, grains: &str, more: &str) -> String {
    format!(
        r#"{{ "domain": {domain}, {more}
        "grains": {{
            "materials": [{{ "name": "m", "density_kg_per_m3": 2500, "young_modulus_pa": 1e7, "poisson_ratio": 0.3 }}],
            "contact": {{ "law": {{ "tsuji": {{ "restitution": 0.5 }} }}, "friction": 0.4 }}, {grains} }},
        "stop": {{ "end_time_s": 0.2 }},
        "output": {{ "probes": [
            {{ "name": "here", "measure": "mass" }},
            {{ "name": "passed", "measure": {{ "flux": {{ "normal": "x", "at_m": 0.05 }} }} }},
            {{ "name": "floor", "measure": {{ "force": {{ "on": {{ "face": "z_min" }} }} }} }}
        ] }} }}"#
    )
}

/// Three spheres slide over a floor without friction; two leave through the open face, at known times.
#[test]
fn exact_count_of_grains_that_leave() {
    let out = folder("leave");
    let domain = r#"{ "size_m": [0.1, 0.1, 0.1],
        "boundaries": { "x_min": "open", "x_max": "open", "z_min": "free_slip", "z_max": "open" } }"#;
    let at = |x: f64, y: f64, v: f64| {
        format!(
            r#"{{ "position_m": [{x}, {y}, 0.005], "radius_m": 0.005, "velocity_m_per_s": [{v}, 0, 0] }}"#
        )
    };
    let grains = format!(
        r#""sets": [{{ "name": "s", "place": {{ "list": [{}, {}, {}] }} }}]"#,
        at(0.02, 0.02, 1.0),
        at(0.02, 0.05, 2.0),
        at(0.02, 0.08, 0.1)
    );
    let path = out.join("leave.json");
    std::fs::write(&path, text(domain, &grains, "")).expect("a written scene");
    let summary = run(&path, &out, &[]);
    let grains = &part(&summary).grains;
    assert_eq!((grains.number, grains.left), (1, 2));
    let one = 2500.0 * 4.0 / 3.0 * std::f64::consts::PI * 1.25e-7;
    assert!((grains.left_kg / one - 2.0).abs() < 1e-12);
    assert!(part(&summary).energy_residual.abs() < 1e-12, "{}", part(&summary).energy_residual);
    let series = Series::read(&out.join("series.csv")).expect("a series");
    let last = series.rows.last().expect("a row");
    // Mass and number here; mass and number that passed x = 0.05 m.
    assert_eq!((last[2], last[4]), (1.0, 2.0));
    // The slow one is still there after 0.2 s at 0.1 m/s.
    let here = series.rows.iter().map(|row| row[2]);
    assert!(
        here.clone().all(|n| (1.0..=3.0).contains(&n)) && here.clone().max_by(f64::total_cmp) == Some(3.0)
    );
}

/// One sphere leaves over a rough floor while another rests on it: books and forces go on.
#[test]
fn nothing_is_forgotten_when_a_grain_leaves() {
    let out = folder("rest");
    let domain = r#"{ "size_m": [0.1, 0.1, 0.1],
        "boundaries": { "x_min": "open", "x_max": "open", "z_min": "no_slip", "z_max": "open" } }"#;
    let grains = r#""sets": [{ "name": "s", "place": { "list": [
        { "position_m": [0.05, 0.02, 0.005], "radius_m": 0.005 },
        { "position_m": [0.05, 0.06, 0.005], "radius_m": 0.005, "velocity_m_per_s": [1, 0, 0] }] } }]"#;
    let gravity = r#""gravity": { "magnitude_m_per_s2": 9.81, "direction": [0, 0, -1] },"#;
    let path = out.join("rest.json");
    std::fs::write(&path, text(domain, grains, gravity)).expect("a written scene");
    let summary = run(&path, &out, &[]);
    let grains = &part(&summary).grains;
    assert_eq!((grains.number, grains.left), (1, 1));
    assert!(part(&summary).energy_residual.abs() < BOOKS, "{}", part(&summary).energy_residual);
    let series = Series::read(&out.join("series.csv")).expect("a series");
    let weight = 9.81 * 2500.0 * 4.0 / 3.0 * std::f64::consts::PI * 1.25e-7;
    // Settled after 0.1 s: one weight or two on the floor, never none. Restitution 0.5 leaves 1e-3 of it ringing.
    for row in series.rows.iter().filter(|row| row[0] > 0.1) {
        let (number, force) = (row[2], -row[7]);
        assert!((force / weight / number - 1.0).abs() < 1e-3, "{} s: {force} N, {number} grains", row[0]);
    }
}

/// Periodic flux: a sphere that goes round three times is counted three times.
#[test]
fn exact_flux_through_a_periodic_plane() {
    let out = folder("round");
    let grains = r#""sets": [{ "name": "s", "place": { "list": [
        { "position_m": [0.02, 0.05, 0.05], "radius_m": 0.005, "velocity_m_per_s": [1.6, 0, 0] }] } }]"#;
    let path = out.join("round.json");
    std::fs::write(&path, text(r#"{ "size_m": [0.1, 0.1, 0.1] }"#, grains, "")).expect("a written scene");
    run(&path, &out, &[]);
    let series = Series::read(&out.join("series.csv")).expect("a series");
    // From 0.02 m on, 0.32 m: planes at 0.05, 0.15, 0.25 m.
    assert_eq!(series.rows.last().map(|row| row[4]), Some(3.0));
}

/// The guard: exit code 3, the pair by its names, and what was written before stays.
#[test]
fn a_guard_stops_a_run_and_names_the_pair() {
    let out = folder("guard");
    let grains = r#""numerics": { "design_speed_m_per_s": 0.1 },
        "sets": [{ "name": "fast", "velocity_m_per_s": [0, 0, -40], "place": { "list": [
        { "position_m": [0.05, 0.05, 0.05], "radius_m": 0.005 }] } }]"#;
    let domain = r#"{ "size_m": [0.1, 0.1, 0.1], "boundaries": { "z_min": "no_slip", "z_max": "open" } }"#;
    let path = out.join("guard.json");
    std::fs::write(&path, text(domain, grains, "")).expect("a written scene");
    let (scene, into) = (path.to_string_lossy(), out.to_string_lossy());
    let output = lahar(&["run", &scene, "--out", &into, "--quiet"]);
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{message}");
    for part in ["guard.json: stopped at step", "grain 0 of set `fast` and wall `z_min`", "likely cause"] {
        assert!(message.contains(part), "`{part}` in {message}");
    }
    let summary = Summary::read(&out.join("summary.json")).expect("a summary");
    assert!(
        summary.stopped.is_some()
            && summary.ended == Ended::Stopped
            && out.join("grains_000000.vtp").is_file()
    );
    assert!(Series::read(&out.join("series.csv")).is_ok());
}

/// No gravity, driven grains outside the box, one grain, all grains gone: none of them is an error.
#[test]
fn awkward_but_sound_scenes_run() {
    let list = |more: &str| {
        format!(
            r#""sets": [{{ "name": "s", {more} "place": {{ "list": [
            {{ "position_m": [0.05, 0.05, 0.02], "radius_m": 0.005 }}] }} }}]"#
        )
    };
    let closed = r#"{ "size_m": [0.1, 0.1, 0.1], "boundaries": {
        "x_min": "no_slip", "x_max": "free_slip", "z_min": "no_slip", "z_max": "open" } }"#;
    let cases = [
        ("weightless", text(closed, &list(r#""velocity_m_per_s": [0.3, 0, 0.1],"#), "")),
        ("spins", text(closed, &list(r#""spin_rad_per_s": [0, 300, 0],"#), "")),
        ("gone", text(closed, &list(r#""velocity_m_per_s": [0, 0, 3],"#), "")),
        ("falls", text(closed, &list(""), r#""gravity": { "magnitude_m_per_s2": 9.81, "slope_deg": 20 },"#)),
    ];
    for (name, text) in cases {
        let out = folder(name);
        let path = out.join("scene.json");
        std::fs::write(&path, text).expect("a written scene");
        let summary = run(&path, &out, &[]);
        assert!(part(&summary).energy_residual.abs() < BOOKS, "{name}: {}", part(&summary).energy_residual);
        assert_eq!(summary.ended, if name == "gone" { Ended::Empty } else { Ended::EndTime }, "{name}");
    }
}

#[test]
fn too_many_grains_are_refused_before_they_are_made() {
    let scene = dry(&root().join("scenes/grains/clump_packing.json"));
    let error = GrainPlan::with_memory(&scene, Some(1 << 20)).expect_err("10 000 clumps in a mebibyte");
    assert!(matches!(*error.problem, PlanProblem::GrainMemory { grains: 10_000, .. }), "{error}");
    assert_eq!(error.path, "grains.sets[0].place.random");
}

#[test]
fn plan_of_grains_as_table_and_as_json() {
    let scene = "scenes/grains/rotating_drum.json";
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(root().join("golden/snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    let table = lahar(&["plan", scene]);
    settings.bind(|| insta::assert_snapshot!("plan__rotating_drum", String::from_utf8_lossy(&table.stdout)));
    let json: serde_json::Value =
        serde_json::from_slice(&lahar(&["plan", scene, "--json"]).stdout).expect("JSON");
    // 110 large and 1200 small ones.
    assert_eq!(json["grains"].as_u64(), Some(1310));
    let refused = lahar(&["plan", scene, "--target-error", "1%"]);
    assert_eq!(refused.status.code(), Some(2));
}
