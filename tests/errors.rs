//! Every malformed or unphysical scene of `tests/bad_scenes` is refused with a message that says
//! where, what, what is allowed and a way out: by the library, and by the command with exit code 2.

use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::process::Command;

use lahar::plan::grains::GrainPlan;
use lahar::plan::memory::predict;
use lahar::plan::{Layout, Plan, PlanProblem};
use lahar::scene::{self, AnyScene, SceneProblem};

fn bad_scenes() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_scenes");
    let entries = std::fs::read_dir(folder).expect("the folder of bad scenes is part of the package");
    let paths = entries.map(|entry| entry.expect("a readable entry").path());
    // Beside the scenes lie the tables and meshes that some of them name.
    let mut scenes: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|e| e == "json")).collect();
    scenes.sort();
    scenes
}

fn snapshots() -> insta::Settings {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings
}

/// The message, by way of the library; `None` if the scene is accepted. Memory is not looked at,
/// so that messages do not depend on the machine.
fn refusal(path: &Path) -> Option<String> {
    match scene::load(path) {
        Ok(AnyScene::Flow(scene)) => Plan::with_memory(&scene, None).err().map(|error| error.to_string()),
        Ok(AnyScene::Dry(scene)) => GrainPlan::with_memory(&scene, None).err().map(|error| error.to_string()),
        Err(error) => Some(error.to_string()),
    }
}

#[test]
fn refuses_at_least_45_scenes_each_with_its_message() {
    let scenes = bad_scenes();
    assert!(scenes.len() >= 45, "{} bad scenes", scenes.len());
    snapshots().bind(|| {
        for path in scenes {
            let stem = path.file_stem().expect("a file name").to_string_lossy().into_owned();
            let Some(message) = refusal(&path) else { panic!("{stem} was accepted") };
            insta::assert_snapshot!(format!("bad_scene__{stem}"), message);
        }
    });
}

#[test]
fn messages_name_file_allowed_and_way_out_but_no_folder() {
    for path in bad_scenes() {
        let name = path.file_name().expect("a file name").to_string_lossy().into_owned();
        let message = refusal(&path).unwrap_or_default();
        assert!(message.starts_with(&format!("{name}: ")), "{message}");
        assert!(message.contains("\n  way out: "), "{name}: {message}");
        let syntax = message.contains("not JSON");
        assert!(syntax || message.contains("\n  allowed"), "{name}: {message}");
        assert!(!message.contains(env!("CARGO_MANIFEST_DIR")), "{message}");
    }
}

#[test]
fn command_exits_with_2_and_the_same_message() {
    for path in bad_scenes() {
        let output =
            Command::new(env!("CARGO_BIN_EXE_lahar")).arg("plan").arg(&path).output().expect("it starts");
        let name = path.display();
        assert_eq!(output.status.code(), Some(2), "{name}");
        assert_eq!(output.stdout, b"", "{name}");
        let message = refusal(&path).unwrap_or_default();
        assert_eq!(String::from_utf8_lossy(&output.stderr), format!("error: {message}\n"));
    }
}

#[test]
fn refuses_what_does_not_fit_into_memory() {
    let text = include_str!("../scenes/verify/taylor_green_3d.json");
    let scene = scene::flow_from_json(text, "taylor_green_3d.json", Path::new(".")).expect("a good scene");
    // 32³ cells of 496 bytes are 16.3 MB.
    assert!(Plan::with_memory(&scene, Some(16_400_000)).is_ok());
    let error = Plan::with_memory(&scene, Some(16_000_000)).expect_err("too little memory");
    assert!(matches!(*error.problem, PlanProblem::OutOfMemory { cells: 32_768, .. }), "{error}");
    assert_eq!(error.path, "domain");
    snapshot("out_of_memory", &error);
}

