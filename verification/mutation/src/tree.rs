//! A copy of the project with a sample of mistakes in it.

use crate::points::{self, Point};
use crate::rewrite::{self, Numbered};
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A mistake of the sample.
#[derive(Clone, Debug)]
pub struct Mutant {
    pub number: u32,
    pub folder: String,
    pub file: String,
    pub point: Point,
}

/// The sources of a part of the project, with all their points.
pub struct Part {
    pub folder: String,
    pub files: Vec<(String, Vec<Point>)>,
}

impl Part {
    /// Reads `src/<folder>`, a folder or a file.
    pub fn read(root: &Path, folder: &str) -> Result<Self, String> {
        let mut files = Vec::new();
        for file in sources(root, &format!("src/{folder}"))? {
            let text =
                std::fs::read_to_string(root.join(&file)).map_err(|error| format!("{file}: {error}"))?;
            let points = points::of(&text).map_err(|error| format!("{file}: {error}"))?;
            files.push((file, points));
        }
        Ok(Self { folder: folder.to_owned(), files })
    }

    pub fn count(&self) -> usize {
        self.files.iter().map(|(_, points)| points.len()).sum()
    }

    /// `most` of its points, those with the least hash of what they are: the same ones as long as they are there.
    pub fn sample(&self, most: usize, seed: u64) -> Vec<(String, Point)> {
        let mut all: Vec<_> = self
            .files
            .iter()
            .flat_map(|(file, points)| {
                points.iter().enumerate().map(move |(k, point)| (file.clone(), k, point.clone()))
            })
            .collect();
        all.sort_by_key(|(file, k, point)| {
            hash(format!("{seed}|{file}|{}|{}|{k}", point.function, point.change).as_bytes())
        });
        all.into_iter().take(most).map(|(file, _, point)| (file, point)).collect()
    }
}

/// FNV-1a, then mixed (Fowler, Noll and Vo; Steele et al. 2014).
fn hash(bytes: &[u8]) -> u64 {
    let step = |h: u64, b: &u8| (h ^ u64::from(*b)).wrapping_mul(0x0100_0000_01b3);
    let sum = bytes.iter().fold(0xcbf2_9ce4_8422_2325_u64, step);
    let mixed = (sum ^ (sum >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb)
}

/// The project's own files below a path.
fn sources(root: &Path, below: &str) -> Result<Vec<String>, String> {
    let list = tracked(root)?;
    let dir = format!("{below}/");
    let tests = |file: &str| file.contains("/tests/") || file.ends_with("tests.rs");
    let wanted = |file: &String| {
        file.ends_with(".rs") && !tests(file) && (file.starts_with(&dir) || *file == format!("{below}.rs"))
    };
    Ok(list.into_iter().filter(wanted).collect())
}

fn tracked(root: &Path) -> Result<Vec<String>, String> {
    let arguments = ["ls-files", "--cached", "--others", "--exclude-standard"];
    let output =
        Command::new("git").args(arguments).current_dir(root).output().map_err(|error| error.to_string())?;
    let text = String::from_utf8(output.stdout).map_err(|error| error.to_string())?;
    Ok(text.lines().filter(|file| root.join(file).is_file()).map(str::to_owned).collect())
}

/// What a score depends on: the sample and every file of the project but those of the score.
pub fn fingerprint(root: &Path, sample: &str) -> Result<String, String> {
    let mut parts = vec![sample.to_owned()];
    for file in tracked(root)? {
        if file != "verification/mutation/score.md" && file != "verification/mutation/equivalent.txt" {
            let bytes = std::fs::read(root.join(&file)).map_err(|error| format!("{file}: {error}"))?;
            parts.push(format!("{file} {:016x}", hash(&bytes)));
        }
    }
    Ok(format!("{:016x}", hash(parts.join("\n").as_bytes())))
}

/// Writes the copy; files that are as they should be stay untouched.
pub fn write(root: &Path, copy: &Path, mutants: &[Mutant]) -> Result<(), String> {
    let mut by_file: BTreeMap<&str, Vec<Numbered>> = BTreeMap::new();
    for mutant in mutants {
        by_file.entry(&mutant.file).or_default().push((mutant.number, &mutant.point));
    }
    let count = mutants.iter().map(|mutant| mutant.number as usize + 1).max().unwrap_or(1);
    let io = |file: &str, error: io::Error| format!("{file}: {error}");
    for file in tracked(root)? {
        let mut bytes = std::fs::read(root.join(&file)).map_err(|error| io(&file, error))?;
        if let Some(points) = by_file.get(file.as_str()) {
            let text = String::from_utf8(bytes).map_err(|error| error.to_string())?;
            bytes = rewrite::with_all(&text, points).into_bytes();
        }
        if file == "src/lib.rs" {
            bytes.extend_from_slice(b"\n/// Which mistake is chosen.\n#[doc(hidden)]\npub mod mutated;\n");
        }
        put(&copy.join(&file), &bytes).map_err(|error| io(&file, error))?;
    }
    put(&copy.join("src/mutated.rs"), rewrite::chooser(count).as_bytes())
        .map_err(|error| io("src/mutated.rs", error))
}

fn put(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if std::fs::read(path).is_ok_and(|found| found == bytes) {
        return Ok(());
    }
    std::fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
    std::fs::write(path, bytes)
}

/// Cargo in the copy, with a target folder of its own: packages of the same names in the project's would take each other's
/// place.
pub fn cargo(copy: &Path) -> Command {
    let mut command = Command::new("cargo");
    command.current_dir(copy).env("CARGO_TARGET_DIR", copy.join("target"));
    command
}

/// The mistakes at which the copy does not compile.
pub fn unviable(copy: &Path) -> Result<BTreeSet<u32>, String> {
    let arguments = ["check", "--lib", "--package", "lahar", "--message-format", "json"];
    let output = cargo(copy).args(arguments).output().map_err(|error| error.to_string())?;
    let mut found = BTreeSet::new();
    let mut texts: BTreeMap<PathBuf, String> = BTreeMap::new();
    let mut others = Vec::new();
    for line in String::from_utf8_lossy(&output.stdout).lines() {
        let Ok(message) = serde_json::from_str::<serde_json::Value>(line) else { continue };
        let message = &message["message"];
        if message["level"] != "error" {
            continue;
        }
        let before = found.len();
        for span in message["spans"].as_array().into_iter().flatten() {
            let path = copy.join(span["file_name"].as_str().unwrap_or_default());
            let text = texts
                .entry(path.clone())
                .or_insert_with(|| std::fs::read_to_string(&path).unwrap_or_default());
            let byte = span["byte_start"].as_u64().unwrap_or(0) as usize;
            found.extend(rewrite::at(text, byte));
        }
        let spans = message["spans"].as_array().map_or(0, Vec::len);
        if found.len() == before && spans > 0 {
            others.push(message["rendered"].as_str().unwrap_or_default().to_owned());
        }
    }
    if found.is_empty() && !output.status.success() {
        return Err(format!(
            "the copy does not compile:\n{}{}",
            others.join("\n"),
            String::from_utf8_lossy(&output.stderr)
        ));
    }
    Ok(found)
}
