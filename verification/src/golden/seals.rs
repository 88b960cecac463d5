//! Seals of golden files: what tells a digit that was changed by hand, also where no test computes it again.
//!
//! A seal holds a hash over a file and over what is said about when it was computed. Blessing makes it. It guards against slips, of
//! people and of merges, not against people who want to deceive: they can make a seal, too, but not without a line in the log.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::{Evaluations, Golden, GoldenError, Shelf, revision, today, write};
use crate::study::Study;
use lahar::run::summary::hash;

/// One seal.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Seal {
    /// Over the content, the revision and date below, and for a claim its last evaluation.
    pub hash: String,
    /// The revision the working copy was based on when the numbers were computed; `None` if unknown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub revision: Option<String>,
    /// The day (UTC) on which they were.
    pub date: String,
}

/// Seals by file below `golden`: `records/abc-flow.json`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Seals(pub BTreeMap<String, Seal>);

/// What is wrong with a golden file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Breach {
    /// Its content, or what is said about its evaluation, is not what was sealed.
    Changed,
    /// It has no seal.
    Unsealed,
    /// There is a seal and no file.
    Missing,
    /// No study declares what it holds.
    Undeclared,
}

impl std::fmt::Display for Breach {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(match self {
            Self::Changed => "is not what was blessed",
            Self::Unsealed => "was never blessed",
            Self::Missing => "is gone",
            Self::Undeclared => "belongs to nothing that a study declares",
        })
    }
}

impl Shelf {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Records, Self::Exhibits, Self::Measured, Self::Mutants];
}

/// Where the file of a study's claim, exhibit or mutant is kept.
pub fn files(study: &Study) -> impl Iterator<Item = (Shelf, &'static str)> {
    let exhibit = |timed| if timed { Shelf::Measured } else { Shelf::Exhibits };
    let claims = study.claims.iter().map(|c| (Shelf::Records, c.id));
    let exhibits = study.exhibits.iter().map(move |e| (exhibit(e.timed), e.id));
    claims.chain(exhibits).chain(study.mutants.iter().map(|m| (Shelf::Mutants, m.id)))
}

/// The key of a file.
#[must_use]
pub fn key(shelf: Shelf, id: &str) -> String {
    format!("{}/{id}.json", shelf.folder())
}

impl Seals {
    /// Seals a file as it is now, as computed now.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn seal(
        &mut self,
        golden: &Golden,
        evaluations: &Evaluations,
        shelf: Shelf,
        id: &str,
    ) -> Result<(), GoldenError> {
        self.seal_as_of(golden, evaluations, (shelf, id), (revision(), today()))
    }

    /// Seals a file as it is now, as computed at a revision on a day.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn seal_as_of(
        &mut self,
        golden: &Golden,
        evaluations: &Evaluations,
        (shelf, id): (Shelf, &str),
        (revision, date): (Option<String>, String),
    ) -> Result<(), GoldenError> {
        let mut seal = Seal { hash: String::new(), revision, date };
        seal.hash = seal.over(golden, evaluations, shelf, id)?;
        self.0.insert(key(shelf, id), seal);
        Ok(())
    }

    /// What is wrong with golden files, by key; nothing if they are what was blessed.
    ///
    /// # Errors
    /// Files that cannot be read.
    pub fn breaches(
        &self,
        golden: &Golden,
        studies: &[&Study],
    ) -> Result<Vec<(String, Breach)>, GoldenError> {
        let evaluations = golden.evaluations()?;
        let declared: BTreeSet<String> =
            studies.iter().copied().flat_map(files).map(|(s, id)| key(s, id)).collect();
        let mut found = Vec::new();
        let mut seen = BTreeSet::new();
        for shelf in Shelf::ALL {
            for id in golden.ids(shelf)? {
                let key = key(shelf, &id);
                match self.0.get(&key) {
                    _ if !declared.contains(&key) => found.push((key.clone(), Breach::Undeclared)),
                    None => found.push((key.clone(), Breach::Unsealed)),
                    Some(seal) if seal.over(golden, &evaluations, shelf, &id)? != seal.hash => {
                        found.push((key.clone(), Breach::Changed));
                    }
                    Some(_) => {}
                }
                seen.insert(key);
            }
        }
        let gone = self.0.keys().filter(|key| !seen.contains(*key));
        found.extend(gone.map(|key| (key.clone(), Breach::Missing)));
        Ok(found)
    }
}

