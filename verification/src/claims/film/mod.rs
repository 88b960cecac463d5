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
        "Shear that lies below the first cell centre is not seen. A film of 1.02 critical thicknesses (HARD_CASES H19) \
         has 2 % of its depth in shear: on 25 cells its surface moves at 1e-7 m/s in the wrong direction instead of \
         3.5e-9 m/s, a residue of the wall rule. From two cells in the sheared layer on the velocity is right to 3 %, \
         from four to 1.5 % (shown at 1.1 and 1.4 critical thicknesses).",
        "A film of Herschel-Bulkley fluid converges with an order that rises from 1.5 to 1.9 between 6 and 48 cells.",
    ],
    agreement: Agreement::Bits,
};
