//! Integrators \[D3\]: the passes over bodies, before the forces and after them.

pub mod gear;
pub(crate) mod verlet;

use super::bodies::Body;
use super::rotation::{rotate_free, spin_of, turn};
use super::{Shape, V3};
use serde::{Deserialize, Serialize};

/// Bodies per task at least.
pub(super) const LEAST: usize = 512;

/// Choice of integrator.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Integrator {
    /// Velocity Verlet, second order, forces at the predicted velocity.
    #[default]
    Verlet,
    /// Gear's 6-value predictor–corrector with c₀ = 3/16 (forces that depend on velocity).
    Gear,
    /// Gear's 6-value predictor–corrector with c₀ = 3/20 (forces that do not depend on velocity).
    GearConservative,
}

/// Force and torque set from outside, one pair per body, or none at all.
pub(crate) type External = Option<(Vec<V3>, Vec<V3>)>;

/// Constants of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Step {
    /// s.
    pub dt: f64,
    /// m/s².
    pub gravity: V3,
    /// Whether single spheres turn their orientation.
    pub turn_spheres: bool,
}

#[inline]
fn outside(external: &External, i: usize) -> (V3, V3) {
    external.as_ref().map_or((V3::zeros(), V3::zeros()), |(f, t)| (f[i], t[i]))
}

/// The free rotation of a body did not converge.
struct TooFast;

impl Body<'_> {
    /// Moves a driven body on with the velocity and spin it was told to keep.
    #[inline(always)]
    fn carry(self, step: &Step) {
        *self.position += *self.velocity * step.dt;
        if *self.shape != Shape::Sphere || step.turn_spheres {
            *self.orientation = turn(self.orientation, self.spin, step.dt);
        }
    }

    /// Turns a clump freely over Δt with the angular momentum `mean`, after which it has the one `then`.
    #[inline(always)]
    fn turn_clump(self, mean: &V3, then: V3, dt: f64) -> Result<(), TooFast> {
        let turned = rotate_free(self.orientation, mean, self.inverse_inertia, dt).ok_or(TooFast)?;
        *self.orientation = turned;
        *self.momentum = then;
        *self.spin = spin_of(self.orientation, self.inverse_inertia, self.momentum);
        Ok(())
    }

    /// Keeps the contact force and torque; whether the body's state is finite.
    #[inline(always)]
    fn settle(self, force: V3, torque: V3) -> bool {
        *self.force = force;
        *self.torque = torque;
        let (x, v, w) = (self.position, self.velocity, self.spin);
        let sum = x.x + x.y + x.z + v.x + v.y + v.z + w.x + w.y + w.z;
        sum.is_finite()
    }
}
