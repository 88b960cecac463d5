//! What a backend is asked to run: one flow, entirely in lattice units.
//!
//! A [`Setup`] is the only thing that crosses from the scene side (SI units,
//! [`crate::plan`]) to the solver side. Lattice units: Δx = Δt = 1, reference
//! density 1, c_s² = 1/3.

use std::sync::Arc;

pub mod course;
pub mod cuts;
mod force;
pub(crate) mod guard;
pub(crate) mod suspension;

pub use course::{Course, Courses};
pub use cuts::CutCell;
pub use force::BodyForce;
pub use suspension::Suspension;

use crate::collision::CollisionChoice;
use crate::rheology::Law;
pub use crate::rheology::YieldTreatment;

/// What happens to populations that would arrive through one face of the box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Face {
    /// They arrive from the opposite face. Both faces of an axis must agree.
    Periodic,
    /// Half-way no-slip wall at rest \[B1\]; the wall lies half a cell outside the first cell centre.
    NoSlip,
    /// Half-way no-slip wall moving with this velocity (lattice units) \[B1\].
    Moving([f64; 3]),
    /// Mirror plane \[B2\], half a cell outside the first cell centre.
    FreeSlip,
    /// Open to gas at reference pressure: fluid leaves and is debited from the ledger \[F5\]; nothing
    /// comes in. Only with a free surface.
    Open,
}

/// Rigid motion of a solid that stays where it is on the grid: its surface
/// velocity is `velocity + spin × (x − centre)` (004 Eq 3.38, product order corrected).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SolidMotion {
    /// Translation velocity, lattice units.
    pub velocity: [f64; 3],
    /// Angular velocity, radians per step.
    pub spin: [f64; 3],
    /// Centre of rotation, in cells; the centre of cell (i, j, k) is at (i+½, j+½, k+½).
    pub centre: [f64; 3],
}

impl SolidMotion {
    /// Whether its surface has a velocity anywhere.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.velocity != [0.0; 3] || self.spin != [0.0; 3]
    }
}

/// Which wall velocity half-way bounce-back uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WallRule {
    /// \[B1\] as it stands.
    HalfWay,
    /// \[B3\]: corrected for the known slip, so that it does not depend on viscosity.
    ViscosityIndependent,
}

/// In which precision populations (f − w) are kept and computed with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// Both in f64.
    #[default]
    Double,
    /// Both in f32. Walls, the free surface and all sums over cells are in f64, and so is the local solve of
    /// laws with a power or an exponential.
    Single,
    /// Kept in f32, computed with in f64: one rounding per population and step.
    SingleStorage,
}

impl Precision {
    /// Every choice.
    pub const ALL: [Self; 3] = [Self::Double, Self::Single, Self::SingleStorage];

    /// Short name, as in scenes.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Double => "double",
            Self::Single => "single",
            Self::SingleStorage => "single_storage",
        }
    }

    /// Bytes of a population.
    #[must_use]
    pub(crate) const fn bytes(self) -> u64 {
        match self {
            Self::Double => 8,
            Self::Single | Self::SingleStorage => 4,
        }
    }

    /// Roundings, each of at most [`Self::rounding`] times the momentum of a cell, that it suffers in a step.
    ///
    /// Stored in f32: one. Computed in f32 as well: the two sums of five populations (2.3 together, partial
    /// sums of u/6 to u/2), their difference, the half force, the division by ρ and ρ itself (4), ρu and the
    /// half force put back (2), and the ten populations with c_x ≠ 0 rebuilt from half-sums of moments below
    /// 2u/3 (4.7): thirteen.
    #[must_use]
    pub const fn roundings(self) -> f64 {
        match self {
            Self::SingleStorage => 1.0,
            Self::Double | Self::Single => 13.0,
        }
    }

    /// Largest relative error of rounding a population once.
    #[must_use]
    pub const fn rounding(self) -> f64 {
        match self {
            Self::Double => 0.5 * f64::EPSILON,
            // Half the distance from 1 to the next number of 24 bits.
            Self::Single | Self::SingleStorage => 0.5 / 8_388_608.0,
        }
    }
}

