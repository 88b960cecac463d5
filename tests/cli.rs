//! The command line: every scene can be planned, runs write what they should, exit codes.

mod program;

use std::path::{Path, PathBuf};

use lahar::output::csv::Series;
use lahar::plan::Plan;
use lahar::run::{Ended, Summary};
use lahar::scene;
use program::{lahar, root};

/// An empty folder of this test's own.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    folder
}

fn scenes() -> Vec<PathBuf> {
    let mut scenes = Vec::new();
    for kind in ["verify", "show"] {
        for entry in std::fs::read_dir(root().join("scenes").join(kind)).expect("a folder of scenes") {
            scenes.push(entry.expect("a readable entry").path());
        }
    }
    scenes.sort();
    scenes
}

#[test]
fn every_scene_of_the_package_has_a_plan() {
    for path in scenes() {
        let scene = scene::load_flow(&path).unwrap_or_else(|error| panic!("{error}"));
        let plan = Plan::new(&scene).unwrap_or_else(|error| panic!("{error}"));
        assert!(plan.steps > 0 && plan.numbers.mach <= 0.2, "{}", path.display());
    }
}

#[test]
fn schema_of_the_package_is_the_one_printed() {
    let written = std::fs::read_to_string(root().join("scenes/scene.schema.json")).expect("a schema");
    let printed = lahar(&["schema"]);
    assert_eq!(printed.status.code(), Some(0));
    assert_eq!(
        String::from_utf8_lossy(&printed.stdout),
        written,
        "run `lahar schema > scenes/scene.schema.json`"
    );
}

