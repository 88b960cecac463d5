//! The two traits that sit outside the hot loop: a [`Backend`] starts a [`Run`].

use super::layout::Layout;
use crate::coupling::Immersed;
use crate::fingerprint::Fingerprint;
use crate::lattice::Q;
use crate::lattice::moments::{Moments, deviator, magnitude};
use crate::rheology::relaxation::shear_rate_of_omega;
use crate::setup::Setup;
pub use crate::setup::guard::{Runaway, StartError, Stopped};
use crate::state::{StateError, Tape, state};

/// A solver that can run a [`Setup`]. External solvers implement this to be put through the claims.
pub trait Backend: Sync {
    /// Short name, as used on the command line and in records.
    fn name(&self) -> &'static str;

    /// How it lays cells out, for the prediction of its memory. Backends from elsewhere are taken to hold every cell.
    fn layout(&self) -> Layout {
        Layout::EveryCell
    }

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
    fn populations(&self, cell: usize) -> [f64; Q];

    /// Total mass excess Σ(ρ − 1) and momentum Σρu over the fluid cells, summed in index order.
    fn totals(&self) -> Totals;

    /// Hash and digest of the complete state.
    fn fingerprint(&self) -> Fingerprint;

    /// Number of fluid cells now: lattice-site updates per step. With a free surface it changes.
    fn fluid_cells(&self) -> u64;

    /// The ledger of a free-surface run \[F5\]; `None` without a free surface.
    fn ledger(&self) -> Option<Ledger> {
        None
    }

    /// Loads on the numbered solids, in the order of [`Setup::solid_motion`]; empty unless
    /// [`Setup::loads`].
    fn loads(&self) -> Vec<Load> {
        Vec::new()
    }

    /// Bytes held by this run's arrays.
    fn allocated_bytes(&self) -> u64;

    /// The grains in the fluid; `None` without any.
    fn grains(&self) -> Option<&Immersed> {
        None
    }

    /// The grains in the fluid, to be told new motions; `None` without any.
    fn grains_mut(&mut self) -> Option<&mut Immersed> {
        None
    }

    /// Takes the grains that are not kept out of the run; `keep` has one entry per grain. Nothing happens in a run
    /// without grains.
    fn leave(&mut self, keep: &[bool]);

    /// Writes the whole state to a tape, or puts one that was written by a run of the same set-up in place of its own: from there
    /// both go on with the same bits. Grains that had left must have been taken out ([`Self::leave`]).
    ///
    /// # Errors
    /// I/O, another state, or a backend that does not have this.
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let _ = tape;
        Err(StateError::Unsupported)
    }

    /// Seconds spent in each pass since the start; empty where a backend does not keep them. For people:
    /// results never depend on them.
    fn pass_seconds(&self) -> Vec<(&'static str, f64)> {
        Vec::new()
    }
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

/// Where the mass and momentum of a free-surface flow are and where they went \[F5\]. Lattice units;
/// masses are sums of ρ over liquid cells and of m over interface cells.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ledger {
    /// Mass at step 0.
    pub initial_mass: f64,
    /// Mass now, with `parked`.
    pub mass: f64,
    /// Volume missing in partly filled cells without gas neighbour \[F8\], cells.
    pub voids: f64,
    /// Excess that has no receiver at the moment.
    pub parked: f64,
    /// Mass that left through open faces.
    pub outflow: f64,
    /// Mass that came in at walls: rounding, part of `mass_residual`.
    pub from_walls: f64,
    /// (mass + outflow − mass_from_grains − initial)/initial.
    pub mass_residual: f64,
    /// Momentum Σ c f of all fluid cells now, populations f − w.
    pub momentum: [f64; 3],
    /// What the body force brought in so far.
    pub from_force: [f64; 3],
    /// What walls and mirror planes of the box brought in so far.
    pub from_faces: [f64; 3],
    /// What solids brought in so far.
    pub from_solids: [f64; 3],
    /// What the gas brought in so far, through reconstructed populations \[F2\] and open faces.
    pub from_gas: [f64; 3],
    /// What cells brought in by becoming fluid, less what they took by becoming gas.
    pub from_conversions: [f64; 3],
    /// Mass that came in from grains: over their surfaces and with cells they gave free, less what they took by
    /// covering cells.
    pub mass_from_grains: f64,
    /// What grains brought in so far, the same way.
    pub from_grains: [f64; 3],
    /// Largest component of momentum − Σ of the above, absolute.
    pub momentum_residual: f64,
    /// Liquid cells now.
    pub liquid_cells: u64,
    /// Interface cells now.
    pub interface_cells: u64,
    /// Cells that changed kind so far.
    pub conversions: u64,
}

/// Load of the fluid on one solid \[C7\], lattice units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Load {
    /// Force during the last step.
    pub force: [f64; 3],
    /// Torque during the last step about [`crate::setup::SolidMotion::centre`].
    pub torque: [f64; 3],
    /// Sum of the force over all steps.
    pub impulse: [f64; 3],
    /// Wetted area by face: `wetted[axis][0]` is the area whose fluid lies on the low side of the solid.
    /// Partly filled cells count with their fill.
    pub wetted: [[f64; 2]; 3],
}

/// Macroscopic fields in lattice units, one entry per cell, x fastest. Solid and gas cells: ρ = 1, rest
/// zero.
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
    /// Fill φ: 1 in liquid, 0 in gas and solid, m/ρ in between (may leave 0..1 by the margin ε). Empty
    /// without a free surface.
    pub fill: Vec<f64>,
    /// Kind of each cell, [`crate::free_surface::Kind`] as a number: 0 gas, 1 interface, 2 liquid, 3
    /// solid. Empty without a free surface.
    pub kind: Vec<u8>,
}

impl Fields {
    /// Nothing anywhere: density 1, the rest zero; without fill and kind.
    #[must_use]
    pub fn empty(cells: usize) -> Self {
        Self {
            density: vec![1.0; cells],
            velocity: vec![[0.0; 3]; cells],
            stress: vec![[0.0; 6]; cells],
            shear_rate: vec![0.0; cells],
            omega: vec![0.0; cells],
            ..Self::default()
        }
    }

    /// Writes down one cell from its moments and even relaxation rate \[Y2\].
    pub fn record(&mut self, cell: usize, m: &Moments<f64>, omega: f64) {
        let q = deviator(&m.q);
        let weight = 1.0 - 0.5 * omega;
        self.density[cell] = m.rho;
        self.velocity[cell] = m.u;
        self.stress[cell] = q.map(|q| -weight * q);
        self.shear_rate[cell] = shear_rate_of_omega(m.rho, omega, magnitude(&q));
        self.omega[cell] = omega;
    }

    /// Whether a cell holds fluid; `solid`: whether it is solid.
    #[must_use]
    pub fn is_fluid(&self, cell: usize, solid: bool) -> bool {
        !solid && self.kind.get(cell).is_none_or(|&kind| kind == 1 || kind == 2)
    }
}

state!(Load: force torque impulse wetted);
