//! What mutants are made from.

use std::io;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::json::Donors;

/// A file: its ending, and what is in it.
pub struct Seed {
    /// `stl`.
    pub ending: String,
    /// Content.
    pub bytes: Vec<u8>,
}

/// All seeds, in the order of their names.
pub struct Corpus {
    /// Scenes of all kinds: those that come with lahar, and those once answered wrongly.
    pub scenes: Vec<Seed>,
    /// The same as trees, those that are JSON.
    pub trees: Vec<Value>,
    /// What may be grafted from one into the other.
    pub donors: Donors,
    /// Meshes of each format.
    pub meshes: Vec<Seed>,
    /// Tables of grains.
    pub tables: Vec<Seed>,
    /// Series.
    pub series: Vec<Seed>,
}

/// Folders with scenes, from the root of the repository.
const SCENES: [&str; 5] =
    ["scenes/verify", "scenes/show", "scenes/grains", "scenes/coupled", "verification/corpus/scenes"];

/// And one with scenes that are refused.
const REFUSED: &str = "tests/bad_scenes";

/// Folders with files that scenes name.
const BESIDE: [&str; 3] = [REFUSED, "verification/corpus/tables", "verification/corpus/series"];

impl Corpus {
    /// Reads it.
    ///
    /// # Errors
    /// A folder or file that cannot be read.
    pub fn read(root: &Path) -> io::Result<Self> {
        let (mut scenes, mut trees, mut donors) = (Vec::new(), Vec::new(), Donors::default());
        for folder in SCENES {
            scenes.extend(seeds(&root.join(folder), &["json"])?);
        }
        // Those that are refused as they are only lend their parts: their mutants would be refused as well.
        let refused = seeds(&root.join(REFUSED), &["json"])?;
        for scene in refused.iter().filter_map(|scene| serde_json::from_slice(&scene.bytes).ok()) {
            donors.add(&scene);
        }
        for scene in &scenes {
            if let Ok(tree) = serde_json::from_slice::<Value>(&scene.bytes) {
                donors.add(&tree);
                trees.push(tree);
            }
        }
        let [_, tables, series] = BESIDE.map(|folder| root.join(folder));
        let (meshes, series) = (seeds(&tables, &["stl", "obj"])?, seeds(&series, &["csv"])?);
        Ok(Self { scenes, trees, donors, meshes, tables: seeds(&tables, &["csv"])?, series })
    }

    /// Copies what scenes name into a folder.
    ///
    /// # Errors
    /// I/O.
    pub fn beside(root: &Path, folder: &Path) -> io::Result<()> {
        for from in BESIDE {
            for path in files(&root.join(from))? {
                let name = path.file_name().unwrap_or_default();
                if ending(&path) != "json" {
                    std::fs::copy(&path, folder.join(name))?;
                }
            }
        }
        Ok(())
    }
}

fn seeds(folder: &Path, endings: &[&str]) -> io::Result<Vec<Seed>> {
    let mut seeds = Vec::new();
    for path in files(folder)? {
        let ending = ending(&path);
        if endings.contains(&ending.as_str()) {
            seeds.push(Seed { ending, bytes: std::fs::read(&path)? });
        }
    }
    Ok(seeds)
}

fn files(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        files.push(entry?.path());
    }
    files.sort();
    Ok(files)
}

fn ending(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().into_owned()
}
