//! Claims of the study `grains-piles`: heaps that come to rest, how steep they are, how far columns run out.

use crate::claim::VerifyError;
use crate::golden::Agreement;
use crate::study::Study;
use lahar::dem::DemError;

mod collapse;
mod column;
mod heap;
mod repose;
mod resting;
mod slope;
mod speed;
mod support;

/// The study.
pub static STUDY: Study = Study {
    id: "grains-piles",
    title: "Piles of grains",
    intro: "Many spheres, or clumps of four, on a rough bed: whether a heap comes to rest and stays there, how steep it \
            lies, how far a column runs out when its side is opened. Grains have a mean radius of 5 mm, 2650 kg/m3, \
            restitution 0.3 and no drag or artificial damping of any kind; spheres roll without resistance but in the heaps. The \
            modulus is 1 MPa, so that the weight of a grain over its stiffness, rho g R/E, is 1e-4: ten layers press \
            the lowest contacts by one per cent of the radius. Slices are periodic in the direction across.\n\n\
            A heap's angle and a column's run-out depend on how it was made. Here blocks fall loosely into place between \
            smooth walls, which are then taken away at once.",
    claims: &[heap::AT_REST, heap::BOOKS, repose::FRICTION, repose::CLUMPS, collapse::RUN_OUT],
    exhibits: &[heap::HISTORY, repose::ANGLES, collapse::COLUMNS, speed::SPEED],
    mutants: &[],
    limits: &[
        "The time step must be short enough for the dashpots of all contacts of a grain together. With 15 steps in the \
         shortest contact the kinetic energy of a heap of 343 spheres does not fall below 1e-12 of its largest within 10 s \
         and its books gain 4 per cent, with 25 that of 2197 spheres does not fall below 1e-14; the heaps here take 40. \
         Tetrahedral clumps have more contacts: with 25 steps single ones keep moving, with 40 they rest.",
        "The published run-outs differ among materials by a third, and the run-out of a column a few grains wide grows with \
         the number of grains across (1.5 a at 10 and 1.7 to 1.9 a at 20 diameters for a = 1). The spheres here run as \
         far as the upper of the two experiments, Lube et al., up to a = 2 and 16 per cent farther at a = 4. There are no side \
         walls to hold them, and they roll freely: rolling friction 0.1 takes about a tenth off. The comparison cannot be \
         sharper than that.",
        "The bounds of this study were set after first runs, none of them below what those runs gave: two standard errors for \
         the angles (they reach 0.42 of one increase, from friction 0.3 to 0.6), 35 per cent for the run-out (0.255).",
        "The references for the angle of repose are statements of order, not numbers: angles of repose depend on size, \
         width and preparation of the heap.",
    ],
    agreement: Agreement::Bits,
};

/// What a run of grains refuses, as a failed rung.
fn refused(e: DemError) -> VerifyError {
    VerifyError::Numerics { what: "a run of grains", detail: e.to_string() }
}
