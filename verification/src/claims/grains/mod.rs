//! Claims of the study `grains`.

use crate::golden::Agreement;
use crate::study::Study;

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
mod turntable;
mod twisting;

/// The study.
pub static STUDY: Study = Study {
    id: "grains",
    title: "Grains",
    intro: "Spheres and rigid clumps of spheres with frictional, visco-elastic contact, without any fluid. What is at stake: that \
            one collision, one rolling sphere and one tumbling clump follow the closed forms of mechanics, that nothing is lost \
            in the sums over many, and how the error depends on the time step. A step is a share of the shortest contact; \
            contacts are where accuracy is won or lost, because forces begin there like powers 3/2, 1/2 or 1/4 of time.\n\n\
            Formulas of rigid bodies are limits: friction acts at the arm r - delta, delta the overlap. Claims about them either \
            climb a ladder of stiffness towards the limit (the error follows delta, as E^(-2/3) at rest and E^(-2/5) in an \
            impact), or compare with the same formula for that arm, which holds to rounding. Piles of grains have a study of \
            their own.",
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
        turntable::TURNTABLE,
        rolling::PENDULUM,
        rolling::RESISTANCE,
        twisting::RESISTANCE,
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
        mutants::REVERSED_BOOKS,
    ],
    limits: &[
        "Restitution converges with order 3/2 under the visco-elastic law, 5/4 under Tsuji's and 1 under the linear one, because their \
         damping begins like that power of time at first touch. At the default of 50 steps per contact it is off by 3e-4 (a = 0.2), \
         2e-3 (alpha = 0.6) and 9e-3 (e = 0.2).",
        "Gear's scheme is of second order in every run: a run starts with zero higher derivatives, and every contact begins without \
         them.",
        "A sphere of soft material rolls as if its radius were r - delta: 5/7 becomes 5/7 (1 - (4/7) delta/r).",
        "Edges, corners and curved walls are met with the stiffness of a plane.",
    ],
    agreement: Agreement::Bits,
};
