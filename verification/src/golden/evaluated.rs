//! When and how far claims were last evaluated.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::ladder::Depth;

/// The last evaluation of every claim, by id.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Evaluations(pub BTreeMap<String, Evaluation>);

/// One evaluation whose numbers are kept as golden ones.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Evaluation {
    /// Short or full ladder.
    pub depth: Depth,
    /// The revision the working copy was based on; `None` if unknown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub revision: Option<String>,
    /// The day (UTC), `2026-11-22`.
    pub date: String,
    /// Processor and cores; `None` if unknown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub machine: Option<String>,
}

impl Evaluation {
    /// An evaluation of today, here.
    #[must_use]
    pub fn now(depth: Depth) -> Self {
        let place = super::circumstances();
        Self { depth, revision: super::revision(), date: place.date, machine: Some(place.machine) }
    }
}
