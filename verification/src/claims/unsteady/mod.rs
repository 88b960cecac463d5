//! Claims of the study `unsteady`: start-up, oscillation, and unyielded material at rest.

use crate::golden::Agreement;
use crate::study::Study;

mod acoustic;
mod drift;
mod drum;
mod elastic;
mod mirror;
mod oscillating_wall;
mod plug;
mod resting_layer;
mod start_up;
mod start_up_exhibits;
mod stopping;
mod support;
mod womersley;

/// The study.
pub static STUDY: Study = Study {
    id: "unsteady",
    title: "Unsteady flow and rest",
    intro: "How accurate the scheme is in time, and whether a fluid that should stand still does.\n\n\
            A cell below yield does not relax its stress at all. In steady flow that makes it exactly rigid. In \
            unsteady flow it makes it an elastic solid whose shear modulus is rho c_s^2, so that shear waves cross \
            a plug at the speed of sound instead of at once. What this costs is set by one number, nu/(h c_s), the \
            time a wave takes to cross the channel over the viscous time (equal to Ma/Re): errors of first order in \
            it after a force that is switched on at once, of second order after one that sets in smoothly. The \
            same number decides how much a flow that has just stopped still rings. In a Newtonian fluid there is \
            nothing of the kind, and the oscillating flows below are of second order throughout.",
    claims: &[
        womersley::ALPHA_1_TRT,
        womersley::ALPHA_4_TRT,
        womersley::ALPHA_10_TRT,
        womersley::ALPHA_1_CENTRAL,
        womersley::ALPHA_4_CENTRAL,
        womersley::ALPHA_10_CENTRAL,
        oscillating_wall::WALL,
        mirror::WALL_SET_IN_MOTION,
        mirror::HALF_CHANNEL,
        mirror::QUARTER_DUCT,
        acoustic::BGK_FREQUENCY,
        acoustic::CENTRAL_FREQUENCY,
        acoustic::BGK_DECAY,
        acoustic::CENTRAL_DECAY,
        acoustic::CUBE,
        acoustic::HYDROSTATIC,
        start_up::BINGHAM_SMOOTH_CELLS,
        start_up::BINGHAM_SMOOTH_TIME,
        start_up::HERSCHEL_BULKLEY_SMOOTH_CELLS,
        start_up::HERSCHEL_BULKLEY_SMOOTH_TIME,
        start_up::BINGHAM_SUDDEN_CELLS,
        start_up::BINGHAM_SUDDEN_TIME,
        start_up::HERSCHEL_BULKLEY_SUDDEN_CELLS,
        start_up::HERSCHEL_BULKLEY_SUDDEN_TIME,
        elastic::RINGING,
        elastic::DAMPING,
        stopping::TIME,
        stopping::ENERGY,
        stopping::CLAMPED_TIME,
        stopping::CLAMPED_CREEP,
        stopping::REST_HALF_WAY,
        stopping::REST_B3,
        plug::DIAGONAL,
        plug::SKEW,
        resting_layer::ALIGNED,
        resting_layer::OBLIQUE,
        resting_layer::HALF_WAY,
        resting_layer::BED,
        drum::RIGID,
    ],
    exhibits: &[
        start_up_exhibits::PROFILES,
        start_up_exhibits::ERROR_AGAINST_TAU,
        stopping::HISTORY,
        elastic::AGAINST_FLOOR,
        drift::ARREST,
        drift::STAIRCASE,
        resting_layer::CURES_TABLE,
    ],
    mutants: &[],
    limits: &[
        "Unyielded material is elastic with modulus rho c_s^2. A force switched on at once leaves an error of first \
         order in nu/(h c_s) = Ma/Re, and stopped material rings until the floor theta has damped it, at theta k^2/3.",
        "The law by stress [B3] takes the fall of the stress across the wall cell from F - grad p, which leaves out the inertia \
         rho du/dt.",
        "On staircase walls whose steps are longer than one cell an unyielded layer still creeps, at about a quarter \
         of what half-way walls give: removing the mean of the correction, so that no mass passes the wall, removes \
         part of the correction itself.",
        "A plug that moves obliquely to the grid shears by 2 n_x n_z sigma0/(rho c_s^2) of its speed, because D3Q19 \
         has no xyz moment. In a channel this is of the order of Ma^2/Re.",
        "With the default theta = 0.05 an unyielded block carried at 0.1 along (1,0,0), (1,1,0) or (1,0.5,0.25) keeps \
         ringing at 4e-3 of the flow that arrested in it; at 0.05, or along (1,1,1), or with theta = 0.1, it does not.",
    ],
    agreement: Agreement::Bits,
};