/// One point of an initial flow, lattice units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowPoint {
    /// Density; pressure is (density − 1)/3.
    pub density: f64,
    /// Velocity.
    pub velocity: [f64; 3],
    /// `gradient[a][b] = ∂u_a/∂x_b`; starts the populations with the right stress.
    pub gradient: [[f64; 3]; 3],
}

/// Initial flow as a function of the cell index; `None` in [`Setup`] means rest at density 1.
pub type InitialFlow = Arc<dyn Fn([usize; 3]) -> FlowPoint + Send + Sync>;

/// How the body force acts in interface cells \[F3\].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SurfaceForce {
    /// F, as in the bulk.
    Full,
    /// φF: exact hydrostatics at any fill level.
    #[default]
    ByFill,
    /// φF + (1 − φ) times the smoothed acceleration of the liquid neighbours, at most |F|: for flows
    /// that fall freely.
    ByFillAndInertia,
}

/// What a cell that becomes interface starts from \[F4\].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Refill {
    /// Equilibrium at the mean density and velocity of its fluid neighbours.
    #[default]
    Equilibrium,
    /// Equilibrium as above, with the mean non-equilibrium part of those neighbours.
    WithStress,
}

/// Which neighbours take the mass that a conversion leaves over \[F4\].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ExcessRule {
    /// All interface neighbours in equal parts.
    #[default]
    Even,
    /// Interface neighbours in proportion to how far they lie along the surface normal.
    AlongNormal,
}

/// A mass-tracking free surface \[F1\]–\[F6\].
#[derive(Clone, Debug, PartialEq)]
pub struct FreeSurface {
    /// Initial fill φ of every cell, 0 to 1; entries of solid cells are ignored.
    pub fill: Arc<[f64]>,
    /// How the body force acts in interface cells.
    pub force: SurfaceForce,
    /// What new interface cells start from.
    pub refill: Refill,
    /// Where excess mass goes.
    pub excess: ExcessRule,
    /// ε: a cell fills above (1 + ε)ρ and empties below −ερ.
    pub margin: f64,
    /// η: a cell without gas neighbour fills above (1 − η)ρ, one without liquid neighbour empties below ηρ.
    pub lonely_margin: f64,
}

impl FreeSurface {
    /// The default rules for a given initial fill.
    #[must_use]
    pub fn new(fill: Vec<f64>) -> Self {
        Self {
            fill: fill.into(),
            force: SurfaceForce::default(),
            refill: Refill::default(),
            excess: ExcessRule::default(),
            margin: 1e-2,
            lonely_margin: 0.1,
        }
    }
}

/// One flow in lattice units.
#[derive(Clone)]
pub struct Setup {
    /// Cells along x, y, z; x is the fastest index: cell = i + nx (j + ny k).
    pub extents: [usize; 3],
    /// `faces[axis][0]` is the low face, `faces[axis][1]` the high one.
    pub faces: [[Face; 2]; 3],
    /// Per cell: 0 fluid, s > 0 the solid `solid_motion[s − 1]`. Empty: no solid cell.
    pub solids: Vec<u8>,
    /// Motion of each numbered solid.
    pub solid_motion: Vec<SolidMotion>,
    /// How the velocities of faces and solids change in time; constant by default.
    pub courses: Courses,
    /// Where the surfaces of solids cut links, in order of the cells \[B4\]; empty: half-way everywhere.
    pub cuts: Arc<[CutCell]>,
    /// Per cell: index into `fluids`. Empty: all cells hold `fluids[0]`.
    pub fluid_of_cell: Vec<u8>,
    /// The constitutive laws, lattice units.
    pub fluids: Vec<Law>,
    /// How τ follows from the law.
    pub yielding: YieldTreatment,
    /// The collision operator and its parameters.
    pub collision: CollisionChoice,
    /// How walls treat the tangential velocity.
    pub wall_rule: WallRule,
    /// \[K6\] source in the third moments (experimental).
    pub stress_source: bool,
    /// Body force.
    pub force: BodyForce,
    /// Initial flow; `None` is rest at density 1.
    pub initial: Option<InitialFlow>,
    /// The free surface; `None`: fluid fills every cell that is not solid.
    pub free_surface: Option<FreeSurface>,
    /// Grains in the fluid.
    pub grains: Option<Arc<Suspension>>,
    /// Whether the force on every numbered solid is recorded \[C7\].
    pub loads: bool,
    /// A run stops when a cell is faster than this (lattice units) or not finite.
    pub speed_limit: f64,
    /// Precision of the populations.
    pub precision: Precision,
    /// Worker threads; results do not depend on it.
    pub threads: usize,
}

