//! Contact between two members, or a member and a wall: geometry and motion in, force and torque out.
//!
//! A contact is seen from its first side: `normal` points from the second side to the first, `slip` is the
//! velocity of the first surface relative to the second, the force acts on the first side and its opposite on
//! the second.

pub(crate) mod friction;
pub(crate) mod hertz;
pub(crate) mod linear;
pub(crate) mod pass;
pub mod restitution;
pub(crate) mod tsuji;

use super::V3;
use super::material::{Compiled, PairLaw};
use crate::state::state;
use friction::{Slider, slide};

/// The three statements of contact mechanics that a run can be made with others of: a harness that shows that it
/// would notice a wrong one implements them so. They are compiled into the kernel, and cost nothing.
pub trait ContactEquations: Copy + Send + Sync {
    /// Turns a vector of the old contact plane (normal `n0`) into the new one (normal `n`), with the twist
    /// angle `twist` (rad) about the normal.
    ///
    /// The tilt is the smallest rotation that takes `n0` to `n`, so a rigid motion of the pair carries the
    /// spring along unchanged (objectivity).
    #[inline(always)]
    fn rotate_spring(&self, s: &V3, n0: &V3, n: &V3, twist: f64) -> V3 {
        let along = s.dot(n);
        let c = 1.0 + n0.dot(n);
        // c = 0 would be a normal that turned over within one step; the spring then only loses its normal part.
        let tilted = if c > 1e-3 { s - (n0 + n) * (along / c) } else { s - n * along };
        tilted * (1.0 - 0.5 * twist * twist) + n.cross(&tilted) * twist
    }

    /// Largest tangential force, μ F_n (Coulomb).
    #[inline(always)]
    fn friction_cap(&self, friction: f64, normal_force: f64) -> f64 {
        friction * normal_force
    }

    /// Velocity of a body's surface, u = v + ω × r (004 Eq 3.38 corrected).
    #[inline(always)]
    fn surface_velocity(&self, v: &V3, omega: &V3, r: &V3) -> V3 {
        v + omega.cross(r)
    }
}

/// The equations as they should be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StandardContact;
impl ContactEquations for StandardContact {}

/// Where two surfaces meet.
#[derive(Debug, Clone, Copy)]
pub struct Geometry {
    /// From the second side to the first, unit length.
    pub normal: V3,
    /// δ > 0, m.
    pub overlap: f64,
    /// R*, m.
    pub radius: f64,
    /// m*, kg.
    pub mass: f64,
}

/// How two surfaces move against each other.
#[derive(Debug, Clone, Copy)]
pub struct Motion {
    /// Velocity of the first surface relative to the second, m/s.
    pub slip: V3,
    /// ω₁ − ω₂, rad/s.
    pub relative_spin: V3,
    /// ½(ω₁ + ω₂), rad/s: the contact plane twists with it.
    pub mean_spin: V3,
}

/// What a contact remembers from one step to the next.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct History {
    /// Normal at the last step; zero when the surfaces did not touch.
    pub normal: V3,
    /// Contact radius √(R* δ) at the last step (1 for the linear law), m; 0 when the surfaces did not touch.
    pub root: f64,
    /// Tangential spring, m, already advanced by half of the last step (trapezoidal rule).
    pub spring: V3,
    /// Magnitude of the tangential spring force at the last step, N.
    pub force: f64,
}

/// What a contact with rolling resistance remembers besides.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rolling {
    /// Rolling spring, rad, advanced like [`History::spring`].
    pub roll: V3,
    /// Magnitude of the rolling spring torque at the last step, N m.
    pub torque: f64,
    /// Rolling torque on the first side at the last step, N m.
    pub moment: V3,
}

state!(History: normal root spring force);
state!(Rolling: roll torque moment);

impl History {
    /// Energy still in the tangential spring of a contact that has just opened, J. It is lost.
    #[inline]
    pub(crate) fn released(&self) -> f64 {
        0.5 * self.force * self.spring.norm()
    }
}

impl Rolling {
    /// Energy still in the rolling spring of a contact that has just opened, J. It is lost.
    #[inline]
    pub(crate) fn released(&self) -> f64 {
        0.5 * self.torque * self.roll.norm()
    }
}

/// Rates (W) and amounts (J) that contacts lose or exchange; see `super::energy`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Losses {
    /// Rate lost in the normal direction, W.
    pub normal: f64,
    /// Rate lost tangentially while sticking (dashpot, change of stiffness), W.
    pub tangential: f64,
    /// Rate lost in rolling while sticking, W.
    pub rolling: f64,
    /// Work of slip in this step, J.
    pub slip: f64,
    /// Work of rolling slip in this step, J.
    pub roll_slip: f64,
    /// Rate at which moving walls and driven bodies work on the contacts, W.
    pub driven: f64,
}

