//! What `plan` refuses, and what it takes: with the right words.

mod planned;

use lahar::plan::grains::GrainPlan;
use lahar::scene;
use planned::program::{folder, lahar};
use planned::{plan, pool, refusal, says, warnings};
use serde_json::{Value, json};

#[test]
fn polygons_whose_edges_cross_are_refused_with_the_place() {
    let with = |points: Value| {
        let mut json = pool();
        json["fluid"]["initial"]["shapes"][0]["shape"] =
            json!({"polygon": {"axis": "z", "points_m": points, "to_m": 0.1}});
        json
    };
    let path = "`fluid.initial.shapes[0].shape.polygon.points_m`";
    let bow_tie = refusal(&with(json!([[0.1, 0.1], [0.3, 0.3], [0.3, 0.1], [0.1, 0.3]])));
    says(&bow_tie, &[path, "from corner 1 to the next", "from corner 3 to the next", "(0.2, 0.2) m"]);
    let crossing = refusal(&with(json!([[0.0, 0.0], [0.3, 0.3], [0.3, 0.0], [0.0, 0.2]])));
    says(&crossing, &[path, "from corner 1 to the next", "from corner 3 to the next", "0.12"]);
    says(&refusal(&with(json!([[0.0, 0.0], [0.2, 0.2], [0.4, 0.4]]))), &["3 corners enclosing 0 m²"]);
    // Clockwise, closed, and with a corner given twice in a row.
    let good = with(json!([[0.1, 0.1], [0.1, 0.3], [0.1, 0.3], [0.3, 0.3], [0.3, 0.1], [0.1, 0.1]]));
    let volume = plan(&good).expect("a plan").numbers.volume_m3.expect("a surface");
    // A square of 10 × 10 cells through 5 layers; one rounding per cell.
    assert!((volume - 0.2 * 0.2 * 0.1).abs() < 500.0 * f64::EPSILON * 0.004, "{volume}");
}

#[test]
fn marks_of_missing_data_are_refused() {
    for mark in [-9999.0, -99999.0, -32768.0, 32767.0, 1e20, 3.402_823_466_385_288_6e38, -3.4e38] {
        let mut json = pool();
        let heights = json!([[0.02, 0.03, 0.02], [0.02, mark, 0.02], [mark, 0.02, 0.02]]);
        json["solids"] =
            json!([{"name": "bed", "shape": {"heightfield": {"spacing_m": 0.2, "heights_m": heights}}}]);
        let message = refusal(&json);
        says(
            &message,
            &["`solids[0].shape.heightfield.heights_m`: row 2, column 2", "and 2 heights like it"],
        );
    }
    let mut deep = pool();
    let heights = json!([[0.05, 0.05, 0.05], [0.05, 0.05, 0.05], [0.05, 0.05, -50.0]]);
    deep["solids"] =
        json!([{"name": "bed", "shape": {"heightfield": {"spacing_m": 0.2, "heights_m": heights}}}]);
    assert_eq!(plan(&deep).err(), None, "a shaft of 50 m is what is drawn");
}

/// Beyond 45° the bed stays the bed.
#[test]
fn up_is_the_normal_of_the_bed_at_any_slope() {
    for (slope, normal) in [(50.0, None), (-60.0, None), (89.0, Some("y")), (90.0, None)] {
        let mut json = pool();
        json["gravity"] = json!({"magnitude_m_per_s2": 9.81, "slope_deg": slope});
        if let Some(normal) = normal {
            json["gravity"]["bed_normal"] = json!(normal);
        }
        json["output"] = json!({"probes": [
            {"name": "front", "measure": {"front": {"along": "x", "threshold_m": 0.02}}},
            {"name": "across", "measure": {"front": {"along": normal.unwrap_or("z"), "threshold_m": 0.02}}}
        ]});
        let message = refusal(&json);
        says(&message, &["`output.probes[1].measure.front.along`", "the axis normal to the bed"]);
        json["output"]["probes"].as_array_mut().expect("a list").pop();
        let plan = plan(&json).unwrap_or_else(|message| panic!("{slope}: {message}"));
        let depth = if normal.is_some() { 20.0 } else { 5.0 };
        assert_eq!(plan.numbers.depth_cells, Some(depth), "{slope}");
    }
}