impl Seal {
    fn over(
        &self,
        golden: &Golden,
        evaluations: &Evaluations,
        shelf: Shelf,
        id: &str,
    ) -> Result<String, GoldenError> {
        let path = golden.path(shelf, id);
        let mut bytes =
            std::fs::read(&path).map_err(|source| GoldenError::Read { path: path.clone(), source })?;
        // Some checkouts end lines in their own way.
        bytes.retain(|&byte| byte != b'\r');
        let evaluation = (shelf == Shelf::Records).then(|| evaluations.0.get(id)).flatten();
        let about = serde_json::to_string(&(&self.revision, &self.date, evaluation));
        bytes.extend(about.map_err(|source| GoldenError::Json { path, source })?.bytes());
        Ok(hash(&bytes))
    }
}

impl Golden {
    /// Where the seals are kept.
    #[must_use]
    pub fn seals_file(&self) -> std::path::PathBuf {
        self.root.join("seals.json")
    }

    /// The seals; empty if there is no such file.
    ///
    /// # Errors
    /// The file is there but cannot be read.
    pub fn seals(&self) -> Result<Seals, GoldenError> {
        Ok(super::read(&self.seals_file())?.unwrap_or_default())
    }

    /// Ids of the files of a shelf, in order.
    ///
    /// # Errors
    /// The folder cannot be read.
    pub fn ids(&self, shelf: Shelf) -> Result<Vec<String>, GoldenError> {
        let path = self.root.join(shelf.folder());
        let entries = std::fs::read_dir(&path).and_then(Iterator::collect::<std::io::Result<Vec<_>>>);
        let entries = entries.map_err(|source| GoldenError::Read { path, source })?;
        let id = |name: &Path| Some(name.to_str()?.strip_suffix(".json")?.to_owned());
        let mut ids: Vec<String> = entries.iter().filter_map(|e| id(Path::new(&e.file_name()))).collect();
        ids.sort();
        Ok(ids)
    }

    /// Seals what differs from its seal, as it is: after a merge, whose numbers nobody has computed in one piece. No number is
    /// written.
    ///
    /// # Returns
    /// The keys of what was sealed, and of seals that were dropped because their file is gone.
    ///
    /// # Errors
    /// Files that cannot be read or written.
    pub fn stamp(&self, studies: &[&Study]) -> Result<Vec<(String, Breach)>, GoldenError> {
        let (mut seals, evaluations) = (self.seals()?, self.evaluations()?);
        let found = seals.breaches(self, studies)?;
        for (key, breach) in &found {
            let place = Shelf::ALL.into_iter().find_map(|shelf| {
                let id = key.strip_prefix(shelf.folder())?.strip_prefix('/')?.strip_suffix(".json")?;
                Some((shelf, id))
            });
            match (breach, place) {
                (Breach::Changed | Breach::Unsealed, Some((shelf, id))) => {
                    let of_claim = (shelf == Shelf::Records).then(|| evaluations.0.get(id)).flatten();
                    let when = match of_claim {
                        Some(e) => (e.revision.clone(), e.date.clone()),
                        None => last_change(&self.path(shelf, id)),
                    };
                    seals.seal_as_of(self, &evaluations, (shelf, id), when)?;
                }
                (Breach::Missing, _) => drop(seals.0.remove(key)),
                _ => {}
            }
        }
        write(&self.seals_file(), &seals)?;
        Ok(found)
    }
}

/// Revision and day of the last change of a file under version control; no revision and today without one.
fn last_change(path: &Path) -> (Option<String>, String) {
    let folder = path.parent().unwrap_or(Path::new("."));
    let git = std::process::Command::new("git")
        .arg("-C")
        .arg(folder)
        .args(["log", "-1", "--format=%h %cs", "--"])
        .arg(path)
        .output();
    let text = git.ok().filter(|o| o.status.success()).and_then(|o| String::from_utf8(o.stdout).ok());
    let found = text.as_deref().and_then(|text| text.trim().split_once(' '));
    found.map_or_else(|| (None, today()), |(revision, date)| (Some(revision.to_owned()), date.to_owned()))
}
