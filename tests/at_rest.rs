//! When a run counts as at rest: what a drop or a grain of little mass does must not keep it going.

mod program;

use lahar::output::csv::Series;
use lahar::run::{Ended, RestOutcome, Summary};
use program::lahar;
use std::path::Path;

/// Runs a scene with a backend, on a number of threads; what it printed and what it was.
fn run(name: &str, scene: &str, more: &[&str]) -> (String, Summary) {
    let out = program::folder("at-rest", name);
    let path = out.join("scene.json");
    std::fs::write(&path, scene).expect("a written scene");
    let arguments = ["run", &path.to_string_lossy(), "--out", &out.to_string_lossy()];
    let output = lahar(&[&arguments, more].concat());
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{message}");
    (message, Summary::read(&out.join("summary.json")).expect("a summary"))
}

fn rest(summary: &Summary) -> RestOutcome {
    summary.rest.expect("what the checks for rest found")
}

/// A pool at rest of 60 by 32 cells, and a drop of 16 cells that falls on it: 0.83 % of the mass. It lands after
/// √(2 · 0.46 m/g) = 0.31 s, beyond the end.
fn pool_and_drop(measure: &str) -> String {
    format!(
        r#"{{
        "domain": {{
            "size_m": [0.6, 0.01, 0.9], "spacing_m": 0.01,
            "boundaries": {{ "x_min": "free_slip", "x_max": "free_slip", "z_min": "no_slip", "z_max": "open" }}
        }},
        "gravity": {{ "magnitude_m_per_s2": 9.81, "direction": [0, 0, -1] }},
        "fluid": {{
            "density_kg_per_m3": 1000.0,
            "rheology": {{ "newtonian": {{ "viscosity_pa_s": 2.0 }} }},
            "initial": {{
                "fill_level": {{ "axis": "z", "height_m": 0.32 }},
                "shapes": [{{ "shape": {{ "box": {{ "min_m": [0.28, -1, 0.78], "max_m": [0.32, 1, 0.82] }} }} }}]
            }}
        }},
        "numerics": {{ "time_step_s": 0.0005, "free_surface": {{ "gravity": "by_fill_and_inertia" }} }},
        "stop": {{
            "end_time_s": 0.25,
            "arrested": {{ {measure} "speed_m_per_s": 0.001, "for_s": 0.1, "check_every_s": 0.02 }}
        }}
    }}"#
    )
}

#[test]
fn a_falling_drop_does_not_keep_a_pool_at_rest_going() {
    let (message, summary) = run("drop", &pool_and_drop(""), &[]);
    let found = rest(&summary);
    // Below from the first check at 0.02 s on, for 0.1 s.
    assert!(summary.ended == Ended::AtRest && found.reached, "{found:?}");
    assert!((0.12..0.17).contains(&summary.time_s), "{}", summary.time_s);
    assert!(found.speed_m_per_s < 0.001 && found.below_since_s.is_some(), "{found:?}");
    // The drop falls with g t, but for the accelerations that its cells smooth (less than a tenth, claim `falling-drop-by-fill-and-inertia`).
    let falls = 9.81 * summary.time_s;
    assert!((found.largest_speed_m_per_s - falls).abs() < 0.1 * falls, "{found:?}");
    assert!(message.contains("(at rest, speed of 99 % of the mass below 1.00e-3 m/s since 0."), "{message}");
    assert!(message.contains("largest speed then 1."), "{message}");
}

