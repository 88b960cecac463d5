//! Columns of the series in SI, against each other and against closed forms.

mod planned;

use lahar::run::{Ended, Summary};
use lahar::solver::choose::Best;
use lahar::solver::run::Backend;
use planned::program::{column, folder, root, series};
use planned::{plan, pool, refusal, says};
use serde_json::{Value, json};

/// The last row of a run, by the names of its columns.
fn last(name: &str, scene: &Value) -> impl Fn(&str) -> f64 + use<> {
    let out = folder("series_scenes", name);
    let path = out.join("scene.json");
    std::fs::write(&path, scene.to_string()).expect("a written scene");
    let series = series(&path.to_string_lossy());
    move |name: &str| *column(&series, name).last().expect("a row")
}

fn shipped(name: &str) -> Value {
    let text = std::fs::read_to_string(root().join(name)).expect("a scene");
    serde_json::from_str(&text).expect("JSON")
}

/// A film whose highest cell is half full.
#[test]
fn mean_velocity_of_a_window_is_that_of_the_discharge() {
    let mut scene = shipped("scenes/verify/film_newtonian.json");
    scene.as_object_mut().expect("an object").remove("$schema");
    scene["stop"] = json!({"end_time_s": 0.1});
    scene["output"] = json!({"probes": [
        {"name": "rate", "measure": {"flow_rate": {"normal": "x", "at_m": 0.0}}},
        {"name": "window", "measure": {"window_velocity": {"min_m": [0, 0, 0], "max_m": [0.001, 0.001, 0.028]}}}
    ]});
    let at = last("film", &scene);
    // Compressed by ρ g H²/2 over the pressure of a cell's unit at most: the volume is the fill.
    let (mean, area) = (at("window_x"), at("window_volume") / 0.001);
    assert!(mean > 0.01 && (area / (0.001 * 0.0205) - 1.0).abs() < 1e-5, "{mean} {area}");
    // 21 sums of the same products.
    assert!((mean * area / at("rate") - 1.0).abs() < 1e-13, "{mean} {area}");
}

/// Two spheres on top of each other on a floor: the lower one has two contacts, the upper one has one.
#[test]
fn contacts_per_grain_count_pairs_for_both() {
    let sphere = |z: f64| json!({"position_m": [0.025, 0.025, z], "radius_m": 0.005});
    let scene = json!({
        "domain": {"size_m": [0.05, 0.05, 0.05], "boundaries": {"z_min": "no_slip", "z_max": "open"}},
        "gravity": {"magnitude_m_per_s2": 9.81, "direction": [0, 0, -1]},
        "grains": {
            "materials": [{"name": "glass", "density_kg_per_m3": 2500, "young_modulus_pa": 1e7, "poisson_ratio": 0.2}],
            "contact": {"law": {"tsuji": {"restitution": 0.2}}, "friction": 0.3},
            "sets": [{"name": "pile", "place": {"list": [sphere(0.005), sphere(0.015)]}}]
        },
        "stop": {"end_time_s": 0.01},
        "output": {"probes": [{"name": "touching", "measure": "contacts"}]}
    });
    let at = last("contacts", &scene);
    let found = ["touching_pairs", "touching_walls", "touching_per_grain"].map(at);
    assert_eq!(found, [1.0, 1.0, 1.5]);
}

/// Gravity along a channel and a body force add up: u = G (h² − y²)/2μ.
#[test]
fn gravity_and_body_force_drive_together() {
    let scene = |gravity: f64, force: f64| {
        json!({
            "domain": {"size_m": [0.01, 0.16, 0.01], "spacing_m": 0.01,
                "boundaries": {"y_min": "no_slip", "y_max": "no_slip"}},
            "gravity": {"magnitude_m_per_s2": gravity, "direction": [1, 0, 0]},
            "fluid": {"density_kg_per_m3": 1000.0, "rheology": {"newtonian": {"viscosity_pa_s": 1.0}},
                "body_force": {"constant": {"force_n_per_m3": [force, 0, 0]}}},
            "stop": {"end_time_s": 60.0, "steady": {"tolerance": 1e-9, "check_every_s": 0.5}},
            "output": {"probes": [{"name": "most", "measure": "max_speed"}]}
        })
    };
    // In the cells beside the middle, half a cell of 16 off it.
    let exact = 25.0 * 0.08 * 0.08 / 2.0 * (1.0 - 1.0 / 256.0);
    for (name, gravity, force) in [("both", 0.02, 5.0), ("against", 0.03, -5.0)] {
        let found = last(name, &scene(gravity, force))("most");
        // The scheme is exact here; the run stops 2e-6 before the steady flow (limit set after seeing).
        assert!((found / exact - 1.0).abs() < 1e-5, "{name}: {found} {exact}");
    }
}

