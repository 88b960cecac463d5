//! Claims of the study `grains`.

use crate::verify::golden::Agreement;
use crate::verify::study::Study;

mod books;
mod collisions;
mod contact;
mod exhibits;
mod hard;
mod impact;
mod inertia;
mod mutants;
mod neighbours;
mod orders;
mod restitution;
mod rolling;
mod rotation;
mod support;

/// The study.
pub static STUDY: Study = Study {
    id: "grains",
    title: "Grains",
    intro: "",
    claims: &[
        collisions::TIME,
        collisions::OVERLAP,
        collisions::TABLE,
        restitution::VISCO_ELASTIC_TABLE,
        restitution::VISCO_ELASTIC,
        restitution::VISCO_ELASTIC_ORDER,
        restitution::VISCO_ELASTIC_SPEED,
        restitution::TSUJI_TABLE,
        restitution::TSUJI,
        restitution::TSUJI_SPEED,
        restitution::ASKED_FOR,
        restitution::NO_ATTRACTION,
        orders::VERLET,
        orders::CONTACT,
        orders::GEAR_DAMPED,
        orders::GEAR_CONSERVATIVE,
        orders::GEAR_ZERO_START,
        orders::GEAR_IN_RUN,
        rolling::SLIDING,
        rolling::SLIDING_ARM,
        rolling::SLIDING_TIME,
        rolling::INCLINE,
        rolling::THRESHOLD,
        rolling::TURNTABLE,
        rolling::PENDULUM,
        impact::SLIP,
        impact::STICK,
        impact::CRADLE,
        impact::CORNER,
        impact::BALANCE,
        rotation::CONSERVATION,
        rotation::FLIP,
        inertia::TWO,
        inertia::APART,
        inertia::QUADRATURE,
        contact::CARRIED,
        books::ENERGY,
        books::MOMENTUM,
        books::THREADS,
        hard::SIZE,
        hard::DENSITIES,
        hard::MESH_ROLLING,
        hard::MESH_IMPACT,
        hard::GUARD,
        hard::NO_FRICTION,
        neighbours::COMPLETE,
    ],
    exhibits: &[exhibits::ORDERS, exhibits::RESTITUTION, exhibits::FREE_CLUMP],
    mutants: &[
        mutants::NOT_ROTATED,
        mutants::NOT_ROTATED_RUN,
        mutants::NO_CAP,
        mutants::NO_CAP_IMPACT,
        mutants::SUM_OF_SPHERES,
        mutants::REVERSED,
        mutants::NOT_ROTATED_PENDULUM,
        mutants::REVERSED_BOOKS,
    ],
    limits: &[],
    agreement: Agreement::Bits,
};
