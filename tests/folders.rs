//! The folder of a run holds the files of one run.

mod program;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Output;

use program::{folder, lahar, root};

const SCENE: &str = "scenes/verify/channel_newtonian.json";

fn run(scene: &str, out: &Path, more: &[&str]) -> Output {
    lahar(&[&["run", scene, "--out", &out.to_string_lossy(), "--until", "0.01"], more].concat())
}

fn message(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Files of a folder and of its plots, by their path from it.
fn files(out: &Path) -> BTreeSet<String> {
    let all = |folder: PathBuf| {
        let entries =
            std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
        entries.filter(|path| path.is_file()).collect::<Vec<_>>()
    };
    let names = [all(out.to_path_buf()), all(out.join("plots"))].concat();
    names.iter().map(|path| path.strip_prefix(out).expect("inside").to_string_lossy().into_owned()).collect()
}

#[test]
fn a_second_run_leaves_of_the_first_only_what_is_not_lahar_s() {
    let out = folder("folders", "reused");
    let first = run("scenes/verify/film_newtonian.json", &out, &[]);
    assert_eq!(first.status.code(), Some(0), "{}", message(&first));
    let before = files(&out);
    std::fs::write(out.join("notes.txt"), "mine").expect("a file");
    std::fs::write(out.join("plots/mine.svg"), "mine").expect("a file");
    // What a killed run may leave.
    std::fs::write(out.join(".lahar-1-1.part"), "half").expect("a file");
    let second = run(SCENE, &out, &[]);
    assert_eq!(second.status.code(), Some(0), "{}", message(&second));
    let removed = format!("note: removed {} files of an earlier run", before.len() - 1);
    assert!(message(&second).contains(&removed), "{removed}: {}", message(&second));
    let after = files(&out);
    let list = std::fs::read_to_string(out.join("lahar_files.txt")).expect("a list");
    let mut expected: BTreeSet<String> = list.lines().skip(1).map(str::to_owned).collect();
    expected.extend(["lahar_files.txt", "notes.txt", "plots/mine.svg"].map(str::to_owned));
    assert_eq!(after, expected);
    assert!(before.contains("surface.pvd") && !after.contains("surface.pvd"));
    // The same run by itself leaves the same files.
    let alone = folder("folders", "alone");
    assert_eq!(run(SCENE, &alone, &["--quiet"]).status.code(), Some(0));
    expected.retain(|name| name != "notes.txt" && name != "plots/mine.svg");
    assert_eq!(files(&alone), expected);
}

#[test]
fn a_run_that_is_to_be_kept_is_kept() {
    let out = folder("folders", "kept");
    assert_eq!(run(SCENE, &out, &["--keep"]).status.code(), Some(0));
    let before = files(&out);
    let refused = run(SCENE, &out, &["--keep"]);
    assert_eq!(refused.status.code(), Some(2), "{}", message(&refused));
    for part in ["holds an earlier run (`", "allowed", "way out: name another folder with `--out`"] {
        assert!(message(&refused).contains(part), "{part}: {}", message(&refused));
    }
    assert_eq!(files(&out), before);
}

#[test]
fn files_of_unknown_origin_are_neither_removed_nor_mixed_with() {
    for name in ["fields_000107.vti", "series.csv", "scene.json", "lahar_files.txt"] {
        let out = folder("folders", &format!("stranger_{}", name.replace('.', "_")));
        std::fs::write(out.join(name), "not lahar's").expect("a file");
        let refused = run(SCENE, &out, &[]);
        assert_eq!(refused.status.code(), Some(2), "{name}: {}", message(&refused));
        assert!(message(&refused).contains(&format!("holds `{name}`")), "{name}: {}", message(&refused));
        assert_eq!(std::fs::read_to_string(out.join(name)).expect("it is there"), "not lahar's");
    }
}

#[test]
fn one_run_at_a_time() {
    let out = folder("folders", "locked");
    let list = std::fs::File::create(out.join("lahar_files.txt")).expect("a list");
    if list.try_lock().is_err() {
        // Files cannot be locked here.
        return;
    }
    let refused = run(SCENE, &out, &[]);
    assert_eq!(refused.status.code(), Some(4), "{}", message(&refused));
    assert!(message(&refused).contains("another run writes into this folder"), "{}", message(&refused));
    drop(list);
    assert_eq!(run(SCENE, &out, &[]).status.code(), Some(0));
}

#[test]
fn scene_and_plan_lie_beside_the_results() {
    let out = folder("folders", "copies");
    assert_eq!(run(SCENE, &out, &["--quiet"]).status.code(), Some(0));
    let read = |path: &Path| {
        std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    };
    assert_eq!(read(&out.join("scene.json")), read(&root().join(SCENE)));
    let plan = lahar(&["plan", SCENE, "--json"]);
    assert_eq!(read(&out.join("plan.json")), String::from_utf8_lossy(&plan.stdout));
    // A scene that lies in the folder under that name stays as it is, and is not lahar's to remove.
    let own = folder("folders", "own_scene");
    let scene = own.join("scene.json");
    std::fs::copy(root().join(SCENE), &scene).expect("a copy");
    for _ in 0..2 {
        let output = run(&scene.to_string_lossy(), &own, &["--quiet"]);
        assert_eq!(output.status.code(), Some(0), "{}", message(&output));
        assert_eq!(read(&scene), read(&root().join(SCENE)));
    }
}
