//! The log of golden files.

use std::fmt::Write as _;

use super::{Golden, GoldenError, revision, today};
use lahar::output::atomic;

impl Golden {
    /// Appends what a command changed, and why.
    ///
    /// # Errors
    /// The log cannot be read or written.
    pub fn log_change(&self, command: &str, reason: &str, lines: &[String]) -> Result<(), GoldenError> {
        let path = self.log();
        let head =
            "# Log of golden files\n\nEvery change of a golden record, with its reason; newest last.\n";
        let mut text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => head.to_owned(),
            Err(source) => return Err(GoldenError::Read { path, source }),
        };
        let reason = reason.split_whitespace().collect::<Vec<_>>().join(" ");
        let after = revision().map_or_else(String::new, |r| format!(", after revision {r}"));
        let _ = write!(text, "\n## {}{after}: {command}\n\n{reason}\n\n", today());
        if lines.is_empty() {
            text.push_str("- no number changed\n");
        }
        for line in lines {
            let _ = writeln!(text, "{line}");
        }
        Ok(atomic::write(&path, text.as_bytes())?)
    }
}
