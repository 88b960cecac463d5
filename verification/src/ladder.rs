//! Ladders: which rungs are evaluated, and which of them a tolerance applies to.

use serde::{Deserialize, Serialize};

use super::claim::{Claim, Ladder, Rung};

/// How much of a ladder is evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Depth {
    /// The rungs of `cargo test`.
    Short,
    /// All rungs.
    Full,
}

impl Ladder {
    /// The rungs of a depth.
    #[must_use]
    pub fn rungs(&self, depth: Depth) -> &'static [f64] {
        match depth {
            Depth::Short => self.short,
            Depth::Full => self.full,
        }
    }

    /// The parameter's name without its explanation: `N` of `N (cells across)`.
    #[must_use]
    pub fn symbol(&self) -> &'static str {
        symbol(self.parameter)
    }
}

/// The part of a parameter's name before ` (`.
#[must_use]
pub fn symbol(parameter: &str) -> &str {
    parameter.split(" (").next().unwrap_or(parameter)
}

impl Rung {
    /// Whether a tolerance applies to rung `parameter` of a ladder that ends with `last`.
    #[must_use]
    pub fn covers(self, parameter: f64, last: f64) -> bool {
        match self {
            Self::Every => true,
            Self::Last => parameter.to_bits() == last.to_bits(),
            Self::At(at) => parameter.to_bits() == at.to_bits(),
        }
    }

    /// In words: `every rung`, `the last rung`, `N = 64`.
    #[must_use]
    pub fn describe(self, ladder: &Ladder) -> String {
        match self {
            Self::Every => "every rung".to_owned(),
            Self::Last => "the last rung".to_owned(),
            Self::At(at) => format!("{} = {at}", ladder.symbol()),
        }
    }
}

/// What is wrong with a claim's declaration; empty if nothing is. Tests demand that it is empty.
#[must_use]
pub fn faults(claim: &Claim) -> Vec<String> {
    let mut faults = Vec::new();
    let mut check = |good: bool, fault: &str| {
        if !good {
            faults.push(format!("claim `{}`: {fault}", claim.id));
        }
    };
    // A point for ids that name a parameter: `…-0.6`.
    let kebab = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-' || c == '.';
    let Ladder { short, full, parameter } = claim.ladder;
    check(!claim.id.is_empty() && claim.id.chars().all(kebab), "the id is not kebab-case");
    check(!claim.title.trim().is_empty(), "no title");
    check(!claim.tags.is_empty(), "no equation tag");
    check(!claim.measures.trim().is_empty(), "does not say what is measured");
    check(!claim.reference.source.trim().is_empty(), "does not name its reference");
    check(claim.reference.uncertainty >= 0.0, "the reference's uncertainty is negative or NaN");
    check(!claim.tolerance.because.trim().is_empty(), "the tolerance has no reason");
    check(claim.tolerance.value >= 0.0, "the tolerance is negative or NaN");
    check(!parameter.trim().is_empty(), "the ladder's parameter has no name");
    check(!short.is_empty(), "the short ladder is empty");
    let contained = short.iter().all(|s| full.iter().any(|f| f.to_bits() == s.to_bits()));
    check(contained, "a short rung is missing from the full ladder");
    let distinct = |rungs: &[f64]| rungs.iter().enumerate().all(|(k, a)| !rungs[..k].contains(a));
    check(distinct(short) && distinct(full), "a rung occurs twice");
    check(claim.order.is_none() || short.len() >= 3, "an order needs at least three short rungs");
    if let Rung::At(at) = claim.tolerance.at {
        check(short.contains(&at), "the tolerance's rung is not in the short ladder");
    }
    faults
}
