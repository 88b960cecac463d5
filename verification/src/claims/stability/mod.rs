//! Claims of the study `stability`: von Neumann analysis and runs driven unstable on purpose.

mod eigenvalues;
mod exhibits;
mod galilean;
mod layers;
mod limits;
mod mutants;
mod noise;
mod reference;

use crate::golden::Agreement;
use crate::study::Study;

/// The study.
pub static STUDY: Study = Study {
    id: "stability",
    title: "Linear stability",
    intro: "Below a certain viscosity, or above a certain speed, a scheme amplifies its own rounding errors. Linear analysis says where; runs show that it is right. *Stable* means that in an unbounded uniform flow of constant tau no wave grows by more than 1e-8 per step: necessary, not sufficient, because walls, gradients of tau and free surfaces are left out. The chapter also holds the cases that stress a scheme in other ways: two layers of very different viscosity, and waves and vortices carried by a fast stream.\n\nThe numbers of this chapter are eigenvalues, which agree between processors to rounding only, and searches for the largest of them, which may then stop at slightly different waves; so they are compared to a relative 1e-5 and not bit for bit.",
    claims: &[
        limits::RATES,
        noise::EVOLUTION,
        noise::TRT_GROWS,
        noise::BGK_DECAYS,
        noise::GUARD,
        limits::TABLE,
        limits::TABLE_HIGH,
        limits::TABLE_COARSE,
        limits::CERTIFICATE,
        limits::QUARTER,
        limits::ODD_RATE,
        limits::REST,
        limits::RIGID,
        galilean::PARALLEL,
        galilean::NORMAL,
        galilean::CENTRAL,
        galilean::VORTEX_BGK,
        galilean::VORTEX_TRT,
        galilean::VORTEX_CENTRAL,
        layers::STRESS_BGK,
        layers::INTERFACE_BGK,
        layers::STRESS_TRT,
        layers::INTERFACE_TRT,
        layers::STRESS_CENTRAL,
        layers::INTERFACE_CENTRAL,
        layers::LONG,
    ],
    exhibits: &[exhibits::MAP, exhibits::ODD_RATE, exhibits::HISTORY, exhibits::GALILEAN],
    mutants: &[mutants::SWAPPED_RATES],
    limits: &[
        "The central-moment and regularised operators remove the Galilean defect 3 U² of a shear wave along an axis, not that of in-plane diagonal waves: 9/4 U² against 3/2 U² for BGK, because the lattice has no free moment xxx.",
        "In moving material that never yields, the central-moment and regularised operators amplify off-axis waves by about 1.5 U² per step (0.4 % at U = 0.05) and 0.15 U² respectively; BGK and TRT do not. The wave ends where its stress makes the material yield.",
        "Below about tau = 0.5015 the central-moment operator with its default odd rate, and below about 0.5011 the regularised one, amplify waves even in fluid at rest (by 6e-4 per step at tau = 0.501): the stability limit is zero there. BGK and TRT are stable at rest at every tau.",
        "The independent table covers one and two relaxation times. The limits of the central-moment operator, which `plan` uses by default, rest on lahar's own linearisation.",
        "The limits are those of uniform flow: neither walls nor gradients of tau or velocity are in the analysis.",
        "Below tau = 0.51 the growing waves of operators with one small odd rate fill thin shells of wave vectors; the search then gives upper bounds that scatter by about 10 %.",
    ],
    agreement: Agreement::Relative(1e-5),
};
