//! Files beside a scene: meshes, and tables of grains.

use std::path::{Path, PathBuf};

use crate::scene::dry::DryScene;
use crate::scene::read::other_than_file;

/// Path of a file that a scene names, asked for before it is opened: a pipe or a device may have no end.
///
/// # Errors
/// In words: there is no such file, with the folder that was looked into, or it is no regular file.
pub(super) fn path_of(scene: &DryScene, file: &str) -> Result<PathBuf, String> {
    let path = scene.folder.join(file);
    match std::fs::metadata(&path) {
        Ok(metadata) => match other_than_file(&metadata) {
            None => Ok(path),
            Some(kind) => Err(format!("it is a {kind}")),
        },
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            Err(format!("there is no such file in the folder `{}`", shown(&scene.folder)))
        }
        Err(error) => Err(error.kind().to_string()),
    }
}

/// A folder seen from the one the program was started in.
fn shown(folder: &Path) -> String {
    let here = std::env::current_dir().unwrap_or_default();
    let seen = folder.strip_prefix(&here).unwrap_or(folder);
    if seen.as_os_str().is_empty() { ".".to_owned() } else { seen.display().to_string() }
}
