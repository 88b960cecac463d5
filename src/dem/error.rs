//! What can be wrong with a set-up, and what stops a run.
#![allow(missing_docs, reason = "the message beside each variant says what it and its fields are")]

use std::fmt;

use thiserror::Error;

/// Errors of the discrete element method.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum DemError {
    #[error(
        "material `{name}`: Young's modulus is {found} Pa; Hertz contact [D1] needs a finite value above zero"
    )]
    Young { name: String, found: f64 },
    #[error("material `{name}`: Poisson's ratio is {found}; an isotropic solid needs -1 < nu < 0.5")]
    Poisson { name: String, found: f64 },
    #[error("material `{name}`: density is {found} kg/m3; it must be finite and above zero")]
    Density { name: String, found: f64 },
    #[error("pair of materials `{first}` and `{second}`: {what} is {found}; allowed is {allowed}")]
    PairProperty { first: String, second: String, what: &'static str, found: f64, allowed: &'static str },
    #[error("material number {found} is used, but only {count} materials are defined")]
    UnknownMaterial { found: usize, count: usize },
    #[error("no material is defined; every grain and wall needs one")]
    NoMaterial,
    #[error("clump `{name}` has no member spheres")]
    EmptyClump { name: String },
    #[error(
        "clump `{name}`: member {member} has radius {radius} m; every member needs a finite radius above zero"
    )]
    MemberRadius { name: String, member: usize, radius: f64 },
    #[error("clump `{name}`: member {member} is at a centre that is not finite")]
    MemberCentre { name: String, member: usize },
    #[error("clump `{name}`: {what} is {found}; it must be finite and above zero")]
    ClumpValue { name: String, what: &'static str, found: f64 },
    #[error("grain {grain}: {what} is {found}; it must be finite{}", if *.positive { " and above zero" } else { "" })]
    GrainValue { grain: usize, what: &'static str, found: f64, positive: bool },
    #[error("grain {grain} uses shape {found}, but only {count} clumps are defined")]
    UnknownShape { grain: usize, found: usize, count: usize },
    #[error(
        "grains {first} and {second} overlap by {overlap_m:.3e} m at the start, more than the {allowed_m:.3e} m allowed; \
         move them apart or raise `start_overlap`"
    )]
    StartOverlap { first: usize, second: usize, overlap_m: f64, allowed_m: f64 },
    #[error(
        "grain {grain} overlaps wall `{wall}` by {overlap_m:.3e} m at the start, more than the {allowed_m:.3e} m allowed"
    )]
    StartOverlapWall { grain: usize, wall: String, overlap_m: f64, allowed_m: f64 },
    #[error("{what} is {found}; it must be {allowed}")]
    Setting { what: &'static str, found: f64, allowed: &'static str },
    #[error(
        "time step {found_s:.3e} s is too long for the stiffest pair, {pair}: its contact lasts {contact_s:.3e} s at the \
         design speed {speed_m_s} m/s, and at least {steps} steps are needed inside it; use at most {limit_s:.3e} s"
    )]
    TimeStep { found_s: f64, pair: String, contact_s: f64, speed_m_s: f64, steps: f64, limit_s: f64 },
    #[error(
        "time step {found_s:.3e} s makes energy {motion} of {pair}: the spring and the dashpot of this contact are stable below \
         {limit_s:.3e} s at the design speed {speed_m_s} m/s; use {advised_s:.3e} s"
    )]
    Unstable {
        found_s: f64,
        pair: String,
        motion: &'static str,
        speed_m_s: f64,
        limit_s: f64,
        advised_s: f64,
    },
    #[error(
        "periodic axis {axis} is {length_m} m long; grains of this size need more than {needed_m} m, or a pair would meet itself twice"
    )]
    PeriodTooShort { axis: char, length_m: f64, needed_m: f64 },
    #[error("wall `{wall}`: {what}")]
    Wall { wall: String, what: &'static str },
    #[error("mesh: {what}{}", .line.map(|l| format!(" (line {l})")).unwrap_or_default())]
    Mesh { what: String, line: Option<usize> },
    #[error("mesh file {path}: {source}")]
    MeshFile { path: String, source: std::sync::Arc<MeshIo> },
    #[error(
        "packing: {placed} of {wanted} grains found a place after {attempts} attempts for the next; lower the number or the sizes"
    )]
    PackingFull { placed: usize, wanted: usize, attempts: u32 },
    #[error("packing: {what} is {found}; it must be {allowed}")]
    Packing { what: &'static str, found: f64, allowed: &'static str },
    #[error("checkpoint does not fit the set-up: {what} is {found}, expected {expected}")]
    Checkpoint { what: &'static str, found: usize, expected: usize },
    #[error(
        "run stopped at step {step}, t = {time_s:.9e} s: {pair} overlap by {overlap_m:.4e} m, {share:.3} of the smaller radius \
         (limit {limit}); the impact is too fast for this stiffness, or the time step too long"
    )]
    Overlap {
        step: u64,
        time_s: f64,
        /// The two bodies, a grain first.
        pair: Touching,
        overlap_m: f64,
        share: f64,
        limit: f64,
    },
    #[error("run stopped at step {step}, t = {time_s:.9e} s: state of grain {grain} is not finite")]
    NotFinite { step: u64, time_s: f64, grain: usize },
    #[error(
        "run stopped at step {step}, t = {time_s:.9e} s: grain {grain} spins at {spin_rad_s:.3e} rad/s, too fast for the time step \
         {step_s:.3e} s (the free rotation did not converge)"
    )]
    Spin { step: u64, time_s: f64, grain: usize, spin_rad_s: f64, step_s: f64 },
}

/// Two bodies that touch.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Touching {
    /// Two grains, by their numbers.
    Grains(usize, usize),
    /// A grain and a wall.
    Wall {
        /// Number of the grain.
        grain: usize,
        /// Name of the wall.
        wall: String,
    },
}

impl Touching {
    /// Number of the grain, the first one of two.
    #[must_use]
    pub(crate) fn grain(&self) -> usize {
        match *self {
            Self::Grains(grain, _) | Self::Wall { grain, .. } => grain,
        }
    }
}

impl fmt::Display for Touching {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Grains(first, second) => write!(f, "grains {first} and {second}"),
            Self::Wall { grain, wall } => write!(f, "grain {grain} and wall `{wall}`"),
        }
    }
}

/// An input/output failure, comparable so that errors can be compared in tests.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct MeshIo {
    /// What the operating system said.
    pub message: String,
}
