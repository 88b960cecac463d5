//! A scene: SI units, checked, nothing numerical yet; read from a file ([`load`]) or made in Rust
//! ([`Scene::builder`], [`dry::DryScene::builder`]).

mod build;
mod check;
mod checker;
mod coupled;
mod domain;
pub mod dry;
mod elsewhere;
mod error;
mod field_choice;
mod fluid;
pub(crate) mod force;
mod hint;
mod json;
mod key_rule;
mod located;
mod meaning;
mod motion;
mod nearest;
mod numerics;
mod operator;
mod parse;
pub(crate) mod probe;
pub(crate) mod read;
mod rheology;
pub(crate) mod series;
mod view;
mod words;

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use build::SceneBuilder;
pub use coupled::{Coupling, GrainRefillChoice, GrainWallChoice, LubricationChoice, LubricationRules};
pub use domain::{Boundaries, Boundary, Domain, End};
pub use error::{KeyRule, Located, SceneError, SceneProblem};
pub use field_choice::{FieldChoice, FieldName, FieldPrecision, FieldRegion};
pub use fluid::{
    BodyForce, FillLevel, Fluid, FluidShape, Gravity, InitialFluid, InitialPressure, InitialVelocity, Layer,
    Solid,
};
pub use hint::Hint;
pub use motion::{FACE_KEYS, Motion, Motions};
pub use numerics::{
    Arrested, Cadence, ClampLimits, Collision, ExcessChoice, Numerics, Output, PrecisionChoice, RefillChoice,
    RestMeasure, SolidSurface, Steady, Stop, SurfaceGravity, SurfaceRules, WallChoice, YieldChoice,
};
pub use operator::Operator;
pub use probe::{Measure, Probe, Subject, Target};
pub use rheology::Rheology;

/// One experiment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
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
    pub domain: Domain,
    /// Gravity; none when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gravity: Option<Gravity>,
    /// The fluid.
    pub fluid: Fluid,
    /// Parts of the box that hold another fluid.
    #[serde(default)]
    pub layers: Vec<Layer>,
    /// Fixed solids; with `grains` they are walls of the grains too.
    #[serde(default)]
    pub solids: Vec<Solid>,
    /// Grains in the fluid, which push it and are pushed by it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grains: Option<dry::Grains>,
    /// Numerical choices.
    #[serde(default)]
    pub numerics: Numerics,
    /// When to stop.
    pub stop: Stop,
    /// What to write.
    #[serde(default)]
    pub output: Output,
    /// Name of the file it came from, for messages.
    #[serde(skip)]
    pub file: String,
    /// Folder of that file: tables of grains are looked for there.
    #[serde(skip)]
    pub folder: PathBuf,
}

impl Scene {
    /// Laws of all its fluids: that of `fluid`, then those of the layers.
    pub(crate) fn rheologies(&self) -> impl Iterator<Item = &Rheology> {
        std::iter::once(&self.fluid.rheology).chain(self.layers.iter().map(|layer| &layer.rheology))
    }
}

/// A scene of any kind.
#[derive(Clone, Debug, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub enum AnyScene {
    /// With fluid, and grains in it if there are any.
    Flow(Box<Scene>),
    /// Grains without fluid.
    Dry(Box<dry::DryScene>),
}

impl AnyScene {
    /// Name of the file it came from.
    #[must_use]
    pub fn file(&self) -> &str {
        match self {
            Self::Flow(scene) => &scene.file,
            Self::Dry(scene) => &scene.file,
        }
    }
}

/// Reads and checks a scene file of any kind: one that has `grains` and no `fluid` is dry.
///
/// # Errors
/// The file cannot be read, is not JSON, does not have the shape of a scene, or holds values that
/// make no sense. The message names the file (without its folder) and the JSON path.
pub fn load(path: &Path) -> Result<AnyScene, SceneError> {
    let (text, file) = read::text_of(path)?;
    from_json(&text, &file, folder_of(path))
}

/// Reads and checks the file of a scene with fluid.
///
/// # Errors
/// As [`load`]; a scene without `fluid` does not have the shape.
pub fn load_flow(path: &Path) -> Result<Scene, SceneError> {
    let (text, file) = read::text_of(path)?;
    flow_from_json(&text, &file, folder_of(path))
}

/// Reads and checks the file of a scene without fluid.
///
/// # Errors
/// As [`load`]; a scene with `fluid` does not have the shape.
pub fn load_dry(path: &Path) -> Result<dry::DryScene, SceneError> {
    let (text, file) = read::text_of(path)?;
    dry_from_json(&text, &file, folder_of(path))
}

/// Checks a scene of any kind given as text; `file` is its name in messages, and meshes and tables of grains are looked
/// for in `folder`.
///
/// # Errors
/// As [`load`].
pub(crate) fn from_json(text: &str, file: &str, folder: &Path) -> Result<AnyScene, SceneError> {
    if parse::is_dry(text) {
        dry_from_json(text, file, folder).map(|scene| AnyScene::Dry(Box::new(scene)))
    } else {
        flow_from_json(text, file, folder).map(|scene| AnyScene::Flow(Box::new(scene)))
    }
}

/// Checks a scene with fluid given as text; `file` is its name in messages, and tables of grains are looked for in
/// `folder`.
///
/// # Errors
/// As [`load_flow`].
pub fn flow_from_json(text: &str, file: &str, folder: &Path) -> Result<Scene, SceneError> {
    let mut scene: Scene = parse::parse(text, file)?;
    file.clone_into(&mut scene.file);
    folder.clone_into(&mut scene.folder);
    check::check(&scene)?;
    Ok(scene)
}

/// Checks a scene without fluid given as text; `file` is its name in messages, and meshes and tables are looked for in
/// `folder`.
///
/// # Errors
/// As [`load_dry`].
pub fn dry_from_json(text: &str, file: &str, folder: &Path) -> Result<dry::DryScene, SceneError> {
    let mut scene: dry::DryScene = parse::parse(text, file)?;
    file.clone_into(&mut scene.file);
    folder.clone_into(&mut scene.folder);
    dry::check(&scene)?;
    Ok(scene)
}

fn folder_of(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new("."))
}

/// The JSON Schema of a scene, pretty-printed, with a final newline.
#[must_use]
pub fn schema() -> String {
    let schema = schemars::schema_for!(AnyScene);
    format!("{:#}\n", schema.as_value())
}
