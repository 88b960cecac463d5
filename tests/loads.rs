//! Loads on solids and walls in the summary: against hydrostatics and against the weight of grains.

mod program;

use lahar::run::{LoadSummary, Summary};
use program::lahar;

fn loads(name: &str, scene: &str, more: &[&str]) -> Vec<LoadSummary> {
    let out = program::folder("loads", name);
    let path = out.join("scene.json");
    std::fs::write(&path, scene).expect("a written scene");
    let arguments = ["run", &path.to_string_lossy(), "--out", &out.to_string_lossy(), "--quiet"];
    let output = lahar(&[&arguments, more].concat());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    Summary::read(&out.join("summary.json")).expect("a summary").loads
}

/// A pool at rest, 20 cells deep and one cell of 0.01 m wide, beside a wall whose wetted face is at x = 0.1 m.
const POOL: &str = r#"{
    "domain": {
        "size_m": [0.14, 0.01, 0.3], "spacing_m": 0.01,
        "boundaries": { "x_min": "free_slip", "x_max": "no_slip", "z_min": "no_slip", "z_max": "open" }
    },
    "gravity": { "magnitude_m_per_s2": 9.81, "direction": [0, 0, -1] },
    "fluid": {
        "density_kg_per_m3": 1000.0,
        "rheology": { "newtonian": { "viscosity_pa_s": 5.0 } },
        "initial": { "fill_level": { "axis": "z", "height_m": 0.2 } }
    },
    "solids": [{ "name": "wall", "shape": { "box": { "min_m": [0.1, -1, 0], "max_m": [0.14, 1, 0.3] } } }],
    "numerics": { "time_step_s": 0.0005 },
    "stop": { "end_time_s": 0.1 },
    "output": { "probes": [
        { "name": "face", "measure": { "force": { "solid": "wall", "about_m": [0.1, 0.005, 0], "window_s": 0.02 } } },
        { "name": "foot", "measure": { "force": { "solid": "wall" } } },
        { "name": "turn", "measure": { "torque": { "solid": "wall", "about_m": [0.1, 0.005, 0.1], "window_s": 1e-6 } } }
    ] }
}"#;

#[test]
fn a_pool_at_rest_pushes_at_a_third_of_its_depth() {
    let all = loads("pool", POOL, &[]);
    let [face, foot, turn] = &all[..] else { panic!("{all:?}") };
    // The start is the discrete rest, whose linear pressure the links sum exactly: 1e-9 is far above the roundings of 200
    // steps and far below a link of 360.
    let near = |found: f64, expected: f64, what: &str| {
        assert!((found - expected).abs() < 1e-9 * expected.abs(), "{what}: {found} {expected}");
    };
    // ρ g h²/2 per width.
    let force = 1000.0 * 9.81 * 0.2 * 0.2 / 2.0 * 0.01;
    for (peaks, what) in [(face.raw, "raw"), (face.windowed, "windowed")] {
        let peak = peaks.expect("peaks").force;
        near(peak.force_n[0], force, what);
        let centre = peak.centre_of_pressure_m.expect("a centre of pressure");
        near(centre[2], 0.2 / 3.0, "h/3");
        assert!(centre[0] == 0.1 && (centre[1] - 0.005).abs() < 1e-9, "{centre:?}");
        near(peak.overturning_n_m, force * 0.2 / 3.0, "F h/3");
        near(peak.moment_n_m[1], force * 0.2 / 3.0, "the moment turns the wall over along x");
    }
    assert_eq!(face.load, "of fluid and grains on solid `wall`");
    assert!(
        (face.window_s - 0.02).abs() < 1e-12 && (face.sampled_every_s - 0.0005).abs() < 1e-15,
        "{face:?}"
    );
    // A steady load for 0.1 s.
    near(face.impulse_n_s[0], force * 0.1, "impulse");
    near(face.angular_impulse_n_m_s[1], force * 0.2 / 3.0 * 0.1, "angular impulse");
    // The middle of the foot, and the time between 100 rows in 0.1 s.
    assert_eq!((foot.about_m, foot.up), ([0.12000000000000001, 0.005, 0.0], 'z'));
    assert!((foot.window_s - 0.001).abs() < 1e-12, "{}", foot.window_s);
    // About a point above the centre of pressure the moment has the other sign; a window is one step at least.
    let peak = turn.windowed.expect("peaks").force;
    let expected = force * (0.2 / 3.0 - 0.1);
    assert!((peak.moment_n_m[1] - expected).abs() < 1e-9 * force * 0.1, "{peak:?} {expected}");
    assert_eq!((turn.window_s, turn.impulse_n_s), (turn.sampled_every_s, face.impulse_n_s));
}

