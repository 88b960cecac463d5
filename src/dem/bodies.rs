//! State of the bodies (structure of arrays) and of their member spheres.

use super::{Orientation, Shape, V3};
use crate::state::state;
use rayon::prelude::*;

/// State and constants of all bodies, one entry per body in the order of the grains of the set-up.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Bodies {
    /// Centre of mass, m. With periodic faces it runs on without being folded back.
    pub position: Vec<V3>,
    /// m/s.
    pub velocity: Vec<V3>,
    /// rad/s, frame of the scene.
    pub spin: Vec<V3>,
    /// Body frame to frame of the scene. Single spheres keep the start value unless the set-up asks for it.
    pub orientation: Vec<Orientation>,
    /// Angular momentum about the centre, kg m²/s; kept for clumps only.
    pub momentum: Vec<V3>,
    /// Contact force, N.
    pub force: Vec<V3>,
    /// Contact torque about the centre, N m.
    pub torque: Vec<V3>,
    /// kg.
    pub mass: Vec<f64>,
    /// 1/kg; 0 for driven bodies.
    pub inverse_mass: Vec<f64>,
    /// Principal moments of inertia, kg m².
    pub inertia: Vec<V3>,
    /// Their inverses; 0 for driven bodies.
    pub inverse_inertia: Vec<V3>,
    /// Radius of the sphere, or of the sphere of the clump's volume, m.
    pub radius: Vec<f64>,
    /// As in the set-up.
    pub shape: Vec<Shape>,
    /// First member of each body, and the number of all members at the end.
    pub first_member: Vec<u32>,
    /// Bodies that move as told, not as pushed.
    pub driven: Vec<u32>,
}

state!(Bodies:
    position velocity spin orientation momentum force torque;
    but mass inverse_mass inertia inverse_inertia radius shape first_member driven
);

/// One body as an integrator moves it.
#[derive(Debug)]
pub(crate) struct Body<'a> {
    /// Centre of mass, m.
    pub position: &'a mut V3,
    /// m/s.
    pub velocity: &'a mut V3,
    /// rad/s.
    pub spin: &'a mut V3,
    /// Body frame to frame of the scene.
    pub orientation: &'a mut Orientation,
    /// kg m²/s; of clumps only.
    pub momentum: &'a mut V3,
    /// Contact force, N.
    pub force: &'a mut V3,
    /// Contact torque, N m.
    pub torque: &'a mut V3,
    /// 1/kg; 0 for driven bodies.
    pub inverse_mass: &'a f64,
    /// 1/(kg m²); 0 for driven bodies.
    pub inverse_inertia: &'a V3,
    /// Sphere or clump.
    pub shape: &'a Shape,
}

impl Bodies {
    /// All bodies one by one, in order.
    pub(super) fn each(&mut self) -> impl IndexedParallelIterator<Item = Body<'_>> {
        (
            (&mut self.position, &mut self.velocity, &mut self.spin, &mut self.orientation),
            (&mut self.momentum, &mut self.force, &mut self.torque),
            (&self.inverse_mass, &self.inverse_inertia, &self.shape),
        )
            .into_par_iter()
            .map(|(motion, (momentum, force, torque), (inverse_mass, inverse_inertia, shape))| {
                let (position, velocity, spin, orientation) = motion;
                Body {
                    position,
                    velocity,
                    spin,
                    orientation,
                    momentum,
                    force,
                    torque,
                    inverse_mass,
                    inverse_inertia,
                    shape,
                }
            })
    }

    /// Number of bodies.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Translational kinetic energy of body `i`, J (0 if driven).
    pub fn translational_energy(&self, i: usize) -> f64 {
        if self.inverse_mass[i] > 0.0 { 0.5 * self.mass[i] * self.velocity[i].norm_squared() } else { 0.0 }
    }

    /// Rotational kinetic energy of body `i`, J (0 if driven).
    pub fn rotational_energy(&self, i: usize) -> f64 {
        if self.inverse_mass[i] > 0.0 { 0.5 * self.spin[i].dot(&self.angular_momentum(i)) } else { 0.0 }
    }

    /// Angular momentum of body `i` about its centre, kg m²/s.
    pub(crate) fn angular_momentum(&self, i: usize) -> V3 {
        if self.shape[i] == Shape::Sphere { self.spin[i] * self.inertia[i].x } else { self.momentum[i] }
    }
}

/// A member sphere as the contact kernel reads it: everything of one member side by side in memory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Member {
    /// Centre, m.
    pub position: V3,
    /// m.
    pub radius: f64,
    /// Velocity of the centre, m/s.
    pub velocity: V3,
    /// Of the body, rad/s.
    pub spin: V3,
    /// Of the body, 1/kg.
    pub inverse_mass: f64,
    /// Body number.
    pub body: u32,
    /// Material number.
    pub material: u32,
}

state!(Member: position velocity spin; but radius inverse_mass body material);
