//! How many of several keys a scene may give.

use std::fmt;

/// How many of several keys a scene gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeyRule {
    /// One of them, or none.
    AtMostOne,
    /// One of them.
    ExactlyOne,
    /// The least and the largest of one kind.
    OnePair,
}

impl KeyRule {
    pub(super) fn way_out(self, found: &[&str]) -> &'static str {
        match self {
            Self::OnePair => "give the least and the largest of one kind, and nothing else",
            Self::AtMostOne | Self::ExactlyOne if found.is_empty() => "add one of them",
            Self::AtMostOne | Self::ExactlyOne => "keep one of them",
        }
    }
}

impl fmt::Display for KeyRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::AtMostOne => "at most one",
            Self::ExactlyOne => "exactly one",
            Self::OnePair => "one min-max pair",
        })
    }
}
