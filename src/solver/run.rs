//! The two traits that sit outside the hot loop: a [`Backend`] starts a [`Run`].

use super::fingerprint::Fingerprint;
use super::setup::Setup;

/// A solver that can run a [`Setup`]. External solvers implement this to be put through the claims.
pub trait Backend: Sync {
    /// Short name, as used on the command line and in records.
    fn name(&self) -> &'static str;

    /// Allocates and initialises a run.
    ///
    /// # Errors
    /// The setup asks for something this backend does not have, or is inconsistent.
    fn start(&self, setup: &Setup) -> Result<Box<dyn Run>, StartError>;
}

/// A flow being stepped.
pub trait Run {
    /// Advances by `steps` time steps.
    ///
    /// # Errors
    /// A guard stopped the run; the fields are those of the step named in the error.
    fn advance(&mut self, steps: u64) -> Result<(), Stopped>;

    /// Steps taken so far.
    fn step(&self) -> u64;

    /// The setup this run was started from.
    fn setup(&self) -> &Setup;

    /// Macroscopic fields at the current step.
    fn fields(&self) -> Fields;

    /// Populations of one cell, stored as f − w_i \[L7\].
    fn populations(&self, cell: usize) -> [f64; 19];

    /// Total mass excess Σ(ρ − 1) and momentum Σρu over the fluid cells, summed in index order.
    fn totals(&self) -> Totals;

    /// Hash and digest of the complete state.
    fn fingerprint(&self) -> Fingerprint;

    /// Number of fluid cells: lattice-site updates per step.
    fn fluid_cells(&self) -> u64;

    /// Bytes held by this run's arrays.
    fn allocated_bytes(&self) -> u64;
}

/// Sums over all fluid cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Totals {
    /// Σ(ρ − 1), lattice mass units.
    pub mass_excess: f64,
    /// Σρu (u with half the force), lattice units.
    pub momentum: [f64; 3],
    /// Σ½ρu², lattice units.
    pub kinetic_energy: f64,
}

/// Macroscopic fields in lattice units, one entry per cell, x fastest. Solid cells: ρ = 1, rest zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fields {
    /// Density ρ.
    pub density: Vec<f64>,
    /// Velocity u, with half the force \[L4\].
    pub velocity: Vec<[f64; 3]>,
    /// Deviatoric stress xx, yy, zz, xy, xz, yz (viscous part, sign of +2μS).
    pub stress: Vec<[f64; 6]>,
    /// Shear rate magnitude γ̇ = √(2 S:S) \[Y2\].
    pub shear_rate: Vec<f64>,
    /// Even relaxation rate ω⁺ = 1/τ; 0 in an unyielded cell.
    pub omega: Vec<f64>,
}

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
    /// Density or velocity is not a finite number.
    NotFinite,
    /// Density is zero or negative.
    NoDensity {
        /// Density found (lattice units, reference 1).
        density: f64,
    },
    /// Faster than the speed limit (lattice units).
    TooFast {
        /// Speed found.
        speed: f64,
        /// The limit of the setup.
        limit: f64,
    },
}