/// Gear's method keeps three more derivatives of place, orientation and their likes than velocity Verlet: twelve vectors.
#[test]
fn refuses_grains_that_do_not_fit_by_what_their_integrator_keeps() {
    let text = include_str!("../scenes/grains/hopper.json");
    let bytes = |integrator: &str| {
        let mut json: serde_json::Value = serde_json::from_str(text).expect("JSON");
        json.as_object_mut().expect("an object").remove("$schema");
        json["grains"]["numerics"]["integrator"] = integrator.into();
        let scene =
            scene::dry_from_json(&json.to_string(), "hopper.json", Path::new(".")).expect("a good scene");
        let error = GrainPlan::with_memory(&scene, Some(0)).expect_err("no memory");
        match *error.problem {
            PlanProblem::GrainMemory { grains, bytes, available: 0 } => bytes as f64 / grains as f64,
            ref other => panic!("{other}"),
        }
    };
    let verlet = bytes("verlet");
    assert!(verlet > 1000.0, "{verlet}");
    for gear in ["gear", "gear_conservative"] {
        assert!((bytes(gear) - verlet - 12.0 * 24.0).abs() < 0.5, "{gear}: {} {verlet}", bytes(gear));
    }
}

/// The limit is the prediction of the set-up with all its walls, to the byte.
#[test]
fn refuses_one_byte_too_little_for_walls_and_surfaces() {
    for name in ["verify/square_duct_newtonian", "verify/pipe_bingham", "show/slump_cone"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("scenes/{name}.json"));
        let scene = scene::load_flow(&path).unwrap_or_else(|error| panic!("{error}"));
        for layout in [Layout::EveryCell, Layout::Blocks] {
            let plan = |bytes| Plan::with_layout(&scene, layout, Some(bytes));
            let total = predict(&plan(u64::MAX).expect("a plan").setup, layout).total;
            assert!(plan(total).is_ok(), "{name} {layout:?}");
            let error = plan(total - 1).expect_err("too little memory");
            assert!(matches!(*error.problem, PlanProblem::OutOfMemory { .. }), "{name}: {error}");
        }
    }
}

/// 1500³ cells need 1.7 terabytes: refused by both commands before anything is made.
#[test]
fn commands_refuse_what_does_not_fit() {
    let limit = 3_375_000_000_u64 * 496;
    if lahar::plan::available_memory().is_none_or(|bytes| bytes > limit) {
        // The system does not say what it has, or has it.
        return;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("too_large");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join("too_large.json");
    let text = include_str!("../scenes/verify/taylor_green_3d.json");
    let scene = scene::flow_from_json(text, "taylor_green_3d.json", Path::new(".")).expect("a good scene");
    let mut json: serde_json::Value = serde_json::from_str(text).expect("JSON");
    json["domain"]["spacing_m"] = (scene.domain.size_m[0] / 1500.0).into();
    json.as_object_mut().expect("an object").remove("$schema");
    std::fs::write(&path, json.to_string()).expect("a written scene");
    let out = folder.join("out");
    for arguments in [vec!["plan"], vec!["run", "--out", out.to_str().expect("a path")]] {
        let output = Command::new(env!("CARGO_BIN_EXE_lahar"))
            .args(&arguments)
            .arg(&path)
            .output()
            .expect("it starts");
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        for part in ["3375000000 cells need 641.", " GiB\n  allowed: at most the ", "`domain.spacing_m` of "]
        {
            assert!(message.contains(part), "`{part}` in {message}");
        }
        assert!(!out.exists());
    }
}

#[test]
fn missing_file_is_an_io_error() {
    let error = scene::load(Path::new("no/such/scene.json")).expect_err("there is no such file");
    assert_eq!(*error.problem, SceneProblem::Unreadable { kind: std::io::ErrorKind::NotFound });
    snapshot("missing_file", &error);
    let output = Command::new(env!("CARGO_BIN_EXE_lahar"))
        .args(["plan", "no/such/scene.json"])
        .output()
        .expect("it starts");
    assert_eq!(output.status.code(), Some(4));
}

fn snapshot(name: &str, error: &dyn Display) {
    snapshots().bind(|| insta::assert_snapshot!(name, error.to_string()));
}
