//! State of the bodies (structure of arrays) and of their member spheres.

use super::{Orientation, V3};

/// Shape number of a single sphere.
pub const SPHERE: u32 = u32::MAX;

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
    /// Number of the clump in the set-up, or [`SPHERE`].
    pub shape: Vec<u32>,
    /// First member of each body, and the number of all members at the end.
    pub first_member: Vec<u32>,
    /// Bodies that move as told, not as pushed.
    pub driven: Vec<u32>,
}

impl Bodies {
    /// Number of bodies.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
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
    pub fn angular_momentum(&self, i: usize) -> V3 {
        if self.shape[i] == SPHERE { self.spin[i] * self.inertia[i].x } else { self.momentum[i] }
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
