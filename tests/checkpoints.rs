//! A run that is killed and goes on from its checkpoint leaves the files of one that was never disturbed, byte for byte.
#![cfg(unix)]

mod program;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use program::{folder, lahar};

/// Mud that breaks against a wall in a channel of 24 × 4 × 12 cells, with all that a run keeps: loads, sections, a looked-for rest.
const DAM: &str = r#"{
    "domain": {
        "size_m": [0.24, 0.04, 0.12], "spacing_m": 0.01,
        "boundaries": { "x_min": "no_slip", "x_max": "open", "y_min": "free_slip", "y_max": "free_slip", "z_min": "no_slip", "z_max": "open" }
    },
    "gravity": { "magnitude_m_per_s2": 9.81, "direction": [0, 0, -1] },
    "fluid": {
        "density_kg_per_m3": 1500,
        "rheology": { "bingham": { "yield_stress_pa": 20, "plastic_viscosity_pa_s": 2 } },
        "initial": { "shapes": [{ "shape": { "box": { "min_m": [0, 0, 0], "max_m": [0.08, 0.04, 0.1] } } }] }
    },
    "solids": [{ "name": "step", "shape": { "sphere": { "centre_m": [0.15, 0.02, 0], "radius_m": 0.021 } } }],
    "stop": { "end_time_s": 0.06, "arrested": { "speed_m_per_s": 1e-3, "for_s": 0.02, "check_every_s": 0.005 } },
    "output": {
        "fields": { "count": 3 }, "series": { "every_s": 0.0005 },
        "probes": [
            { "name": "ledger", "measure": "ledger" },
            { "name": "section", "measure": { "surface_profile": { "along": "x" } } },
            { "name": "load", "measure": { "force": { "solid": "step", "window_s": 0.004 } } }
        ]
    }
}"#;

/// Grains that touch, roll over a bed and leave through an open face.
const GRAINS: &str = r#"{
    "domain": {
        "size_m": [0.06, 0.04, 0.06],
        "boundaries": { "x_min": "no_slip", "x_max": "open", "z_min": "no_slip", "z_max": "open" }
    },
    "gravity": { "magnitude_m_per_s2": 9.81, "direction": [0.5, 0, -1] },
    "grains": {
        "materials": [{ "name": "glass", "density_kg_per_m3": 2500, "young_modulus_pa": 1e6, "poisson_ratio": 0.25 }],
        "clumps": [{ "name": "tetrahedron", "members": { "tetrahedron": { "edge_over_radius": 1.2 } } }],
        "contact": { "law": { "tsuji": { "restitution": 0.5 } }, "friction": 0.4, "rolling_friction": 0.05 },
        "sets": [
            { "name": "balls", "place": { "lattice": {
                "kind": "simple_cubic", "region": { "box": { "min_m": [0, 0, 0], "max_m": [0.05, 0.04, 0.02] } }, "radius_m": 0.004
            } } },
            { "name": "tumbles", "clump": "tetrahedron", "place": { "list": [{ "position_m": [0.02, 0.02, 0.035], "radius_m": 0.004 }] } },
            { "name": "fast", "place": { "list": [
                { "position_m": [0.05, 0.01, 0.03], "radius_m": 0.003, "velocity_m_per_s": [1, 0, 0] },
                { "position_m": [0.05, 0.03, 0.03], "radius_m": 0.003, "velocity_m_per_s": [0.4, 0, 0] }
            ] } }
        ]
    },
    "stop": { "end_time_s": 0.05 },
    "output": {
        "grains": { "count": 3 }, "series": { "every_s": 0.0005 },
        "probes": [
            { "name": "energy", "measure": "energies" },
            { "name": "passed", "measure": { "flux": { "normal": "x", "at_m": 0.03 } } },
            { "name": "floor", "measure": { "force": { "on": { "face": "z_min" } } } }
        ]
    }
}"#;

/// A smaller dam with grains in it, one of which leaves.
fn grains_in_dam() -> String {
    let mut scene: serde_json::Value = serde_json::from_str(DAM).expect("JSON");
    let dry: serde_json::Value = serde_json::from_str(GRAINS).expect("JSON");
    scene["domain"]["size_m"] = serde_json::json!([0.09, 0.04, 0.07]);
    scene["fluid"]["initial"]["shapes"][0]["shape"]["box"]["max_m"] = serde_json::json!([0.05, 0.04, 0.05]);
    scene["solids"][0]["shape"]["sphere"]["centre_m"] = serde_json::json!([0.06, 0.02, -0.01]);
    scene["grains"] = dry["grains"].clone();
    scene["grains"].as_object_mut().expect("an object").remove("clumps");
    scene["grains"]["sets"] = serde_json::json!([{ "name": "stones", "place": { "list": [
        { "position_m": [0.02, 0.02, 0.02], "radius_m": 0.012 },
        { "position_m": [0.077, 0.02, 0.04], "radius_m": 0.012, "velocity_m_per_s": [2.5, 0, 0] }
    ] } }]);
    scene["stop"] = serde_json::json!({ "end_time_s": 0.0144 });
    scene["output"]["grain_probes"] = serde_json::json!([{ "name": "energy", "measure": "energies" }]);
    scene.to_string()
}

