//! Checkpoints: the state of a run in a file, from which it goes on bit for bit.
//!
//! The file holds a mark, the number of the format, what the state belongs to ([`Labels`]), the state, and a sum over all of it.
//! Nothing of it is believed before the sum is right. A new one takes the place of the one before when it is complete and on the
//! disk.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::time::{Duration, Instant};

use crate::output::{OutputError, atomic};
use crate::state::{State, StateError, Tape, state};

/// The file.
pub(super) const FILE: &str = "checkpoint.lahar";
/// Its first bytes.
const MARK: [u8; 16] = *b"lahar checkpoint";
/// To be counted up when any state changes.
const FORMAT: u32 = 1;
/// Bytes of the sum.
const SUM: u64 = 8;

/// How often checkpoints are due.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Every {
    /// By the clock on the wall.
    Time(Duration),
    /// By steps.
    Steps(u64),
}

impl FromStr for Every {
    type Err = String;

    /// `90s`, `10min`, `2h`, `5000steps`.
    fn from_str(text: &str) -> Result<Self, String> {
        let end = text.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(text.len());
        let (number, unit) = (text[..end].trim(), text[end..].trim());
        let wanted = || "a time or a number of steps is wanted: `90s`, `10min`, `2h`, `5000steps`".to_owned();
        if let "step" | "steps" = unit {
            let steps = number.parse().ok().filter(|&steps| steps > 0);
            return steps.map(Self::Steps).ok_or_else(wanted);
        }
        let seconds = match unit {
            "s" => 1.0,
            "min" => 60.0,
            "h" => 3600.0,
            _ => return Err(wanted()),
        };
        let time = number.parse::<f64>().ok().filter(|&number| number > 0.0);
        let time = time.and_then(|number| Duration::try_from_secs_f64(number * seconds).ok());
        time.map(Self::Time).ok_or_else(wanted)
    }
}

/// When the next checkpoint is due.
pub(super) struct Due {
    every: Option<Every>,
    last: Instant,
    step: u64,
}

impl Due {
    pub fn new(every: Option<Every>) -> Self {
        Self { every, last: Instant::now(), step: 0 }
    }

    /// The run goes on from a step.
    pub(crate) fn start(&mut self, step: u64) {
        (self.last, self.step) = (Instant::now(), step);
    }

    /// Whether one is due; the next one is as far away as this one was.
    pub(crate) fn take(&mut self, step: u64) -> bool {
        let due = match self.every {
            None => false,
            Some(Every::Time(time)) => self.last.elapsed() >= time,
            Some(Every::Steps(steps)) => step - self.step >= steps,
        };
        if due {
            self.start(step);
        }
        due
    }
}

/// What a state belongs to.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Labels {
    /// Version of lahar.
    pub version: String,
    /// Backend, or what else moves.
    pub solver: String,
    /// Hash of the scene.
    pub scene: String,
    /// Hash of grains, walls and solids as planned: the scene has no more than the names of their tables and meshes.
    pub bodies: String,
    /// Last step.
    pub end: u64,
}
state!(Labels: version solver scene bodies end);

/// Why a run cannot go on from a checkpoint.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointProblem {
    /// There is none.
    #[error(
        "there is no checkpoint\n  allowed: folders of runs with `--checkpoint-every` that have not come to their end\n  \
         way out: run the scene from the start, with `--out` and `--checkpoint-every`"
    )]
    Missing,
    /// It cannot be read.
    #[error("cannot be read: {0}")]
    Io(#[from] io::Error),
    /// It is not whole.
    #[error(
        "is damaged: {0}\n  allowed: checkpoints as lahar wrote them\n  way out: a copy of the folder, or run the scene from the start"
    )]
    Damaged(&'static str),
    /// It is of something else.
    #[error("is of {what} {found}\n  allowed: {wanted}\n  way out: {way_out}")]
    Other {
        /// Of what.
        what: &'static str,
        /// Which.
        found: String,
        /// Which one this run is of.
        wanted: String,
        /// What to do.
        way_out: &'static str,
    },
    /// The solver cannot be continued.
    #[error("{0}")]
    Unsupported(StateError),
}

/// A checkpoint whose sum is right.
pub(super) struct Kept {
    path: PathBuf,
    pub labels: Labels,
}

/// Adds up bytes on their way, FNV-1a (64 bit).
struct Summing<'a> {
    out: &'a mut dyn Write,
    sum: u64,
}

const START: u64 = 0xcbf2_9ce4_8422_2325;