#[test]
fn a_falling_drop_keeps_the_largest_and_the_mean_speed_up() {
    for (measure, words) in [("largest", "largest speed"), ("rms", "√(2E/m)")] {
        let (message, summary) = run(measure, &pool_and_drop(&format!(r#""measure": "{measure}","#)), &[]);
        let found = rest(&summary);
        assert!(summary.ended == Ended::EndTime && !found.reached, "{measure}: {found:?}");
        assert!(found.speed_m_per_s > 0.1 && found.below_since_s.is_none(), "{measure}: {found:?}");
        assert!(message.contains("(end time, not at rest: ") && message.contains(words), "{message}");
    }
    // √(2E/m) of 16 cells of 1936: 1/11 of the speed of the drop, whose cells differ by a few per cent.
    let (_, summary) = run("mean", &pool_and_drop(r#""measure": "rms","#), &["--until", "0.1"]);
    let found = rest(&summary);
    let expected = found.largest_speed_m_per_s / 11.0;
    assert!((found.speed_m_per_s - expected).abs() < 0.05 * expected, "{found:?} {expected}");
}

/// More of the mass than the rest that a percentile leaves out must be slow.
#[test]
fn a_share_beyond_the_drop_sees_it() {
    let measure = r#""measure": { "mass_percentile": { "share": 0.995 } },"#;
    let found = rest(&run("share", &pool_and_drop(measure), &[]).1);
    assert!(!found.reached && found.speed_m_per_s > 0.9 * found.largest_speed_m_per_s, "{found:?}");
}

#[test]
fn exact_outcome_on_both_backends_and_any_threads() {
    for measure in ["", r#""measure": "rms","#] {
        let scene = pool_and_drop(measure);
        let all = [["plain", "1"], ["fast", "1"], ["fast", "2"]];
        let found = all.map(|[backend, threads]| {
            let name = format!("same-{backend}-{threads}-{}", measure.len());
            rest(&run(&name, &scene, &["--backend", backend, "--threads", threads]).1)
        });
        assert_eq!(found[0], found[1]);
        assert_eq!(found[1], found[2]);
    }
}

/// 250 spheres at rest, and one that flies: 0.4 % of the mass.
fn grains(measure: &str) -> String {
    format!(
        r#"{{
        "domain": {{ "size_m": [0.1, 0.1, 0.3] }},
        "grains": {{
            "materials": [{{ "name": "glass", "density_kg_per_m3": 2500, "young_modulus_pa": 1e7, "poisson_ratio": 0.2 }}],
            "contact": {{ "law": {{ "tsuji": {{ "restitution": 0.9 }} }}, "friction": 0.3 }},
            "sets": [
                {{ "name": "rest", "place": {{ "lattice": {{
                    "kind": "simple_cubic", "radius_m": 0.004,
                    "region": {{ "box": {{ "min_m": [0, 0, 0], "max_m": [0.0401, 0.0401, 0.0801] }} }} }} }} }},
                {{ "name": "flies", "velocity_m_per_s": [0, 0, 0.5], "place": {{ "list": [
                    {{ "position_m": [0.07, 0.07, 0.1], "radius_m": 0.004 }} ] }} }}
            ]
        }},
        "stop": {{
            "end_time_s": 0.1,
            "arrested": {{ {measure} "speed_m_per_s": 0.001, "for_s": 0.02, "check_every_s": 0.01 }}
        }}
    }}"#
    )
}

#[test]
fn a_flying_grain_keeps_only_the_largest_speed_up() {
    let (message, summary) = run("grains", &grains(""), &[]);
    let found = rest(&summary);
    assert!(summary.ended == Ended::AtRest && found.speed_m_per_s < 0.001, "{found:?}");
    assert!((found.largest_speed_m_per_s - 0.5).abs() < 1e-9, "{found:?}");
    assert!(message.contains("(at rest, speed of 99 % of the mass below"), "{message}");
    let (_, summary) = run("grains-largest", &grains(r#""measure": "largest","#), &[]);
    assert!(summary.ended == Ended::EndTime && !rest(&summary).reached, "{summary:?}");
    // √(2E/m) of one of the grains at 0.5 m/s.
    let number = summary.grains().expect("grains").number as f64;
    let found = rest(&run("grains-rms", &grains(r#""measure": "rms","#), &[]).1);
    assert!((found.speed_m_per_s - 0.5 / number.sqrt()).abs() < 1e-9, "{found:?}");
}

/// A layer of 8 mm hangs on a vertical wall, 118 of its 150 Pa at the wall. With a floor of the odd rate that holds at rest it
/// crept at 1.3e-4 m/s at its ends and 15 µm/s in the mean, for ever.
const LAYER: &str = r#"{
    "domain": {
        "size_m": [0.02, 0.001, 0.06], "spacing_m": 0.001,
        "boundaries": { "x_min": "no_slip", "x_max": "open", "z_min": "no_slip", "z_max": "open" }
    },
    "gravity": { "magnitude_m_per_s2": 9.81, "direction": [0, 0, -1] },
    "fluid": {
        "density_kg_per_m3": 1500,
        "rheology": { "bingham": { "yield_stress_pa": 150, "plastic_viscosity_pa_s": 2.0 } },
        "initial": {
            "pressure": "uniform",
            "shapes": [{ "shape": { "box": { "min_m": [0, 0, 0.02], "max_m": [0.008, 0.001, 0.05] } } }]
        }
    },
    "stop": {
        "end_time_s": 3.0,
        "arrested": { "measure": "largest", "speed_m_per_s": 1e-6, "for_s": 0.05, "check_every_s": 0.01 }
    }
}"#;

#[test]
fn mud_that_hangs_on_a_wall_does_not_creep() {
    let (_, summary) = run("layer", LAYER, &[]);
    let found = rest(&summary);
    assert!(summary.ended == Ended::AtRest && found.largest_speed_m_per_s < 1e-6, "{found:?}");
    // A floor that is asked for holds at any speed: creep.
    let kept =
        LAYER.replacen("\"stop\"", "\"numerics\": { \"collision\": { \"floor\": 0.05 } }, \"stop\"", 1);
    let (_, summary) = run("layer-kept", &kept, &["--until", "0.8"]);
    let found = rest(&summary);
    assert!(summary.ended == Ended::EndTime && found.largest_speed_m_per_s > 1e-5, "{found:?}");
}

/// Δx, m, of the pools below.
const CELL: f64 = 0.01;

/// The viscosity, Pa s, that gives τ⁺ − ½ = 3μΔt/(ρΔx²).
fn viscosity(excess: f64, dt: f64) -> f64 {
    1000.0 * excess * CELL * CELL / (3.0 * dt)
}

/// A pool between walls, `wide` by `across` cells, on the average 3.64 cells deep, for 20 000 steps of `dt`, s; `higher`: by how
/// much its left half stands higher, m.
fn pool_between_walls(
    [wide, across]: [u32; 2],
    rheology: &str,
    operator: &str,
    (dt, higher): (f64, f64),
) -> String {
    let (dx, end) = (CELL, 20_000.0 * dt);
    let [left, right, middle] = [0.0364 + 0.5 * higher, 0.0364 - 0.5 * higher, 0.5 * f64::from(wide) * dx];
    let [x, y] = [f64::from(wide) * dx, f64::from(across) * dx];
    let sides = if across > 1 { r#", "y_min": "no_slip", "y_max": "no_slip""# } else { "" };
    format!(
        r#"{{
        "domain": {{
            "size_m": [{x}, {y}, 0.06], "spacing_m": {dx},
            "boundaries": {{
                "x_min": "no_slip", "x_max": "no_slip", "z_min": "no_slip", "z_max": "open"{sides}
            }}
        }},
        "gravity": {{ "magnitude_m_per_s2": 9.81, "direction": [0, 0, -1] }},
        "fluid": {{
            "density_kg_per_m3": 1000.0,
            "rheology": {{ {rheology} }},
            "initial": {{ "shapes": [
                {{ "shape": {{ "box": {{ "min_m": [-1, -1, -1], "max_m": [1, 1, {right}] }} }} }},
                {{ "shape": {{ "box": {{ "min_m": [-1, -1, -1], "max_m": [{middle}, 1, {left}] }} }} }}
            ] }}
        }},
        "numerics": {{ "time_step_s": {dt}, "collision": {{ "operator": "{operator}" }} }},
        "output": {{ "probes": [{{ "name": "fastest", "measure": "max_speed" }}] }},
        "stop": {{ "end_time_s": {end} }}
    }}"#
    )
}

/// Largest speeds of a pool, m/s, one after the other.
fn speeds(name: &str, scene: &str) -> Vec<f64> {
    run(name, scene, &[]);
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("at-rest").join(name).join("series.csv");
    let series = Series::read(&path).expect("a series");
    let column = series.columns.iter().position(|column| column.name == "fastest").expect("a column");
    series.rows.iter().map(|row| row[column]).collect()
}

/// Rounding is all that moves: √(g × depth) is 0.6 m/s, and 20 000 steps add up to 1e-14 of it (1e-12 leaves room). Where walls
/// answer as strongly as steady flow asks, these pools reach 1e-3 to 1e-2 m/s. A yield stress of 0 or of nearly nothing is none.
#[test]
fn pools_of_thin_fluids_stay_at_rest_between_walls() {
    for (size, excess) in
        [([4, 1], 0.0055), ([7, 1], 0.005), ([3, 1], 0.003), ([5, 4], 0.006), ([6, 1], 0.015)]
    {
        let mu = viscosity(excess, 0.002);
        let newtonian = format!(r#""newtonian": {{ "viscosity_pa_s": {mu} }}"#);
        let bingham = |sigma0: f64| {
            format!(r#""bingham": {{ "yield_stress_pa": {sigma0:e}, "plastic_viscosity_pa_s": {mu} }}"#)
        };
        for (k, (rheology, operator)) in [
            (&newtonian, "trt"),
            (&newtonian, "central_moment"),
            (&bingham(0.0), "central_moment"),
            (&bingham(1e-9), "central_moment"),
        ]
        .into_iter()
        .enumerate()
        {
            let name = format!("pool-{}-{}-{k}", size[0], size[1]);
            let found = speeds(&name, &pool_between_walls(size, rheology, operator, (0.002, 0.0)));
            let most = found.into_iter().fold(0.0, f64::max);
            assert!(most < 1e-12, "{size:?} cells, {excess}, {rheology}, {operator}: {most} m/s");
        }
    }
}

/// Waves of a fluid whose viscosity follows the shear rate die out, whatever the flow index. Where walls answer as strongly as
/// steady flow asks, a tenth to all of the largest speed is left; a thousandth is what friction brings it below (set after seeing:
/// 2e-4 at most).
#[test]
fn waves_between_walls_die_out() {
    for (n, times) in [(0.8, 1.0), (1.0, 0.5), (1.2, 1.0), (1.2, 5.0)] {
        let k = times * viscosity(0.02, 0.001);
        let rheology = format!(
            r#""herschel_bulkley": {{ "yield_stress_pa": 0.01, "consistency_pa_s_n": {k}, "flow_index": {n} }}"#
        );
        let scene = pool_between_walls([6, 1], &rheology, "central_moment", (0.001, 0.0016));
        let found = speeds(&format!("waves-{n}-{times}"), &scene);
        let (most, last) = (found.iter().copied().fold(0.0, f64::max), found[found.len() - 1]);
        assert!(most > 1e-3 && last < 1e-3 * most, "{n}, {times}: {last} of {most} m/s");
    }
}
