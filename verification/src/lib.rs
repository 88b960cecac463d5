//! Claims, ladders, records and exact solutions.
//!
//! A [`claim::Claim`] is declared once. [`evaluate`] runs it over a [`claim::Ladder`] on any
//! [`Backend`] and judges the outcome; [`golden`] keeps the result bit for bit; [`study`] is the
//! body of the study binaries; [`crate::report`] turns the golden records into a document.

pub mod claim;
pub mod claims;
pub mod evaluate;
pub mod exact;
pub mod exhibit;
pub mod golden;
pub mod ladder;
pub mod mutant;
pub mod order;
pub mod record;
pub mod reference_values;
pub mod report;
pub mod study;

use ladder::Depth;
use lahar::solver::run::Backend;
use record::Record;

/// Evaluates every claim of every study on its short ladder: the way to put another solver through
/// the suite, from a test of its own crate.
#[must_use]
pub fn run(backend: &dyn Backend) -> Vec<Record> {
    let claims = claims::studies().iter().flat_map(|s| s.claims);
    claims.map(|claim| evaluate::evaluate(claim, backend, Depth::Short)).collect()
}
