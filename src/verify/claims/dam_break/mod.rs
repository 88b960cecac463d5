//! Claims of the study `dam-break`: flows released on the horizontal and on slopes.

use crate::verify::golden::Agreement;
use crate::verify::study::Study;

mod exhibits;
mod mudflow;
mod newtonian;
mod slope;
mod thesis;

/// The study.
pub static STUDY: Study = Study {
    id: "dam-break",
    title: "Dam breaks",
    intro: "Fluid that is let go: Newtonian blocks on the horizontal, and the Herschel-Bulkley reservoir on a slope of \
            004 Ch. 5 with and without an erodible bed. The reference on slopes is not an experiment but a \
            depth-averaged solver (lubrication theory), so that one model is compared with another that leaves out \
            inertia, the stress along the flow and everything steeper than its slope is shallow. Where it stops \
            being a reference can be seen in the profiles: for the first seconds, at the rear wall, within about \
            one depth of the tip, and at the steps of the bed.\n\n\
            Times, lengths and fronts are in SI units. The front is where the surface falls through 3 mm above the \
            top of the bed.",
    claims: &[
        newtonian::PLANAR,
        newtonian::ROUND,
        newtonian::RITTER,
        newtonian::MARTIN_MOYCE,
        slope::RUN_A,
        slope::RUN_C,
        slope::RUN_E,
        slope::RUN_H,
    ],
    exhibits: &[exhibits::RUNS, exhibits::TIME_STEP, exhibits::NEWTONIAN_HISTORY, mudflow::WALL],
    mutants: &[],
    limits: &[],
    agreement: Agreement::Bits,
};
