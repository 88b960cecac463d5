//! What decides the error of a scene, as far as flows with an exact solution tell.

use serde::Serialize;

use crate::dem;
use crate::plan::figures::{Basis, along_bed, along_walls, push};
use crate::plan::time_step::{COMPRESSION_MAX, compression};
use crate::rheology::Law;
use crate::scene::{BodyForce, Boundary, Motion, Operator};
use crate::setup::{WallRule, YieldTreatment};

/// A kind of scene with an exact solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// A uniform layer down an incline.
    Film,
    /// Between plane walls, driven by a force.
    Channel,
    /// A Newtonian fluid between plane walls of which one is set in motion.
    MovingWall,
    /// Another fluid between plane walls of which one moves steadily.
    Couette,
    /// The same with several fluids one above the other.
    Layers,
    /// Beside a wall that oscillates in its plane.
    OscillatingWall,
    /// Fluid that lies level and rests.
    Pool,
    /// Grains that collide, slide and roll.
    Contact,
}

/// A number that decides: its name, and the factor by which two scenes are one unit apart.
type Axis = (&'static str, f64);

impl Kind {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Film,
        Self::Channel,
        Self::MovingWall,
        Self::Couette,
        Self::Layers,
        Self::OscillatingWall,
        Self::Pool,
        Self::Contact,
    ];

    /// As it is called in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Film => "film on an incline",
            Self::Channel => "channel",
            Self::MovingWall => "wall set in motion",
            Self::Couette => "steady shear",
            Self::Layers => "layers between walls",
            Self::OscillatingWall => "oscillating wall",
            Self::Pool => "pool at rest",
            Self::Contact => "grains in contact",
        }
    }

    /// What the two errors of a row are.
    #[must_use]
    pub const fn errors(self) -> &'static [&'static str] {
        match self {
            Self::Film => &["mean speed", "largest speed"],
            Self::Channel => &["discharge", "largest speed"],
            Self::MovingWall | Self::Couette | Self::Layers | Self::OscillatingWall => {
                &["speed anywhere, of the wall's"]
            }
            Self::Pool => &["speeds, of √(g × depth)", "volume"],
            Self::Contact => &["restitution", "speed after sliding or rolling"],
        }
    }

    /// The numbers that decide.
    #[must_use]
    pub const fn axes(self) -> &'static [Axis] {
        match self {
            Self::Film => &FILM,
            Self::Channel => &CHANNEL,
            Self::MovingWall => &MOVING_WALL,
            Self::Couette => &COUETTE,
            Self::Layers => &LAYERS,
            Self::OscillatingWall => &OSCILLATING,
            Self::Pool => &POOL,
            Self::Contact => &CONTACT,
        }
    }
}

const FILM: [Axis; 4] = [
    ("cells of depth", 1.5),
    ("cells sheared", 2.0),
    ("n", 1.5),
    ("of the speed per step of the force", 4.0),
];
const CHANNEL: [Axis; 4] =
    [("cells across", 2.0), ("cells sheared", 2.0), ("n", 1.5), ("of the speed per step of the force", 4.0)];
const MOVING_WALL: [Axis; 3] =
    [("cells across", 3.0), ("cells that the motion reached", 1.5), ("plastic τ − ½", 10.0)];
const COUETTE: [Axis; 3] =
    [("cells across", 3.0), ("n", 3.0), ("(τ − ½) × cells per step of the wall, or 0.3", 1.5)];
const POOL: [Axis; 2] = [("cells of depth", 2.0), ("plastic τ − ½", 3.0)];
const LAYERS: [Axis; 3] =
    [("cells of the thinnest layer", 1.5), ("ratio of viscosities", 3.0), ("plastic τ − ½", 3.0)];
const OSCILLATING: [Axis; 3] =
    [("cells of 1/e of the amplitude", 1.5), ("steps per period", 2.0), ("cells across", 2.0)];
const CONTACT: [Axis; 2] = [("steps in the shortest contact", 1.3), ("restitution", 1.5)];

/// Most numbers that decide.
pub const AXES: usize = 4;

/// A scene as a point among others of its kind.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Likeness {
    /// Kind.
    pub kind: Kind,
    /// The numbers of [`Kind::axes`], all above 0; the rest is 1.
    pub at: [f64; AXES],
}

impl Likeness {
    /// A point.
    #[must_use]
    pub fn new(kind: Kind, numbers: &[f64]) -> Self {
        let mut at = [1.0; AXES];
        for (to, from) in at.iter_mut().zip(numbers) {
            *to = *from;
        }
        Self { kind, at }
    }

    /// Distance from another one of the same kind, units of [`Kind::axes`].
    #[must_use]
    pub fn apart(&self, other: &Self) -> f64 {
        let axes = self.kind.axes().iter();
        let square = axes.zip(self.at.iter().zip(&other.at)).map(|((_, unit), (a, b))| {
            let x = libm::log(a / b) / libm::log(*unit);
            x * x
        });
        square.sum::<f64>().sqrt()
    }
}

