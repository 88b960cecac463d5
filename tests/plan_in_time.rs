//! Planning takes no longer for inputs with many entries: heights, materials, names, shapes.

use std::path::Path;
use std::time::{Duration, Instant};

use lahar::plan::Plan;
use lahar::plan::grains::GrainPlan;
use lahar::scene;
use serde_json::{Value, json};

/// What is a second or less on a free machine with optimisation, and was most of a minute to hours when every entry was
/// compared with every other or looked at in every cell.
const IN_TIME: Duration = Duration::from_secs(30);

fn in_time(name: &str, plan: impl FnOnce() -> Result<(), String>) {
    let start = Instant::now();
    assert_eq!(plan(), Ok(()), "{name}");
    let taken = start.elapsed();
    println!("{name}: {taken:?}");
    assert!(taken < IN_TIME, "{name}: {taken:?}");
}

fn flow(json: &Value) -> Result<(), String> {
    let scene = scene::flow_from_json(&json.to_string(), "many.json", Path::new("."));
    let scene = scene.map_err(|error| error.to_string())?;
    Plan::with_memory(&scene, None).map(|_| ()).map_err(|error| error.to_string())
}

fn dry(json: &Value) -> Result<(), String> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let path = folder.join("plan_in_time.json");
    std::fs::write(&path, json.to_string()).map_err(|error| error.to_string())?;
    let scene = scene::load_dry(&path).map_err(|error| error.to_string())?;
    GrainPlan::with_memory(&scene, None).map(|_| ()).map_err(|error| error.to_string())
}

/// Viscous mud on 20 × 20 × 10 cells.
fn mud() -> Value {
    json!({
        "domain": {"size_m": [20, 20, 10], "spacing_m": 1,
            "boundaries": {"x_min": "no_slip", "x_max": "no_slip", "y_min": "no_slip", "y_max": "no_slip",
                           "z_min": "no_slip", "z_max": "open"}},
        "gravity": {"magnitude_m_per_s2": 9.81, "direction": [0, 0, -1]},
        "fluid": {"density_kg_per_m3": 1800.0,
            "rheology": {"bingham": {"yield_stress_pa": 500.0, "plastic_viscosity_pa_s": 5000.0}},
            "initial": {"shapes": [{"shape": {"box": {"min_m": [0, 0, 0], "max_m": [10, 20, 8]}}}]}},
        "stop": {"end_time_s": 2}
    })
}

#[test]
fn many_heights() {
    let height = |i: u32, j: u32| 2.0 + libm::sin(f64::from(i) / 7.0) + 0.5 * libm::cos(f64::from(j) / 9.0);
    let rows: Vec<Vec<f64>> = (0..500).map(|j| (0..500).map(|i| height(i, j)).collect()).collect();
    let mut json = mud();
    json["solids"] =
        json!([{"name": "bed", "shape": {"heightfield": {"spacing_m": 20.0 / 499.0, "heights_m": rows}}}]);
    in_time("500 × 500 heights", || flow(&json));
}

#[test]
fn many_probes_and_parts_of_the_fluid() {
    let mut json = mud();
    let probe = |i: u32| json!({"name": format!("p{i}"), "measure": {"point_velocity": {"at_m": [1, 1, 1]}}});
    json["output"] = json!({"probes": (0..30_000).map(probe).collect::<Vec<_>>()});
    in_time("30 000 probes", || flow(&json));
    let mut json = mud();
    let part = |i: u32| {
        let [x, y] = [i % 173, i / 173].map(|k| 0.1 * f64::from(k));
        json!({"shape": {"box": {"min_m": [x, y, 0], "max_m": [x + 0.6, y + 0.6, 0.9]}}})
    };
    json["fluid"]["initial"]["shapes"] = json!((0..30_000).map(part).collect::<Vec<_>>());
    in_time("30 000 parts of the fluid", || flow(&json));
}

#[test]
fn many_materials_and_sets() {
    let material = |i: u32| json!({"name": format!("m{i}"), "density_kg_per_m3": 2500, "young_modulus_pa": 1e7, "poisson_ratio": 0.3});
    let set = |name: String, material: String, i: u32| {
        let at = [0.002 + 0.005 * f64::from(i % 170), 0.002 + 0.005 * f64::from(i / 170), 0.1];
        json!({"name": name, "material": material, "place": {"list": [{"position_m": at, "radius_m": 0.002}]}})
    };
    let mut json = json!({
        "domain": {"size_m": [1, 1, 1], "boundaries": {"z_min": "no_slip", "z_max": "open"}},
        "gravity": {"magnitude_m_per_s2": 9.81, "direction": [0, 0, -1]},
        "grains": {"materials": (0..400).map(material).collect::<Vec<_>>(),
            "contact": {"law": {"tsuji": {"restitution": 0.5}}, "friction": 0.5},
            "sets": (0..400).map(|i| set(format!("s{i}"), format!("m{i}"), i)).collect::<Vec<_>>()},
        "stop": {"end_time_s": 0.01}
    });
    in_time("400 materials", || dry(&json));
    json["grains"]["materials"] = json!([material(0)]);
    json["grains"]["sets"] =
        json!((0..30_000).map(|i| set(format!("s{i}"), "m0".to_owned(), i)).collect::<Vec<_>>());
    in_time("30 000 sets", || dry(&json));
}
