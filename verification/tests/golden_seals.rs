//! Golden files are what was blessed, to the digit: also the rungs and exhibits that no test computes.

use std::path::{Path, PathBuf};

use lahar_verification::claims::studies;
use lahar_verification::golden::{Breach, Golden, package_root};

#[test]
fn golden_files_are_as_they_were_blessed() {
    let golden = Golden::here();
    let breaches = golden.seals().unwrap().breaches(&golden, studies()).unwrap();
    let lines: Vec<String> = breaches.iter().map(|(key, breach)| format!("golden/{key} {breach}")).collect();
    assert!(
        lines.is_empty(),
        "{}\nnumbers come from studies with --bless; after a merge: cargo run --release --bin verify -- --stamp REASON",
        lines.join("\n")
    );
}

/// A copy of the golden files, without the figures.
fn copy(name: &str) -> (PathBuf, Golden) {
    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join("seals").join(name);
    let _ = std::fs::remove_dir_all(&root);
    let from = package_root().join("golden");
    for folder in ["records", "exhibits", "measured", "mutants"] {
        let to = root.join("golden").join(folder);
        std::fs::create_dir_all(&to).unwrap();
        for entry in std::fs::read_dir(from.join(folder)).unwrap() {
            let entry = entry.unwrap();
            std::fs::copy(entry.path(), to.join(entry.file_name())).unwrap();
        }
    }
    for file in ["seals.json", "evaluated.json"] {
        std::fs::copy(from.join(file), root.join("golden").join(file)).unwrap();
    }
    (root.join("golden"), Golden::under(&root))
}

fn breaches(golden: &Golden) -> Vec<(String, Breach)> {
    golden.seals().unwrap().breaches(golden, studies()).unwrap()
}

/// Puts another digit in place of the last one of a file.
fn change_a_digit(path: &Path) {
    let mut bytes = std::fs::read(path).unwrap();
    let at = bytes.iter().rposition(u8::is_ascii_digit).expect("a digit");
    bytes[at] = if bytes[at] == b'7' { b'8' } else { b'7' };
    std::fs::write(path, bytes).unwrap();
}

#[test]
fn limit_a_changed_digit_is_found_on_every_shelf() {
    let (folder, golden) = copy("digit");
    assert_eq!(breaches(&golden), []);
    let mut keys = [
        "exhibits/film-profiles.json",
        "measured/grains-speed.json",
        "mutants/stress-sign.json",
        "records/duct-square.json",
    ];
    keys.iter().for_each(|key| change_a_digit(&folder.join(key)));
    keys.sort_unstable();
    let mut found = breaches(&golden);
    found.sort_by(|a, b| a.0.cmp(&b.0));
    assert_eq!(found, keys.map(|key| (key.to_owned(), Breach::Changed)));
}

#[test]
fn limit_what_is_said_about_an_evaluation_is_sealed_too() {
    let (folder, golden) = copy("evaluation");
    let path = folder.join("evaluated.json");
    let text = std::fs::read_to_string(&path).unwrap();
    let mut all: serde_json::Value = serde_json::from_str(&text).unwrap();
    all["duct-square"]["date"] = "2020-02-02".into();
    std::fs::write(&path, all.to_string()).unwrap();
    assert_eq!(breaches(&golden), [("records/duct-square.json".to_owned(), Breach::Changed)]);
}

#[test]
fn files_that_are_gone_or_strange_are_found_and_a_stamp_changes_no_number() {
    let (folder, golden) = copy("strange");
    std::fs::remove_file(folder.join("records/duct-square.json")).unwrap();
    std::fs::write(folder.join("records/nobody.json"), "{}\n").unwrap();
    change_a_digit(&folder.join("exhibits/film-profiles.json"));
    let expected = [
        ("records/nobody.json".to_owned(), Breach::Undeclared),
        ("exhibits/film-profiles.json".to_owned(), Breach::Changed),
        ("records/duct-square.json".to_owned(), Breach::Missing),
    ];
    assert_eq!(breaches(&golden), expected);
    let before = std::fs::read(folder.join("exhibits/film-profiles.json")).unwrap();
    golden.stamp(studies()).unwrap();
    assert_eq!(breaches(&golden), expected[..1]);
    assert_eq!(std::fs::read(folder.join("exhibits/film-profiles.json")).unwrap(), before);
}
