//! The time step that springs and dashpots of contacts allow \[D3\].
//!
//! A contact moves like m ẍ + c ẋ + k x = 0. With K = kΔt²/m and D = cΔt/m, velocity Verlet that takes its forces at the
//! velocity predicted by v + aΔt (`integrate/verlet.rs`) has the characteristic polynomial
//!
//! z³ + (K + 3D/2 − 2) z² + (1 − 2D) z + D/2,
//!
//! whose roots lie inside the unit circle exactly while K + 4D < 4: the first one leaves at z = −1. Damping thus costs
//! twice the step it costs where forces take the velocity of half a step ago, Δt < (2/ω)(√(1 + ζ²) − ζ). Gear's scheme
//! was searched for roots beyond the unit circle from ζ = 0 to 100: K < 0.405 without damping and D < 0.1577 at ζ = ½
//! are its narrowest places, and the line between them lies inside.
//!
//! # Source
//! Undamped and damped central differences: Belytschko, Liu & Moran 2000, section 6.6. Modes of packings and of rotation:
//! O'Sullivan & Bray 2004, doi:10.1108/02644400410519794; Otsubo, O'Sullivan & Shire 2017,
//! doi:10.1016/j.compgeo.2016.12.022; damped collisions with rotation: Burns & Hanley 2017, doi:10.1002/nme.5361.

use super::bodies::{Bodies, Member};
use super::contact::restitution::hertz_largest_overlap;
use super::contact::{Geometry, normal_terms};
use super::integrate::Integrator;
use super::material::{Compiled, PairLaw, PairTable};
use super::timestep::FEWEST_STEPS;
use super::{Setup, V3};

/// Largest D of the normal dashpot in a step that is chosen. An impact stopped by a dashpot alone loses e^{−D} of its speed
/// per step; the books find its energy by the trapezoidal rule to D²/3: 0.3 %.
const RESOLVED: f64 = 0.1;

/// Share of the stability limit of a pair that tangential and rolling modes may take in a step that is chosen: a sphere
/// between many sticking neighbours has modes several times as fast as a pair has.
const RESERVE: f64 = 0.5;

/// Steps that dashpots and springs of contacts allow.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Stable {
    /// Longest step that a pair by itself bears, s.
    pub limit_s: f64,
    /// Longest step that is chosen, s.
    pub advised_s: f64,
    /// Which pair, in words.
    pub pair: String,
    /// Which of its motions, in words.
    pub motion: &'static str,
}

/// A way in which a contact can move.
#[derive(Debug, Clone, Copy)]
struct Mode {
    /// k/m, 1/s².
    stiffness: f64,
    /// c/m, 1/s.
    damping: f64,
    /// The same without the turning of clumps, which is a bound and not what most impacts do; 1/s.
    head_on: f64,
    motion: &'static str,
    /// Share of the stability limit in a step that is chosen.
    reserve: f64,
}

/// A member that may be part of the fastest contact.
#[derive(Debug, Clone, Copy)]
struct Side {
    radius: f64,
    material: u32,
    inverse_mass: f64,
    /// Largest 1/J of its body, 1/(kg m²).
    inverse_inertia: f64,
    /// Distance of its centre from that of its body, m.
    offset: f64,
    body: u32,
}

impl Side {
    /// A wall.
    const fn wall(material: u32) -> Self {
        let (inverse_mass, inverse_inertia) = (0.0, 0.0);
        Self { radius: f64::INFINITY, material, inverse_mass, inverse_inertia, offset: 0.0, body: u32::MAX }
    }

    /// Velocity of its surface per force across the normal, 1/kg, at most.
    fn turning(&self) -> f64 {
        let arm = self.offset + self.radius;
        if self.inverse_inertia > 0.0 { self.inverse_mass + self.inverse_inertia * arm * arm } else { 0.0 }
    }

    fn words(&self) -> String {
        match self.body {
            u32::MAX => "a wall".to_owned(),
            body => format!("a grain like {body} (radius {:.3e} m)", self.radius),
        }
    }
}

/// Coefficients (a, b) of a K + b D < 1.
const fn limits(integrator: Integrator) -> (f64, f64) {
    match integrator {
        Integrator::Verlet => (0.25, 1.0),
        Integrator::Gear | Integrator::GearConservative => (1.0 / 0.39, 1.0 / 0.155),
    }
}

impl Mode {
    /// Step at which a K + b D is `share`, s; infinite without spring and dashpot.
    fn step(&self, integrator: Integrator, share: f64) -> f64 {
        let (a, b) = limits(integrator);
        let damping = b * self.damping;
        2.0 * share / (damping + (damping * damping + 4.0 * share * a * self.stiffness).sqrt())
    }

    /// Step that is chosen at most, s.
    fn advised(&self, integrator: Integrator) -> f64 {
        let stable = self.step(integrator, self.reserve);
        let resolved = if self.motion == NORMAL {
            RESOLVED / self.head_on
        } else {
            std::f64::consts::PI / (FEWEST_STEPS * self.stiffness.sqrt())
        };
        stable.min(resolved)
    }
}

const NORMAL: &str = "along the normal";

