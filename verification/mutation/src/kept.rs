//! What a run leaves behind for one that goes on.

use crate::runs::Test;
use crate::score::Outcome;
use std::collections::BTreeMap;
use std::fs::OpenOptions;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// Files of a run.
pub struct Kept {
    folder: PathBuf,
}

impl Kept {
    /// The files of the run with this fingerprint; those of another are removed.
    pub fn open(scratch: &Path, fingerprint: &str) -> Result<Self, String> {
        let folder = scratch.join("kept");
        let of = folder.join("of");
        if std::fs::read_to_string(&of).ok().as_deref() != Some(fingerprint) {
            let _ = std::fs::remove_dir_all(&folder);
            std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
            std::fs::write(&of, fingerprint).map_err(|error| format!("{}: {error}", of.display()))?;
        }
        Ok(Self { folder })
    }

    /// The tests and what they reach, if that was finished.
    pub fn tests(&self) -> Result<Option<Vec<Test>>, String> {
        let path = self.folder.join("tests.json");
        if !path.is_file() {
            return Ok(None);
        }
        let bytes = std::fs::read(&path).map_err(|error| error.to_string())?;
        serde_json::from_slice(&bytes).map(Some).map_err(|error| format!("{}: {error}", path.display()))
    }

    /// Keeps the tests; the file is whole or not there.
    pub fn keep_tests(&self, tests: &[Test]) -> Result<(), String> {
        let text = serde_json::to_string(tests).map_err(|error| error.to_string())?;
        let part = self.folder.join("tests.part");
        std::fs::write(&part, text)
            .and_then(|()| std::fs::rename(&part, self.folder.join("tests.json")))
            .map_err(|error| error.to_string())
    }

    /// Outcomes by number of the mistake; a last line that was not finished counts for nothing.
    pub fn outcomes(&self) -> Result<BTreeMap<u32, Outcome>, String> {
        let path = self.folder.join("outcomes.jsonl");
        if !path.is_file() {
            return Ok(BTreeMap::new());
        }
        let text = std::fs::read_to_string(&path).map_err(|error| error.to_string())?;
        Ok(text.lines().filter_map(|line| serde_json::from_str::<(u32, Outcome)>(line).ok()).collect())
    }

    /// Appends an outcome.
    pub fn keep_outcome(&self, number: u32, outcome: &Outcome) -> Result<(), String> {
        let line = serde_json::to_string(&(number, outcome)).map_err(|error| error.to_string())?;
        let mut file = OpenOptions::new()
            .create(true)
            .append(true)
            .open(self.folder.join("outcomes.jsonl"))
            .map_err(|error| error.to_string())?;
        writeln!(file, "{line}").map_err(|error| error.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_goes_on_and_another_starts_anew() {
        let scratch = std::env::temp_dir().join(format!("lahar-mutation-kept-{}", std::process::id()));
        let kept = Kept::open(&scratch, "a").unwrap();
        assert!(kept.tests().unwrap().is_none() && kept.outcomes().unwrap().is_empty());
        kept.keep_tests(&[]).unwrap();
        kept.keep_outcome(3, &Outcome::Noticed("by this".into())).unwrap();
        kept.keep_outcome(5, &Outcome::Survived { left_out: 2 }).unwrap();
        let again = Kept::open(&scratch, "a").unwrap();
        assert!(again.tests().unwrap().is_some_and(|tests| tests.is_empty()));
        let outcomes = again.outcomes().unwrap();
        assert_eq!(outcomes[&3], Outcome::Noticed("by this".into()));
        assert_eq!(outcomes[&5], Outcome::Survived { left_out: 2 });
        let other = Kept::open(&scratch, "b").unwrap();
        assert!(other.tests().unwrap().is_none() && other.outcomes().unwrap().is_empty());
        std::fs::remove_dir_all(&scratch).unwrap();
    }
}
