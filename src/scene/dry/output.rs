//! When a dry run stops and what it writes.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::scene::{Arrested, Cadence, Probe};

/// When the run ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrainStop {
    /// End time, s.
    pub end_time_s: f64,
    /// End earlier when the fastest grain has been slower than a limit for a while.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arrested: Option<Arrested>,
}

/// What is written.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrainOutput {
    /// Grains and contacts for ParaView: at the start and the end only when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grains: Option<Cadence>,
    /// Rows of the time series: 100 when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub series: Option<Cadence>,
    /// What the time series holds; energies and contacts when nothing is named.
    #[serde(default)]
    pub probes: Vec<Probe>,
}