/// Motions of a contact at its deepest in an elastic impact: later loads press as deep into a contact as its own damping
/// lets an impact not go.
fn modes(law: &PairLaw, sides: [&Side; 2], speed: f64, overlap_limit: f64) -> impl Iterator<Item = Mode> {
    let [a, b] = sides;
    let mass = 1.0 / (a.inverse_mass + b.inverse_mass);
    let radius = if b.radius.is_infinite() { a.radius } else { a.radius * b.radius / (a.radius + b.radius) };
    let deepest = match law.normal {
        // Neither spring nor dashpot depends on it.
        Compiled::Linear { .. } => radius,
        Compiled::ViscoElastic { .. } | Compiled::Tsuji { .. } => {
            hertz_largest_overlap(mass, law.young, radius, speed)
        }
    };
    let overlap = deepest.min(overlap_limit * a.radius.min(b.radius));
    let n = normal_terms(law, &Geometry { normal: V3::z(), overlap, radius, mass });
    let (exponent, reserve) = match law.normal {
        // Its dashpot acts at once where the others begin with the overlap.
        Compiled::Linear { .. } => (1.0, RESOLVED),
        Compiled::ViscoElastic { .. } | Compiled::Tsuji { .. } => (1.5, RESERVE),
    };
    let mode = |stiffness: f64, damping: f64, mobility: f64, motion| Mode {
        stiffness: stiffness * mobility,
        damping: damping * mobility,
        head_on: damping / mass,
        motion,
        reserve,
    };
    let off = |side: &Side| side.inverse_mass + side.inverse_inertia * side.offset * side.offset;
    let normal = mode(exponent * n.elastic / overlap, n.damping, off(a) + off(b), NORMAL);
    let (stiffness, damping) = (n.tangential_stiffness, law.tangential_damping * n.damping);
    let rubs = law.friction > 0.0;
    let across = mode(stiffness, damping, a.turning() + b.turning(), "across the normal");
    let arm = radius * radius;
    let turn = a.inverse_inertia + b.inverse_inertia;
    let rolling = mode(stiffness * arm, damping * arm, turn, "rolling");
    let rolls = rubs && law.rolling > 0.0;
    [Some(normal), rubs.then_some(across), rolls.then_some(rolling)].into_iter().flatten()
}

/// The members of each material that can be part of the fastest contact: rates fall with mass, and for given mass rise with
/// radius and with the arm of a clump; of driven bodies, which have no mass here, the largest counts.
fn candidates(bodies: &Bodies, members: &[Member], offsets: &[V3]) -> Vec<Side> {
    let materials = members.iter().map(|m| m.material as usize + 1).max().unwrap_or(0);
    // Lightest, smallest, easiest to turn, largest driven.
    let mut best: Vec<[Option<Side>; 4]> = vec![[None; 4]; materials];
    for (m, offset) in members.iter().zip(offsets) {
        let side = Side {
            radius: m.radius,
            material: m.material,
            inverse_mass: m.inverse_mass,
            inverse_inertia: bodies.inverse_inertia[m.body as usize].max(),
            offset: offset.norm(),
            body: m.body,
        };
        let of = &mut best[m.material as usize];
        let mut keep = |k: usize, size: &dyn Fn(&Side) -> f64| {
            if of[k].as_ref().is_none_or(|best| size(&side) > size(best)) {
                of[k] = Some(side);
            }
        };
        if m.inverse_mass > 0.0 {
            keep(0, &|side| side.inverse_mass);
            keep(1, &|side| 1.0 / side.radius);
            keep(2, &Side::turning);
        } else {
            keep(3, &|side| side.radius);
        }
    }
    let mut all: Vec<Side> = best.into_iter().flatten().flatten().collect();
    all.sort_by_key(|side| side.body);
    all.dedup_by(|a, b| (a.body, a.radius, a.offset) == (b.body, b.radius, b.offset));
    all
}

/// Steps that the contacts of a set-up allow, at its design speed; `None` if nothing can touch.
///
/// # Verified by
/// `limit_of_verlet_and_gear`, `no_energy_is_made`.
pub(crate) fn stable(
    setup: &Setup,
    table: &PairTable,
    parts: (&Bodies, &[Member], &[V3]),
    walls: &[u32],
) -> Option<Stable> {
    let sides = candidates(parts.0, parts.1, parts.2);
    let walls: Vec<Side> = walls.iter().map(|&material| Side::wall(material)).collect();
    let mut found: Option<Stable> = None;
    for (k, a) in sides.iter().enumerate() {
        for b in sides[k..].iter().chain(&walls) {
            // A mass of one of the two at least.
            let (a, b) = if a.inverse_mass > 0.0 { (a, b) } else { (b, a) };
            if a.inverse_mass == 0.0 {
                continue;
            }
            let law = table.law(a.material, b.material);
            for mode in modes(law, [a, b], setup.design_speed_m_s, setup.overlap_limit) {
                let limit_s = mode.step(setup.integrator, 1.0);
                let advised_s = mode.advised(setup.integrator);
                let best = found.get_or_insert_with(|| Stable {
                    limit_s: f64::INFINITY,
                    advised_s: f64::INFINITY,
                    pair: String::new(),
                    motion: NORMAL,
                });
                best.advised_s = best.advised_s.min(advised_s);
                if limit_s < best.limit_s {
                    (best.limit_s, best.motion) = (limit_s, mode.motion);
                    best.pair = format!("{} and {}", a.words(), b.words());
                }
            }
        }
    }
    found
}
