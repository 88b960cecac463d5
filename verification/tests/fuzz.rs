//! Mutants of scenes, meshes, tables, series and checkpoints, always the same ones: no panic, no hang, no plan that the run refuses.
#![cfg(unix)]

use std::process::Command;

/// Mutants that are read and planned, and those of them that are small are run: some seconds.
const MUTANTS: u64 = 200;

#[test]
fn mutants_are_refused_or_run() {
    let output = Command::new(env!("CARGO_BIN_EXE_fuzz"))
        .args(["--seed", "1", "--steps", "3", "--count", &MUTANTS.to_string()])
        .output()
        .expect("it starts");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{text}{errors}");
    // Mutants that are all refused at their first letter would show nothing.
    let row = |reader: &str| -> Vec<u64> {
        let line = text.lines().find(|line| line.starts_with(reader)).expect("a row");
        line.split_whitespace().skip(1).map_while(|word| word.parse().ok()).collect()
    };
    let [scenes, refused, accepted, run, ..] = row("scene")[..] else { panic!("{text}") };
    assert_eq!(scenes, MUTANTS * 6 / 10, "{text}");
    assert!(refused > scenes / 4 && accepted > scenes / 10 && run > scenes / 20, "{text}");
    for reader in ["mesh", "table", "series", "checkpoint"] {
        let [all, refused, accepted, ..] = row(reader)[..] else { panic!("{text}") };
        assert!(all == MUTANTS / 10 && refused > 0 && accepted > 0, "{text}");
    }
}
