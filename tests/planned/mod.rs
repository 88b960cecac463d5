//! Scenes as JSON, and what `plan` says about them.
#![allow(dead_code, reason = "each test file uses a part of it")]

#[path = "../program/mod.rs"]
pub mod program;

use lahar::plan::{Plan, Warning};
use lahar::scene::{self, AnyScene};
use program::folder;
use serde_json::{Value, json};

/// A pool at rest on a floor.
pub fn pool() -> Value {
    json!({
        "domain": {"size_m": [0.4, 0.4, 0.2], "spacing_m": 0.02,
            "boundaries": {"x_min": "no_slip", "x_max": "no_slip", "y_min": "no_slip", "y_max": "no_slip",
                           "z_min": "no_slip", "z_max": "open"}},
        "gravity": {"magnitude_m_per_s2": 9.81, "direction": [0, 0, -1]},
        "fluid": {"density_kg_per_m3": 1800.0,
            "rheology": {"bingham": {"yield_stress_pa": 20.0, "plastic_viscosity_pa_s": 5.0}},
            "initial": {"shapes": [{"name": "mud", "shape": {"box": {"min_m": [0, 0, 0], "max_m": [0.2, 0.4, 0.1]}}}]}},
        "stop": {"end_time_s": 0.2}
    })
}

/// A scene in a file of its own.
fn load(json: &Value) -> Result<AnyScene, String> {
    // Of this program and this thread alone.
    let thread = format!("{:?}", std::thread::current().id()).replace(['(', ')'], "_");
    let folder = folder("planned", &format!("{}_{thread}", env!("CARGO_CRATE_NAME")));
    let path = folder.join("case.json");
    std::fs::write(&path, json.to_string()).expect("a written scene");
    scene::load(&path).map_err(|error| error.to_string())
}

/// The plan, or why there is none.
pub fn plan(json: &Value) -> Result<Plan, String> {
    match load(json)? {
        AnyScene::Flow(scene) => Plan::with_memory(&scene, None).map_err(|error| error.to_string()),
        AnyScene::Dry(_) => panic!("a scene with fluid"),
    }
}

/// Why there is no plan.
pub fn refusal(json: &Value) -> String {
    plan(json).err().unwrap_or_else(|| panic!("accepted: {json}"))
}

/// What a plan warns of.
pub fn warnings(json: &Value) -> Vec<String> {
    let plan = plan(json).unwrap_or_else(|message| panic!("{message}"));
    plan.numbers.warnings.iter().map(Warning::to_string).collect()
}

/// A text that has all of `parts`.
pub fn says(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "`{part}` in: {text}");
    }
}
