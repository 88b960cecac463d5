//! The claims, one file per study.

use super::study::Study;

pub mod moments;
pub mod mutants_physics;
pub mod poiseuille;
pub mod slump;
pub mod stability;
pub mod unsteady;
pub mod viscosity;

static STUDIES: [&Study; 6] = [
    &moments::STUDY,
    &viscosity::STUDY,
    &poiseuille::STUDY,
    &unsteady::STUDY,
    &stability::STUDY,
    &slump::STUDY,
];

/// All studies, in the order of the report.
#[must_use]
pub fn studies() -> &'static [&'static Study] {
    &STUDIES
}
