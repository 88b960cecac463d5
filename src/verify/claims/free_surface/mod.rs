//! Claims of the study `free-surface`: mass tracking, rest, ledgers, symmetry, loads.

use crate::verify::golden::Agreement;
use crate::verify::study::Study;

mod cells;
mod dam;
mod drop;
mod heap;
mod loads;
mod mutants;
mod pool;
mod support;
mod symmetry;
mod tilted;

/// The study.
pub static STUDY: Study = Study {
    id: "free-surface",
    title: "The free surface",
    intro: "Partly filled cells carry a mass of their own; gas is not computed. What is at stake: that no mass is lost \
            in any of the ways a cell can fill and empty, that fluid that should rest does, and what the surface cells \
            cost in accuracy.\n\n\
            Every run keeps a ledger of mass and momentum and stops when a step's mass does not close. The mutants \
            below are let through that guard, so that the claims have something to measure.",
    claims: &[
        pool::REST,
        pool::PRESSURE,
        pool::FLICKER,
        tilted::POOL,
        heap::HEAP,
        drop::FULL,
        drop::INERTIA,
        drop::BY_FILL,
        dam::MASS,
        dam::MOMENTUM,
        dam::OUTFLOW,
        dam::FOAM,
        cells::ISOLATED,
        cells::FALLS,
        cells::CARRIED,
        symmetry::MIRROR,
        symmetry::HALF,
        loads::BUOYANCY,
        loads::WALL,
    ],
    exhibits: &[tilted::OPTIONS, heap::MINUTE],
    mutants: &[
        mutants::MASSES,
        mutants::DIFFERENCES,
        mutants::NEIGHBOUR,
        mutants::BEFORE_COLLISION,
        mutants::EXCESS_DROPPED,
    ],
    limits: &[],
    agreement: Agreement::Bits,
};