/// Wave numbers are counts over lengths, so in a box twice as long k = (1, 2) for one wave along each axis.
#[test]
fn oblique_waves_are_transverse_to_their_wave_vector() {
    let scene = |amplitude: [f64; 3]| {
        json!({
            "domain": {"size_m": [0.2, 0.1, 0.1], "spacing_m": 0.01},
            "fluid": {"density_kg_per_m3": 1000.0, "rheology": {"newtonian": {"viscosity_pa_s": 1.0}},
                "initial_velocity": {"shear_wave": {"amplitude_m_per_s": amplitude, "wave_counts": [1, 1, 0]}}},
            "stop": {"end_time_s": 0.5}
        })
    };
    assert_eq!(plan(&scene([0.02, -0.01, 0.0])).err(), None);
    // (2, −1)·(1, 2) = 0, but (1, −1)·(1, 2)/√10 = −0.316.
    says(
        &refusal(&scene([0.01, -0.01, 0.0])),
        &["`fluid.initial_velocity.shear_wave.amplitude_m_per_s`", "-0.3162"],
    );
}

/// Errors of walls are quoted from channels between two plates that are computed with the exact law.
#[test]
fn errors_of_walls_are_those_of_plane_channels() {
    let rows = |scene: &Value| plan(scene).expect("a plan").numbers.wall_error.is_some();
    let mut channel = shipped("scenes/verify/channel_bingham.json");
    channel.as_object_mut().expect("an object").remove("$schema");
    assert!(rows(&channel));
    let mut clamped = channel.clone();
    clamped["numerics"] = json!({"yield_treatment": {"implicit_clamped": {"tau_min": 0.51, "tau_max": 5.0}}});
    assert!(!rows(&clamped));
    let mut duct = shipped("scenes/verify/square_duct_newtonian.json");
    duct.as_object_mut().expect("an object").remove("$schema");
    assert!(!rows(&duct) && !rows(&pool()));
}

/// A dam break in a box: partly filled cells below its surface, in m³ as the solver counts them in cells.
#[test]
fn voids_of_the_ledger_are_a_volume() {
    let mut scene = pool();
    scene["output"] =
        json!({"series": {"every_s": 0.01}, "probes": [{"name": "books", "measure": "ledger"}]});
    let at = last("voids", &scene);
    let plan = plan(&scene).expect("a plan");
    let mut run = Best.start(&plan.setup).expect("a run");
    run.advance(plan.steps).expect("a whole run");
    let ledger = run.ledger().unwrap_or_default();
    assert!(ledger.voids > 0.0, "{ledger:?}");
    let cell = 0.02_f64 * 0.02 * 0.02;
    assert_eq!(at("books_voids"), ledger.voids * cell);
    assert_eq!(at("books_conversions"), ledger.conversions as f64);
}

/// A run that is to become steady says what still changes where its time was too short.
#[test]
fn a_summary_says_what_is_not_steady() {
    let mut scene = shipped("scenes/verify/channel_bingham.json");
    scene.as_object_mut().expect("an object").remove("$schema");
    scene["stop"]["end_time_s"] = json!(2.0);
    let out = folder("series_scenes", "not_steady");
    let (path, results) = (out.join("scene.json"), out.join("out"));
    std::fs::write(&path, scene.to_string()).expect("a written scene");
    let paths = [&path, &results].map(|path| path.to_str().expect("a path"));
    let run = planned::program::lahar(&["run", paths[0], "--quiet", "--out", paths[1]]);
    assert_eq!(run.status.code(), Some(0), "{}", String::from_utf8_lossy(&run.stderr));
    let summary = Summary::read(&results.join("summary.json")).expect("a summary");
    assert_eq!(summary.ended, Ended::EndTime);
    let said = summary.not_steady.expect("what changes");
    assert!(said.starts_with("not steady: "), "{said}");
}
