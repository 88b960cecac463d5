//! What a run of grains consists of.

use super::{Clump, Integrator, Materials, Orientation, V3, Wall};
use serde::{Deserialize, Serialize};

/// Shape of a grain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Shape {
    /// A single sphere.
    Sphere,
    /// The clump of this number in [`Setup::clumps`].
    Clump(usize),
}

/// One grain at the start.
#[derive(Debug, Clone, PartialEq)]
pub struct Grain {
    /// Shape.
    pub shape: Shape,
    /// Radius of the sphere, or of the sphere with the clump's volume, m.
    pub radius: f64,
    /// Index of its material.
    pub material: usize,
    /// Centre of mass, m.
    pub position: V3,
    /// m/s.
    pub velocity: V3,
    /// Body frame (principal axes, see [`Clump::frame`]) to frame of the scene.
    pub orientation: Orientation,
    /// rad/s.
    pub spin: V3,
    /// Keeps its velocity and spin whatever pushes it.
    pub driven: bool,
}

impl Grain {
    /// A sphere at rest.
    pub fn sphere(radius: f64, position: V3, material: usize) -> Self {
        Self {
            shape: Shape::Sphere,
            radius,
            material,
            position,
            velocity: V3::zeros(),
            orientation: Orientation::identity(),
            spin: V3::zeros(),
            driven: false,
        }
    }

    /// A clump at rest.
    pub fn clump(
        number: usize,
        radius: f64,
        position: V3,
        orientation: Orientation,
        material: usize,
    ) -> Self {
        Self { shape: Shape::Clump(number), orientation, ..Self::sphere(radius, position, material) }
    }

    /// This grain with a velocity, m/s.
    pub fn moving(self, velocity: V3) -> Self {
        Self { velocity, ..self }
    }

    /// This grain with a spin, rad/s.
    pub fn spinning(self, spin: V3) -> Self {
        Self { spin, ..self }
    }
}

/// Period of each axis, m; the base cell starts at 0.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Period(pub [Option<f64>; 3]);

/// A run, before it is checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Setup {
    /// Materials and their pair table.
    pub materials: Materials,
    /// Shapes that grains refer to.
    pub clumps: Vec<Clump>,
    /// The grains.
    pub grains: Vec<Grain>,
    /// The scenery.
    pub walls: Vec<Wall>,
    /// Periodic axes.
    pub period: Period,
    /// m/s².
    pub gravity: V3,
    /// Step, s; `None` takes `steps_per_contact` steps in the shortest contact, or what its dashpots and springs need where
    /// that would make energy.
    pub time_step_s: Option<f64>,
    /// Impact speed the step is chosen for, m/s.
    pub design_speed_m_s: f64,
    /// Steps in the shortest contact at the design speed, for the suggested step.
    pub steps_per_contact: f64,
    /// Integrator.
    pub integrator: Integrator,
    /// Verlet skin as a share of each member's radius.
    pub skin: f64,
    /// Largest overlap as a share of the smaller radius; beyond it the run stops.
    pub overlap_limit: f64,
    /// Largest overlap at the start as a share of the smaller radius.
    pub start_overlap: f64,
    /// Whether single spheres turn their orientation too (only output needs it).
    pub turn_spheres: bool,
}

impl Setup {
    /// A set-up without grains, walls or gravity; 50 steps per contact at 1 m/s, velocity Verlet.
    pub fn new(materials: Materials) -> Self {
        Self {
            materials,
            clumps: Vec::new(),
            grains: Vec::new(),
            walls: Vec::new(),
            period: Period::default(),
            gravity: V3::zeros(),
            time_step_s: None,
            design_speed_m_s: 1.0,
            steps_per_contact: 50.0,
            integrator: Integrator::Verlet,
            skin: 0.1,
            overlap_limit: 0.2,
            start_overlap: 1e-9,
            turn_spheres: false,
        }
    }
}
