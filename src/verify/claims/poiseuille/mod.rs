//! Claims of the study `poiseuille`: channels, ducts, pipes and Couette flow of all fluids.

mod channel;
mod newtonian;
mod yield_stress;

use crate::verify::golden::Agreement;
use crate::verify::study::Study;

/// The study.
pub static STUDY: Study = Study {
    id: "poiseuille",
    title: "Steady flow between walls",
    intro: "Steady flow between walls has exact solutions for every fluid lahar knows. They show the error of the wall, of the yield surface and of the relaxation scheme, one at a time.",
    claims: &[
        newtonian::BGK_SLIP,
        newtonian::MAGIC,
        newtonian::CENTRAL,
        newtonian::CENTRAL_MACH,
        newtonian::B3,
        newtonian::B3_LARGE_TAU,
        newtonian::REGULARISED,
        newtonian::ORIENTATION,
        yield_stress::BINGHAM_L2,
        yield_stress::HB_L2,
        yield_stress::PLUG_CELLS,
        yield_stress::PLUG_RIGID,
        yield_stress::FLOW_INDEX,
        yield_stress::FROM_REST,
        yield_stress::SCHEME,
        yield_stress::WALL_NODE,
    ],
    exhibits: &[],
    mutants: &[],
    limits: &[],
    agreement: Agreement::Bits,
};
