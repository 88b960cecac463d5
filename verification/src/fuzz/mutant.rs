//! One mutant: how it is made, and what lahar makes of it.

use std::path::{Path, PathBuf};

use lahar::output::csv::Series;
use lahar::plan::target::Target;
use lahar::run::Options;
use lahar::solver::choose::Best;
use lahar::solver::run::Backend;
use lahar::{Planned, RunError, scene};
use serde_json::{Value, json};

use super::checkpoints::Checkpoints;
use super::corpus::{Corpus, Seed};
use super::random::Random;
use super::tally::Outcome;
use super::{bytes, json as tree};

/// What reads a mutant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, clap::ValueEnum)]
pub enum Reader {
    /// A scene file.
    Scene,
    /// An STL or OBJ file that a scene names.
    Mesh,
    /// A table of grains that a scene names.
    Table,
    /// A series, as a run has written it.
    Series,
    /// A checkpoint.
    Checkpoint,
}

/// Of ten mutants, which readers they are for: scenes have most keys.
const TURNS: [Reader; 10] = {
    use Reader::{Checkpoint, Mesh, Scene, Series, Table};
    [Scene, Scene, Mesh, Scene, Table, Scene, Series, Scene, Checkpoint, Scene]
};

/// Runs of more cells are left out: ten steps of them take seconds without optimisation.
const CELLS: u64 = 20_000;
/// Runs of more spheres are left out.
const SPHERES: usize = 2_000;

/// Makes mutants.
pub struct Maker {
    pub corpus: Corpus,
    /// Where files go.
    pub folder: PathBuf,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Only this reader.
    pub reader: Option<Reader>,
    /// Steps to run what was planned; 0 for none.
    pub steps: u64,
    /// Made when they are first wanted.
    pub checkpoints: Option<Checkpoints>,
}

/// Why a mutant could not be tried: nothing that lahar did.
type Trouble = Box<dyn std::error::Error>;

impl Maker {
    /// Who reads the mutant of this number, if not always the same one.
    pub fn turn(reader: Option<Reader>, number: u64) -> Reader {
        reader.unwrap_or(TURNS[(number % TURNS.len() as u64) as usize])
    }

    /// Makes a mutant and gives it to its reader.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn give(&mut self, number: u64) -> Result<Outcome, Trouble> {
        let mut random = Random::of(self.seed, number);
        match Self::turn(self.reader, number) {
            Reader::Scene => {
                let text = self.scene(&mut random);
                std::fs::write(self.folder.join("mutant.json"), text)?;
                Ok(self.scene_file("mutant.json", &mut random))
            }
            Reader::Mesh => {
                let name = self.file(&self.corpus.meshes, &mut random)?;
                self.around(&json!([{ "name": "mutant", "mesh": { "file": name } }]), &grain())?;
                Ok(self.scene_file("around.json", &mut random))
            }
            Reader::Table => {
                let name = self.file(&self.corpus.tables, &mut random)?;
                let set = json!([{ "name": "mutant", "place": { "csv": { "file": name } } }]);
                self.around(&json!([]), &set)?;
                Ok(self.scene_file("around.json", &mut random))
            }
            Reader::Series => {
                let name = self.file(&self.corpus.series, &mut random)?;
                let read = Series::read(&self.folder.join(name));
                Ok(read.map_or_else(|error| refused(&error.to_string()), |_| Outcome::Accepted))
            }
            Reader::Checkpoint => {
                let folder = self.folder.join("checkpoints");
                let checkpoints = match &mut self.checkpoints {
                    Some(made) => made,
                    empty => empty.insert(Checkpoints::make(&folder)?),
                };
                checkpoints.give(&mut random)
            }
        }
    }

    fn scene(&self, random: &mut Random) -> Vec<u8> {
        let mut text = if random.once_in(8) {
            random.pick(&self.corpus.scenes).map_or_else(Vec::new, |seed| seed.bytes.clone())
        } else {
            let mut value = random.pick(&self.corpus.trees).cloned().unwrap_or_default();
            tree::mutate(&mut value, &self.corpus.donors, random);
            return value.to_string().into_bytes();
        };
        let donor = random.pick(&self.corpus.scenes).map_or(&[][..], |seed| &seed.bytes);
        bytes::mutate(&mut text, donor, random);
        text
    }

    /// Writes a mutant of a file; its name.
    fn file(&self, seeds: &[Seed], random: &mut Random) -> Result<String, Trouble> {
        let seed = random.pick(seeds).ok_or("the corpus is empty")?;
        let mut content = seed.bytes.clone();
        let donor = random.pick(seeds).map_or(&[][..], |donor| &donor.bytes);
        bytes::mutate(&mut content, donor, random);
        let name = format!("mutant.{}", seed.ending);
        std::fs::write(self.folder.join(&name), content)?;
        Ok(name)
    }

    /// Writes a scene around a mutant.
    fn around(&self, solids: &Value, sets: &Value) -> Result<(), Trouble> {
        let scene = json!({
            "domain": { "size_m": [0.1, 0.1, 0.1], "boundaries": { "z_min": "no_slip", "z_max": "open" } },
            "gravity": { "magnitude_m_per_s2": 9.81, "direction": [0, 0, -1] },
            "grains": {
                "materials": [{ "name": "glass", "density_kg_per_m3": 2500, "young_modulus_pa": 1e7, "poisson_ratio": 0.25 }],
                "contact": { "law": { "tsuji": { "restitution": 0.5 } }, "friction": 0.5 },
                "sets": sets
            },
            "solids": solids,
            "stop": { "end_time_s": 0.1 }
        });
        Ok(std::fs::write(self.folder.join("around.json"), scene.to_string())?)
    }

    /// Reads, plans and runs a scene file.
    fn scene_file(&self, name: &str, random: &mut Random) -> Outcome {
        let scene = match scene::load(&self.folder.join(name)) {
            Ok(scene) => scene,
            Err(error) => return refused(&error.to_string()),
        };
        let planned = match Planned::new(scene, Best.layout()) {
            Ok(planned) => planned,
            Err(error) => return refused(&error.to_string()),
        };
        if let Some(fault) = unreadable(&planned, random) {
            return Outcome::Fault(fault);
        }
        if self.steps == 0 || !is_small(&planned) { Outcome::Accepted } else { self.run(&planned) }
    }

    fn run(&self, planned: &Planned) -> Outcome {
        let step = match planned {
            Planned::Flow(_, plan) => plan.units.dt_s,
            Planned::Dry(_, plan) => plan.numbers.time_step_s,
        };
        let until_s = Some(step * self.steps as f64);
        let options = Options { until_s, ..Options::new(self.folder.join("out"), &Best) };
        judged(lahar::run_scene(planned, &options).map(|_| ()))
    }
}