#[test]
fn no_fluid_is_refused() {
    let mut json = pool();
    json["fluid"]["initial"] = json!({"fill_level": {"height_m": 1e-9}});
    says(&refusal(&json), &["`fluid.initial`", "at most 1.000e-9 m deep", "5.000e-8 cells"]);
    json["fluid"]["initial"] = json!({"fill_level": {"height_m": 0.1}});
    assert!(plan(&json).is_ok());
}

/// A gate that is lifted out of the fluid, a paddle, a falling block: cells of a solid stay where they are.
#[test]
fn solids_that_would_leave_their_place_are_refused() {
    for velocity in [[0.0, 0.0, 0.5], [0.3, 0.0, 0.0], [0.1, 0.1, -0.1]] {
        let mut json = pool();
        json["solids"] = json!([{"name": "gate", "velocity_m_per_s": velocity,
            "shape": {"box": {"min_m": [0.2, 0.1, 0.0], "max_m": [0.24, 0.3, 0.15]}}}]);
        says(&refusal(&json), &["`solids[0].velocity_m_per_s`", "`gate` would leave its place"]);
    }
}

/// Bytes and numbers of files, and the ways to have less of them.
#[test]
fn files_are_counted_and_can_be_cut() {
    let mut json = pool();
    json["output"] = json!({"fields": {"every_s": 0.01}});
    let whole = plan(&json).expect("a plan").numbers.files;
    let bytes =
        |files: &[lahar::plan::Files]| files.iter().find(|f| f.what == "fields").expect("fields").bytes;
    // 21 shots of 20 × 20 × 10 cells: 12 numbers of 8 bytes and three marks.
    assert_eq!(bytes(&whole), 21 * (4000 * (12 * 8 + 3) + 2048));
    json["output"]["field_names"] = json!(["velocity", "fill"]);
    json["output"]["field_region"] = json!({"min_m": [0.1, 0.1, 0], "max_m": [0.3, 0.3, 0.05]});
    json["output"]["field_precision"] = json!("single");
    // 10 × 10 × 3 cells, 4 numbers of 4 bytes.
    assert_eq!(bytes(&plan(&json).expect("a plan").numbers.files), 21 * (300 * 16 + 2048));
    json["output"]["fields"]["every_s"] = json!(1e-7);
    json["stop"]["end_time_s"] = json!(2000.0);
    says(
        &warnings(&json).join("\n"),
        &["files, about", "`output.field_names`", "`every_s` of `output.fields`"],
    );
    for (key, value, part) in [
        ("field_names", json!(["solid"]), "no such field"),
        ("field_names", json!([]), "an empty list"),
        ("field_names", json!(["density"]), "unknown choice `density`"),
        (
            "field_region",
            json!({"min_m": [0.5, 0, 0], "max_m": [0.6, 1, 1]}),
            "something between 0 m and 0.4 m",
        ),
        (
            "field_region",
            json!({"min_m": [0.3, 0, 0], "max_m": [0.2, 1, 1]}),
            "the first less than the second",
        ),
    ] {
        let mut wrong = pool();
        wrong["output"][key] = value;
        says(&refusal(&wrong), &[&format!("output.{key}"), part]);
    }
}

/// The files are what was asked for, and what was counted.
#[test]
fn field_files_hold_what_was_chosen() {
    let mut json = pool();
    json["stop"]["end_time_s"] = json!(0.01);
    json["output"] = json!({"field_names": ["velocity", "kind"], "field_precision": "single",
        "field_region": {"min_m": [0.1, 0.1, 0], "max_m": [0.3, 0.3, 0.05]}});
    let folder = folder("plan_cases", "chosen");
    let path = folder.join("chosen.json");
    std::fs::write(&path, json.to_string()).expect("a written scene");
    let out = folder.join("out");
    let run =
        lahar(&["run", path.to_str().expect("a path"), "--quiet", "--out", out.to_str().expect("a path")]);
    assert_eq!(run.status.code(), Some(0), "{}", String::from_utf8_lossy(&run.stderr));
    let file = out.join("fields_000001.vti");
    let bytes = std::fs::read(&file).expect("a file of fields");
    let head = String::from_utf8_lossy(&bytes);
    for part in [
        "WholeExtent=\"0 10 0 10 0 3\" Origin=\"0.1 0.1 0\"",
        "<DataArray type=\"Float32\" Name=\"velocity_m_per_s\"",
        "<DataArray type=\"UInt8\" Name=\"kind\"",
    ] {
        assert!(head.contains(part), "{part}");
    }
    assert!(!head.contains("stress_pa") && !head.contains("\"fill\""));
    let data = bytes.windows(2).position(|pair| pair == b"\n_").expect("data") + 2;
    assert_eq!(bytes[data..data + 8], (300_u64 * 12).to_le_bytes());
}

