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
