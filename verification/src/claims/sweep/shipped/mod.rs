//! The scenes that come with lahar: what their plans say, and what their runs did.

mod exact;
mod program;

use crate::claim::VerifyError;
use crate::exhibit::{Entry, Exhibit, ExhibitData, Table};
use crate::golden::package_root;
use program::Finished;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Longest run, planned seconds: of longer ones the first part is made.
const LONGEST_S: f64 = 40.0;
/// The same for the short form.
const SHORT_S: f64 = 0.05;

/// Plans against runs.
pub const SHIPPED: Exhibit = Exhibit {
    id: "plans-and-runs",
    caption: "Every scene of `scenes`, run as its plan says by `lahar run` on one thread. Where the plan takes more than 40 s \
              only that share of its end time was run; steps and seconds are of it, and fluid that spreads has not spread. Steps: fewer than planned where the flow was \
              steady before. Memory: the largest resident size of the process; a plan counts what a scene needs, the program \
              itself takes 5 to 10 MiB. Errors where the scene has a closed form and the plan an interval.",
    timed: true,
    run: |_, full| {
        let root = package_root();
        let mut table = Table::new("Plans and runs", &COLUMNS);
        for path in files(&root.join("scenes"))? {
            if let Some(row) = row(&root, &path, if full { LONGEST_S } else { SHORT_S })? {
                table.push(row);
            }
        }
        Ok(ExhibitData { tables: vec![table], ..ExhibitData::default() })
    },
};

const COLUMNS: [&str; 10] = [
    "scene",
    "share of its end time",
    "steps planned",
    "steps made",
    "MiB planned",
    "MiB used",
    "s planned",
    "s taken",
    "error expected, %",
    "error, %",
];

/// Scene files of a folder and its folders, in order.
fn files(folder: &Path) -> Result<Vec<PathBuf>, VerifyError> {
    let mut found = Vec::new();
    let mut entries: Vec<PathBuf> =
        std::fs::read_dir(folder).map_err(program::fault)?.flatten().map(|entry| entry.path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            found.extend(files(&path)?);
        } else if path.extension().is_some_and(|e| e == "json") && !path.ends_with("scene.schema.json") {
            found.push(path);
        }
    }
    Ok(found)
}

/// A row of the table; none for what takes too long in the short form.
fn row(root: &Path, path: &Path, longest_s: f64) -> Result<Option<Vec<Entry>>, VerifyError> {
    let plan = program::plan(path)?;
    let number = |key: &str| plan[key].as_f64().unwrap_or(f64::NAN);
    let share = (longest_s / number("estimated_seconds")).min(1.0);
    if longest_s < LONGEST_S && share < 1.0 {
        return Ok(None);
    }
    let out = root.join("target/plans-and-runs");
    let Finished { steps, seconds, peak_bytes } =
        program::run(path, &out, (share < 1.0).then(|| share * number("end_time_s")))?;
    let mib = |bytes: f64| bytes / f64::from(1 << 20);
    let bytes = plan["bytes_at_most"].as_f64().unwrap_or_else(|| number("bytes"));
    let error = if share < 1.0 { None } else { exact::error(path, &out)? };
    let name = path.strip_prefix(root).unwrap_or(path).display().to_string();
    let percent = |of: &str, end: &str| {
        interval(&plan, of).map_or(f64::NAN, |found| 100.0 * found[end].as_f64().unwrap_or(f64::NAN))
    };
    let (expected, found) = error.map_or((String::new(), String::new()), |(of, error)| {
        (
            format!("{:.2} to {:.2}: {of}", percent(of, "low"), percent(of, "high")),
            format!("{:.3}", 100.0 * error),
        )
    });
    Ok(Some(vec![
        name.into(),
        share.into(),
        (share * number("steps")).round().into(),
        steps.into(),
        mib(bytes).into(),
        mib(peak_bytes).into(),
        (share * number("estimated_seconds")).into(),
        seconds.into(),
        expected.into(),
        found.into(),
    ]))
}

/// The interval of an error in a plan.
fn interval<'a>(plan: &'a Value, of: &str) -> Option<&'a Value> {
    plan["expected"]["measured"]["errors"].as_array()?.iter().find(|error| error["of"] == of)
}
