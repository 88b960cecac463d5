//! Claims of the study `unsteady`: start-up, oscillation, and unyielded material at rest.

use crate::verify::golden::Agreement;
use crate::verify::study::Study;

mod start_up;
mod support;
mod womersley;

/// The study.
pub static STUDY: Study = Study {
    id: "unsteady",
    title: "Unsteady flow and rest",
    intro: "How accurate the scheme is in time, and whether a fluid that should stand still does.",
    claims: &[
        womersley::ALPHA_1_TRT,
        womersley::ALPHA_4_TRT,
        womersley::ALPHA_10_TRT,
        womersley::ALPHA_1_CENTRAL,
        womersley::ALPHA_4_CENTRAL,
        womersley::ALPHA_10_CENTRAL,
        start_up::BINGHAM_CELLS,
        start_up::HERSCHEL_BULKLEY_CELLS,
        start_up::BINGHAM_STEPS,
        start_up::HERSCHEL_BULKLEY_STEPS,
        start_up::BINGHAM_TAU,
        start_up::HERSCHEL_BULKLEY_TAU,
    ],
    exhibits: &[start_up::ERROR_AGAINST_TAU],
    mutants: &[],
    limits: &[],
    agreement: Agreement::Bits,
};