state!(Losses: normal tangential rolling slip roll_slip driven);

impl Losses {
    /// Adds `other`, term by term.
    #[inline(always)]
    pub(crate) fn add(&mut self, other: &Losses) {
        self.normal += other.normal;
        self.tangential += other.tangential;
        self.rolling += other.rolling;
        self.slip += other.slip;
        self.roll_slip += other.roll_slip;
        self.driven += other.driven;
    }
}

/// Force and torque of a contact on its first side.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Reaction {
    /// Normal force F_n ≥ 0, N.
    pub normal: f64,
    /// Tangential force, N.
    pub tangential: V3,
    /// Rolling torque, N m.
    pub rolling: V3,
}

/// The normal force without cut-off and what follows from it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Normal {
    /// Elastic part, N.
    pub elastic: f64,
    /// Damping coefficient, N s/m.
    pub damping: f64,
    /// Contact radius √(R* δ), m; 1 for the linear law.
    pub root: f64,
    /// Tangential stiffness, N/m.
    pub tangential_stiffness: f64,
}

/// Elastic force, damping and tangential stiffness of a pair at an overlap.
#[inline(always)]
pub(crate) fn normal_terms(law: &PairLaw, g: &Geometry) -> Normal {
    match law.normal {
        Compiled::ViscoElastic { time } => hertz::visco_elastic(law.young, law.shear, time, g),
        Compiled::Tsuji { alpha } => tsuji::constant_restitution(law.young, law.shear, alpha, g),
        Compiled::Linear { stiffness, ratio, tangential } => {
            linear::spring_dashpot(stiffness, ratio, tangential, g)
        }
    }
}

/// Elastic energy stored by the overlap, J.
#[inline]
pub(crate) fn elastic_energy(law: &PairLaw, g: &Geometry) -> f64 {
    let n = normal_terms(law, g);
    match law.normal {
        // integral of F over the overlap: F ~ delta^{3/2}
        Compiled::ViscoElastic { .. } | Compiled::Tsuji { .. } => 0.4 * n.elastic * g.overlap,
        Compiled::Linear { .. } => 0.5 * n.elastic * g.overlap,
    }
}

/// A contact in one step.
#[derive(Debug, Clone, Copy)]
pub struct Contact<'a> {
    /// The pair's constants.
    pub law: &'a PairLaw,
    /// Where the surfaces meet.
    pub geometry: Geometry,
    /// How they move.
    pub motion: Motion,
    /// Time since the last step, s.
    pub dt: f64,
}

/// What a contact remembers, and the books it writes to.
#[derive(Debug)]
pub struct Memory<'a> {
    /// Of the tangential spring.
    pub history: &'a mut History,
    /// Of the rolling spring; untouched without rolling resistance.
    pub rolling: &'a mut Rolling,
    /// Where losses are added.
    pub losses: &'a mut Losses,
}

/// Force of a contact, \[D1\] and \[D2\]; moves its history on by one step.
///
/// # Arguments
/// `equations`: [`StandardContact`] but for trials. `memory`: of this contact.
/// # Source
/// docs/method.md \[D1\], \[D2\]; 000 Sec 2.1.
#[inline(always)]
pub fn react<E: ContactEquations>(equations: &E, contact: &Contact, memory: Memory) -> Reaction {
    let Contact { law, geometry: g, motion: m, .. } = contact;
    let Memory { history, rolling, losses } = memory;
    let n = normal_terms(law, g);
    let speed = -m.slip.dot(&g.normal); // rate of the overlap
    let wished = n.elastic + n.damping * speed;
    let force = if wished > 0.0 { wished } else { 0.0 };
    losses.normal += (force - n.elastic) * speed;
    let mut out = Reaction { normal: force, ..Reaction::default() };
    if law.friction > 0.0 {
        let carried = Carried::over(equations, contact, history, &n);
        let cap = equations.friction_cap(law.friction, force);
        out.tangential = carried.friction(contact, &n, cap, history, losses);
        if law.rolling > 0.0 {
            out.rolling = carried.resistance(contact, &n, force, rolling, losses);
        }
    }
    history.normal = g.normal;
    history.root = n.root;
    out
}

/// How springs come over from the last step.
struct Carried<'a, E> {
    equations: &'a E,
    /// Normals then and now.
    normals: [V3; 2],
    /// Whether there was a contact.
    old: bool,
    /// Angle by which the pair has twisted about the normal, rad.
    twist: f64,
    /// Share of a spring's elongation that a change of stiffness leaves.
    keep: f64,
    /// Rate of the overlap, m/s.
    speed: f64,
    /// Of the tangential stiffness over itself, 1/s.
    stiffness_rate: f64,
}