/// What came of a run that was planned.
pub fn judged(result: Result<(), RunError>) -> Outcome {
    match result {
        Ok(()) => Outcome::Ran,
        Err(error @ RunError::Stopped(_)) => {
            let text = error.to_string();
            if text.is_empty() { Outcome::Fault("a stop without words".to_owned()) } else { Outcome::Stopped }
        }
        Err(error @ RunError::Checkpoint { .. }) => refused(&error.to_string()),
        Err(error) => Outcome::Fault(format!("planned, and then refused: {error}")),
    }
}

/// A refusal must say something.
pub fn refused(message: &str) -> Outcome {
    if message.trim().is_empty() {
        Outcome::Fault("a refusal without words".to_owned())
    } else {
        Outcome::Refused
    }
}

/// A plan must be numbers in each of its forms.
fn unreadable(planned: &Planned, random: &mut Random) -> Option<String> {
    let table = planned.to_string();
    let word = |text: &str, word: &str| text.split(|c: char| !c.is_alphanumeric()).any(|w| w == word);
    if let Some(line) = table.lines().find(|line| word(line, "NaN") || word(line, "inf")) {
        return Some(format!("no number in the plan: {}", line.trim()));
    }
    let quote = if random.once_in(8) { planned.quote(target()) } else { Ok(None) };
    let quote = match quote {
        Ok(quote) => quote,
        Err(error) => return Some(format!("no quote: {error}")),
    };
    let _ = quote.as_ref().map(ToString::to_string);
    planned.json(quote.as_ref()).err().map(|error| format!("no JSON: {error}"))
}

fn target() -> Target {
    "1%".parse()
        .unwrap_or_else(|error| unreachable!("one per cent is an error that can be asked for: {error}"))
}

fn is_small(planned: &Planned) -> bool {
    match planned {
        Planned::Flow(_, plan) => {
            let spheres = plan.grains.as_ref().map_or(0, |coupled| coupled.grains.numbers.spheres);
            plan.setup.cells() as u64 <= CELLS && spheres <= SPHERES
        }
        Planned::Dry(_, plan) => plan.numbers.spheres <= SPHERES,
    }
}

/// Path of the last mutant of a reader, to be kept if it is at fault.
pub fn kept(folder: &Path, reader: Reader) -> Vec<PathBuf> {
    let names: &[&str] = match reader {
        Reader::Scene => &["mutant.json"],
        Reader::Mesh => &["mutant.stl", "mutant.obj", "around.json"],
        Reader::Table | Reader::Series => &["mutant.csv", "around.json"],
        Reader::Checkpoint => &["checkpoints/mutant.lahar"],
    };
    names.iter().map(|name| folder.join(name)).filter(|path| path.is_file()).collect()
}

/// A grain above a mesh.
fn grain() -> Value {
    json!([{ "name": "grain", "place": { "list": [{ "position_m": [0.05, 0.05, 0.09], "radius_m": 0.005 }] } }])
}
