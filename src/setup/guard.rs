//! Why a run does not start, and why it stops by itself.

use crate::dem::DemError;

/// Why a run could not start.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StartError {
    /// The backend has no such feature.
    #[error("backend `{backend}` does not have {feature}")]
    Unsupported {
        /// Backend name.
        backend: &'static str,
        /// What it lacks.
        feature: &'static str,
    },
    /// No backend has both.
    #[error("no backend has both {precision} precision and {feature}: choose double precision")]
    Together {
        /// Of the populations.
        precision: &'static str,
        /// What only the plain backend has.
        feature: &'static str,
    },
    /// A per-cell array has the wrong length.
    #[error("`{field}` has {found} entries, but the box has {expected} cells")]
    Length { field: &'static str, found: usize, expected: usize },
    /// A per-cell number points outside its table.
    #[error("cell {cell} names entry {found} of `{table}`, which has {len} entries")]
    UnknownEntry { table: &'static str, cell: usize, found: usize, len: usize },
    /// Only one of the two faces of an axis is periodic.
    #[error("axis {axis}: one face is periodic and the other is not")]
    HalfPeriodic { axis: char },
    /// Nothing to compute.
    #[error("the box has no fluid cell")]
    NoFluid,
    /// The grains cannot start.
    #[error("grains: {0}")]
    Grains(Box<DemError>),
    /// A fill outside 0..1.
    #[error("cell {cell} has a fill of {found}; allowed: 0 to 1")]
    Fill { cell: usize, found: f64 },
    /// An open face without a free surface.
    #[error("axis {axis}: an open face needs a free surface")]
    OpenWithoutSurface { axis: char },
    /// More cells than this build can index.
    #[error("{cells} cells are more than the {max} this solver can index")]
    TooManyCells { cells: u128, max: u64 },
}

/// Why a run stopped by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stopped {
    /// Step at which the cell was found.
    pub step: u64,
    /// First offending cell in index order.
    pub cell: [usize; 3],
    /// What was found.
    pub what: Runaway,
    /// Relaxation time τ of the cell at that step (infinite when unyielded).
    pub tau: f64,
}

/// The ways a cell fails the guard.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Runaway {
    /// The mass ledger does not close within rounding \[F5\]; the cell is the one that exchanged most.
    Ledger {
        /// Mass gained or lost in this step, relative to the whole.
        residual: f64,
        /// The rounding bound it exceeds.
        bound: f64,
    },
    /// Density or velocity is not a finite number.
    NotFinite,
    /// Density is zero or negative.
    NoDensity {
        /// Density found (lattice units, reference 1).
        density: f64,
    },
    /// The grains could not go on; `Immersed::failure` says why.
    Grains {
        /// The first grain it happened to.
        grain: u32,
    },
    /// A grain is faster than the speed limit (lattice units).
    GrainTooFast {
        /// Its number.
        grain: u32,
        /// Its speed.
        speed: f64,
        /// The limit of the setup.
        limit: f64,
    },
    /// Faster than the speed limit (lattice units).
    TooFast {
        /// Speed found.
        speed: f64,
        /// The limit of the setup.
        limit: f64,
    },
}
