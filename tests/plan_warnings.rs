//! What `plan` accepts, and warns about: the words, and the numbers in them.

mod planned;

use planned::{plan, pool, says, warnings};
use serde_json::json;

/// Bars of 6 cm and slits of 4 cm on cells of 5 cm.
#[test]
fn bars_and_slits_of_another_width_are_warned_about_with_both_numbers() {
    let bar = |k: u32| {
        let low = 0.1 * f64::from(k);
        json!({"box": {"min_m": [1.0, low, 0.0], "max_m": [1.1, low + 0.06, 0.6]}})
    };
    let mut json = pool();
    json["domain"]["size_m"] = json!([2.0, 0.5, 0.6]);
    json["domain"]["spacing_m"] = json!(0.05);
    json["fluid"]["initial"]["shapes"][0]["shape"]["box"]["max_m"] = json!([0.6, 0.5, 0.4]);
    json["solids"] = json!([{"name": "rack", "shape": {"union": (0..5).map(bar).collect::<Vec<_>>()}}]);
    let text = warnings(&json).join("\n");
    says(&text, &["a gap between solids is 0.04 m wide along y as drawn, and has 1 cells, 0.05 m"]);
    says(&text, &["a solid between gaps is 0.06 m wide along y as drawn, and has 1 cells, 0.05 m"]);
    // On cells of 2 cm both are what they are.
    json["domain"]["spacing_m"] = json!(0.02);
    json["domain"]["size_m"] = json!([2.0, 0.5, 0.6]);
    let text = warnings(&json).join("\n");
    assert!(!text.contains("as drawn, and has"), "{text}");
}

#[test]
fn relaxation_times_near_one_half_are_warned_about() {
    let mut json = pool();
    json["fluid"]["rheology"] = json!({"newtonian": {"viscosity_pa_s": 1.0}});
    let text = warnings(&json).join("\n");
    says(&text, &["is below 0.52", "may be stopped by the guard", "a spacing of"]);
    let mut thickening = pool();
    thickening["fluid"]["rheology"] = json!({"power_law": {"consistency_pa_s_n": 5.0, "flow_index": 3.0}});
    says(&warnings(&thickening).join("\n"), &["flow index 3 vanishes where nothing is sheared"]);
}

/// A sweep over a speed begins at 0, where a centre, a motion or a frequency says nothing yet.
#[test]
fn keys_without_effect_are_no_errors_at_zero() {
    let mut json = pool();
    json["solids"] = json!([{"name": "roller", "spin_rad_per_s": [0, 0, 0], "centre_m": [0.3, 0.2, 0.05],
        "shape": {"cylinder": {"point_m": [0.3, 0.0, 0.05], "direction": [0, 1, 0], "radius_m": 0.05}}}]);
    assert_eq!(plan(&json).err(), None);
    json["solids"][0]["motion"] = json!({"oscillating": {"frequency_hz": 2.0}});
    assert_eq!(plan(&json).err(), None);
    json["fluid"]["body_force"] = json!({"oscillating": {
        "mean_n_per_m3": [0, 0, 0], "amplitude_n_per_m3": [0, 0, 0], "frequency_hz": 0, "phase_rad": 0}});
    assert_eq!(plan(&json).err(), None);
    json["numerics"] = json!({"collision": {"operator": "bgk", "floor": 0.0}});
    assert_eq!(plan(&json).err(), None);
}

#[test]
fn memory_follows_the_fluid() {
    let mut json = pool();
    json["domain"]["size_m"] = json!([2.0, 0.4, 0.4]);
    let numbers = plan(&json).expect("a plan").numbers;
    let most = numbers.bytes_at_most.expect("a free surface in blocks");
    assert!(most as f64 > 1.2 * numbers.bytes as f64, "{most} {}", numbers.bytes);
}

#[test]
fn hidden_solids_shut_gates_and_densities_in_other_units_are_warned_about() {
    let block = |name: &str, low: f64, high: f64, above: f64| json!({"name": name, "shape": {"box": {"min_m": [low, 0, above], "max_m": [high, 0.4, 0.2]}}});
    let mut json = pool();
    json["solids"] = json!([block("hidden", 0.28, 0.32, 0.04), block("gate", 0.24, 0.36, 0.028)]);
    json["fluid"]["density_kg_per_m3"] = json!(1.8);
    let said = warnings(&json).join("\n");
    says(
        &said,
        &[
            "`hidden` has no cell of its own",
            "a gap between a solid and a wall is 0.028 m wide along z",
            "1.8 kg/m³, which no",
        ],
    );
    json["solids"] = json!([block("first", 0.24, 0.32, 0.04), block("second", 0.28, 0.36, 0.04)]);
    json["output"] = json!({"probes": [{"name": "load", "measure": {"force": {"solid": "first"}}}]});
    says(&warnings(&json).join("\n"), &["50 % of the cells of `first`"]);
}

#[test]
fn loaded_solids_of_another_volume_than_drawn_are_warned_about() {
    let mut json = pool();
    let ball = json!({"sphere": {"centre_m": [0.3, 0.2, 0.1], "radius_m": 0.05}});
    json["solids"] = json!([{"name": "ball", "shape": ball}]);
    json["output"] = json!({"probes": [{"name": "load", "measure": {"force": {"solid": "ball"}}}]});
    // A ball of 5 cells across has 56 or 81 cells, not 65.4; of 20 cells within 2 %.
    for (cells, off) in [(5.0, true), (20.0, false)] {
        json["domain"]["spacing_m"] = json!(0.1 / cells);
        let said = warnings(&json).join("\n");
        assert_eq!(
            said.contains("m³ of `ball`, whose lift is that of the cells, where"),
            off,
            "{cells}: {said}"
        );
    }
}

/// σ0 / (ρ g sin α) of a layer on a slope; a level floor stops no layer, and water none on any slope.
#[test]
fn arrest_thickness_is_that_of_a_layer_on_the_slope() {
    let with = |slope: f64, law: serde_json::Value| {
        let mut json = pool();
        json["gravity"] = json!({"magnitude_m_per_s2": 9.81, "slope_deg": slope});
        json["fluid"]["rheology"] = law;
        plan(&json).expect("a plan").numbers.arrest_thickness_m
    };
    let mud = || json!({"bingham": {"yield_stress_pa": 20.0, "plastic_viscosity_pa_s": 5.0}});
    for slope in [5.0_f64, 20.0] {
        let exact = 20.0 / (1800.0 * 9.81 * libm::sin(slope.to_radians()));
        let found = with(slope, mud()).unwrap_or(f64::NAN);
        // Some roundings.
        assert!((found / exact - 1.0).abs() < 1e-14, "{slope}: {found} {exact}");
    }
    assert_eq!(with(0.0, mud()), None);
    assert_eq!(with(20.0, json!({"newtonian": {"viscosity_pa_s": 5.0}})), None);
}
