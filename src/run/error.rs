//! Why a run did not end as planned.

use std::path::PathBuf;

use super::checkpoint::CheckpointProblem;
use super::stop::StopReport;
use crate::output::OutputError;
use crate::solver::run::StartError;

/// Why a run did not end as planned.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The output folder cannot be made.
    #[error("cannot make the folder {}: {source}", .path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// Another run writes into the folder.
    #[error(
        "{}: another run writes into this folder\n  allowed: one at a time\n  way out: wait for it, or name another folder with `--out`",
        .path.display()
    )]
    InUse {
        /// The folder.
        path: PathBuf,
    },
    /// The folder holds an earlier run, which is to be kept.
    #[error(
        "{}: holds an earlier run (`{first}`)\n  allowed: with `--keep` folders without one\n  \
         way out: name another folder with `--out`, or leave `--keep` out to have the earlier run's files removed",
        .path.display()
    )]
    Kept {
        /// The folder.
        path: PathBuf,
        /// One of its files.
        first: String,
    },
    /// The folder holds a file that the run might mix with its own.
    #[error(
        "{}: holds `{name}`, which is named like a file of a run but is not in the list `lahar_files.txt` of one\n  \
         allowed: folders where every such file is lahar's own, so that runs do not mix\n  \
         way out: name another folder with `--out`, or move such files away",
        .path.display()
    )]
    Stranger {
        /// The folder.
        path: PathBuf,
        /// The file.
        name: String,
    },
    /// The run cannot go on from its checkpoint.
    #[error("{}: {problem}", .path.display())]
    Checkpoint {
        /// The file.
        path: PathBuf,
        /// Why.
        problem: CheckpointProblem,
    },
    /// The backend refused the set-up.
    #[error("cannot start: {0}")]
    Start(StartError),
    /// A guard stopped the run.
    #[error("{0}")]
    Stopped(Box<StopReport>),
    /// The worker threads cannot be made.
    #[error("cannot make worker threads: {0}")]
    Threads(rayon::ThreadPoolBuildError),
    /// A file could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}
