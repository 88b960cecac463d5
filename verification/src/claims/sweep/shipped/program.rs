//! The command `lahar` as its users start it.

use crate::claim::VerifyError;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

/// What a run was.
pub struct Finished {
    pub steps: f64,
    pub seconds: f64,
    pub peak_bytes: f64,
}

/// An error of the command.
pub fn fault(detail: impl ToString) -> VerifyError {
    VerifyError::Numerics { what: "the command lahar", detail: detail.to_string() }
}

/// It lies beside the program of the study.
fn program() -> Result<PathBuf, VerifyError> {
    let path = std::env::current_exe().map_err(fault)?.with_file_name("lahar");
    if path.is_file() {
        Ok(path)
    } else {
        Err(fault(format!("{} is not there: build all programs", path.display())))
    }
}

/// What `lahar plan --json` says.
pub fn plan(scene: &Path) -> Result<Value, VerifyError> {
    let output = Command::new(program()?).arg("plan").arg(scene).arg("--json").output().map_err(fault)?;
    serde_json::from_slice(&output.stdout).map_err(|_| fault(String::from_utf8_lossy(&output.stderr)))
}

/// `lahar run` into a folder, to a time in seconds or to the scene's end.
pub fn run(scene: &Path, out: &Path, until_s: Option<f64>) -> Result<Finished, VerifyError> {
    let mut command = Command::new(program()?);
    command.arg("run").arg(scene).args(["--quiet", "--threads", "1", "--out"]).arg(out).stdin(Stdio::null());
    if let Some(until_s) = until_s {
        command.arg("--until").arg(until_s.to_string());
    }
    let mut child = command.spawn().map_err(fault)?;
    let mut peak_bytes = f64::NAN;
    // Its largest size so far, as long as it lives: what comes in the last five milliseconds is missed.
    while child.try_wait().map_err(fault)?.is_none() {
        peak_bytes = peak_bytes.max(peak(child.id()).unwrap_or(f64::NAN));
        std::thread::sleep(Duration::from_millis(5));
    }
    let text = std::fs::read_to_string(out.join("summary.json")).map_err(fault)?;
    let summary: Value = serde_json::from_str(&text).map_err(fault)?;
    let number = |key: &str| summary[key].as_f64().ok_or_else(|| fault(format!("no `{key}` in the summary")));
    Ok(Finished { steps: number("steps")?, seconds: number("wall_seconds")?, peak_bytes })
}

/// Largest resident size of a process so far, bytes; none where the system does not say.
fn peak(process: u32) -> Option<f64> {
    let text = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(1024.0 * line.trim().strip_suffix("kB")?.trim().parse::<f64>().ok()?)
}
