//! Claims of the study `poiseuille`: channels, ducts, pipes and Couette flow of all fluids.

pub(super) mod channel;
pub(super) mod clamped;
mod couette;
mod density;
mod duct_waves;
mod ducts;
mod fast_wall;
mod mutants;
mod newtonian;
mod pipes;
mod place;
mod thesis_figures;
mod turning;
mod work_precision;
mod yield_stress;

use crate::golden::Agreement;
use crate::study::Study;

/// The study.
pub static STUDY: Study = Study {
    id: "poiseuille",
    title: "Steady flow between walls",
    intro: "Steady flow between walls has exact solutions for every fluid lahar knows. They show the error of the \
            wall, of the yield surface and of the relaxation scheme, one at a time.\n\n\
            In a plane channel the lattice scheme itself has a steady solution in closed form: the shear stress at a \
            cell centre is exactly Gy, and u_j = Σγ̇_i + ½γ̇_j + 2G(τ⁻_j − ½), counted from the wall. It holds for \
            every law, with and without a viscosity clamp, and the tolerances below are taken from it. Errors of the \
            model (what a clamp does to the law) and of the discretisation are separate claims.",
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
        yield_stress::THESIS_CHANNEL,
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
        fast_wall::FAST_WALL,
        couette::TAYLOR,
        turning::RING,
        turning::TORQUE,
        turning::ARRAY,
        density::SI_DENSITY,
        density::UNIFORM_ACCELERATION,
        ducts::SQUARE_DUCT,
        duct_waves::WAVES,
        pipes::PIPE,
        pipes::PIPE_BINGHAM,
        pipes::PIPE_HB,
        pipes::CUT_PIPE,
        pipes::CUT_PIPE_BINGHAM,
        pipes::CUT_PIPE_HB,
        place::SPHERE,
    ],
    exhibits: &[thesis_figures::FIGURES, pipes::STAIRCASE, work_precision::WORK, work_precision::SECONDS],
    mutants: mutants::MUTANTS,
    limits: &[
        "On stairs of cells pipes and rotating cylinders converge at first order with either wall rule; the rules differ in the \
         size of the error. Scenes have solids in their place unless one of them moves.",
        "For n > 1 the shear rate leaves the yield surface more steeply than linearly, and the order falls to 1 + 1/n.",
        "The odd relaxation time follows the apparent viscosity. Above yield the tangent viscosity would be right, and \
         most of the error of Bingham and Herschel-Bulkley channels comes from the difference.",
        "With a yield stress or a power, the law by stress [B3] takes the pressure gradient along the flow as it is at the moment. \
         At small τ that keeps pressure waves along a wall alive: behind a block in a channel of 16 cells the velocity of a \
         Bingham fluid at τ = 0.511 goes on moving by up to 1e-3 of the largest, with half-way walls by 5e-5.",
        "The central-moment operator has an error proportional to the squared lattice shear rate; the factor grows from \
         0.005 at τ = 0.55 to 0.33 at τ = 2. The stress of yield-stress laws is off by the squared velocity.",
    ],
    agreement: Agreement::Bits,
};
