//! Claims of the study `unsteady`: start-up, oscillation, and unyielded material at rest.

use crate::verify::golden::Agreement;
use crate::verify::study::Study;

/// The study.
pub static STUDY: Study = Study {
    id: "unsteady",
    title: "Unsteady flow and rest",
    intro: "How accurate the scheme is in time, and whether a fluid that should stand still does.",
    claims: &[],
    exhibits: &[],
    mutants: &[],
    limits: &[],
    agreement: Agreement::Bits,
};
