//! `REPORT.md` and `verification/report/*.md`: documents made from the golden files alone.
//!
//! [`render()`] is a pure function from [`Chapter`]s to files; [`command`] reads the golden files, writes
//! the documents with their figures, or checks that all of them are current.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::claims::studies;
use crate::figures;
use crate::golden::{Golden, GoldenError};
use lahar::output::{OutputError, atomic, svg};

mod chapter;
mod claim;
mod equations;
mod exhibits;
mod index;
mod ladders;
mod mutants;
mod page;
mod papers;
pub mod text;

pub use chapter::{Chapter, Entry, Tried};

/// Where the chapters stand, relative to the root of the repository.
const FOLDER: &str = "verification/report";

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A golden file cannot be used.
    #[error(transparent)]
    Golden(#[from] GoldenError),
    /// A figure or a document cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A file cannot be read or removed.
    #[error("cannot {doing} {}: {source}", path.display())]
    Io { path: PathBuf, doing: &'static str, source: std::io::Error },
}

/// What came of [`command`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ReportOutcome {
    /// The files were written.
    Written { files: usize },
    /// Check: everything is as the golden files say.
    Current,
    /// Check: these files are missing, different or superfluous (paths relative to the root).
    Stale { files: Vec<PathBuf> },
}

/// Makes the documents. Pure: the same chapters give the same bytes.
///
/// # Returns
/// Path relative to the root of the repository, and content.
#[must_use]
pub fn render(chapters: &[Chapter]) -> BTreeMap<PathBuf, String> {
    let mut files = BTreeMap::from([
        (PathBuf::from("REPORT.md"), index::render(chapters)),
        (Path::new(FOLDER).join(equations::FILE), equations::render(chapters)),
        (Path::new(FOLDER).join(ladders::FILE), ladders::render(chapters)),
    ]);
    for (k, chapter) in chapters.iter().enumerate() {
        files.insert(Path::new(FOLDER).join(page::file(k, chapter)), page::render(k, chapter));
    }
    files
}

/// Makes the documents and `golden/figures/*.svg` from the golden files under `root`; with `check`
/// nothing is written, and the outcome says whether the files on disk are the ones that would be.
///
/// # Errors
/// [`ReportError`] for files that cannot be read or written.
pub fn command(root: &Path, check: bool) -> Result<ReportOutcome, ReportError> {
    let golden = Golden::under(root);
    let evaluations = golden.evaluations()?;
    let chapters = studies().iter().map(|s| Chapter::read(s, &golden, &evaluations));
    let files = files(&chapters.collect::<Result<Vec<_>, _>>()?)?;
    let superfluous = superfluous(root, &files)?;
    if check {
        let stale = files.iter().map(|(path, text)| stale(root, path, text));
        let stale = stale.collect::<Result<Vec<_>, _>>()?;
        let files: Vec<PathBuf> = stale.into_iter().flatten().chain(superfluous).collect();
        return Ok(if files.is_empty() { ReportOutcome::Current } else { ReportOutcome::Stale { files } });
    }
    for (path, text) in &files {
        atomic::write(&root.join(path), text.as_bytes())?;
    }
    for path in superfluous {
        let remove = std::fs::remove_file(root.join(&path));
        remove.map_err(|source| ReportError::Io { path, doing: "remove", source })?;
    }
    Ok(ReportOutcome::Written { files: files.len() })
}

/// The path, if the file on disk is not this text.
fn stale(root: &Path, path: &Path, text: &str) -> Result<Option<PathBuf>, ReportError> {
    let same = match std::fs::read_to_string(root.join(path)) {
        // A checkout may have changed the line ends.
        Ok(found) => found.replace("\r\n", "\n") == text,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => false,
        Err(source) => return Err(ReportError::Io { path: path.to_owned(), doing: "read", source }),
    };
    Ok((!same).then(|| path.to_owned()))
}

/// Documents and figures: path relative to the root, and content.
fn files(chapters: &[Chapter]) -> Result<BTreeMap<PathBuf, String>, ReportError> {
    let mut files = render(chapters);
    for chapter in chapters {
        let exhibits = chapter.exhibits.iter().flat_map(|(_, e)| figures::of_exhibit(e));
        for (name, plot) in figures::convergence(&chapter.id, &chapter.records()).into_iter().chain(exhibits)
        {
            files.insert(Path::new("golden/figures").join(name), svg::draw(&plot)?);
        }
    }
    Ok(files)
}

/// Figures and chapters on disk that no record asks for any more.
fn superfluous(root: &Path, files: &BTreeMap<PathBuf, String>) -> Result<Vec<PathBuf>, ReportError> {
    let mut found = Vec::new();
    for (folder, ending) in [("golden/figures", "svg"), (FOLDER, "md")] {
        let folder = root.join(folder);
        let entries = match std::fs::read_dir(&folder) {
            Ok(entries) => entries,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => continue,
            Err(source) => return Err(ReportError::Io { path: folder, doing: "read", source }),
        };
        for entry in entries {
            let entry =
                entry.map_err(|source| ReportError::Io { path: folder.clone(), doing: "read", source })?;
            let path = entry.path();
            let relative = path.strip_prefix(root).unwrap_or(&path).to_path_buf();
            if path.extension().is_some_and(|e| e == ending) && !files.contains_key(&relative) {
                found.push(relative);
            }
        }
    }
    found.sort();
    Ok(found)
}
