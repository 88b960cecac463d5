//! What can be wrong with a scene once it is put into numbers.

use super::text::{human, relaxation, short};
use super::ways::Ways;
use crate::scene::{Located, Operator};

/// A problem found while planning a scene.
pub type PlanError = Located<PlanProblem>;

/// What is wrong. Every message says what was found, what is allowed and why, and a way out.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the message above each variant says what its fields are")]
pub enum PlanProblem {
    /// No fluid cell left.
    #[error(
        "solids cover all {cells} cells\n  \
         allowed: at least one fluid cell; a cell is solid if its centre is inside\n  \
         way out: smaller solids, a finer `domain.spacing_m`, or check `invert`"
    )]
    SolidEverywhere { cells: u64 },
    /// A shape between the cell centres.
    #[error(
        "`{name}` holds no cell centre\n  \
         allowed: shapes with at least one; a cell belongs to a shape if its centre is inside\n  \
         way out: a shape larger than the spacing of {spacing} m, or a finer spacing"
    )]
    NoCellCovered { name: String, spacing: f64 },
    /// A moving solid that would not stay where it is.
    #[error(
        "`{name}` would leave its place: its motion carries its surface at ({:.6}, {:.6}, {:.6}) m out of it or into the \
         fluid, but cells of a solid stay where they are\n  \
         allowed: solids that turn about their own axis (cylinders, spheres, rings) or slide along themselves (a belt \
         through the whole box, along a periodic axis or from wall to wall) [B1]\n  \
         way out: remove the motion (a gate that is opened: leave it out from the start), set `centre_m` on the axis, or \
         move a part of the box with `moving_wall`", .at_m[0], .at_m[1], .at_m[2])]
    SolidLeaves { name: String, at_m: [f64; 3] },
    /// Cut links, and solids that move or motions that change in time.
    #[error(
        "`central_linear` in a scene where a solid moves, or a motion changes in time\n  \
         allowed: `central_linear` with solids at rest and steady walls of the box, `half_way` with all\n  \
         way out: leave out `numerics.solid_surface`, or the motions"
    )]
    CutsInMotion,
    /// As good as no fluid.
    #[error(
        "the fluid is at most {} m deep, {} cells of {spacing} m: it has no surface in any of them\n  \
         allowed: at least {least} cells; a layer of less than 4 is not resolved\n  \
         way out: more fluid, or a `domain.spacing_m` of at most a quarter of the depth",
        short(*depth), short(*depth / *spacing)
    )]
    NoDepth { depth: f64, spacing: f64, least: f64 },
    /// A part of the initial fluid that is nowhere.
    #[error(
        "`{name}` fills no cell\n  \
         allowed: fluid in at least one cell at time 0\n  \
         way out: a place inside the box and a size of about the spacing of {spacing} m or more"
    )]
    NoCellFilled { name: String, spacing: f64 },
    /// A part of the initial fluid that lies in solids.
    #[error(
        "`{name}` fills no cell: all of it lies inside {solids}\n  \
         allowed: parts that reach out of the solids; what is inside them does not count\n  \
         way out: move it, remove it, or take a recess out of the solid with `difference`"
    )]
    FluidInsideSolids { name: String, solids: String },
    /// No air to move into.
    #[error(
        "{fluid} of {cells} cells hold fluid, {solids} are solid, and no empty cell can be reached: there is no \
         free surface\n  \
         allowed: fluid that has room to move into\n  \
         way out: less fluid, open up the solids, or leave out `fluid.initial` for a box full of fluid"
    )]
    NoRoom { fluid: u64, solids: u64, cells: u64 },
    /// Fluid at an open face.
    #[error(
        "fluid touches the open face {face} at time 0 in {cells} cells, the first at ({:.6}, {:.6}, {:.6}) m\n  \
         allowed: open faces that fluid reaches later; here it would drain from the first step on\n  \
         way out: make {face} a wall, or leave at least one cell of air before it", .at_m[0], .at_m[1], .at_m[2])]
    OpenUnderFluid { face: &'static str, cells: u64, at_m: [f64; 3] },
    /// A recess that is none.
    #[error(
        "takes nothing away: no cell centre is inside both\n  \
         allowed: parts that remove at least one cell\n  \
         way out: move it to where `from` is, make it larger than the spacing of {spacing} m, or remove it"
    )]
    NothingRemoved { spacing: f64 },
    /// More memory than there is.
    #[error(
        "{cells} cells need {}\n  \
         allowed: at most the {} that are available\n  \
         way out: `domain.spacing_m` of {spacing_needed:.3e} m or more instead of {spacing} m, or one cell along \
         periodic axes on which nothing changes", human(*needed), human(*available)
    )]
    OutOfMemory {
        /// Cells of the box.
        cells: u64,
        /// Bytes predicted.
        needed: u64,
        /// Bytes that can be taken.
        available: u64,
        /// Spacing of the scene, m.
        spacing: f64,
        /// Spacing at which the same box would fit, m.
        spacing_needed: f64,
    },
    /// Too fast.
    #[error(
        "found Mach number {mach:.3}: {speed:.4e} m/s at a time step of {dt:.3e} s\n  \
         allowed: at most {limit}; the equilibrium is of second order in Ma [L3]\n  \
         way out: {ways}"
    )]
    MachTooHigh { mach: f64, speed: f64, dt: f64, limit: f64, ways: Ways },
    /// τ too near ½.
    #[error(
        "found a relaxation time of {} at a time step of {dt:.3e} s\n  \
         allowed: at least {limit}, the least for which stability is tabulated [K5] [L6]\n  \
         way out: {ways}",
        relaxation(*tau)
    )]
    TauTooSmall { tau: f64, dt: f64, limit: f64, ways: Ways },
    /// τ too large.
    #[error(
        "found a relaxation time of {tau:.4} at a time step of {dt:.3e} s\n  \
         allowed: at most {limit} with {operator}: {because}\n  \
         way out: {ways}"
    )]
    TauTooLarge { tau: f64, dt: f64, limit: f64, operator: Operator, because: &'static str, ways: Ways },
    /// Too few cells between walls.
    #[error(
        "found {cells} cells between walls\n  \
         allowed: at least {least} for the {law}: fewer give fluxes that are off by more than 5 %, up to all of it [B3]\n  \
         way out: {ways}"
    )]
    GapTooNarrow { cells: f64, least: f64, law: &'static str, ways: Ways },
    /// Beyond the stability table.
    #[error(
        "found a speed of {} cells per step with {operator} at a relaxation time of {}\n  \
         allowed: at most {}, the von Neumann limit [K5]\n  \
         way out: {ways}",
        short(*speed), relaxation(*tau), short(*limit)
    )]
    Unstable { speed: f64, limit: f64, tau: f64, operator: Operator, ways: Ways },
    /// Nothing says at which shear rate the viscosity is to be taken.
    #[error(
        "no velocity scale: nothing drives the fluid, and its viscosity depends on the shear rate\n  \
         allowed: flows whose speed can be estimated, or a speed [L6]\n  \
         way out: give `numerics.reference_velocity_m_per_s`"
    )]
    NoShearRate,
    /// Nothing says how fast the flow is.
    #[error(
        "no velocity scale: nothing drives the fluid, so that no step has this Mach number\n  \
         allowed: flows whose speed can be estimated, or a speed [L6]\n  \
         way out: give `numerics.reference_velocity_m_per_s`, or leave `numerics.target_mach` out"
    )]
    NoSpeed,
    /// Steps that cannot be counted.
    #[error(
        "{steps:.3e} steps of {dt:.3e} s to reach {end:.3e} s\n  \
         allowed: at most 9e15, the integers exact in 64-bit floating point\n  \
         way out: an earlier `stop.end_time_s`; the step follows from density, viscosity, forces and spacing: check their \
         magnitudes"
    )]
    TooManySteps { steps: f64, dt: f64, end: f64 },
    /// End before the first step.
    #[error(
        "the end time of {end} s is less than half a time step of {dt} s\n  \
         allowed: at least one step\n  \
         way out: a smaller `numerics.time_step_s`"
    )]
    NoStep { end: f64, dt: f64 },
    /// Nothing says how fast grains become.
    #[error(
        "no speed: no grain and no wall moves, and there is no gravity\n  \
         allowed: scenes in which something moves\n  \
         way out: give a velocity, gravity, or `design_speed_m_per_s`"
    )]
    NoDesignSpeed,
    /// All grains are driven.
    #[error(
        "all grains are driven: nothing can be pushed\n  \
         allowed: at least one grain that is free\n  \
         way out: remove `driven` from a set"
    )]
    NothingMoves,
    /// End before the first step of the grains.
    #[error(
        "the end time of {end:.3e} s is less than half a time step of {dt:.3e} s\n  \
         allowed: at least one step\n  \
         way out: a later end, or a smaller `grains.numerics.time_step_s`"
    )]
    NoGrainStep { end: f64, dt: f64 },
    /// Grains that overlap at time 0.
    #[error(
        "{first} and {second} overlap by {overlap_m:.3e} m at time 0\n  \
         allowed: at most {allowed_m:.3e} m; deeper overlaps would explode\n  \
         way out: move one of them, or raise `grains.numerics.start_overlap`"
    )]
    GrainsOverlap { first: String, second: String, overlap_m: f64, allowed_m: f64 },
    /// A time step that does not resolve a contact.
    #[error(
        "found {found_s:.3e} s\n  \
         allowed: at most {limit_s:.3e} s; the contact between {pair} lasts {contact_s:.3e} s at the design speed \
         of {speed_m_s:.4} m/s and needs {steps} steps at least [D3]\n  \
         way out: leave it out, softer material, or a lower `design_speed_m_per_s`"
    )]
    GrainTimeStep { found_s: f64, pair: String, contact_s: f64, speed_m_s: f64, steps: f64, limit_s: f64 },
    /// A time step at which the dashpot or the springs of a contact make energy.
    #[error(
        "found {found_s:.3e} s\n  \
         allowed: below {limit_s:.3e} s; beyond, the spring and the dashpot of the contact between {pair} make energy \
         {motion} at the design speed of {speed_m_s:.4} m/s [D3]\n  \
         way out: leave it out or take {advised_s:.3e} s, which keeps the books of energy; or less damping"
    )]
    GrainStepUnstable {
        found_s: f64,
        pair: String,
        motion: &'static str,
        speed_m_s: f64,
        limit_s: f64,
        advised_s: f64,
    },
    /// A periodic axis too short.
    #[error(
        "axis {axis}: found {length_m} m\n  \
         allowed: more than {needed_m:.4e} m along a periodic axis; on less a pair would touch twice\n  \
         way out: a longer box, smaller grains, or `free_slip` faces"
    )]
    GrainPeriod { axis: char, length_m: f64, needed_m: f64 },
    /// No room.
    #[error(
        "{placed} of {wanted} grains found a place without overlap\n  \
         allowed: as many as random addition finds room for, about a third of the volume\n  \
         way out: fewer or smaller grains, a larger region, or a lattice"
    )]
    PackingFull { placed: usize, wanted: usize },
    /// A lattice without a place.
    #[error(
        "no grain of radius {radius_m} m lies wholly inside the region\n  \
         allowed: regions with room for at least one\n  \
         way out: a larger region, or smaller grains"
    )]
    NoGrainFits { radius_m: f64 },
    /// A file beside the scene.
    #[error(
        "`{file}` cannot be read as {kind}: {what}\n  \
         allowed: {kind} in the folder of the scene\n  \
         way out: check its name and content"
    )]
    BadFile { file: String, kind: &'static str, what: String },
    /// A mesh that is nowhere.
    #[error(
        "axis {axis}: the mesh reaches from {} m to {} m\n  \
         allowed: something between 0 m and {size} m, the box\n  \
         way out: `scale` of 0.001 where the file is in millimetres, or a `shift_m` that moves it into the box",
        short(*low), short(*high)
    )]
    MeshOutside { axis: char, low: f64, high: f64, size: f64 },
    /// A grain that is not in the box.
    #[error(
        "axis {axis}: the centre of {grain} is at {at_m} m\n  \
         allowed: 0 m to {size_m} m, the box{}\n  \
         way out: move it into the box", if *.open { "; what passes an open face is taken out" } else { "" }
    )]
    GrainOutside { grain: String, axis: char, at_m: f64, size_m: f64, open: bool },
    /// A grain in a body.
    #[error(
        "{grain} is inside solid `{solid}`\n  \
         allowed: outside of it; nothing would hold a grain that is inside at time 0\n  \
         way out: move the grain or the region of its set out of the solid, or set `driven` if it is part of it"
    )]
    GrainInSolid { grain: String, solid: String },
    /// More than can be numbered.
    #[error(
        "found {spheres:.3e} spheres\n  \
         allowed: at most {max:.0e}, which can be numbered\n  \
         way out: fewer or larger grains"
    )]
    TooManyGrains { spheres: f64, max: f64 },
    /// More than fits.
    #[error(
        "{grains} grains need {}\n  \
         allowed: at most the {} that are free\n  \
         way out: fewer or larger grains", human(*.bytes), human(*.available)
    )]
    GrainMemory { grains: u64, bytes: u64, available: u64 },
    /// A quantity that left the range of 64-bit numbers.
    #[error(
        "{quantity} cannot be had: it is 0, infinite or not a number\n  \
         allowed: magnitudes for which it is a number above 0\n  \
         way out: check the magnitudes of radii, densities, Young's moduli, speeds and gravity"
    )]
    GrainScale { quantity: &'static str },
    /// A wall that cannot be made.
    #[error(
        "the wall cannot be made: {what}\n  \
         allowed: corners at different places, edges that do not cross, finite numbers\n  \
         way out: remove corners that are given twice"
    )]
    BadWall { what: String },
    /// Anything else that the discrete element method refuses.
    #[error(
        "{what}\n  \
         allowed: what the message asks for\n  \
         way out: change the value it names"
    )]
    Grains { what: String },
    /// A solid whose surface moves away from its cells.
    #[error(
        "the surface of this solid moves away from where its cells are\n  \
         allowed: with grains, surfaces that slide along themselves: a plane in its plane, an endless cylinder \
         about or along its axis\n  \
         way out: set velocity and spin to 0, or make it a `driven` grain"
    )]
    SolidLeavesCells,
    /// Grains the cells cannot show.
    #[error(
        "a grain of set `{set}` has a radius of {radius:.4e} m, {cells:.3} cells\n  \
         allowed: at least {least} cell; below it the surface is a handful of links, and the drag is off by half \
         and more\n  \
         way out: `domain.spacing_m` of at most {spacing:.4e} m ({good:.4e} m for errors of about 1 %), larger \
         grains, or put these sizes into the rheology"
    )]
    GrainTooSmall { set: String, radius: f64, cells: f64, least: f64, spacing: f64, good: f64 },
    /// Too light for explicit coupling.
    #[error(
        "found {density} kg/m³, {ratio:.3} of the fluid's density\n  \
         allowed: at least {least} of it: a grain accelerates half its volume of fluid with it, and forces that are \
         known only one step later make lighter ones ring ever louder\n  \
         way out: at least {least_density:.4} kg/m³, or a `driven` grain"
    )]
    GrainTooLight { density: f64, ratio: f64, least: f64, least_density: f64 },
    /// Faster than the guard of the run.
    #[error(
        "grains reach {speed:.4e} m/s, {lattice:.3} cells per step at a time step of {dt:.3e} s\n  \
         allowed: at most {limit} cells per step, where the run is stopped\n  \
         way out: a time step of at most {dt_max:.3e} s, or leave it to `plan`"
    )]
    GrainsTooFast { speed: f64, lattice: f64, limit: f64, dt: f64, dt_max: f64 },
    /// Lubrication needs shorter steps.
    #[error(
        "with {steps} the friction of lubrication, 6πμR²/h, is limited by the time step below a gap of {gap:.3} \
         cells\n  \
         allowed: gaps of at most {allowed} cells, so that grains do not touch through the fluid\n  \
         way out: at least {needed}, leave it out, or `\"lubrication\": \"off\"`"
    )]
    LubricationStep { steps: u32, needed: f64, gap: f64, allowed: f64 },
    /// More sub-steps than make sense.
    #[error(
        "contacts and lubrication need {needed:.3e} steps of the grains in one step of the fluid\n  \
         allowed: at most {most:.0e}\n  \
         way out: softer material, a smaller `numerics.time_step_s`, or heavier grains"
    )]
    TooManySubSteps { needed: f64, most: f64 },
    /// A scale that left the range of 64-bit numbers.
    #[error(
        "{quantity} is {found} in lattice units\n  \
         allowed: finite numbers\n  \
         way out: check the magnitudes of spacing, density and viscosity"
    )]
    NotFinite { quantity: &'static str, found: f64 },
}
