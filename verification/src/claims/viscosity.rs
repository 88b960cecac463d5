//! Claims of the study `viscosity`: waves and vortices in periodic boxes.

mod convergence;
mod exhibits;
mod mutants;
mod sound;
mod table;
pub(super) mod vortices;
mod waves;

use crate::golden::Agreement;
use crate::study::Study;

/// The study.
pub static STUDY: Study = Study {
    id: "viscosity",
    title: "Viscosity, sound and periodic flows",
    intro: "Without walls, the scheme's only physical content is how waves travel and decay. The decay of a \
single wave is an eigenvalue of the linearised scheme, so it is known exactly at every resolution, not only \
in the limit: the measured viscosity has to agree with the *discrete* one to the digits of the reference, \
and only the discrete one has to converge to ν = (τ − ½)/3.\n\n\
Vortices then check what single waves cannot: the nonlinear term and the pressure it needs.",
    claims: &[
        table::AXIS_BGK,
        table::AXIS_TRT,
        table::DIAGONAL_BGK,
        table::DIAGONAL_TRT,
        table::DENSE,
        convergence::ORDER_BGK,
        convergence::ORDER_TRT,
        convergence::ORDER_CENTRAL,
        convergence::ORDER_REGULARISED,
        convergence::DEFECT,
        convergence::ACROSS,
        convergence::CENTRAL,
        sound::DAMPING,
        sound::UNIT_TRACE,
        sound::SPEED,
        vortices::TAYLOR_GREEN_2D,
        vortices::TAYLOR_GREEN_3D,
        vortices::ABC_FLOW,
        vortices::ADVECTED,
    ],
    exhibits: exhibits::EXHIBITS,
    mutants: mutants::MUTANTS,
    limits: &[
        "BGK and TRT lower the viscosity of a wave along a mean flow U by the factor 1 − 3U²; the \
central-moment and the regularised operator do not.",
        "The bulk viscosity is not a parameter: 2ν/3 with BGK and TRT, 1/9 with the central-moment and the \
regularised operator.",
    ],
    agreement: Agreement::Relative(1e-9),
};
