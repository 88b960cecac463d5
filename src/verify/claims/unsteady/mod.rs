//! Claims of the study `unsteady`: start-up, oscillation, and unyielded material at rest.

use crate::verify::golden::Agreement;
use crate::verify::study::Study;

mod acoustic;
mod drift;
mod elastic;
mod mirror;
mod plug;
mod start_up;
mod stopping;
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
        start_up::BINGHAM_SUDDEN_CELLS,
        start_up::BINGHAM_SUDDEN_TIME,
        start_up::HERSCHEL_BULKLEY_SUDDEN_CELLS,
        start_up::HERSCHEL_BULKLEY_SUDDEN_TIME,
        start_up::BINGHAM_SMOOTH_CELLS,
        start_up::BINGHAM_SMOOTH_TIME,
        start_up::HERSCHEL_BULKLEY_SMOOTH_CELLS,
        start_up::HERSCHEL_BULKLEY_SMOOTH_TIME,
        acoustic::BGK_FREQUENCY,
        acoustic::CENTRAL_FREQUENCY,
        acoustic::BGK_DECAY,
        acoustic::CENTRAL_DECAY,
        acoustic::CUBE,
        acoustic::HYDROSTATIC,
        mirror::HALF_CHANNEL,
        mirror::QUARTER_DUCT,
        mirror::WALL_SET_IN_MOTION,
        stopping::TIME,
        stopping::ENERGY,
        stopping::CLAMPED_TIME,
        stopping::CLAMPED_CREEP,
        stopping::REST_HALF_WAY,
        stopping::REST_B3,
        elastic::RINGING,
        plug::DIAGONAL,
        plug::SKEW,
    ],
    exhibits: &[start_up::ERROR_AGAINST_TAU, elastic::AGAINST_FLOOR, drift::ARREST, drift::STAIRCASE],
    mutants: &[],
    limits: &[],
    agreement: Agreement::Bits,
};