#[test]
fn meshes_outside_the_box_are_refused() {
    let place = folder("plan_cases", "mesh");
    let obj = |x: f64| format!("v {x} 0 0\nv {} 0 0\nv {x} 0.1 0.05\nf 1 2 3\n", x + 0.1);
    std::fs::write(place.join("far.obj"), obj(1000.0)).expect("a mesh");
    std::fs::write(place.join("in.obj"), obj(0.1)).expect("a mesh");
    let scene = |file: &str| {
        let json = json!({
            "domain": {"size_m": [1, 1, 1], "boundaries": {"z_min": "no_slip", "z_max": "open"}},
            "gravity": {"magnitude_m_per_s2": 9.81, "direction": [0, 0, -1]},
            "grains": {"materials": [{"name": "m", "density_kg_per_m3": 2500, "young_modulus_pa": 1e7, "poisson_ratio": 0.3}],
                "contact": {"law": {"tsuji": {"restitution": 0.5}}, "friction": 0.5},
                "sets": [{"name": "s", "place": {"list": [{"position_m": [0.5, 0.5, 0.5], "radius_m": 0.05}]}}]},
            "solids": [{"name": "wall", "mesh": {"file": file}}],
            "stop": {"end_time_s": 0.01}
        });
        let path = place.join("mesh.json");
        std::fs::write(&path, json.to_string()).expect("a written scene");
        let dry = scene::load_dry(&path).unwrap_or_else(|error| panic!("{error}"));
        GrainPlan::with_memory(&dry, None).map(|_| ()).map_err(|error| error.to_string())
    };
    assert_eq!(scene("in.obj"), Ok(()));
    let far = scene("far.obj").expect_err("nothing of it is in the box");
    says(
        &far,
        &["`solids[0].mesh.file`", "from 1000 m to 1000 m", "between 0 m and 1 m", "`scale` of 0.001"],
    );
    says(&scene("none.obj").expect_err("there is none"), &["no such file in the folder"]);
    std::fs::create_dir_all(place.join("folder.obj")).expect("a folder");
    says(&scene("folder.obj").expect_err("a folder"), &["it is a folder"]);
}

