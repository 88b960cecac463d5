//! Claims of the study `viscosity`: decay of shear waves and vortices, sound.

use crate::verify::golden::Agreement;
use crate::verify::study::Study;

/// The study.
pub static STUDY: Study = Study {
    id: "viscosity",
    title: "Viscosity and sound",
    intro: "A decaying wave shows the viscosity that the scheme really has, at a given resolution and in a given direction, against the one it was asked for.",
    claims: &[],
    exhibits: &[],
    mutants: &[],
    limits: &[],
    agreement: Agreement::Bits,
};