/// A channel that is looked at for steadiness, below a wall that swings.
const CHANNEL: &str = r#"{
    "domain": { "size_m": [0.01, 0.16, 0.01], "spacing_m": 0.01, "boundaries": { "y_min": "no_slip", "y_max": { "moving_wall": { "velocity_m_per_s": [0.01, 0, 0] } } },
        "motion": { "y_max": { "oscillating": { "frequency_hz": 2.0 } } } },
    "fluid": { "density_kg_per_m3": 1000, "rheology": { "herschel_bulkley": { "yield_stress_pa": 0.1, "consistency_pa_s_n": 2.0, "flow_index": 0.6 } } },
    "numerics": { "reference_velocity_m_per_s": 0.01 },
    "stop": { "end_time_s": 0.6, "steady": { "tolerance": 1e-9, "check_every_s": 0.02 } },
    "output": { "series": { "count": 120 }, "probes": [{ "name": "profile", "measure": { "profile": { "along": "y" } } }, { "name": "speed", "measure": "max_speed" }] }
}"#;

/// A scene in a folder of its own.
fn scene(name: &str, text: &str) -> PathBuf {
    let path = folder("checkpoints", name).join("scene_of_test.json");
    std::fs::write(&path, text).expect("a written scene");
    path
}

fn command(scene: &Path, more: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lahar"));
    // Large arrays on the stack where nothing is optimised.
    command.arg("run").arg(scene).args(more).arg("--quiet").env("RUST_MIN_STACK", "67108864");
    command
}

fn run(scene: &Path, more: &[&str]) -> Output {
    command(scene, more).output().expect("the command starts")
}

