//! How a backend lays cells out in memory, for the prediction of what a run holds.

use serde::Serialize;

/// How a backend lays cells out in memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Layout {
    /// Every cell of the box has all arrays: the plain backend.
    EveryCell,
    /// Only blocks that hold fluid have arrays: the fast backend.
    #[default]
    Blocks,
}
