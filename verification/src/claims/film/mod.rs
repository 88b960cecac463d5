//! Claims of the study `film`: steady films on an incline under a free surface.

use crate::golden::Agreement;
use crate::study::Study;

mod exhibits;
mod marginal;
mod newtonian;
pub(super) mod support;
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
        newtonian::CLOSED_FORM,
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
    limits: &[
        "The uniform film says nothing about how a varying surface is carried along: see `surface-pattern-carried` in \
         the study of the free surface.",
        "Films drift back by 1e-7 m/s at any resolution, as with the wall rule before: a film of 1.02 critical thicknesses \
         (HARD_CASES H19), whose surface should move at 3.5e-9 m/s, moves the wrong way; at 1.1 critical thicknesses it takes 5 % \
         of the speed, at 1.4 it is right to 0.13 %, on one cell in the sheared layer as on sixteen. The cause is not found.",
        "A film of Herschel-Bulkley fluid converges with an order that rises from 1.5 to 1.9 between 6 and 48 cells.",
    ],
    agreement: Agreement::Bits,
};
