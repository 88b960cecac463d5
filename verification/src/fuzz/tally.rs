//! What came of mutants, counted.

use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

use super::mutant::Reader;

/// What came of a mutant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Refused, with a message.
    Refused,
    /// Read and planned; too large to be run, or not to be run.
    Accepted,
    /// Run to the last step.
    Ran,
    /// Run, and stopped by a guard, with a message.
    Stopped,
    /// What must not be, in words.
    Fault(String),
}

impl fmt::Display for Outcome {
    /// In one line.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refused => out.write_str("refused"),
            Self::Accepted => out.write_str("accepted"),
            Self::Ran => out.write_str("ran"),
            Self::Stopped => out.write_str("stopped"),
            Self::Fault(what) => write!(out, "fault {}", what.replace('\n', " ")),
        }
    }
}

impl FromStr for Outcome {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        Ok(match text.split_once(' ').unwrap_or((text, "")) {
            ("refused", "") => Self::Refused,
            ("accepted", "") => Self::Accepted,
            ("ran", "") => Self::Ran,
            ("stopped", "") => Self::Stopped,
            ("fault", what) => Self::Fault(what.to_owned()),
            _ => return Err(()),
        })
    }
}

/// Counts of one reader.
#[derive(Clone, Copy, Debug, Default)]
struct Counts {
    all: u64,
    refused: u64,
    ran: u64,
    stopped: u64,
    faults: u64,
    slowest_s: f64,
}

/// Counts by reader.
#[derive(Clone, Debug, Default)]
pub struct Tally(BTreeMap<Reader, Counts>);

impl Tally {
    /// Adds a mutant.
    pub fn add(&mut self, reader: Reader, outcome: &Outcome, seconds: f64) {
        let counts = self.0.entry(reader).or_default();
        counts.all += 1;
        counts.slowest_s = counts.slowest_s.max(seconds);
        match outcome {
            Outcome::Refused => counts.refused += 1,
            Outcome::Accepted => {}
            Outcome::Ran => counts.ran += 1,
            Outcome::Stopped => counts.stopped += 1,
            Outcome::Fault(_) => counts.faults += 1,
        }
    }

    /// Faults of all readers.
    #[must_use]
    pub fn faults(&self) -> u64 {
        self.0.values().map(|counts| counts.faults).sum()
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(out, "reader      mutants  refused  accepted  of these run  stopped  faults  slowest [s]")?;
        for (reader, c) in &self.0 {
            let accepted = c.all - c.refused - c.faults;
            let name = format!("{reader:?}").to_lowercase();
            let ran = c.ran + c.stopped;
            writeln!(
                out,
                "{name:10} {:8} {:8} {accepted:9} {ran:13} {:8} {:7} {:12.2}",
                c.all, c.refused, c.stopped, c.faults, c.slowest_s
            )?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outcomes_come_back_from_their_line() {
        let fault = Outcome::Fault("two\nlines".to_owned());
        assert_eq!(fault.to_string().parse(), Ok(Outcome::Fault("two lines".to_owned())));
        for outcome in [Outcome::Refused, Outcome::Accepted, Outcome::Ran, Outcome::Stopped] {
            assert_eq!(outcome.to_string().parse(), Ok(outcome));
        }
        assert!("begun".parse::<Outcome>().is_err());
    }
}
