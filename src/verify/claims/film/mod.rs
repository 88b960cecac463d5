//! Claims of the study `film`: steady films on an incline under a free surface.

use crate::verify::golden::Agreement;
use crate::verify::study::Study;

mod exhibits;
mod marginal;
mod newtonian;
mod support;
mod yielding;

/// The study.
pub static STUDY: Study = Study {
    id: "film",
    title: "Films on an incline",
    intro: "A film of uniform depth is the one free-surface flow with an exact solution for every law. It tests the \
            surface condition, the force in partly filled cells and the wall at once, and it can be made so thin that \
            the surface cell is a good part of the fluid. The depth is always the mass in the column, never a count of \
            cells.",
    claims: &[
        newtonian::PROFILE,
        newtonian::FLUX,
        newtonian::THIN,
        newtonian::FULL_GRAVITY,
        yielding::BINGHAM,
        yielding::HERSCHEL_BULKLEY,
        marginal::REST,
        marginal::CREEP,
        marginal::FLOWS,
    ],
    exhibits: &[exhibits::PROFILES, exhibits::AGAINST_DEPTH, marginal::NEAR_CRITICAL],
    mutants: &[],
    limits: &[],
    agreement: Agreement::Bits,
};
