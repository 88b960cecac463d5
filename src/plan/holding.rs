//! Which warnings hold, and how they are written.

use serde::{Serialize, Serializer};

use super::warning::Warning;

impl Serialize for Warning {
    /// Its text.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// The warnings whose condition holds.
pub(super) fn holding(warnings: impl IntoIterator<Item = (bool, Warning)>) -> Vec<Warning> {
    warnings.into_iter().filter_map(|(holds, warning)| holds.then_some(warning)).collect()
}

impl Warning {
    /// Whether a warning about grains by themselves also holds for grains in a fluid, which holds them and has a cost
    /// of its own.
    #[must_use]
    pub(crate) const fn holds_in_a_fluid(&self) -> bool {
        !matches!(self, Self::FallForEver | Self::Days { .. })
    }
}
