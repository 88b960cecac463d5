//! `REPORT.md`: a document made from the golden files alone.
//!
//! [`render()`] is a pure function; [`command`] reads the golden files, writes the report with its
//! figures, or checks that both are current.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::claims::studies;
use crate::exhibit::ExhibitRecord;
use crate::golden::{Golden, GoldenError, rejudge};
use crate::mutant::MutantRecord;
use crate::record::Record;
use crate::study::Study;
use lahar::output::{OutputError, atomic, svg};

pub mod figures;
pub mod format;
mod render;
mod trace;

pub use render::render;

/// One study as the report needs it.
pub struct Chapter {
    /// Id of the study.
    pub id: String,
    /// Heading.
    pub title: String,
    /// Introduction, Markdown.
    pub intro: String,
    /// Known limits, sentences.
    pub limits: Vec<String>,
    /// Claims with a golden record, judged by their present declaration.
    pub records: Vec<Record>,
    /// Exhibits with their captions; the timed ones carry date and machine.
    pub exhibits: Vec<(String, ExhibitRecord)>,
    /// Mutants.
    pub mutants: Vec<MutantRecord>,
    /// Ids of claims, exhibits and mutants without a golden file.
    pub missing: Vec<String>,
}

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A golden file cannot be used.
    #[error(transparent)]
    Golden(#[from] GoldenError),
    /// A figure or the report cannot be written.
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

/// Makes `REPORT.md` and `golden/figures/*.svg` from the golden files under `root`; with `check`
/// nothing is written, and the outcome says whether the files on disk are the ones that would be.
///
/// # Errors
/// [`ReportError`] for files that cannot be read or written.
pub fn command(root: &Path, check: bool) -> Result<ReportOutcome, ReportError> {
    let golden = Golden::under(root);
    let chapters = studies().iter().map(|s| chapter(s, &golden)).collect::<Result<Vec<_>, _>>()?;
    let files = files(&chapters)?;
    let superfluous = superfluous(root, &golden, &files)?;
    if check {
        let stale = |(path, text): (&PathBuf, &String)| -> Result<Option<PathBuf>, ReportError> {
            let same = match std::fs::read_to_string(root.join(path)) {
                // A checkout may have changed the line ends.
                Ok(found) => found.replace("\r\n", "\n") == *text,
                Err(error) if error.kind() == std::io::ErrorKind::NotFound => false,
                Err(source) => return Err(ReportError::Io { path: path.clone(), doing: "read", source }),
            };
            Ok((!same).then(|| path.clone()))
        };
        let stale = files.iter().map(stale).collect::<Result<Vec<_>, _>>()?;
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

/// Report and figures: path relative to the root, and content.
fn files(chapters: &[Chapter]) -> Result<BTreeMap<PathBuf, String>, ReportError> {
    let mut files = BTreeMap::from([(PathBuf::from("REPORT.md"), render(chapters))]);
    for chapter in chapters {
        let records: Vec<&Record> = chapter.records.iter().collect();
        let exhibits = chapter.exhibits.iter().flat_map(|(_, e)| figures::of_exhibit(e));
        for (name, plot) in figures::convergence(&chapter.id, &records).into_iter().chain(exhibits) {
            files.insert(Path::new("golden/figures").join(name), svg::draw(&plot)?);
        }
    }
    Ok(files)
}

/// Figures on disk that no record asks for any more.
fn superfluous(
    root: &Path,
    golden: &Golden,
    files: &BTreeMap<PathBuf, String>,
) -> Result<Vec<PathBuf>, ReportError> {
    let folder = golden.figures();
    let entries = match std::fs::read_dir(&folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(source) => return Err(ReportError::Io { path: folder, doing: "read", source }),
    };
    let mut found = Vec::new();
    for entry in entries {
        let path =
            entry.map_err(|source| ReportError::Io { path: folder.clone(), doing: "read", source })?.path();
        let relative = path.strip_prefix(root).unwrap_or(&path).to_path_buf();
        if path.extension().is_some_and(|e| e == "svg") && !files.contains_key(&relative) {
            found.push(relative);
        }
    }
    found.sort();
    Ok(found)
}

fn chapter(study: &Study, golden: &Golden) -> Result<Chapter, ReportError> {
    let mut chapter = Chapter {
        id: study.id.to_owned(),
        title: study.title.to_owned(),
        intro: study.intro.to_owned(),
        limits: study.limits.iter().map(|&l| l.to_owned()).collect(),
        records: Vec::new(),
        exhibits: Vec::new(),
        mutants: Vec::new(),
        missing: Vec::new(),
    };
    for claim in study.claims {
        match golden.record(claim.id)? {
            Some(mut record) => {
                let in_ladder = |p: f64| claim.ladder.full.iter().any(|f| f.to_bits() == p.to_bits());
                record.samples.retain(|s| in_ladder(s.parameter));
                chapter.records.push(rejudge(claim, &record.samples));
            }
            None => chapter.missing.push(claim.id.to_owned()),
        }
    }
    for exhibit in study.exhibits {
        match golden.exhibit(exhibit.id, exhibit.timed)? {
            Some(record) => chapter.exhibits.push((exhibit.caption.to_owned(), record)),
            None => chapter.missing.push(exhibit.id.to_owned()),
        }
    }
    for mutant in study.mutants {
        match golden.mutant(mutant.id)? {
            Some(record) => chapter.mutants.push(record),
            None => chapter.missing.push(mutant.id.to_owned()),
        }
    }
    Ok(chapter)
}
