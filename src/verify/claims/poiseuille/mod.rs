//! Claims of the study `poiseuille`: channels, ducts, pipes and Couette flow of all fluids.

mod channel;
mod clamped;
mod couette;
mod density;
mod ducts_pipes;
mod mutants;
mod newtonian;
mod thesis_figures;
mod work_precision;
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
        yield_stress::HB_B3_L2,
        yield_stress::PLUG_CELLS,
        yield_stress::PLUG_RIGID,
        yield_stress::FLOW_INDEX,
        yield_stress::FROM_REST,
        yield_stress::SCHEME,
        yield_stress::WALL_NODE,
        clamped::IMPLICIT_06,
        clamped::IMPLICIT_15,
        clamped::IMPLICIT_18,
        clamped::LAGGED_06,
        clamped::LAGGED_15,
        clamped::LAGGED_18,
        clamped::MODEL_ERROR,
        clamped::OVER_YIELD_LAGGED,
        clamped::OVER_YIELD_EXACT,
        clamped::OVER_YIELD_REST,
        couette::NEWTONIAN,
        couette::ALL_LAWS,
        couette::SHEAR_RATE,
        couette::TAYLOR,
        density::SI_DENSITY,
        density::UNIFORM_ACCELERATION,
        ducts_pipes::SQUARE_DUCT,
        ducts_pipes::PIPE,
        ducts_pipes::PIPE_BINGHAM,
        ducts_pipes::PIPE_HB,
    ],
    exhibits: &[
        thesis_figures::FIGURES,
        ducts_pipes::STAIRCASE,
        work_precision::WORK,
        work_precision::SECONDS,
    ],
    mutants: mutants::MUTANTS,
    limits: &[],
    agreement: Agreement::Bits,
};
