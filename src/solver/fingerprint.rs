//! Hash and readable digest of a complete state.

use serde::{Deserialize, Serialize};

/// Equal fingerprints: equal bits. The digest says what moved when they differ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fingerprint {
    /// Steps taken.
    pub step: u64,
    /// FNV-1a (64 bit) over the raw bits of all populations of fluid cells, 16 hex digits.
    pub hash: String,
    /// Σ(ρ − 1) over fluid cells.
    pub mass_excess: f64,
    /// Σρu over fluid cells.
    pub momentum: [f64; 3],
    /// Largest speed.
    pub max_speed: f64,
}
