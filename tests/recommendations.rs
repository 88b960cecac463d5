//! What `plan --target-error` recommends: always a scene that has a plan, never outside of what was measured.

mod program;

use std::path::{Path, PathBuf};

use lahar::plan::target::{Answer, Quote, Target};
use lahar::plan::{Plan, expected::Interval};
use lahar::scene;
use program::root;
use serde_json::{Value, json};

fn planned(json: &Value) -> Result<(lahar::Scene, Plan), String> {
    let scene = scene::flow_from_json(&json.to_string(), "case.json", Path::new("."));
    let scene = scene.map_err(|error| error.to_string())?;
    let plan = Plan::with_memory(&scene, None).map_err(|error| error.to_string())?;
    Ok((scene, plan))
}

fn quote(json: &Value, target: &str) -> Option<Quote> {
    let (scene, plan) = planned(json).ok()?;
    let target: Target = target.parse().expect("a target");
    Some(lahar::plan::target::quote(&scene, &plan, target).expect("a table"))
}

/// The scene with an answer put into it, and the errors that the answer expects; `None` without a recommendation.
fn put(json: &Value, answer: &Answer) -> Option<(Value, Vec<Interval>)> {
    let mut changed = json.clone();
    let mut space = |spacing: f64, size: [f64; 3]| {
        changed["domain"]["spacing_m"] = json!(spacing);
        changed["domain"]["size_m"] = json!(size);
    };
    match answer {
        Answer::NotCovered(_) => None,
        Answer::Covered(covered) => {
            let advice = &covered.advice;
            space(advice.spacing_m, advice.size_m);
            changed["numerics"] = json!({
                "collision": {"operator": advice.operator},
                "time_step_s": advice.time_step_s,
            });
            if let Some(rule) = advice.wall_rule {
                changed["numerics"]["wall_rule"] = json!(rule);
            }
            Some((changed, covered.expected.clone()))
        }
        Answer::Swept(swept) => {
            space(swept.spacing_m, swept.size_m);
            if let Some(numerics) = changed.get_mut("numerics").and_then(Value::as_object_mut) {
                numerics.retain(|key, _| key != "time_step_s" && key != "relaxation_time");
            }
            Some((changed, swept.expected.clone()))
        }
    }
}

/// A recommendation has a plan that expects what the recommendation says.
fn check(name: &str, json: &Value, target: &str) -> Option<Quote> {
    let quote = quote(json, target)?;
    if let Some((changed, errors)) = put(json, &quote.answer) {
        let (_, plan) =
            planned(&changed).unwrap_or_else(|error| panic!("{name} {target}: {error}\n{changed}"));
        assert_eq!(plan.numbers.expected.errors(), errors, "{name} {target}: {changed}");
    }
    Some(quote)
}

fn files(folder: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(root().join(folder)).expect("a folder");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    files
}

fn read(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).expect("text")).expect("JSON")
}

/// Multiplies every number below a key, however deep.
fn times(value: &mut Value, keys: &[&str], factor: f64) {
    match value {
        Value::Object(map) => {
            for (key, value) in map {
                match value {
                    Value::Number(number) if keys.contains(&key.as_str()) => {
                        *value = json!(number.as_f64().unwrap_or(1.0) * factor);
                    }
                    _ => times(value, keys, factor),
                }
            }
        }
        Value::Array(list) => list.iter_mut().for_each(|value| times(value, keys, factor)),
        _ => {}
    }
}

#[test]
fn recommendations_have_plans_for_all_scenes_and_their_kin() {
    let mut found = [0, 0];
    for path in files("scenes/verify").into_iter().chain(files("scenes/show")) {
        let (name, json) = (path.display().to_string(), read(&path));
        if json["domain"]["size_m"].as_array().is_some_and(|size| size[0].as_f64() > Some(50.0)) {
            // The valleys of `show`: minutes of plans.
            continue;
        }
        let mut thick = json.clone();
        times(&mut thick, &["viscosity_pa_s", "plastic_viscosity_pa_s", "consistency_pa_s_n"], 7.0);
        let mut stiff = json.clone();
        times(&mut stiff, &["yield_stress_pa"], 1.3);
        times(&mut stiff, &["flow_index"], 1.7);
        let mut steep = json.clone();
        times(&mut steep, &["slope_deg", "height_m"], 0.7);
        for (json, target) in [(&json, "1%"), (&json, "20%"), (&thick, "2%"), (&stiff, "2%"), (&steep, "2%")]
        {
            match check(&name, json, target) {
                Some(Quote { answer: Answer::NotCovered(_), .. }) => found[1] += 1,
                Some(_) => found[0] += 1,
                None => {}
            }
        }
    }
    assert!(found[0] >= 20 && found[1] >= 20, "recommendations and refusals of one: {found:?}");
}

/// The table's heap is seven times as wide as high, and hardly yields to its weight: a slump cone is neither.
#[test]
fn limit_no_error_is_quoted_for_a_scene_outside_of_the_table() {
    let cone = read(&root().join("scenes/show/slump_cone.json"));
    let quote = quote(&cone, "2%").expect("a plan");
    let Answer::NotCovered(why) = &quote.answer else { panic!("{quote}") };
    for part in ["outside of the table", "times as long as high", "of ρgH"] {
        assert!(why.contains(part), "{why}");
    }
}

/// A film that the table of work and precision has is recommended cells of which scenes like it were within the target.
#[test]
fn films_near_their_yield_stress_are_recommended_more_cells() {
    let film = |sigma0: f64| {
        json!({
            "domain": {"size_m": [0.001, 0.001, 0.04], "spacing_m": 0.001,
                "boundaries": {"z_min": "no_slip", "z_max": "open"}},
            "gravity": {"magnitude_m_per_s2": 9.81, "slope_deg": 12.0},
            "fluid": {"density_kg_per_m3": 1400.0,
                "rheology": {"herschel_bulkley":
                    {"yield_stress_pa": sigma0, "consistency_pa_s_n": 40.0, "flow_index": 0.33}},
                "initial": {"fill_level": {"height_m": 0.03}}},
            "stop": {"end_time_s": 1.0}
        })
    };
    // ρ g sin θ h = 85.66 Pa: half of the depth is sheared, and a tenth.
    let cells = |sigma0: f64| {
        let quote = check("film", &film(sigma0), "5%").expect("a plan");
        let Answer::Covered(covered) = &quote.answer else { panic!("{quote}") };
        covered.advice.cells
    };
    let [half, tenth] = [cells(42.8), cells(77.1)];
    assert!(half >= 4.0 && tenth > half, "{half} {tenth}");
}
