//! Claims of the study `moments`: identities of the velocity set and the equilibrium, conservation
//! by every collision, and the shear rate that the non-equilibrium tensor gives.

mod conservation;
mod equilibrium;
mod identities;
mod mutants;
mod shear_rate;

use crate::golden::Agreement;
use crate::study::Study;

/// The study.
pub static STUDY: Study = Study {
    id: "moments",
    title: "Lattice and equilibrium moments",
    intro: "Everything the method promises rests on sums over the nineteen velocities. These identities \
are checked first, in integer arithmetic where that is possible: with the weights multiplied by 36 every \
sum is a whole number, so there is no rounding to hide behind.\n\n\
Then come the sums that a collision may not change (mass and momentum), and the tensor from which the \
shear rate is read. Most misprints of the source papers sit here; each of them is coded as a mutant and \
must be caught.",
    claims: &[
        identities::IDENTITIES,
        identities::SIXTH_ORDER,
        equilibrium::MOMENTS,
        equilibrium::CUBIC_DEFECT,
        equilibrium::INVERSE,
        conservation::CONSERVATION,
        shear_rate::ACCELERATION,
        shear_rate::COUETTE,
    ],
    exhibits: &[],
    mutants: mutants::MUTANTS,
    limits: &[
        "The lattice is isotropic to fourth order only: third moments of the equilibrium lack the cubic \
term ρ u_a u_b u_c. The Galilean defect 1 − 3U² of the study `viscosity` follows from that.",
    ],
    agreement: Agreement::Bits,
};