/// Whether something holds, and what is said where it does not.
fn only_if(holds: bool, why: &'static str) -> Result<(), &'static str> {
    if holds { Ok(()) } else { Err(why) }
}

/// The point of a scene with fluid; why there is none.
pub(in crate::plan) fn of_flow(basis: &Basis, tau: f64) -> Result<Likeness, &'static str> {
    let (facts, setup) = (basis.facts, basis.setup);
    let scene = facts.scene;
    only_if(scene.grains.is_none(), "there are grains in the fluid")?;
    only_if(setup.solids.iter().all(|&s| s == 0), "there are solids in the box")?;
    only_if(setup.yielding == YieldTreatment::Exact, "the relaxation time is clamped")?;
    let known = matches!(Operator::of(&setup.collision), Operator::CentralMoment | Operator::Trt);
    only_if(known, "only `central_moment` and `trt` were measured")?;
    only_if(
        setup.wall_rule == WallRule::ViscosityIndependent,
        "only `viscosity_independent` walls were measured",
    )?;
    let steady = matches!(scene.fluid.body_force, None | Some(BodyForce::Constant { .. }));
    only_if(steady, "the force changes in time")?;
    let mach = 3.0_f64.sqrt() * lattice_speed(basis);
    only_if(mach <= MACH, "the Mach number is above 0.25")?;
    let likeness = if basis.pool.is_some() { surface(basis, tau)? } else { walls(basis, tau)? };
    only_if(likeness.at.iter().all(|x| *x > 0.0 && x.is_finite()), "nothing is sheared")?;
    Ok(likeness)
}

/// Mach number up to which errors of its square are among the others.
const MACH: f64 = 0.25;

/// Restitution below which contacts count alike.
const LEAST_RESTITUTION: f64 = 0.01;

/// The point of grains by themselves; `steps` in the shortest contact, `restitution` at the design speed.
pub(in crate::plan) fn of_grains(
    setup: &dem::Setup,
    steps: f64,
    restitution: f64,
) -> Result<Likeness, &'static str> {
    only_if(setup.integrator == dem::Integrator::Verlet, "only velocity Verlet was measured")?;
    let like = Likeness::new(Kind::Contact, &[steps, restitution.max(LEAST_RESTITUTION)]);
    only_if(like.at.iter().all(|x| x.is_finite()), "the contacts have no restitution")?;
    Ok(like)
}

/// Flow index of a law; 1 with a constant plastic viscosity.
fn index(law: &Law) -> Result<f64, &'static str> {
    match *law {
        Law::Newtonian { .. } | Law::Bingham { .. } => Ok(1.0),
        Law::HerschelBulkley { n, .. } | Law::PowerLaw { n, .. } => Ok(n),
        Law::Papanastasiou { .. } => Err("no Papanastasiou fluid was measured"),
    }
}

/// The expected speed, cells per step.
fn lattice_speed(basis: &Basis) -> f64 {
    basis.units.velocity_to_lattice(basis.scales.velocity)
}

fn surface(basis: &Basis, tau: f64) -> Result<Likeness, &'static str> {
    let facts = basis.facts;
    only_if(facts.scene.layers.is_empty(), "there are several fluids below a surface")?;
    let pool = basis.pool.ok_or("there is no fluid")?;
    only_if(pool.level, "the fluid does not lie level")?;
    only_if(pool.fall <= 0.0, "the fluid falls")?;
    only_if(moving(basis).count() == 0, "a wall moves below a surface")?;
    let (up, force) = (pool.up.index(), facts.forces.extremes[0]);
    let depth = basis.units.length_to_lattice(pool.depth);
    let along = |a: usize| a != up && force[a] != 0.0;
    if !(0..3).any(along) {
        return Ok(Likeness::new(Kind::Pool, &[depth, tau - 0.5]));
    }
    only_if(!(0..3).any(|a| a != up && facts.closed[a]), "walls or mirrors beside the film")?;
    let n = index(&facts.laws[0])?;
    let bed = along_bed(basis).unwrap_or(0.0);
    let rigid = basis.units.length_to_lattice(facts.curve().plastic_stress() / bed);
    only_if(depth > rigid, "the film is below the yield stress")?;
    let [compressed, _] = compression(facts, basis.pool.as_ref(), basis.units.dt_s);
    only_if(compressed <= COMPRESSION_MAX, "the time step lets the fluid be compressed")?;
    let pushed = push(basis).ok_or("nothing moves")?;
    Ok(Likeness::new(Kind::Film, &[depth, depth - rigid, n, pushed]))
}

/// Faces that move, with their motion: axis and side.
fn moving<'a>(basis: &'a Basis) -> impl Iterator<Item = (usize, usize, Option<&'a Motion>)> {
    let motions = basis.facts.scene.domain.motion.by_axis();
    let faces = basis.facts.faces;
    (0..6).map(|k| (k / 2, k % 2)).filter_map(move |(axis, side)| {
        matches!(faces[axis][side], Boundary::MovingWall { .. }).then_some((axis, side, motions[axis][side]))
    })
}