fn add(sum: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(sum, |sum, &byte| (sum ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

impl Write for Summing<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.out.write_all(bytes)?;
        self.sum = add(self.sum, bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// Writes a checkpoint.
///
/// # Errors
/// I/O; the solver cannot be continued.
pub(super) fn write(
    path: &Path,
    labels: &Labels,
    state: impl FnOnce(&mut Tape<'_>) -> Result<(), StateError>,
) -> Result<(), OutputError> {
    atomic::write_to_disk(path, |out| {
        let mut summing = Summing { out, sum: START };
        summing.write_all(&MARK)?;
        let mut tape = Tape::to(&mut summing);
        let all = || {
            FORMAT.clone().state(&mut tape)?;
            labels.clone().state(&mut tape)?;
            state(&mut tape)
        };
        all().map_err(|error| match error {
            StateError::Io(error) => error,
            other => io::Error::other(other.to_string()),
        })?;
        let sum = summing.sum;
        out.write_all(&sum.to_le_bytes())
    })
}

impl Kept {
    /// Looks for the checkpoint of a folder, and at its sum.
    ///
    /// # Errors
    /// There is none; it is not whole, or of another format.
    pub fn find(folder: &Path) -> Result<Self, CheckpointProblem> {
        let path = folder.join(FILE);
        let file = match File::open(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Err(CheckpointProblem::Missing),
            file => file?,
        };
        let length = file.metadata()?.len();
        let mut file = BufReader::new(file);
        let head = MARK.len() as u64 + 4;
        let mut mark = [0; MARK.len()];
        if length < head + SUM || file.read_exact(&mut mark).is_err() || mark != MARK {
            return Err(CheckpointProblem::Damaged("it does not begin as one"));
        }
        let mut format = 0_u32;
        format.state(&mut Tape::from(&mut file, 4)).map_err(damaged)?;
        if format != FORMAT {
            return Err(CheckpointProblem::Other {
                what: "format",
                found: format.to_string(),
                wanted: format!("format {FORMAT}, of lahar {}", env!("CARGO_PKG_VERSION")),
                way_out: "the version of lahar that wrote it, or run the scene from the start",
            });
        }
        file.rewind()?;
        if sum_of(&mut file, length - SUM)? != last_number(&mut file)? {
            return Err(CheckpointProblem::Damaged("the sum over its bytes is wrong"));
        }
        file.seek(io::SeekFrom::Start(head))?;
        let mut labels = Labels::default();
        labels.state(&mut Tape::from(&mut file, length - head)).map_err(damaged)?;
        Ok(Self { path, labels })
    }

    /// Whether it is of a run with these labels.
    ///
    /// # Errors
    /// It is not.
    pub fn belongs_to(&self, own: &Labels) -> Result<(), CheckpointProblem> {
        let Labels { version, solver, scene, bodies, end } = &self.labels;
        let steps = (end.to_string(), own.end.to_string());
        for (what, found, wanted, way_out) in [
            ("version", version, &own.version, "that version of lahar, or run the scene from the start"),
            ("scene", scene, &own.scene, "the scene it was made with: `scene.json` beside it"),
            ("grains, solids or meshes", bodies, &own.bodies, "the tables and meshes it was made with"),
            ("solver", solver, &own.solver, "the same `--backend`"),
            ("last step", &steps.0, &steps.1, "the same `--until`, or none"),
        ] {
            if found != wanted {
                let (found, wanted) = (found.clone(), wanted.clone());
                return Err(CheckpointProblem::Other { what, found, wanted, way_out });
            }
        }
        Ok(())
    }

    /// Reads the state.
    ///
    /// # Errors
    /// I/O, or another state.
    pub(crate) fn read(
        &self,
        state: impl FnOnce(&mut Tape<'_>) -> Result<(), StateError>,
    ) -> Result<(), CheckpointProblem> {
        let file = File::open(&self.path)?;
        let length = file.metadata()?.len();
        let mut file = BufReader::with_capacity(1 << 20, file);
        file.read_exact(&mut [0; MARK.len()])?;
        let mut tape = Tape::from(&mut file, length - MARK.len() as u64 - SUM);
        let all = || {
            0_u32.state(&mut tape)?;
            Labels::default().state(&mut tape)?;
            state(&mut tape)?;
            tape.ends()
        };
        all().map_err(damaged)
    }
}

fn damaged(error: StateError) -> CheckpointProblem {
    match error {
        StateError::Io(error) => CheckpointProblem::Io(error),
        StateError::Malformed(what) => CheckpointProblem::Damaged(what),
        StateError::Unsupported => CheckpointProblem::Unsupported(error),
    }
}

fn sum_of(file: &mut dyn Read, mut length: u64) -> io::Result<u64> {
    let (mut sum, mut piece) = (START, vec![0; 1 << 16]);
    while length > 0 {
        let size = piece.len().min(usize::try_from(length).unwrap_or(usize::MAX));
        file.read_exact(&mut piece[..size])?;
        sum = add(sum, &piece[..size]);
        length -= size as u64;
    }
    Ok(sum)
}

fn last_number(file: &mut dyn Read) -> io::Result<u64> {
    let mut bytes = [0; SUM as usize];
    file.read_exact(&mut bytes)?;
    Ok(u64::from_le_bytes(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_intervals() {
        let seconds = |s| Ok(Every::Time(Duration::from_secs(s)));
        for (text, every) in [
            ("90s", seconds(90)),
            ("10min", seconds(600)),
            ("1.5 h", seconds(5400)),
            ("1step", Ok(Every::Steps(1))),
            ("5000 steps", Ok(Every::Steps(5000))),
        ] {
            assert_eq!(text.parse(), every, "{text}");
        }
        for text in
            ["", "10", "min", "0s", "-1s", "NaNs", "1e300h", "infs", "0steps", "1.5steps", "2d", "1 µs"]
        {
            assert!(text.parse::<Every>().is_err(), "{text}");
        }
    }
}
