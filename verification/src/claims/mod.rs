//! The claims, one module per study.

use super::study::Study;

pub mod columns;
pub mod coupling;
pub mod dam_break;
pub mod film;
pub mod free_surface;
pub mod grains;
pub mod immersed;
pub mod moments;
pub mod mutants_physics;
pub mod piles;
pub mod poiseuille;
pub mod settling;
pub mod slump;
pub mod stability;
pub mod sweep;
mod unguarded;
pub mod unsteady;
pub mod viscosity;
pub mod work_precision;

static STUDIES: [&Study; 15] = [
    &moments::STUDY,
    &viscosity::STUDY,
    &poiseuille::STUDY,
    &unsteady::STUDY,
    &stability::STUDY,
    &free_surface::STUDY,
    &film::STUDY,
    &slump::STUDY,
    &dam_break::STUDY,
    &work_precision::STUDY,
    &grains::STUDY,
    &piles::STUDY,
    &settling::STUDY,
    &coupling::STUDY,
    &sweep::STUDY,
];

/// All studies, in the order of the report.
#[must_use]
pub fn studies() -> &'static [&'static Study] {
    &STUDIES
}
