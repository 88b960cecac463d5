//! Mutants of checkpoints.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use lahar::run::{Every, Options};
use lahar::solver::choose::Best;
use lahar::solver::run::Backend;
use lahar::{Planned, scene};
use serde_json::{Value, json};

use super::bytes;
use super::mutant::{judged, refused};
use super::random::Random;
use super::tally::Outcome;

type Trouble = Box<dyn std::error::Error>;

/// Bytes of the sum at the end of a checkpoint.
const SUM: usize = 8;
/// Bytes before the state: mark and number of the format.
const HEAD: usize = 20;

/// Checkpoints of a fluid, of grains, and of both, with the runs they belong to.
pub struct Checkpoints {
    folder: PathBuf,
    runs: Vec<(Planned, PathBuf, Vec<u8>)>,
}

impl Checkpoints {
    /// Interrupts a small run of each kind after its first checkpoint.
    ///
    /// # Errors
    /// Files, or a run that leaves no checkpoint.
    pub fn make(folder: &Path) -> Result<Self, Trouble> {
        let mut runs = Vec::new();
        for (name, scene) in scenes() {
            let out = folder.join(name);
            std::fs::create_dir_all(&out)?;
            let path = folder.join(format!("{name}.json"));
            std::fs::write(&path, scene.to_string())?;
            let planned = Planned::new(scene::load(&path)?, Best.layout())?;
            let bytes = interrupted(&planned, &out)?;
            runs.push((planned, out, bytes));
        }
        Ok(Self { folder: folder.to_owned(), runs })
    }

    /// Goes on from a mutant. Every second one has the sum that its bytes want: only such a one reaches the readers of states.
    /// A state that is read is written again at once, without a step.
    pub fn give(&mut self, random: &mut Random) -> Result<Outcome, Trouble> {
        let (planned, out, whole) = random.pick(&self.runs).ok_or("no checkpoints")?;
        let donor = &random.pick(&self.runs).ok_or("no checkpoints")?.2;
        let mut content = whole.clone();
        if random.once_in(2) {
            bytes::mutate(&mut content, donor, random);
        } else {
            content.truncate(whole.len() - SUM);
            let mut state = content.split_off(HEAD);
            bytes::mutate(&mut state, donor, random);
            content.extend(state);
            content.extend(sum(&content).to_le_bytes());
        }
        std::fs::write(self.folder.join("mutant.lahar"), &content)?;
        std::fs::write(out.join("checkpoint.lahar"), &content)?;
        let asked = AtomicBool::new(true);
        let options = Options {
            interrupt: Some(&asked),
            resume: true,
            checkpoint_every: Some(Every::Steps(1)),
            ..Options::new(out.clone(), &Best)
        };
        Ok(match lahar::run_scene(planned, &options) {
            Ok(_) => Outcome::Ran,
            // Rows of another number of columns: the file of the series is not the one of the mutant.
            Err(error @ lahar::RunError::Output(_)) => refused(&error.to_string()),
            Err(error) => judged(Err(error)),
        })
    }
}

/// FNV-1a (64 bit), as checkpoints are summed.
fn sum(bytes: &[u8]) -> u64 {
    let start = 0xcbf2_9ce4_8422_2325;
    bytes.iter().fold(start, |sum: u64, &b| (sum ^ u64::from(b)).wrapping_mul(0x0000_0100_0000_01b3))
}

/// The checkpoint of a run that is interrupted once there is one.
fn interrupted(planned: &Planned, out: &Path) -> Result<Vec<u8>, Trouble> {
    let asked = AtomicBool::new(false);
    let file = out.join("checkpoint.lahar");
    let options = Options {
        interrupt: Some(&asked),
        checkpoint_every: Some(Every::Steps(2)),
        ..Options::new(out.to_owned(), &Best)
    };
    std::thread::scope(|scope| {
        scope.spawn(|| {
            while !asked.load(Ordering::Relaxed) {
                if file.exists() {
                    asked.store(true, Ordering::Relaxed);
                }
                std::thread::sleep(Duration::from_millis(1));
            }
        });
        let result = lahar::run_scene(planned, &options);
        asked.store(true, Ordering::Relaxed);
        result
    })?;
    Ok(std::fs::read(file)?)
}

/// A fluid with a surface, grains, and both.
fn scenes() -> [(&'static str, Value); 3] {
    let fluid = json!({
        "domain": {
            "size_m": [0.09, 0.04, 0.07], "spacing_m": 0.01,
            "boundaries": { "x_min": "no_slip", "x_max": "open", "y_min": "free_slip", "y_max": "free_slip",
                            "z_min": "no_slip", "z_max": "open" }
        },
        "gravity": { "magnitude_m_per_s2": 9.81, "direction": [0, 0, -1] },
        "fluid": {
            "density_kg_per_m3": 1500,
            "rheology": { "bingham": { "yield_stress_pa": 20, "plastic_viscosity_pa_s": 2 } },
            "initial": { "shapes": [{ "shape": { "box": { "min_m": [0, 0, 0], "max_m": [0.05, 0.04, 0.05] } } }] }
        },
        "stop": { "end_time_s": 60 },
        "output": { "series": { "every_s": 0.01 } }
    });
    let grains = json!({
        "materials": [{ "name": "glass", "density_kg_per_m3": 2500, "young_modulus_pa": 1e6, "poisson_ratio": 0.25 }],
        "contact": { "law": { "tsuji": { "restitution": 0.5 } }, "friction": 0.4 },
        "sets": [{ "name": "stones", "place": { "list": [
            { "position_m": [0.02, 0.02, 0.013], "radius_m": 0.012 },
            { "position_m": [0.044, 0.02, 0.013], "radius_m": 0.012, "velocity_m_per_s": [-0.5, 0, 0] }
        ] } }]
    });
    let mut both = fluid.clone();
    both["grains"] = grains.clone();
    let mut dry = both.clone();
    for key in ["fluid", "domain"] {
        dry.as_object_mut().map(|scene| scene.remove(key));
    }
    dry["domain"] = json!({ "size_m": [0.09, 0.04, 0.07], "boundaries": {
        "y_min": "free_slip", "y_max": "free_slip", "z_min": "no_slip", "z_max": "open"
    } });
    [("fluid", fluid), ("grains", dry), ("both", both)]
}