/// `plan` as its users call it, on the files it is given.
#[test]
fn encodings_folders_and_devices() {
    let place = folder("plan_cases", "files");
    let write = |name: &str, bytes: &[u8]| {
        let path = place.join(name);
        std::fs::write(&path, bytes).expect("a written file");
        path.to_str().expect("a path").to_owned()
    };
    let run = |path: &str| {
        let output = lahar(&["plan", path]);
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let text = pool().to_string();
    let marked = write("marked.json", &[b"\xEF\xBB\xBF", text.as_bytes()].concat());
    assert_eq!(run(&marked).0, Some(0), "a byte-order mark before UTF-8 is no fault");
    let wide: Vec<u8> =
        std::iter::once(0xFEFF).chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    let (code, message) = run(&write("wide.json", &wide));
    assert_eq!(code, Some(2));
    says(&message, &["wide.json: is UTF-16", "allowed: UTF-8"]);
    let (code, message) = run(place.to_str().expect("a path"));
    assert_eq!(code, Some(4));
    says(&message, &["is a folder"]);
    let (code, message) = run("no/such/scene.json");
    assert_eq!(code, Some(4));
    says(&message, &["no/such/scene.json: cannot be read"]);
    if cfg!(unix) {
        let (code, message) = run("/dev/zero");
        assert_eq!(code, Some(4));
        says(&message, &["/dev/zero: is a device"]);
    }
}

#[test]
fn vectors_and_choices_of_the_wrong_length() {
    let mut four = pool();
    four["domain"]["size_m"] = json!([0.4, 0.4, 0.2, 1.0]);
    says(&refusal(&four), &["`domain.size_m`", "an array of 4 entries", "an array of 3 numbers"]);
    let mut two = pool();
    two["domain"]["size_m"] = json!([0.4, 0.4]);
    says(&refusal(&two), &["`domain.size_m"]);
    let mut both = pool();
    both["fluid"]["rheology"]["newtonian"] = json!({"viscosity_pa_s": 1.0});
    says(&refusal(&both), &["`fluid.rheology`", "an object with 2 keys", "one choice"]);
    let mut far = pool();
    far["gravity"]["direction"] = json!([0, 0, -1e200]);
    says(&refusal(&far), &["`gravity.direction`", "divide them by the largest"]);
    far["gravity"]["direction"] = json!([0, 0, -1e-200]);
    says(&refusal(&far), &["`gravity.direction`"]);
}

/// Words of other programs are answered with the name of the same meaning, or with what there is instead.
#[test]
fn unknown_words_are_answered_by_their_meaning() {
    let rename = |change: &dyn Fn(&mut Value)| {
        let mut json = pool();
        change(&mut json);
        refusal(&json)
    };
    let probe = |measure: Value| {
        move |json: &mut Value| {
            json["output"] = json!({"probes": [{"name": "p", "measure": measure}]});
        }
    };
    says(&rename(&probe(json!("max_height"))), &["did you mean `surface_profile`?"]);
    says(&rename(&|json| json["domain"]["dx"] = json!(0.02)), &["did you mean `spacing_m`?"]);
    says(&rename(&|json| json["stop"]["t_end"] = json!(1.0)), &["did you mean `end_time_s`?"]);
    says(&rename(&|json| json["obstacles"] = json!([])), &["did you mean `solids`?"]);
    says(&rename(&|json| json["domain"]["boundaries"]["x_min"] = json!("inflow")), &["there is no inflow"]);
    says(&rename(&|json| json["domain"]["boundaries"]["x_min"] = json!("outlet")), &["write `open`"]);
    let cone = json!({"cone": {"base_m": [0.2, 0.2, 0], "direction": [0, 0, 1], "height_m": 0.1, "base_diameter_m": 0.1}});
    says(
        &rename(&|json| json["fluid"]["initial"]["shapes"][0]["shape"] = cone.clone()),
        &["rename it to `base_radius_m`: half of the diameter"],
    );
    says(
        &rename(&|json| json["solids"] = json!([{"name": "s", "mesh": {"file": "a.stl"}}])),
        &["meshes are walls of grains without fluid", "`heightfield`"],
    );
}

/// Grains of radii 1 m and 1/4 m that hit each other at `speed`, m/s, under the visco-elastic law with `time`, s.
fn damped(time: f64, speed: f64) -> [f64; 2] {
    let place = folder("plan_cases", &format!("damped_{time:e}_{speed}"));
    let at = |x: f64, r: f64| json!({"position_m": [x, 5, 5], "radius_m": r});
    let json = json!({
        "domain": {"size_m": [10, 10, 10]},
        "grains": {"materials": [{"name": "m", "density_kg_per_m3": DENSITY, "young_modulus_pa": YOUNG, "poisson_ratio": POISSON}],
            "contact": {"law": {"visco_elastic": {"dissipative_time_s": time}}, "friction": 0.0},
            "numerics": {"design_speed_m_per_s": speed},
            "sets": [{"name": "s", "place": {"list": [at(2.0, 1.0), at(7.0, 0.25)]}}]},
        "stop": {"end_time_s": 0.01}
    });
    let path = place.join("damped.json");
    std::fs::write(&path, json.to_string()).expect("a written scene");
    let dry = scene::load_dry(&path).unwrap_or_else(|error| panic!("{error}"));
    GrainPlan::with_memory(&dry, None).unwrap_or_else(|error| panic!("{error}")).numbers.restitution
}

const DENSITY: f64 = 2500.0;
const YOUNG: f64 = 1e8;
const POISSON: f64 = 0.25;

/// The dissipative time, s, that gives two spheres of radius 1 m the dimensionless damping `a` = A (k/m)^{2/5} v^{1/5} at `speed`:
/// m half the mass of one, k = (4/3) E* √R*, R* = 1/2 m, E* = E/(2(1 − ν²)).
fn time_of(a: f64, speed: f64) -> f64 {
    let mass = 0.5 * DENSITY * 4.0 / 3.0 * std::f64::consts::PI;
    let stiffness = 4.0 / 3.0 * YOUNG / (2.0 * (1.0 - POISSON * POISSON)) * 0.5_f64.sqrt();
    a / (libm::pow(stiffness / mass, 0.4) * libm::pow(speed, 0.2))
}

/// Numbers of docs/references.md, where the contact ends at zero force. k/m goes as r^{−5/2}: a quarter of the radius has four
/// times the damping; 4⁵ times the speed as well.
#[test]
fn reference_restitution_of_the_visco_elastic_law() {
    let (weak, strong) = (0.918_132_9, 0.722_085_4);
    // The numbers have 7 digits; 2000 steps in a unit of time, where 4000 are good to 2e-7, may err by four times that.
    let close = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-6, "{found} {expected}");
    let time = time_of(0.05, 0.01);
    let [large, small] = damped(time, 0.01);
    close(large, weak);
    close(small, strong);
    close(damped(time, 10.24)[0], strong);
}

