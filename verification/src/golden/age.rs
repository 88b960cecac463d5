//! Which golden numbers are older than the code that makes them.

use std::path::Path;
use std::process::Command;

use crate::study::Study;

/// Code that can move no number of a claim, below `src`.
const APART: [&str; 4] = ["src/bench", "src/main.rs", "src/output", "src/run/folder.rs"];

/// Files of the code behind a study's numbers that have changed since a revision; `None` where there is no git, or no such
/// revision in it.
#[must_use]
pub fn changed_since(root: &Path, study: &Study, revision: &str) -> Option<Vec<String>> {
    let mut git = Command::new("git");
    git.arg("-C").arg(root).args([
        "diff",
        "--name-only",
        revision,
        "HEAD",
        "--",
        "src",
        "verification/src/exact",
    ]);
    git.arg(format!("verification/src/claims/{}", folder(root, study)));
    git.args(APART.map(|path| format!(":!{path}")));
    let output = git.output().ok().filter(|output| output.status.success())?;
    let text = String::from_utf8(output.stdout).ok()?;
    Some(text.lines().map(str::to_owned).collect())
}

/// Where a study's claims are: `free_surface` of `free-surface`, `piles` of `grains-piles`.
fn folder(root: &Path, study: &Study) -> String {
    let whole = study.id.replace('-', "_");
    let last = study.id.rsplit('-').next().unwrap_or(study.id).to_owned();
    let there = |name: &String| root.join("verification/src/claims").join(name).is_dir();
    if there(&whole) { whole } else { last }
}
