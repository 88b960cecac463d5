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

/// FNV-1a over 64-bit words.
#[derive(Clone, Copy, Debug)]
pub struct Hasher(u64);

impl Default for Hasher {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Hasher {
    /// Adds the raw bits of one number, byte by byte.
    pub fn number(&mut self, x: f64) {
        for byte in x.to_bits().to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    /// Adds the 19 populations of one cell.
    pub fn cell(&mut self, populations: &[f64; 19]) {
        for &f in populations {
            self.number(f);
        }
    }

    /// The hash as 16 hex digits.
    #[must_use]
    pub fn finish(self) -> String {
        format!("{:016x}", self.0)
    }
}
