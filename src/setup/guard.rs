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
    Length {
        /// The array of the set-up.
        field: &'static str,
        /// Its length.
        found: usize,
        /// Cells in the box.
        expected: usize,
    },
    /// A per-cell number points outside its table.
    #[error("cell {cell} names entry {found} of `{table}`, which has {len} entries")]
    UnknownEntry {
        /// The table.
        table: &'static str,
        /// Index of the cell.
        cell: usize,
        /// The entry it names.
        found: usize,
        /// Entries there are.
        len: usize,
    },
    /// Only one of the two faces of an axis is periodic.
    #[error("axis {axis}: one face is periodic and the other is not")]
    HalfPeriodic {
        /// x, y or z.
        axis: char,
    },
    /// Nothing to compute.
    #[error("the box has no fluid cell")]
    NoFluid,
    /// The grains cannot start.
    #[error("grains: {0}")]
    Grains(Box<DemError>),
    /// A fill outside 0..1.
    #[error("cell {cell} has a fill of {found}; allowed: 0 to 1")]
    Fill {
        /// Index of the cell.
        cell: usize,
        /// Its fill.
        found: f64,
    },
    /// A cut cell that cannot be.
    #[error("cut cell {cell} {what}")]
    Cut {
        /// Index of the cell.
        cell: usize,
        /// What is wrong with it.
        what: &'static str,
    },
    /// Cut links, and solids that move or motions that change in time.
    #[error("links are cut where solids lie only while solids rest and no motion changes in time")]
    CutsInMotion,
    /// An open face without a free surface.
    #[error("axis {axis}: an open face needs a free surface")]
    OpenWithoutSurface {
        /// x, y or z.
        axis: char,
    },
    /// A wall of the box that moves out of its plane.
    #[error(
        "axis {axis}: a face that moves has {found} cells per step along its normal; allowed: 0, it slides in its plane"
    )]
    FaceLeaves {
        /// x, y or z.
        axis: char,
        /// The component of its velocity, lattice units.
        found: f64,
    },
    /// A course that says nothing.
    #[error("a course of motion is not finite, or has a table that is empty or whose times do not ascend")]
    Course,
    /// More cells than this build can index.
    #[error("{cells} cells are more than the {max} this solver can index")]
    TooManyCells {
        /// Cells of the box.
        cells: u128,
        /// The most there can be.
        max: u64,
    },
}

/// Why a run stopped by itself.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("stopped at step {step} in cell {cell:?}: {what}")]
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
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Runaway {
    /// The mass ledger does not close within rounding \[F5\]; the cell is the one that exchanged most.
    #[error("mass changed by {residual:.3e} of the whole in one step; rounding allows {bound:.1e}")]
    Ledger {
        /// Mass gained or lost in this step, relative to the whole.
        residual: f64,
        /// The rounding bound it exceeds.
        bound: f64,
    },
    /// A box without a free surface has not kept its mass within rounding; the cell is its first.
    #[error("mass has changed by {residual:.3e} of the whole since the start; rounding allows {bound:.1e}")]
    Mass {
        /// Mass gained or lost since the start, relative to the whole.
        residual: f64,
        /// The rounding bound it exceeds.
        bound: f64,
    },
    /// Density or velocity is not a finite number.
    #[error("density or velocity is not a finite number")]
    NotFinite,
    /// Density is zero or negative.
    #[error("density of {density:.4} times the reference density, which is not > 0")]
    NoDensity {
        /// Density found (lattice units, reference 1).
        density: f64,
    },
    /// The grains could not go on; `Immersed::failure` says why.
    #[error("grain {grain} could not go on")]
    Grains {
        /// The first grain it happened to.
        grain: u32,
    },
    /// A grain is faster than the speed limit (lattice units).
    #[error("grain {grain} moves {speed:.3} cells per step; the limit is {limit}")]
    GrainTooFast {
        /// Its number.
        grain: u32,
        /// Its speed.
        speed: f64,
        /// The limit of the setup.
        limit: f64,
    },
    /// Faster than the speed limit (lattice units).
    #[error("{speed:.3} cells per step; the limit is {limit}")]
    TooFast {
        /// Speed found.
        speed: f64,
        /// The limit of the setup.
        limit: f64,
    },
}
