//! The command `lahar`, as a test starts it.

#![allow(dead_code, reason = "each test file uses part of it")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use lahar::output::csv::Series;

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

/// The series of a scene of this package.
pub fn series(file: &str) -> Series {
    let folder = folder("series", &file.replace(['/', '.'], "_"));
    let run = lahar(&["run", file, "--quiet", "--out", folder.to_str().expect("a folder")]);
    assert_eq!(run.status.code(), Some(0), "{file}: {}", String::from_utf8_lossy(&run.stderr));
    Series::read(&folder.join("series.csv")).unwrap_or_else(|error| panic!("{error}"))
}

/// The column of a series whose name begins so.
pub fn column(series: &Series, name: &str) -> Vec<f64> {
    let found = series.columns.iter().position(|column| column.name.starts_with(name));
    let at = found.unwrap_or_else(|| panic!("no {name} in the series"));
    series.rows.iter().map(|row| row[at]).collect()
}
