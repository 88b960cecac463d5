//! Scenes without fluid: grains, the walls they touch, and nothing else.
//!
//! Same units, axes, boundaries and gravity as scenes with fluid; there are no cells, so there is no spacing.

mod build;
mod check;
mod check_place;
mod contact;
mod output;
mod place;

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Boundaries, Coupling, Gravity};
use crate::geometry::Shape;

pub use build::DrySceneBuilder;
pub(super) use check::{check, check_in_fluid};
pub use contact::{Contact, ContactLaw, GrainMaterial, PairContact};
pub use output::{GrainOutput, GrainStop};
pub use place::{
    ClumpMember, ClumpMembers, ClumpShape, GrainAt, GrainSet, LatticeKind, Orientations, Placement,
    SizeChoice,
};

/// One experiment with dry grains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DryScene {
    /// Where the schema is, for editors; not read.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// One line for people.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// More for people.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub description: Option<String>,
    /// The box.
    pub domain: DryDomain,
    /// Gravity; none when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gravity: Option<Gravity>,
    /// Materials, contacts, shapes and places of the grains.
    pub grains: Grains,
    /// Walls besides the faces of the box.
    #[serde(default)]
    pub solids: Vec<GrainSolid>,
    /// When to stop.
    pub stop: GrainStop,
    /// What to write.
    #[serde(default)]
    pub output: GrainOutput,
    /// Name of the file it came from, for messages.
    #[serde(skip)]
    pub file: String,
    /// Folder of that file: meshes and tables are looked for there.
    #[serde(skip)]
    pub folder: PathBuf,
}

/// The box of a scene without fluid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DryDomain {
    /// Edge lengths along x, y, z, m; one corner is the origin.
    pub size_m: [f64; 3],
    /// What happens at the six faces. `no_slip` and `moving_wall` are walls with friction, `free_slip` is a wall
    /// without, grains that pass an `open` face are taken out and booked. A face that is not named is periodic.
    #[serde(default)]
    pub boundaries: Boundaries,
    /// Only for scenes with fluid, which have cells.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spacing_m: Option<f64>,
}

/// The grains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Grains {
    /// What grains and walls are made of; the first is the default.
    pub materials: Vec<GrainMaterial>,
    /// What happens where two materials touch, unless `pairs` says otherwise.
    pub contact: Contact,
    /// Exceptions for pairs of materials.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pairs: Vec<PairContact>,
    /// Material of the faces of the box; the first one when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wall_material: Option<String>,
    /// Rigid clumps of spheres that sets refer to.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub clumps: Vec<ClumpShape>,
    /// The grains themselves.
    pub sets: Vec<GrainSet>,
    /// Numerical choices.
    #[serde(default)]
    pub numerics: GrainNumerics,
    /// How grains and fluid act on each other; only in scenes with `fluid`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coupling: Option<Coupling>,
}

/// Numerical choices; the defaults are the best known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrainNumerics {
    /// How motion is integrated.
    #[serde(default)]
    pub integrator: IntegratorChoice,
    /// Time step, s; when not given, the shortest contact over `steps_per_contact`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_step_s: Option<f64>,
    /// Steps in the shortest contact, at least 10; 50 when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steps_per_contact: Option<f64>,
    /// Speed of the fastest impact that the time step is chosen for, m/s; estimated when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub design_speed_m_per_s: Option<f64>,
    /// Overlap at which a run is stopped, as a share of the smaller radius; 0.2 when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub overlap_limit: Option<f64>,
    /// Overlap allowed at time 0, as a share of the smaller radius; 1e-9 when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start_overlap: Option<f64>,
    /// Range of the lists of neighbours beyond touching, as a share of the radius; 0.1 when not given. No effect on
    /// results.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub skin: Option<f64>,
}

/// How motion is integrated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum IntegratorChoice {
    /// Velocity Verlet, second order.
    #[default]
    Verlet,
    /// Gear's predictor-corrector with six values and first coefficient 3/16, for forces that depend on velocity.
    Gear,
    /// Gear's predictor-corrector with six values and first coefficient 3/20, for forces that do not depend on
    /// velocity.
    GearConservative,
}

/// A wall besides the faces of the box: the surface of a shape, or of a mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrainSolid {
    /// Unique name.
    pub name: String,
    /// A body that grains are outside of. A cone has 96 flat sides; inverted it is a funnel, open at both ends. Give
    /// this or `mesh`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<Shape>,
    /// Triangles, touched from both sides. Give this or `shape`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mesh: Option<MeshFile>,
    /// Grains are inside the shape: a drum, a silo.
    #[serde(default)]
    pub invert: bool,
    /// Material; the first one when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Velocity, m/s; the wall moves with it.
    #[serde(default)]
    pub velocity_m_per_s: [f64; 3],
    /// Angular velocity, rad/s; the wall turns with it.
    #[serde(default)]
    pub spin_rad_per_s: [f64; 3],
    /// Centre of rotation at time 0, m; the centre of the shape when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub centre_m: Option<[f64; 3]>,
}

/// A mesh in a file beside the scene: STL (text or binary) or OBJ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshFile {
    /// Its name, relative to the folder of the scene.
    pub file: String,
    /// Metres per unit of the file; 1 when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<f64>,
    /// Added after scaling, m.
    #[serde(default)]
    pub shift_m: [f64; 3],
}

impl DryScene {
    /// Index of a material by name; the first one without a name, `None` for an unknown name.
    #[must_use]
    pub(crate) fn material(&self, name: Option<&str>) -> Option<usize> {
        let Some(name) = name else { return Some(0) };
        self.grains.materials.iter().position(|material| material.name == name)
    }

    /// Acceleration of gravity, m/s².
    #[must_use]
    pub fn gravity(&self) -> [f64; 3] {
        self.gravity.as_ref().map_or([0.0; 3], crate::scene::force::gravity_vector)
    }
}