#[test]
fn plan_as_table_and_as_json() {
    let scene = "scenes/verify/channel_bingham.json";
    let table = lahar(&["plan", scene]);
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(root().join("golden/snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings
        .bind(|| insta::assert_snapshot!("plan__channel_bingham", String::from_utf8_lossy(&table.stdout)));
    let json: serde_json::Value =
        serde_json::from_slice(&lahar(&["plan", scene, "--json"]).stdout).expect("JSON");
    // Wall stress 2 Pa: plug velocity (2 − 1)²/(2 · 0.5 · 40) = 0.025 m/s; two products, one quotient.
    let velocity = json["reference_velocity_m_per_s"].as_f64().expect("a number");
    assert!((velocity - 0.025).abs() <= 4.0 * f64::EPSILON * 0.025, "{velocity}");
    assert_eq!(json["tau_max"], serde_json::Value::Null);
}

fn snapshot(name: &str, text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(root().join("golden/snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name, text));
}

/// What `plan --target-error` adds, without the line that holds a measured speed.
fn target_section(scene: &str, target: &str) -> String {
    let output = lahar(&["plan", scene, "--target-error", target]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let at = text.find("\nTarget error").expect("a section");
    let lines = text[at..].lines().filter(|line| !line.contains("ns per update"));
    lines.map(|line| format!("{line}\n")).collect()
}

#[test]
fn plan_quotes_the_table_of_work_and_precision() {
    let mut all = String::new();
    for (scene, target) in [
        ("scenes/verify/channel_bingham.json", "1%"),
        ("scenes/verify/channel_newtonian.json", "0.0001"),
        ("scenes/verify/film_herschel_bulkley.json", "1 %"),
        ("scenes/show/slump_cone.json", "0.1%"),
        ("scenes/verify/taylor_green_3d.json", "1%"),
        ("scenes/verify/pipe_newtonian.json", "1%"),
        ("scenes/verify/couette.json", "1%"),
        ("scenes/verify/womersley.json", "1%"),
        ("scenes/verify/pool_at_rest.json", "1%"),
    ] {
        all.push_str(&format!("{scene} --target-error {target}\n{}\n", target_section(scene, target)));
    }
    snapshot("plan__target_error", &all);
}

#[test]
fn every_scene_gets_a_recommendation_or_a_reason() {
    for path in scenes() {
        let output = lahar(&["plan", &path.to_string_lossy(), "--target-error", "1%", "--json"]);
        let json: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let target = &json["target"];
        let reason = target["not_covered"].as_str().is_some_and(|why| !why.is_empty());
        let cells = target["covered"]["advice"]["cells"].as_f64().is_some_and(|cells| cells >= 3.0);
        let spacing = target["swept"]["spacing_m"].as_f64().is_some_and(|spacing| spacing > 0.0);
        assert!(
            [reason, cells, spacing].into_iter().filter(|found| *found).count() == 1,
            "{}: {target}",
            path.display()
        );
    }
}

#[test]
fn bad_target_errors_are_exit_code_2_with_a_way_out() {
    for target in ["much", "-1%", "0", "2", "NaN"] {
        let output = lahar(&["plan", "scenes/verify/couette.json", "--target-error", target]);
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{target}: {message}");
        assert!(message.contains("way out") && message.contains(target), "{target}: {message}");
    }
}

#[test]
fn help_of_plan() {
    snapshot("help_plan", &String::from_utf8_lossy(&lahar(&["plan", "--help"]).stdout));
}

#[test]
fn run_writes_all_its_files_and_the_same_bits_with_two_threads() {
    let mut fingerprints = Vec::new();
    for threads in ["1", "2"] {
        let out = folder(&format!("run_{threads}"));
        let name = out.to_string_lossy();
        let scene = "scenes/show/mud_past_block.json";
        let output = lahar(&["run", scene, "--out", &name, "--until", "0.02", "--threads", threads]);
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        for file in ["fields_000000.vti", "run.pvd", "series.csv", "summary.json", "plots/speed.svg"] {
            assert!(out.join(file).is_file(), "{file}");
        }
        let series = Series::read(&out.join("series.csv")).expect("a series");
        assert_eq!(series.columns[0].name, "time");
        assert!(series.rows.len() > 10, "{} rows", series.rows.len());
        let summary = Summary::read(&out.join("summary.json")).expect("a summary");
        assert_eq!((summary.ended, &summary.stopped), (Ended::EndTime, &None));
        let fluid = summary.fluid().expect("a part of the fluid");
        // A sum over 4700 cells of values below 1 in f64.
        assert!(fluid.mass_residual.abs() < 4700.0 * f64::EPSILON, "{}", fluid.mass_residual);
        fingerprints.push(fluid.fingerprint.clone());
    }
    assert_eq!(fingerprints[0], fingerprints[1]);
}

#[test]
fn guard_stops_with_3_says_where_and_keeps_earlier_files() {
    let out = folder("runaway");
    std::fs::create_dir_all(&out).expect("a folder");
    // Ten times faster than it says, accelerated without walls: it must pass the limit of 0.4.
    let scene = r#"{
        "domain": { "size_m": [0.01, 0.08, 0.01], "spacing_m": 0.01 },
        "fluid": {
            "density_kg_per_m3": 1000.0,
            "rheology": { "newtonian": { "viscosity_pa_s": 5.0 } },
            "body_force": { "constant": { "force_n_per_m3": [1000.0, 0.0, 0.0] } }
        },
        "numerics": { "time_step_s": 0.002, "reference_velocity_m_per_s": 0.5 },
        "stop": { "end_time_s": 5.0 },
        "output": { "fields": { "every_s": 0.5 } }
    }"#;
    let path = out.join("runaway.json");
    std::fs::write(&path, scene).expect("a written scene");
    let output = lahar(&["run", &path.to_string_lossy(), "--out", &out.to_string_lossy()]);
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{message}");
    for part in ["stopped at step", "cell (", " m\n", "likely cause", "relaxation time"] {
        assert!(message.contains(part), "`{part}` in {message}");
    }
    // u = g t reaches 0.4 cells per step, 2 m/s, at 2 s: fields of 0, 0.5, 1, 1.5 and 2 s are there, and those of the end.
    for number in 0..6 {
        assert!(out.join(format!("fields_{number:06}.vti")).is_file(), "{number}");
    }
    assert!(!out.join("fields_000006.vti").exists());
    let summary = Summary::read(&out.join("summary.json")).expect("a summary");
    let list = std::fs::read_to_string(out.join("run.pvd")).expect("a list of fields");
    assert!(
        list.contains(&format!("timestep=\"{}\" part=\"0\" file=\"fields_000005.vti\"", summary.time_s)),
        "{list}"
    );
    assert!(summary.stopped.is_some() && summary.ended == Ended::Stopped);
}

#[test]
fn steady_run_ends_early_at_the_exact_velocity() {
    let out = folder("steady");
    let scene = "scenes/verify/channel_bingham.json";
    let output = lahar(&["run", scene, "--out", &out.to_string_lossy(), "--quiet"]);
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(output.stderr, b"");
    let summary = Summary::read(&out.join("summary.json")).expect("a summary");
    assert!(summary.ended == Ended::Steady && summary.time_s < 59.0, "{} s of 60", summary.time_s);
    assert_eq!(summary.not_steady, None);
    // Plug velocity 0.025 m/s; second order in 64 cells: the plug's edge lies within a cell, which
    // moves its velocity by at most (1/32)² of it.
    let speed = summary.fluid().expect("a part of the fluid").speed_m_per_s.greatest;
    assert!((speed - 0.025).abs() < 0.025 / 1024.0, "{speed}");
}

#[test]
fn unwritable_folder_is_exit_code_4_and_bad_usage_2() {
    let out = folder("in_the_way");
    std::fs::write(&out, "a file").expect("a written file");
    let scene = "scenes/verify/shear_wave.json";
    assert_eq!(lahar(&["run", scene, "--out", &out.to_string_lossy()]).status.code(), Some(4));
    assert_eq!(lahar(&["run", scene, "--until", "-1"]).status.code(), Some(2));
    assert_eq!(lahar(&["fly"]).status.code(), Some(2));
}

#[test]
fn free_surface_run_writes_surfaces_sections_and_ledger() {
    let out = folder("surface");
    let scene = "scenes/show/slump_cone.json";
    let output = lahar(&["run", scene, "--out", &out.to_string_lossy(), "--until", "0.005"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    for file in [
        "fields_000001.vti",
        "surface_000000.vtp",
        "surface.pvd",
        "section_shape_000000.csv",
        "depth_seen_from_above_000000.vti",
        "plots/section_shape.svg",
        "plots/depth_seen_from_above.svg",
        "plots/depth.svg",
        "plots/speed.svg",
        "plots/series_spread_x.svg",
    ] {
        assert!(out.join(file).is_file(), "{file}");
    }
    let summary = Summary::read(&out.join("summary.json")).expect("a summary");
    let fluid = summary.fluid().expect("a part of the fluid");
    let ledger = fluid.free_surface.as_ref().expect("a ledger");
    // A quarter of a litre of 2000 kg/m³ from subsamples, plus the weight of compression.
    assert!((ledger.initial_mass_kg - 0.5).abs() < 0.005, "{}", ledger.initial_mass_kg);
    // 4200 cells, 20 steps: roundings of each cell and step add up at worst.
    assert!(fluid.mass_residual.abs() < 1e-12, "{}", fluid.mass_residual);
    let series = Series::read(&out.join("series.csv")).expect("a series");
    let column = |name: &str| {
        let at = series.columns.iter().position(|c| c.name == name).unwrap_or_else(|| panic!("{name}"));
        series.rows.iter().map(|row| row[at]).collect::<Vec<f64>>()
    };
    // The quarter is symmetric about its diagonal; rounding may differ between the two directions.
    for (x, y) in column("spread_x").iter().zip(column("spread_y")) {
        assert!((x - y).abs() < 1e-9, "{x} {y}");
    }
}

#[test]
fn fluid_at_rest_ends_the_run() {
    let out = folder("arrested");
    std::fs::create_dir_all(&out).expect("a folder");
    // A heap 2 cells high of a stiff mud: its yield stress holds ten times its weight.
    let scene = r#"{
        "domain": {
            "size_m": [0.2, 0.01, 0.06], "spacing_m": 0.01,
            "boundaries": { "x_min": "no_slip", "x_max": "open", "z_min": "no_slip", "z_max": "open" }
        },
        "gravity": { "magnitude_m_per_s2": 9.81, "direction": [0, 0, -1] },
        "fluid": {
            "density_kg_per_m3": 1000.0,
            "rheology": { "bingham": { "yield_stress_pa": 2000.0, "plastic_viscosity_pa_s": 10.0 } },
            "initial": { "shapes": [{ "shape": { "box": { "min_m": [0, -1, 0], "max_m": [0.08, 1, 0.02] } } }] }
        },
        "numerics": { "time_step_s": 0.0005 },
        "stop": {
            "end_time_s": 20.0,
            "arrested": { "speed_m_per_s": 0.001, "for_s": 0.5, "check_every_s": 0.05 }
        },
        "output": { "probes": [{ "name": "volume", "measure": "volume" }, { "name": "plug", "measure": "plug_fraction" }] }
    }"#;
    let path = out.join("stiff.json");
    std::fs::write(&path, scene).expect("a written scene");
    let output = lahar(&["run", &path.to_string_lossy(), "--out", &out.to_string_lossy()]);
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{message}");
    assert!(message.contains("(at rest, "), "{message}");
    let summary = Summary::read(&out.join("summary.json")).expect("a summary");
    // Not before the stretch of rest is over, and long before the end.
    assert!(summary.ended == Ended::AtRest && (0.5..10.0).contains(&summary.time_s), "{}", summary.time_s);
    let speed = summary.fluid().expect("a part of the fluid").speed_m_per_s.greatest;
    assert!(speed < 0.01, "{speed}");
}
