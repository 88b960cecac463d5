//! The command `lahar`, as a test starts it.

#![allow(dead_code, reason = "each test file uses part of it")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Runs it from the root of the repository.
pub fn lahar(arguments: &[&str]) -> Output {
    let command = Command::new(env!("CARGO_BIN_EXE_lahar")).args(arguments).current_dir(root()).output();
    command.expect("the command starts")
}

/// The root of the repository.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// An empty folder of a test's own.
pub fn folder(group: &str, name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(group).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}
