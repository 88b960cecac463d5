//! Claims of the study `moments`: identities of the velocity set and the equilibrium.

use crate::verify::golden::Agreement;
use crate::verify::study::Study;

/// The study.
pub static STUDY: Study = Study {
    id: "moments",
    title: "Lattice and equilibrium moments",
    intro: "Everything the method promises rests on sums over the nineteen velocities. These identities are checked first, in exact arithmetic where that is possible.",
    claims: &[],
    exhibits: &[],
    mutants: &[],
    limits: &[],
    agreement: Agreement::Bits,
};
