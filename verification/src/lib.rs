//! Claims, ladders, records and exact solutions.
//!
//! A [`claim::Claim`] is declared once. [`evaluate`] runs it over a [`claim::Ladder`] on any
//! [`Backend`] and judges the outcome; [`golden`] keeps the result bit for bit; [`study`] is the
//! body of the study binaries; [`crate::report`] turns the golden records into documents.
//!
//! Another solver implements [`Backend`] and is put through the claims of its choice with [`run`].

pub mod claim;
pub mod claims;
pub mod evaluate;
pub mod exact;
pub mod exhibit;
pub mod figures;
pub mod format;
pub mod fuzz;
pub mod golden;
pub mod ladder;
pub mod mutant;
pub mod order;
pub mod record;
pub mod reference_values;
pub mod report;
pub mod selection;
pub mod study;
pub mod verify;

pub use selection::{Selection, SelectionError};

use lahar::solver::run::Backend;
use record::Record;

/// Evaluates claims on a backend, one after the other: the way to put another solver through them, from
/// a test of its own crate.
///
/// # Returns
/// One record per claim, in the order of the report. A claim whose run was refused or stopped has a
/// record, too, which says why and does not pass.
///
/// ```no_run
/// use lahar::solver::choose::Best;
/// use lahar_verification::{Selection, run};
///
/// let selection = Selection::ids(["poiseuille-bingham", "couette-all-laws"])?;
/// for record in run(&Best, &selection) {
///     println!("{}: {}", record.claim, if record.passed() { "holds" } else { "fails" });
/// }
/// # Ok::<(), lahar_verification::SelectionError>(())
/// ```
#[must_use]
pub fn run(backend: &dyn Backend, selection: &Selection) -> Vec<Record> {
    let depth = selection.depth();
    selection.claims().iter().map(|claim| evaluate::evaluate(claim, backend, depth)).collect()
}
