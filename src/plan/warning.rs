//! What to think about before running.

use super::film_error::film_error;
use super::text::{human, relaxation, short};
use super::wall_error::{ERROR_MAX, Expected, PUSH_MAX};
use crate::scene::Operator;

/// Least density of a grain over that of the fluid without a warning.
pub(super) const LOW_DENSITY_RATIO: f64 = 0.5;
/// Gap, cells, down to which the friction of lubrication must be had in full.
pub(super) const LUBRICATED_GAP: f64 = 0.1;

/// How to write less.
const CUT: &str = "a longer `every_s` of `output.fields` or `output.grains`, some of the fields (`output.field_names`), a part \
                   of the box (`output.field_region`) or `\"field_precision\": \"single\"` in `output` make it less";

/// A warning of a plan; its text is what `lahar plan` prints and what its JSON holds.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Warning {
    /// Compressibility.
    #[error("Mach number {mach:.3}: errors of order Ma² = {:.1} %", 100.0 * mach * mach)]
    Mach {
        /// Mach number.
        mach: f64,
    },
    /// τ near ½.
    #[error(
        "plastic relaxation time {tau:.4} is below 0.55: a finer spacing than {spacing_m} m would be more accurate"
    )]
    TauSmall {
        /// τ of the plastic viscosity.
        tau: f64,
        /// Cell size, m.
        spacing_m: f64,
    },
    /// τ very near ½.
    #[error(
        "plastic relaxation time {} is below 0.52: the place of walls that are not plane shifts (at 0.55 the \
         drag on a sphere is off by up to 13 % already), pressure waves are hardly damped, and a splash or a fast free surface may \
         be stopped by the guard of the run, as was seen below 0.51; a spacing of {} m brings it \
         to 0.52",
        relaxation(*tau),
        short(*spacing_needed_m)
    )]
    TauTiny {
        /// τ of the plastic viscosity.
        tau: f64,
        /// Cell size at which it would be 0.52 with as many cells per step, m.
        spacing_needed_m: f64,
    },
    /// Shear-thickening fluid at rest.
    #[error(
        "the viscosity of a fluid of flow index {flow_index} vanishes where nothing is sheared: τ falls to ½ there, for which \
         no speed is stable by linear theory [K5]; look at the fields where the flow has no shear"
    )]
    Thickens {
        /// Largest flow index.
        flow_index: f64,
    },
    /// τ large.
    #[error("plastic relaxation time {tau:.2} is above 2: transients are smeared over steps")]
    TauLarge {
        /// τ of the plastic viscosity.
        tau: f64,
    },
    /// A narrow gap.
    #[error("only {cells} cells between walls: the flux can be off by 4 %")]
    FewCells {
        /// Cells between walls.
        cells: f64,
    },
    /// A force that is large for one step.
    #[error(
        "the force adds {} of the largest speed in a step: the flow answers walls in jumps, and may alternate for ever; a \
         time step of {} s adds {PUSH_MAX}",
        short(*push),
        short(*time_step_s)
    )]
    Pushed {
        /// Share of the speed.
        push: f64,
        /// Time step at which it is small enough, s.
        time_step_s: f64,
    },
    /// A sheared layer of few cells.
    #[error(
        "walls: {expected}; a finer spacing or a smaller time step reduces it: with 6 cells and less than 1e-3 it is below \
         {} %",
        short(100.0 * ERROR_MAX)
    )]
    WallError {
        /// The error, and of what.
        expected: Expected,
    },
    /// A sheared layer below half a cell.
    #[error(
        "walls: the sheared layer is {} cells thick: the plug above it may go on alternating by a per cent of its speed; a finer \
         spacing helps",
        short(*cells)
    )]
    ThinLayer {
        /// Its thickness, cells.
        cells: f64,
    },
    /// Near the limit of stability.
    #[error("less than a factor of 2 below the von Neumann limit")]
    NearlyUnstable,
    /// A plug that slips.
    #[error(
        "an unyielded solid held by walls slips {slip_m_per_s:.2e} m/s, more than 1e-3 of the flow; a smaller time step \
         or `viscosity_independent` walls reduce it"
    )]
    PlugSlips {
        /// Speed of the slip, m/s.
        slip_m_per_s: f64,
    },
    /// Fluid that does not come to rest.
    #[error(
        "fluid at rest whose surface is oblique to the grid keeps moving at up to {speed_m_per_s:.2e} m/s, more than a \
         hundredth of the flow [F2]; a finer spacing, or a box turned so that the force lies along an axis"
    )]
    StaysInMotion {
        /// Its speed, m/s.
        speed_m_per_s: f64,
    },
    /// A plug that moves on.
    #[error(
        "`{operator}` cannot bring a moving plug to rest with the exact yield stress; `{}` can [K3]",
        Operator::CentralMoment
    )]
    PlugMovesOn {
        /// The operator.
        operator: Operator,
    },
    /// Rounding.
    #[error(
        "rounding in `{precision}` can change velocities by up to {:.1} %; `double` cannot",
        100.0 * share
    )]
    Rounding {
        /// Name of the precision.
        precision: &'static str,
        /// Share of the velocity.
        share: f64,
    },
    /// Nothing to compute.
    #[error("nothing is expected to move: no force, wall or initial flow overcomes the yield stress")]
    NothingMoves,
    /// A thin film.
    #[error("the fluid is at most {} cells deep at time 0: {}", short(*cells), film_error(*cells))]
    Shallow {
        /// Depth, cells.
        cells: f64,
    },
    /// A thin deposit.
    #[error(
        "the fluid comes to rest {cells:.1} cells thick on this slope; below 4 cells the deposit is not resolved"
    )]
    ThinDeposit {
        /// Thickness, cells.
        cells: f64,
    },
    /// More mass than drawn.
    #[error(
        "the deepest column starts {:.2} % heavier than drawn, compressed by its weight, and the flow gains that much \
         volume; `\"pressure\": \"settled\"` in `fluid.initial` starts with the mass that was drawn",
        100.0 * share
    )]
    Compressed {
        /// Share of the mass.
        share: f64,
    },
    /// A fluid that gives way under its weight.
    #[error(
        "with this time step the fluid is {:.1} % denser at its foot than at its top, and what runs down a slope is too slow by \
         up to two thirds of that (films, measured: 11 % at 17 %, 17 % at 28 %); with `numerics.time_step_s` {} it is 2 %",
        100.0 * share,
        short(*time_step_s)
    )]
    CompressedByStep {
        /// Excess of density.
        share: f64,
        /// Step that keeps it at 2 %, s.
        time_step_s: f64,
    },
    /// Another volume than drawn.
    #[error(
        "the cells hold {} m³ of {what} where {} m³ are drawn ({:+.1} %): a cell is solid or open as a whole; a finer spacing \
         brings both together",
        short(*volume_m3),
        short(*drawn_m3),
        100.0 * (volume_m3 / drawn_m3 - 1.0)
    )]
    OtherVolume {
        /// Fluid or solid.
        what: String,
        /// In the cells, m³.
        volume_m3: f64,
        /// As drawn, m³.
        drawn_m3: f64,
    },
    /// A gap or a bar of another width than drawn.
    #[error(
        "{what} is {} m wide along {axis} as drawn, and has {cells} cells, {} m, at ({}, {}, {}) m: cells are solid or open as a \
         whole, and a gap of fewer than 4 is not resolved; a spacing that divides both widths brings them together",
        short(*drawn_m), short(*cells_m), short(.at_m[0]), short(.at_m[1]), short(.at_m[2])
    )]
    OtherWidth {
        /// Gap or solid.
        what: &'static str,
        /// The axis along which it was measured.
        axis: char,
        /// Its middle on the line where it is worst, m.
        at_m: [f64; 3],
        /// Width as drawn, m.
        drawn_m: f64,
        /// Cells across.
        cells: f64,
        /// Their width, m.
        cells_m: f64,
    },
    /// A solid without cells of its own.
    #[error(
        "`{name}` has no cell of its own: solids that come after it in `solids` hold all of them, and a cell belongs to the \
         last; forces on it are 0; put it after them"
    )]
    SolidHidden {
        /// Its name.
        name: String,
    },
    /// A loaded solid that shares cells.
    #[error(
        "{:.0} % of the cells of `{name}` belong to solids after it in `solids`: its force and torque are of the rest alone",
        100.0 * share
    )]
    SolidShared {
        /// Its name.
        name: String,
        /// Share of its cells.
        share: f64,
    },
    /// A density in other units.
    #[error(
        "the density of {name} is {} kg/m³, which no liquid or solid has: water has 1000, rock 2650; numbers in g/cm³ are \
         to be multiplied by 1000",
        short(*density_kg_per_m3)
    )]
    OddDensity {
        /// Name of the material.
        name: String,
        /// As given, kg/m³.
        density_kg_per_m3: f64,
    },
    /// Memory that may be needed later.
    #[error(
        "blocks of memory follow the fluid: once it has reached every open cell the run holds {}, and {} are available",
        human(*bytes), human(*available)
    )]
    MemoryLater {
        /// Bytes then.
        bytes: u64,
        /// Bytes that can be taken.
        available: u64,
    },
    /// No room on the disk.
    #[error(
        "the run writes {files} files, about {}, most of them {largest}, and {} are free where it was planned: {CUT}",
        human(*bytes), human(*free)
    )]
    DiskFull {
        /// Bytes of all files.
        bytes: u64,
        /// Their number.
        files: u64,
        /// Bytes free.
        free: u64,
        /// The kind that takes most.
        largest: &'static str,
    },
    /// Many files.
    #[error("the run writes {files} files, about {}, most of them {largest}: {CUT}", human(*bytes))]
    MuchOutput {
        /// Bytes of all files.
        bytes: u64,
        /// Their number.
        files: u64,
        /// The kind that takes most.
        largest: &'static str,
    },
    /// Small grains.
    #[error(
        "the smallest grain has a radius of {} cells: expect its drag to be off by {:.1} %; 2.2 cells give 5 %, 3.35 \
         cells 1.2 %, 5 cells 0.4 %",
        short(*cells),
        100.0 * drag_error
    )]
    SmallGrain {
        /// Radius, cells.
        cells: f64,
        /// Expected error of the drag, relative.
        drag_error: f64,
    },
    /// Light grains.
    #[error(
        "a grain has {} of the fluid's density: below {} the added mass of the fluid outweighs it, and its motion rings \
         for some steps",
        short(*ratio),
        LOW_DENSITY_RATIO
    )]
    LightGrain {
        /// Density over that of the fluid.
        ratio: f64,
    },
    /// Friction that the time step limits.
    #[error("lubrication is limited by the time step below {} cells", LUBRICATED_GAP)]
    LubricationLimited,
    /// Fast grains.
    #[error("grains move up to {} cells per step: errors of several per cent", short(*cells_per_step))]
    FastGrains {
        /// Speed, cells per step.
        cells_per_step: f64,
    },
    /// Fast grains at a small τ.
    #[error(
        "grains move up to {} cells per step at a relaxation time of {tau:.3}: below {below} with more than 0.05 cells \
         per step the flow around them blows up with these rules; {way_out}",
        short(*cells_per_step)
    )]
    GrainsUnstable {
        /// Speed, cells per step.
        cells_per_step: f64,
        /// Least τ expected.
        tau: f64,
        /// τ below which it was seen.
        below: f64,
        /// What helps.
        way_out: &'static str,
    },
    /// An impact that stops the run.
    #[error(
        "an impact at the design speed overlaps by {} % of the radius, and runs stop at {} %: stiffer material, or slower \
         grains",
        short(100.0 * overlap),
        short(100.0 * limit)
    )]
    ImpactStops {
        /// Share of the radius.
        overlap: f64,
        /// Share at which a run is stopped.
        limit: f64,
    },
    /// A deep impact.
    #[error(
        "an impact at the design speed overlaps by {} % of the radius; contact laws are for small overlaps",
        short(100.0 * overlap)
    )]
    ImpactDeep {
        /// Share of the radius.
        overlap: f64,
    },
    /// A pile too heavy for its material.
    #[error(
        "grains at the bottom of a pile would overlap by {} % of the radius: the material is soft for this load",
        short(100.0 * overlap)
    )]
    PileDeep {
        /// Share of the radius.
        overlap: f64,
    },
    /// A design speed below what is expected.
    #[error(
        "the design speed is {} m/s, but grains may reach {} m/s",
        short(*design_m_per_s),
        short(*expected_m_per_s)
    )]
    DesignSpeed {
        /// As given, m/s.
        design_m_per_s: f64,
        /// As estimated, m/s.
        expected_m_per_s: f64,
    },
    /// Few steps in a contact.
    #[error("{steps:.1} steps in the shortest contact: restitution is off by about a percent; 50 are usual")]
    FewSteps {
        /// Steps in the shortest contact.
        steps: f64,
    },
    /// Nothing holds the grains. In a fluid its drag does.
    #[error("gravity pulls along a periodic axis and nothing holds the grains: they fall for ever")]
    FallForEver,
    /// A long run of grains by themselves.
    #[error("this takes about {days:.0} days on one thread")]
    Days {
        /// Days.
        days: f64,
    },
    /// A very soft material.
    #[error("Young's modulus below 1e5 Pa is softer than rubber")]
    Soft,
}
