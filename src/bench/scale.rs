//! How large the timed flows are.

/// Full size, or about ten times fewer cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// As described.
    Full,
    /// About a tenth of the cells.
    Quick,
}

impl Scale {
    pub(super) const fn pick(self, full: usize, quick: usize) -> usize {
        match self {
            Self::Full => full,
            Self::Quick => quick,
        }
    }
}
