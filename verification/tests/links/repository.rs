//! The repository: its files, and what names can lead to.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::read::*;

/// The directory with `golden`, this package's own or one above it.
pub fn root() -> PathBuf {
    let start = Path::new(env!("CARGO_MANIFEST_DIR"));
    start.ancestors().find(|path| path.join("golden").is_dir()).unwrap_or(start).to_path_buf()
}

/// All files below some places of the repository with one of some endings, sorted; places that do not exist are
/// passed over.
pub fn files(root: &Path, places: &[&str], endings: &[&str]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open: Vec<PathBuf> = places.iter().map(|place| root.join(place)).collect();
    while let Some(path) = open.pop() {
        if path.is_dir() {
            let entries = fs::read_dir(&path).into_iter().flatten().flatten().map(|entry| entry.path());
            open.extend(entries.filter(|entry| !entry.ends_with("target")));
        } else if path.extension().is_some_and(|e| endings.iter().any(|&ending| e == ending)) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// Path and text of files, without this test, which holds wrong names on purpose.
pub fn texts(root: &Path, places: &[&str], endings: &[&str]) -> Vec<(String, String)> {
    let named = |path: PathBuf| {
        let text = fs::read_to_string(&path).ok()?;
        Some((path.strip_prefix(root).unwrap_or(&path).display().to_string(), text))
    };
    let all = files(root, places, endings)
        .into_iter()
        .filter(|path| !path.parent().is_some_and(|folder| folder.ends_with("tests/links")));
    all.filter_map(named).collect()
}

pub const CODE: [&str; 5] = ["src", "verification", "tests", "benches", "examples"];
pub const DOCUMENTS: [&str; 5] = ["README.md", "CONTRIBUTING.md", "docs", "REPORT.md", "verification/report"];
pub const GOLDEN: [&str; 4] = ["golden/records", "golden/mutants", "golden/exhibits", "golden/measured"];

/// What names can lead to.
#[derive(Default)]
pub struct Known {
    /// Claims, mutants, exhibits.
    pub studies: BTreeSet<String>,
    /// Functions and modules.
    pub functions: BTreeSet<String>,
    /// Headings of `docs/method.md`, rows of `docs/errata.md`, sections of `docs/references.md`, cases of
    /// `docs/hard-cases.md`.
    pub tags: BTreeSet<String>,
    pub errata: BTreeSet<u32>,
    pub sections: BTreeSet<u32>,
    pub cases: BTreeSet<u32>,
}

impl Known {
    pub fn of(root: &Path) -> Self {
        let golden = files(root, &GOLDEN, &["json"]);
        let stem = |path: &PathBuf| path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let document = |name: &str| fs::read_to_string(root.join("docs").join(name)).unwrap_or_default();
        let code = texts(root, &CODE, &["rs"]);
        let mut names: BTreeSet<String> = code.iter().flat_map(|(_, text)| functions(text)).collect();
        names.extend(code.iter().filter_map(|(name, _)| stem(&PathBuf::from(name))));
        Self {
            studies: golden.iter().filter_map(stem).collect(),
            functions: names,
            tags: method_headings(&document("method.md")).into_iter().collect(),
            errata: erratum_rows(&document("errata.md")).into_iter().collect(),
            sections: numbered_headings(&document("references.md"), "## ").into_iter().collect(),
            cases: numbered_headings(&document("hard-cases.md"), "### H").into_iter().collect(),
        }
    }

    /// Whether a name in backticks is a study or a function; a star at its end stands for any ending.
    pub fn has(&self, name: &str) -> bool {
        match name.strip_suffix('*') {
            Some(start) => self.studies.iter().chain(&self.functions).any(|known| known.starts_with(start)),
            None => self.studies.contains(name) || self.functions.contains(name),
        }
    }
}
