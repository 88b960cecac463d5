//! Copies of the scene and of its plan beside the results.

use std::path::PathBuf;

use serde::Serialize;

use super::folder::Folder;
use super::summary::hash_of;
use crate::output::{OutputError, atomic};
use crate::plan::Planned;
use crate::scene::{self, AnyScene};

/// The file a scene was read from; it may have changed since, or not be there.
pub(super) fn source(planned: &Planned) -> PathBuf {
    let (folder, file) = match planned {
        Planned::Flow(scene, _) => (&scene.folder, &scene.file),
        Planned::Dry(scene, _) => (&scene.folder, &scene.file),
    };
    folder.join(file)
}

/// Writes `scene.json` and `plan.json`.
///
/// # Errors
/// I/O.
pub(super) fn write(planned: &Planned, folder: &Folder) -> Result<(), OutputError> {
    let json = |name: &str| {
        let path = PathBuf::from(name);
        move |source| OutputError::Json { path, source }
    };
    let source = source(planned);
    let text = match planned {
        Planned::Flow(scene, _) => text(scene, &source, &scene.folder),
        Planned::Dry(scene, _) => text(scene, &source, &scene.folder),
    };
    let text = text.map_err(json("scene.json"))?;
    if !folder.holds(&source, "scene.json") {
        atomic::write(&folder.file("scene.json")?, text.as_bytes())?;
    }
    let plan = planned.json(None).map_err(json("plan.json"))?;
    atomic::write(&folder.file("plan.json")?, format!("{plan}\n").as_bytes())
}

/// The text of the file if it still says the same as the scene, else the scene with its defaults.
fn text(
    scene: &impl Serialize,
    source: &std::path::Path,
    folder: &std::path::Path,
) -> serde_json::Result<String> {
    if let Ok(text) = std::fs::read_to_string(source) {
        let read = scene::from_json(&text, "scene.json", folder).map(|read| match read {
            AnyScene::Flow(read) => hash_of(&read),
            AnyScene::Dry(read) => hash_of(&read),
        });
        if read.is_ok_and(|hash| hash == hash_of(scene)) {
            return Ok(text);
        }
    }
    Ok(serde_json::to_string_pretty(scene)? + "\n")
}
