//! Claims of the study `coupling`.

use crate::verify::golden::Agreement;
use crate::verify::study::Study;

mod approach;
mod exhibits;
mod free;
mod moving;
mod mutants;
mod surface;

/// The study.
pub static STUDY: Study = Study {
    id: "coupling",
    title: "Grains in the fluid",
    intro: "Grains and fluid together, each pushing the other. What is at stake: that a grain moving across the lattice, covering cells and \
            giving them back, feels what it would feel anywhere; that light grains are as stable as heavy ones; that buoyancy is right \
            with and without a free surface; and that mass, momentum and energy are neither made nor lost.",
    claims: &[
        moving::TWIN,
        moving::MASS,
        free::DENSITY_RATIOS,
        free::NEUTRAL,
        free::NEUTRAL_IN_POOL,
        free::SPHERE_SPIN,
        free::PAIR,
        approach::APPROACH,
        approach::NO_JUMP,
        surface::BOOKS,
        surface::FLOATING,
        surface::SINKING,
        surface::BED,
    ],
    exhibits: &[moving::NOISE, exhibits::APPROACH, exhibits::WORK_PRECISION],
    mutants: &[mutants::WALL_FACTOR, mutants::LUBRICATION, mutants::REVERSED, mutants::COVERED_MASS],
    limits: &[
        "Forces between approaching spheres are made of what the lattice carries and of a lubrication force that begins at 2/3 of a cell; \
         where they meet, at 0.4 cells and R = 4, the sum is 7 % above the exact force.",
    ],
    agreement: Agreement::Bits,
};