impl<'a, E: ContactEquations> Carried<'a, E> {
    #[inline(always)]
    fn over(equations: &'a E, contact: &Contact, history: &History, n: &Normal) -> Self {
        let Contact { geometry: g, motion: m, dt, .. } = contact;
        let speed = -m.slip.dot(&g.normal);
        // The tangential stiffness grows with sqrt(delta). Loading keeps the force, unloading keeps the
        // displacement, so that a change of stiffness never makes energy (Thornton, Cummins & Cleary 2013).
        let ratio = history.root / n.root;
        Self {
            equations,
            normals: [history.normal, g.normal],
            old: history.root > 0.0,
            twist: dt * m.mean_spin.dot(&g.normal),
            keep: if ratio < 1.0 { ratio } else { 1.0 },
            speed,
            stiffness_rate: if n.root == 1.0 { 0.0 } else { 0.5 * speed.abs() / g.overlap },
        }
    }

    /// A spring that lay in the old contact plane.
    #[inline(always)]
    fn spring(&self, s: &V3) -> V3 {
        let [before, now] = &self.normals;
        if self.old {
            self.equations.rotate_spring(s, before, now, self.twist) * self.keep
        } else {
            V3::zeros()
        }
    }

    /// Tangential force, N.
    #[inline(always)]
    fn friction(
        &self,
        contact: &Contact,
        n: &Normal,
        cap: f64,
        history: &mut History,
        losses: &mut Losses,
    ) -> V3 {
        let Contact { law, geometry: g, motion: m, dt } = contact;
        let slip = m.slip + g.normal * self.speed;
        let spring = self.spring(&history.spring);
        let mut s = Slider { spring, force: history.force, keep: self.keep, energy: 0.0 };
        let damping = law.tangential_damping * n.damping;
        let (t, rate, work) = slide(&mut s, &slip, n.tangential_stiffness, damping, cap, *dt);
        losses.tangential += rate + s.energy * self.stiffness_rate;
        losses.slip += work;
        history.spring = s.spring;
        history.force = s.force;
        t
    }

    /// Rolling torque, N m.
    ///
    /// Twisting about the normal is resisted like rolling: without it a sphere on one contact spins for ever.
    /// The twist part of the spring stays along the normal as the contact turns.
    #[inline(always)]
    fn resistance(
        &self,
        contact: &Contact,
        n: &Normal,
        force: f64,
        rolling: &mut Rolling,
        losses: &mut Losses,
    ) -> V3 {
        let Contact { law, geometry: g, motion: m, dt } = contact;
        let before = &self.normals[0];
        let arm2 = g.radius * g.radius;
        let along = rolling.roll.dot(before);
        let kept = if self.old { g.normal * (along * self.keep) } else { V3::zeros() };
        let spring = self.spring(&(rolling.roll - before * along)) + kept;
        let mut r = Slider { spring, force: rolling.torque, keep: self.keep, energy: 0.0 };
        let stiffness = n.tangential_stiffness * arm2;
        let damping = law.tangential_damping * n.damping * arm2;
        let cap = law.rolling * g.radius * force;
        let (t, rate, work) = slide(&mut r, &m.relative_spin, stiffness, damping, cap, *dt);
        losses.rolling += rate + r.energy * self.stiffness_rate;
        losses.roll_slip += work;
        rolling.roll = r.spring;
        rolling.torque = r.force;
        t
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn springs_turn_with_the_normal_and_lose_what_is_along_it_where_it_turns_over() {
        let (x, y, z) = (V3::x(), V3::y(), V3::z());
        // A quarter turn about y takes z to x and −x to z; a twist of 0.02 about x turns z towards −y.
        let turned = StandardContact.rotate_spring(&-x, &z, &x, 0.0);
        assert!((turned - z).norm() < 1e-15, "{turned}");
        let twisted = StandardContact.rotate_spring(&z, &x, &x, 0.02);
        assert!((twisted - (z * (1.0 - 2e-4) - y * 0.02)).norm() < 1e-15, "{twisted}");
        // Turned over: what is along the new normal is left out.
        let n = (z + x * 0.01).normalize();
        let spring = V3::new(0.5, 0.25, 0.125);
        let left = StandardContact.rotate_spring(&spring, &-n, &n, 0.0);
        assert!(
            left.dot(&n).abs() < 1e-15 && (left - (spring - n * spring.dot(&n))).norm() < 1e-15,
            "{left}"
        );
    }
}