impl Setup {
    /// Speed, cells per step, above which a run is stopped unless a set-up says otherwise: 0.7 of that of sound.
    pub const SPEED_LIMIT: f64 = 0.4;

    /// Whether links can be cut where surfaces lie \[B4\]: while every solid rests and no motion changes in time.
    ///
    /// Beside a turning drum whose axis lies 0.2 to 0.4 cells beside the middle of the grid, fluid gains momentum of
    /// alternating sign without end: a tenth of the rim's speed in 1e4 to 5e4 steps at τ⁺ = 0.55 to 1.
    #[must_use]
    pub fn can_be_cut(&self) -> bool {
        let rests = |solid: &SolidMotion| solid.velocity == [0.0; 3] && solid.spin == [0.0; 3];
        !self.courses.vary() && self.solid_motion.iter().all(rests)
    }

    /// A fluid at rest in a fully periodic box, with the default scheme.
    #[must_use]
    pub fn periodic(extents: [usize; 3], law: Law) -> Self {
        Self {
            extents,
            faces: [[Face::Periodic; 2]; 3],
            solids: Vec::new(),
            solid_motion: Vec::new(),
            courses: Courses::default(),
            cuts: Arc::default(),
            fluid_of_cell: Vec::new(),
            fluids: vec![law],
            yielding: YieldTreatment::Exact,
            collision: CollisionChoice::default(),
            wall_rule: WallRule::ViscosityIndependent,
            stress_source: false,
            force: BodyForce::Constant([0.0; 3]),
            initial: None,
            free_surface: None,
            grains: None,
            loads: false,
            speed_limit: Self::SPEED_LIMIT,
            precision: Precision::Double,
            threads: 1,
        }
    }

    /// A column of `n` cells between two no-slip walls normal to y (plane channel, height n).
    #[must_use]
    pub fn channel(n: usize, law: Law, force_x: f64) -> Self {
        let mut setup = Self::periodic([1, n, 1], law);
        setup.faces[1] = [Face::NoSlip; 2];
        setup.force = BodyForce::Constant([force_x, 0.0, 0.0]);
        setup
    }

    /// Per axis: whether its two faces are one.
    #[must_use]
    pub fn periodic_axes(&self) -> [bool; 3] {
        self.faces.map(|faces| faces[0] == Face::Periodic)
    }

    /// Number of cells in the box, fluid or solid.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.extents.iter().product()
    }

    /// Linear index of cell (i, j, k).
    #[must_use]
    pub fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        i + self.extents[0] * (j + self.extents[1] * k)
    }

    /// Cell (i, j, k) of a linear index.
    #[must_use]
    pub fn coordinates(&self, cell: usize) -> [usize; 3] {
        let [nx, ny, _] = self.extents;
        [cell % nx, (cell / nx) % ny, cell / (nx * ny)]
    }

    /// Whether a cell is solid.
    #[must_use]
    pub fn is_solid(&self, cell: usize) -> bool {
        self.solids.get(cell).is_some_and(|&s| s != 0)
    }

    /// The law of the fluid in a cell.
    #[must_use]
    pub fn law(&self, cell: usize) -> Law {
        self.fluids[self.fluid_of_cell.get(cell).map_or(0, |&f| usize::from(f))]
    }
}
