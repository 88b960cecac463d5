//! The table of the score and the list of what nothing noticed.

use crate::tree::{Mutant, Part};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;

/// What became of a mistake.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Outcome {
    /// By this test.
    Noticed(String),
    /// Tests that reach it and were left out, since they would have taken too long.
    Survived { left_out: usize },
    /// No test comes by.
    NotReached,
    /// The value is the same, for this reason.
    Equivalent(String),
}

/// One mistake and its outcome.
#[derive(Clone, Debug)]
pub struct Row {
    pub folder: String,
    pub place: String,
    pub change: String,
    pub outcome: Outcome,
}

/// Reasons why a mistake is none, by file, function and change.
pub type Reasons = BTreeMap<String, String>;

fn key(file: &str, function: &str, change: &str) -> String {
    format!("{file} | {function} | {change}")
}

/// Reads `equivalent.txt`: `file | function | change | reason` on each line, `#` before remarks.
pub fn equivalent(root: &Path) -> Result<Reasons, String> {
    let path = root.join("verification/mutation/equivalent.txt");
    let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let lines = text.lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
    lines
        .map(|line| match line.splitn(4, " | ").collect::<Vec<_>>()[..] {
            [file, function, change, reason] => Ok((key(file, function, change), reason.to_owned())),
            _ => Err(format!("{}: not `file | function | change | reason`: {line}", path.display())),
        })
        .collect()
}

impl Row {
    pub fn new(mutant: &Mutant, outcome: Outcome, equivalent: &Reasons) -> Self {
        let Mutant { folder, file, point, .. } = mutant;
        let reason = equivalent.get(&key(file, &point.function, &point.change));
        let outcome = match (outcome, reason) {
            (Outcome::Survived { .. } | Outcome::NotReached, Some(reason)) => {
                Outcome::Equivalent(reason.clone())
            }
            (outcome, _) => outcome,
        };
        let place = format!("{file} | {}", point.function);
        Self { folder: folder.clone(), place, change: point.change.clone(), outcome }
    }
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { place, change, .. } = self;
        match &self.outcome {
            Outcome::Noticed(test) => write!(f, "{place} | {change}: noticed by {test}"),
            Outcome::Survived { left_out } => {
                write!(f, "{place} | {change}: SURVIVED, {left_out} tests left out")
            }
            Outcome::NotReached => write!(f, "{place} | {change}: NOT REACHED"),
            Outcome::Equivalent(reason) => write!(f, "{place} | {change}: no mistake, {reason}"),
        }
    }
}

/// The interval of a share at 95 % (Wilson 1927), in per cent.
fn wilson(good: usize, of: usize) -> (f64, f64) {
    let (n, z) = (of as f64, 1.96);
    let p = good as f64 / n;
    let middle = p + z * z / (2.0 * n);
    let half = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
    let scale = 100.0 / (1.0 + z * z / n);
    (scale * (middle - half).max(0.0), scale * (middle + half))
}

/// The score of each part and of all, then what nothing noticed.
/// `most_s`: seconds of tests that each mistake met at most.
pub fn table(parts: &[Part], rows: &[Row], seed: u64, most_s: u64) -> String {
    let mut text = format!(
        "# Mutation score\n\nMistakes of one operator or one returned value, drawn from all that the syntax allows (seed {seed}); those that do \
         not compile are not counted. Each meets the tests that reach it, the quickest first, up to {most_s} s of them; what \
         only later ones would notice counts as not noticed, so a score is a lower bound. Written by `lahar-mutation`; what it does is in its `main.rs`.\n\n\
         | part | possible | tried | the same value | noticed | score | 95 % |\n| --- | --- | --- | --- | --- | --- | --- |\n"
    );
    let mut line = |name: &str, possible: usize, folder: Option<&str>| {
        let of: Vec<&Row> =
            rows.iter().filter(|row| folder.is_none_or(|folder| row.folder == folder)).collect();
        let tried = of.len();
        let same = of.iter().filter(|row| matches!(row.outcome, Outcome::Equivalent(_))).count();
        let noticed = of.iter().filter(|row| matches!(row.outcome, Outcome::Noticed(_))).count();
        let (low, high) = wilson(noticed, (tried - same).max(1));
        let score = 100.0 * noticed as f64 / (tried - same).max(1) as f64;
        text += &format!(
            "| {name} | {possible} | {tried} | {same} | {noticed} | {score:.0} % | {low:.0} to {high:.0} % |\n"
        );
    };
    for part in parts {
        line(&part.folder, part.count(), Some(&part.folder));
    }
    line("all", parts.iter().map(Part::count).sum(), None);
    text += "\n## Survived\n\n";
    for row in rows {
        if let Outcome::Survived { left_out } = row.outcome {
            let rest = if left_out > 0 { format!(" (tests left out: {left_out})") } else { String::new() };
            text += &format!("- {} | {}{rest}\n", row.place, row.change);
        }
    }
    text += "\n## Reached by no test\n\n";
    for row in rows.iter().filter(|row| row.outcome == Outcome::NotReached) {
        text += &format!("- {} | {}\n", row.place, row.change);
    }
    text += "\n## The same value\n\n";
    for row in rows {
        if let Outcome::Equivalent(reason) = &row.outcome {
            text += &format!("- {} | {}: {reason}\n", row.place, row.change);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interval_of_a_share() {
        // Wilson's interval of 8 in 10 (Newcombe 1998, method 3, without correction): 49.0 to 94.3 %.
        let (low, high) = wilson(8, 10);
        assert!((low - 49.02).abs() < 0.01 && (high - 94.33).abs() < 0.01, "{low} {high}");
    }
}