fn walls(basis: &Basis, tau: f64) -> Result<Likeness, &'static str> {
    let facts = basis.facts;
    let walled: Vec<usize> = (0..3).filter(|&a| facts.closed[a]).collect();
    let [axis] = walled[..] else { return Err("it is not two plane walls and nothing else") };
    only_if(basis.gap.is_finite(), "there are no walls")?;
    let force = along_walls(basis);
    let mut faces = moving(basis);
    match (faces.next(), force > 0.0) {
        (None, true) => {
            only_if(facts.scene.layers.is_empty(), "there are several fluids")?;
            let index = index(&facts.laws[0])?;
            let half = 0.5 * basis.gap;
            let rigid = basis.units.length_to_lattice(facts.curve().plastic_stress() / force);
            only_if(half > rigid, "the fluid is below the yield stress")?;
            let pushed = push(basis).ok_or("nothing moves")?;
            Ok(Likeness::new(Kind::Channel, &[basis.gap, half - rigid, index, pushed]))
        }
        (None, false) => Err("nothing drives the fluid"),
        (Some(_), true) => Err("a force and a wall drive it together"),
        (Some((_, side, motion)), false) => {
            only_if(faces.next().is_none(), "both walls move")?;
            only_if(facts.faces[axis][1 - side] == Boundary::NoSlip, "the other wall is a mirror")?;
            moved(basis, tau, axis, motion)
        }
    }
}

/// u_w (τ − ½) below which it makes no error worth a number: 0.0024 of its square is 2e-4 \[B3\].
const LEAST_DRIVE: f64 = 0.3;

/// Stress over its part without the yield stress: apparent over plastic viscosity, at the shear rate of the scene.
fn apparent(basis: &Basis) -> f64 {
    let curve = basis.facts.curve();
    let viscous = curve.viscous_stress(basis.scales.velocity / basis.scales.length);
    1.0 + curve.plastic_stress() / viscous
}

/// One wall of `axis` moves.
fn moved(basis: &Basis, tau: f64, axis: usize, motion: Option<&Motion>) -> Result<Likeness, &'static str> {
    let facts = basis.facts;
    let excess = tau - 0.5;
    if !facts.scene.layers.is_empty() {
        only_if(motion.is_none(), "there are several fluids beside a wall whose motion changes")?;
        let thinnest = thinnest(basis, axis)?;
        let viscosity = |low: f64, law: &Law| low.min(law.curve().plastic_viscosity(basis.scales.shear_rate));
        let least = facts.laws.iter().fold(f64::INFINITY, viscosity);
        let most = -facts
            .laws
            .iter()
            .fold(f64::INFINITY, |low, law| low.min(-law.curve().plastic_viscosity(basis.scales.shear_rate)));
        return Ok(Likeness::new(Kind::Layers, &[thinnest, most / least, excess]));
    }
    let newtonian = facts.laws[0].constant_tau();
    match motion {
        None => {
            if newtonian.is_none() {
                // Errors of the others beside fast walls reach 2 % where Λ is fixed and τ⁺ small.
                let central = Operator::of(&basis.setup.collision) == Operator::CentralMoment;
                only_if(central, "only `central_moment` was measured")?;
                let drives = (excess * apparent(basis) * lattice_speed(basis)).max(LEAST_DRIVE);
                return Ok(Likeness::new(Kind::Couette, &[basis.gap, index(&facts.laws[0])?, drives]));
            }
            // √(νt): how far the motion of the wall got.
            let reached = (excess / 3.0 * basis.steps as f64).sqrt().min(basis.gap);
            Ok(Likeness::new(Kind::MovingWall, &[basis.gap, reached, excess]))
        }
        Some(&Motion::Oscillating { frequency_hz, .. }) => {
            only_if(
                newtonian.is_some(),
                "no fluid but Newtonian ones was measured beside an oscillating wall",
            )?;
            let steps = 1.0 / (frequency_hz * basis.units.dt_s);
            // √(2ν/ω), ν = (τ − ½)/3, ω = 2π/steps.
            let depth = (excess / 3.0 * steps / core::f64::consts::PI).sqrt();
            Ok(Likeness::new(Kind::OscillatingWall, &[depth, steps, basis.gap]))
        }
        Some(Motion::Table { .. }) => Err("the motion of the wall comes from a table"),
    }
}

/// Cells of the thinnest layer along an axis.
fn thinnest(basis: &Basis, axis: usize) -> Result<f64, &'static str> {
    let setup = basis.setup;
    let fluid = |cell: usize| setup.fluid_of_cell.get(cell).copied().unwrap_or(0);
    let mut of_layer: Vec<Option<u8>> = vec![None; setup.extents[axis]];
    for cell in 0..setup.cells() {
        let layer = &mut of_layer[setup.coordinates(cell)[axis]];
        let seen = layer.get_or_insert(fluid(cell));
        only_if(*seen == fluid(cell), "the fluids do not lie in layers along the walls")?;
    }
    let mut least = usize::MAX;
    for run in of_layer.chunk_by(|a, b| a == b) {
        least = least.min(run.len());
    }
    Ok(least as f64)
}
