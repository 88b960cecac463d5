//! Exhibits: tables and figures of a study that are worth showing but are not claims.

use super::claim::VerifyError;
pub use lahar::output::table::{Entry, ExhibitData, ExhibitRecord, Measured, Table};
use lahar::solver::run::Backend;

/// Something a study shows.
#[derive(Clone, Copy)]
pub struct Exhibit {
    /// Unique among claims, exhibits and mutants, kebab-case.
    pub id: &'static str,
    /// What is to be seen, in a sentence or two.
    pub caption: &'static str,
    /// Holds wall-clock times: stored with date and machine, never compared.
    pub timed: bool,
    /// Computes it; `true` for the full size.
    pub run: fn(&dyn Backend, bool) -> Result<ExhibitData, VerifyError>,
}
