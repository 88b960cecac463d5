//! Why nothing could be measured.

use crate::plan::memory::human;
use crate::solver::run::StartError;

/// Why nothing could be measured.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// No group and no case has this name.
    #[error("found the name `{found}`\n  allowed: {}\n  way out: one of these, or no `--only` for all of them", names.join(", "))]
    UnknownName {
        /// What was asked for.
        found: String,
        /// What there is.
        names: Vec<String>,
    },
    /// Predicted not to fit.
    #[error("{what} needs {}\n  allowed: at most the {} that are available\n  way out: `--quick`, which is ten times smaller, or free some memory", human(*needed), human(*available))]
    OutOfMemory {
        /// What does not fit.
        what: String,
        /// Predicted bytes.
        needed: u64,
        /// Bytes that can be taken.
        available: u64,
    },
    /// No worker threads.
    #[error("cannot start the worker threads: {0}\n  way out: fewer `--threads`")]
    Threads(rayon::ThreadPoolBuildError),
    /// A backend refused one of the set-ups.
    #[error("`{case}` cannot start: {source}")]
    Start {
        /// The case.
        case: String,
        /// Why.
        source: StartError,
    },
    /// Grains refused or stopped.
    #[error("`{case}`: {source}")]
    Grains {
        /// The case.
        case: String,
        /// Why.
        source: Box<crate::dem::DemError>,
    },
    /// A guard stopped one of the flows.
    #[error("`{case}` was stopped at step {step} by the guard: the measurement means nothing")]
    Stopped {
        /// The case.
        case: String,
        /// The step.
        step: u64,
    },
}
