//! Claims of the study `stability`: von Neumann analysis and runs driven unstable on purpose.

use crate::verify::golden::Agreement;
use crate::verify::study::Study;

/// The study.
pub static STUDY: Study = Study {
    id: "stability",
    title: "Linear stability",
    intro: "Below a certain viscosity, or above a certain speed, a scheme amplifies its own rounding errors. Linear analysis says where; runs show that it is right. The numbers of this chapter are eigenvalues, which agree between processors to rounding only, so they are compared to a relative 1e-9 and not bit for bit.",
    claims: &[],
    exhibits: &[],
    mutants: &[],
    limits: &[],
    agreement: Agreement::Relative(1e-9),
};
