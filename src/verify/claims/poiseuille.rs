//! Claims of the study `poiseuille`: channels, ducts, pipes and Couette flow of all fluids.

use crate::verify::golden::Agreement;
use crate::verify::study::Study;

/// The study.
pub static STUDY: Study = Study {
    id: "poiseuille",
    title: "Steady flow between walls",
    intro: "Steady flow between walls has exact solutions for every fluid lahar knows. They show the error of the wall, of the yield surface and of the relaxation scheme, one at a time.",
    claims: &[],
    exhibits: &[],
    mutants: &[],
    limits: &[],
    agreement: Agreement::Bits,
};