fn message(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Content of all files, without what depends on the clock and the threads.
fn content(out: &Path) -> BTreeMap<String, Vec<u8>> {
    let all = |folder: &Path| {
        let entries =
            std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
        entries.filter(|path| path.is_file()).collect::<Vec<_>>()
    };
    let named = |path: &PathBuf| {
        let name = path.strip_prefix(out).expect("inside").to_string_lossy().into_owned();
        let mut bytes = std::fs::read(path).expect("a file");
        if name == "summary.json" {
            let mut json: serde_json::Value = serde_json::from_slice(&bytes).expect("JSON");
            for key in ["threads", "wall_seconds", "million_updates_per_second"] {
                json.as_object_mut().expect("an object").remove(key);
            }
            bytes = json.to_string().into_bytes();
        }
        (name, bytes)
    };
    [all(out), all(&out.join("plots"))].concat().iter().map(named).collect()
}

/// Waits until a run has written a checkpoint later than `before`, or has ended.
fn next_checkpoint(out: &Path, before: Option<std::time::SystemTime>, child: &mut std::process::Child) {
    let start = Instant::now();
    while child.try_wait().expect("a state").is_none() && (written(out).is_none() || written(out) == before) {
        assert!(start.elapsed() < Duration::from_secs(60), "no checkpoint within a minute");
        std::thread::sleep(Duration::from_millis(1));
    }
}

fn written(out: &Path) -> Option<std::time::SystemTime> {
    std::fs::metadata(out.join("checkpoint.lahar")).and_then(|data| data.modified()).ok()
}

/// Kills a run some times at random moments, goes on every time, and compares its files with those of a straight run.
fn survives(name: &str, text: &str, backend: &str, every: &str, seed: u64) {
    let path = scene(&format!("{name}_{backend}"), text);
    let (straight, killed) = (path.with_file_name("straight"), path.with_file_name("killed"));
    let (straight_name, killed_name) = (straight.to_string_lossy(), killed.to_string_lossy());
    let clock = Instant::now();
    let output = run(&path, &["--out", &straight_name, "--backend", backend, "--threads", "1"]);
    // Soon after one of its checkpoints the other run is under way, even if the machine has become much less busy.
    let soon = clock.elapsed() / 20;
    assert_eq!(output.status.code(), Some(0), "{name}: {}", message(&output));
    // Knuth's generator (The Art of Computer Programming 2, 3.3.4, line 26).
    let mut random = seed;
    let mut kills = 0;
    loop {
        let before = written(&killed);
        let way = if before.is_none() { ["--out", &killed_name] } else { ["--resume", &killed_name] };
        let threads = ["1", "2"][kills % 2];
        let more = ["--checkpoint-every", every, "--backend", backend, "--threads", threads];
        let mut child = command(&path, &[&way[..], &more[..]].concat())
            .stderr(Stdio::piped())
            .spawn()
            .expect("it starts");
        if kills < 3 {
            next_checkpoint(&killed, before, &mut child);
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            std::thread::sleep(soon.mul_f64((random >> 33) as f64 / f64::from(1_u32 << 31)));
            let _ = child.kill();
        }
        let output = child.wait_with_output().expect("an end");
        match output.status.code() {
            None => kills += 1,
            code => {
                assert_eq!(code, Some(0), "{name}: {}", message(&output));
                break;
            }
        }
    }
    assert!(kills > 0, "{name}: it was never killed");
    same(&format!("{name} with the {backend} backend"), &content(&straight), &content(&killed));
}

#[test]
fn a_fluid_goes_on_bit_for_bit() {
    survives("dam", DAM, "fast", "2steps", 1);
    survives("dam", DAM, "plain", "2steps", 2);
    survives("channel", CHANNEL, "fast", "2steps", 3);
    survives("channel", CHANNEL, "plain", "2steps", 4);
}

#[test]
fn grains_go_on_bit_for_bit() {
    survives("grains", GRAINS, "fast", "50steps", 5);
}

#[test]
fn grains_in_a_fluid_go_on_bit_for_bit() {
    survives("both", &grains_in_dam(), "fast", "3steps", 6);
    survives("both", &grains_in_dam(), "plain", "3steps", 7);
}

fn summary_written(out: &Path) -> Option<std::time::SystemTime> {
    std::fs::metadata(out.join("summary.json")).and_then(|data| data.modified()).ok()
}

/// Waits until a run has planned, which may take longer than the run, and has written that it is running.
fn under_way(child: &mut std::process::Child, out: &Path, before: Option<std::time::SystemTime>) {
    while summary_written(out) == before && child.try_wait().is_ok_and(|ended| ended.is_none()) {
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Kills a run as often as it takes to have killed it `kills` times, at moments that know nothing of its checkpoints: some before the
/// first one, some while one is written. A run that comes to its end is compared, and the next one starts in a new folder.
fn survives_many(name: &str, text: &str, backend: &str, every: &str, kills: u32) {
    let path = scene(&format!("{name}_{backend}_{kills}_kills"), text);
    let straight = path.with_file_name("straight");
    let arguments = ["--out", &straight.to_string_lossy(), "--backend", backend, "--threads", "1"];
    let mut child = command(&path, &arguments).stderr(Stdio::piped()).spawn().expect("it starts");
    under_way(&mut child, &straight, None);
    let clock = Instant::now();
    let output = child.wait_with_output().expect("an end");
    // A few kills in the time of a run: it gets on between them even where checkpoints take most of it.
    let longest = clock.elapsed().mul_f64(0.5);
    assert_eq!(output.status.code(), Some(0), "{name}: {}", message(&output));
    let straight = content(&straight);
    // Knuth's generator, as above.
    let mut random = u64::from(kills);
    let (mut killed, mut ended, mut before_any, mut resumed) = (0, 0, 0, 0);
    while killed < kills || ended == 0 {
        let out = path.with_file_name(format!("killed_{ended}"));
        let out_name = out.to_string_lossy();
        let goes_on = written(&out).is_some();
        let way = if goes_on { ["--resume", &out_name] } else { ["--out", &out_name] };
        let threads = ["1", "2"][killed as usize % 2];
        let more = ["--checkpoint-every", every, "--backend", backend, "--threads", threads];
        let before = summary_written(&out);
        let mut child = command(&path, &[&way[..], &more[..]].concat())
            .stderr(Stdio::piped())
            .spawn()
            .expect("it starts");
        resumed += u32::from(goes_on);
        under_way(&mut child, &out, before);
        if killed < kills {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            std::thread::sleep(longest.mul_f64((random >> 33) as f64 / f64::from(1_u32 << 31)));
            let _ = child.kill();
        }
        let output = child.wait_with_output().expect("an end");
        if let Some(code) = output.status.code() {
            assert_eq!(code, 0, "{name} after {killed} kills: {}", message(&output));
            same(&format!("{name} after {killed} kills"), &straight, &content(&out));
            ended += 1;
        } else {
            killed += 1;
            before_any += u32::from(written(&out).is_none());
        }
    }
    println!(
        "{name}, {backend}: {killed} kills, {before_any} before a checkpoint, {resumed} resumed, {ended} runs with equal bits"
    );
    assert!(resumed > kills / 4, "{name}: few of the kills came after a checkpoint");
}

fn same(name: &str, a: &BTreeMap<String, Vec<u8>>, b: &BTreeMap<String, Vec<u8>>) {
    assert_eq!(Vec::from_iter(a.keys()), Vec::from_iter(b.keys()), "{name}");
    for (file, bytes) in a {
        assert!(bytes == &b[file], "{name}: {file} differs");
    }
}

#[test]
#[ignore = "kills 200 runs, which takes minutes: `cargo test --release --test checkpoints -- --ignored --nocapture`"]
fn fifty_kills_of_each_kind_leave_equal_bits() {
    survives_many("dam", DAM, "fast", "2steps", 50);
    survives_many("dam", DAM, "plain", "2steps", 50);
    survives_many("both", &grains_in_dam(), "fast", "3steps", 50);
    survives_many("grains", GRAINS, "fast", "50steps", 50);
}

/// A run that was interrupted, and its folder.
fn interrupted(name: &str) -> (PathBuf, PathBuf) {
    // Ten times as long: it must not be over before the signal comes, on a busy machine either.
    let path = scene(name, &GRAINS.replace(r#""end_time_s": 0.05"#, r#""end_time_s": 0.5"#));
    let out = path.with_file_name("out");
    let name = out.to_string_lossy();
    let mut child = command(&path, &["--out", &name, "--checkpoint-every", "1h"]).spawn().expect("it starts");
    let start = Instant::now();
    while !out.join("series.csv").exists() {
        assert!(start.elapsed() < Duration::from_secs(60), "no series within a minute");
        std::thread::sleep(Duration::from_millis(1));
    }
    let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill starts");
    assert!(kill.success());
    assert_eq!(child.wait().expect("an end").code(), Some(130));
    (path, out)
}

#[test]
fn an_interrupted_run_goes_on_as_if_it_had_not_been() {
    let (path, out) = interrupted("interrupted");
    let name = out.to_string_lossy();
    let output = run(&path, &["--resume", &name]);
    assert_eq!(output.status.code(), Some(0), "{}", message(&output));
    let straight = path.with_file_name("straight");
    assert_eq!(run(&path, &["--out", &straight.to_string_lossy()]).status.code(), Some(0));
    assert_eq!(content(&straight), content(&out));
    // It has come to its end: there is nothing to go on from.
    let output = run(&path, &["--resume", &name]);
    assert_eq!(output.status.code(), Some(2));
    assert!(message(&output).contains("there is no checkpoint"), "{}", message(&output));
}

#[test]
fn checkpoints_that_are_damaged_or_of_something_else_are_refused() {
    let (path, out) = interrupted("refused");
    let name = out.to_string_lossy();
    let file = out.join("checkpoint.lahar");
    let whole = std::fs::read(&file).expect("a checkpoint");
    let refused = |bytes: &[u8], scene: &Path, more: &[&str], part: &str| {
        std::fs::write(&file, bytes).expect("a written file");
        let output = run(scene, &[&["--resume", &name], more].concat());
        assert_eq!(output.status.code(), Some(2), "{part}: {}", message(&output));
        for part in [part, "way out", "checkpoint.lahar"] {
            assert!(message(&output).contains(part), "`{part}` in {}", message(&output));
        }
    };
    for length in [0, 10, 20, whole.len() / 2, whole.len() - 1] {
        refused(&whole[..length], &path, &[], "is damaged");
    }
    for at in [3, 40, whole.len() / 2, whole.len() - 1] {
        let mut bytes = whole.clone();
        bytes[at] ^= 1;
        refused(&bytes, &path, &[], "is damaged");
    }
    let mut later = whole.clone();
    later[16] += 1;
    refused(&later, &path, &[], "is of format 2");
    refused(&whole, &path, &["--until", "0.01"], "is of last step");
    let other = path.with_file_name("other.json");
    std::fs::write(&other, GRAINS.replace("0.003", "0.0031")).expect("a written scene");
    refused(&whole, &other, &[], "is of scene");
    // A fluid has another solver, too.
    let dam = path.with_file_name("dam.json");
    std::fs::write(&dam, DAM).expect("a written scene");
    refused(&whole, &dam, &[], "is of scene");
    // The right one still goes on.
    std::fs::write(&file, &whole).expect("a written file");
    assert_eq!(run(&path, &["--resume", &name]).status.code(), Some(0));
}

#[test]
fn bad_intervals_are_exit_code_2() {
    let path = scene("intervals", GRAINS);
    for interval in ["0s", "-5min", "10", "ten minutes", "1e400h"] {
        let output = lahar(&["run", &path.to_string_lossy(), "--checkpoint-every", interval]);
        assert_eq!(output.status.code(), Some(2), "{interval}");
        assert!(message(&output).contains("`10min`"), "{interval}: {}", message(&output));
    }
}
