//! Why a run did not end as planned.

use std::path::PathBuf;

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