/// The expansion 1 − C₁ b + C₂ b² with b = (3/2) a and C₂ = (3/5) C₁²; C₁ follows from the energy that weak damping takes from
/// an elastic collision: (4/5) (5/4)^{3/5} B(3/5, 3/2). docs/references.md has both numbers.
#[test]
fn limit_restitution_of_weak_and_strong_damping() {
    let beta = libm::tgamma(0.6) * libm::tgamma(1.5) / libm::tgamma(2.1);
    let c = 0.8 * libm::pow(1.25, 0.6) * beta;
    assert!((c - 1.15344).abs() < 2e-5 && (0.6 * c * c - 0.79826).abs() < 2e-5, "{c}");
    let time = time_of(0.0005, 0.01);
    for (found, a) in damped(time, 0.01).into_iter().zip([0.0005, 0.002]) {
        let b = 1.5 * a;
        let expected = 1.0 - c * b + 0.6 * c * c * b * b;
        // The next term is below b^{5/2}, 5e-7; the integration is good to 8e-7 as above.
        assert!((found - expected).abs() < 1e-6, "{a}: {found} {expected}");
    }
    // Without damping all comes back, but for the error of the integration; at a = 100 and 400 next to nothing.
    assert!(damped(0.0, 0.01).iter().all(|e| (e - 1.0).abs() < 1e-6));
    assert!(damped(time_of(100.0, 0.01), 0.01).iter().all(|e| (0.0..1e-3).contains(e)));
}

/// Free grains in bodies that are skins for contacts are refused (`tests/bad_scenes/grains_in_a_*.json`); beside and above them,
/// in a funnel, and driven ones in a bed are not.
#[test]
fn grains_beside_bodies_are_taken() {
    let bad = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_scenes");
    let taken = |name: &str, change: &dyn Fn(&mut Value)| {
        let text = std::fs::read_to_string(bad.join(name)).expect("a scene of the package");
        let mut json: Value = serde_json::from_str(&text).expect("JSON");
        change(&mut json);
        let path = folder("plan_cases", "beside").join("scene.json");
        std::fs::write(&path, json.to_string()).expect("a folder to write in");
        match scene::load(&path).expect("a scene") {
            lahar::scene::AnyScene::Dry(scene) => GrainPlan::with_memory(&scene, None).map(|_| ()),
            lahar::scene::AnyScene::Flow(scene) => lahar::plan::Plan::with_memory(&scene, None).map(|_| ()),
        }
        .unwrap_or_else(|error| panic!("{name}: {error}"));
    };
    let place = |json: &mut Value, z: f64| {
        json["grains"]["sets"][0]["place"]["list"][0]["position_m"][2] = json!(z);
    };
    for name in ["grains_in_a_heightfield.json", "coupled_in_a_heightfield.json", "grains_in_a_polygon.json"]
    {
        taken(name, &|json| place(json, 0.07));
    }
    taken("grains_in_a_heightfield.json", &|json| {
        let mut free = json["grains"]["sets"][0].clone();
        free["name"] = json!("free");
        free["place"]["list"][0]["position_m"][2] = json!(0.07);
        json["grains"]["sets"][0]["driven"] = json!(true);
        json["grains"]["sets"].as_array_mut().expect("sets").push(free);
    });
    taken("grains_in_a_cone.json", &|json| json["solids"][0]["invert"] = json!(true));
    // Flat on the ground, all three of its spheres are outside.
    taken("grains_clump_foot_in_a_heightfield.json", &|json| {
        json["grains"]["sets"][0]["place"]["list"][0]["orientation"] = json!([1.0, 0.0, 0.0, 0.0]);
    });
}