/// A tank at rest with walls all around, a slab on its floor and a shelf on the walls of its far end.
const TANK: &str = r#"{
    "domain": {
        "size_m": [0.3, 0.06, 0.3], "spacing_m": 0.01,
        "boundaries": { "x_min": "no_slip", "x_max": "no_slip", "y_min": "no_slip", "y_max": "no_slip",
                        "z_min": "no_slip", "z_max": "open" }
    },
    "gravity": { "magnitude_m_per_s2": 9.81, "direction": [0, 0, -1] },
    "fluid": {
        "density_kg_per_m3": 1000.0,
        "rheology": { "newtonian": { "viscosity_pa_s": 5.0 } },
        "initial": { "fill_level": { "axis": "z", "height_m": 0.2 } }
    },
    "solids": [
        { "name": "slab", "shape": { "box": { "min_m": [0, 0, 0], "max_m": [0.3, 0.06, 0.02] } } },
        { "name": "shelf", "shape": { "box": { "min_m": [0.2, 0, 0.1], "max_m": [0.3, 0.06, 0.14] } } }
    ],
    "numerics": { "time_step_s": 0.0005 },
    "stop": { "end_time_s": 0.02 },
    "output": { "probes": [
        { "name": "slab", "measure": { "force": { "solid": "slab", "about_m": [0, 0.03, 0.02] } } },
        { "name": "shelf", "measure": { "force": { "solid": "shelf", "about_m": [0.2, 0.03, 0.1] } } }
    ] }
}"#;

#[test]
fn slabs_and_shelves_between_walls_bear_their_pressure() {
    let all = loads("tank", TANK, &[]);
    let [slab, shelf] = &all[..] else { panic!("{all:?}") };
    let weight = 1000.0 * 9.81;
    // 1e-9 as for the pool above.
    let near = |found: [f64; 3], expected: [f64; 3], what: &str| {
        let largest = expected.iter().fold(0.0_f64, |most, e| most.max(e.abs()));
        for axis in 0..3 {
            assert!((found[axis] - expected[axis]).abs() < 1e-9 * largest, "{what}: {found:?} {expected:?}");
        }
    };
    let peak = |load: &LoadSummary| load.windowed.expect("peaks").force;
    let (low, high) = (peak(slab), peak(shelf));
    let pressed = -weight * 0.18 * 0.3 * 0.06;
    near(low.force_n, [0.0, 0.0, pressed], "slab");
    near(low.moment_n_m, [0.0, -0.15 * pressed, 0.0], "moment of the slab");
    // A lift of the weight displaced; a push of the mean pressure, 0.08 m deep, on the front.
    let (lift, push) = (weight * 0.04 * 0.1 * 0.06, weight * 0.08 * 0.04 * 0.06);
    near(high.force_n, [push, 0.0, lift], "shelf");
    // The push acts L²/(12 · depth) below the middle of the front, L = 0.04 m.
    let below = 0.04 * 0.04 / (12.0 * 0.08);
    let moment = [0.0, push * (0.02 - below) - lift * 0.05, 0.0];
    near(high.moment_n_m, moment, "moment of the shelf");
}

#[test]
fn exact_loads_on_both_backends_and_any_threads() {
    let found = [["plain", "1"], ["fast", "1"], ["fast", "2"]].map(|[backend, threads]| {
        let more = ["--backend", backend, "--threads", threads, "--until", "0.02"];
        loads(&format!("same-{backend}-{threads}"), POOL, &more)
    });
    assert_eq!(found[0], found[1]);
    assert_eq!(found[1], found[2]);
}

/// A sphere of 2500 kg/m³ and 5 mm that rests on the floor, 0.03 m from the point of the moments.
const SPHERE: &str = r#"{
    "domain": { "size_m": [0.05, 0.05, 0.05], "boundaries": { "z_min": "no_slip", "z_max": "open" } },
    "gravity": { "magnitude_m_per_s2": 9.81, "direction": [0, 0, -1] },
    "grains": {
        "materials": [{ "name": "glass", "density_kg_per_m3": 2500, "young_modulus_pa": 1e7, "poisson_ratio": 0.2 }],
        "contact": { "law": { "tsuji": { "restitution": 0.2 } }, "friction": 0.3 },
        "sets": [{ "name": "ball", "place": { "list": [{ "position_m": [0.04, 0.025, 0.005], "radius_m": 0.005 }] } }]
    },
    "stop": { "end_time_s": 0.1 },
    "output": { "probes": [{ "name": "floor", "measure": {
        "force": { "on": { "face": "z_min" }, "about_m": [0.01, 0.025, 0], "window_s": 0.05 } } }] }
}"#;

#[test]
fn a_sphere_at_rest_pushes_the_floor_with_its_weight_where_it_lies() {
    let all = loads("sphere", SPHERE, &[]);
    let [floor] = &all[..] else { panic!("{all:?}") };
    let weight = 2500.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.005 * 0.005 * 0.005 * 9.81;
    // Impulse of the weight over 0.1 s, but for the momentum of a sphere that still rocks on its contact: below
    // m √(g δ) of an overlap δ of 1e-7 m, 1e-3 of the impulse; and half a step at either end.
    assert!((floor.impulse_n_s[2] + weight * 0.1).abs() < 3e-3 * weight * 0.1, "{floor:?}");
    let mean = floor.windowed.expect("peaks").force;
    assert!((mean.force_n[2] + weight).abs() < 0.02 * weight, "{mean:?} {weight}");
    let centre = mean.centre_of_pressure_m.expect("a centre of pressure");
    assert!((centre[0] - 0.04).abs() < 1e-9 && (centre[1] - 0.025).abs() < 1e-9, "{centre:?}");
    assert!((mean.overturning_n_m - 0.03 * mean.magnitude_n).abs() < 1e-9 * weight, "{mean:?}");
    // The start, without overlap, shakes the sphere: single steps are larger than the mean, at most twice the weight.
    let raw = floor.raw.expect("peaks").force;
    assert!(raw.magnitude_n > mean.magnitude_n && raw.magnitude_n < 2.01 * weight, "{raw:?}");
}
