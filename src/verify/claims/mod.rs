//! The claims, one file per study.

use super::study::Study;

pub mod film;
pub mod free_surface;
pub mod moments;
pub mod mutants_physics;
pub mod poiseuille;
pub mod stability;
pub mod unsteady;
pub mod viscosity;

static STUDIES: [&Study; 7] = [
    &moments::STUDY,
    &viscosity::STUDY,
    &poiseuille::STUDY,
    &unsteady::STUDY,
    &stability::STUDY,
    &free_surface::STUDY,
    &film::STUDY,
];

/// All studies, in the order of the report.
#[must_use]
pub fn studies() -> &'static [&'static Study] {
    &STUDIES
}
