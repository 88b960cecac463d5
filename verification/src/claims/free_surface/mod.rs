//! Claims of the study `free-surface`: mass tracking, rest, ledgers, symmetry, loads.

use crate::golden::Agreement;
use crate::study::Study;

mod cells;
mod dam;
mod drop;
mod heap;
mod impact;
mod joints;
mod loads;
mod mutants;
mod pool;
mod rest;
pub(super) mod support;
mod symmetry;
mod tilted;
mod trough;
mod turning;
mod voids;
mod waves;

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
        tilted::NEWTONIAN_POOL,
        tilted::BINGHAM_POOL,
        tilted::RESIDUAL,
        heap::HEAP,
        heap::ADVANCE,
        heap::QUIET,
        rest::REST,
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
        joints::JOINTS,
        impact::IMPULSE,
        impact::WETTED,
        waves::SPEED,
        waves::LEVELLING,
        trough::LEVEL,
        voids::CLOSE,
        turning::ROLLER,
        turning::BUCKET,
    ],
    exhibits: &[tilted::OPTIONS, heap::MINUTE],
    mutants: &[
        mutants::MASSES,
        mutants::DIFFERENCES,
        mutants::NEIGHBOUR,
        mutants::BEFORE_COLLISION,
        mutants::EXCESS_DROPPED,
        mutants::MEAN_FILLS,
        mutants::LATERAL_STRESS,
        mutants::VOIDS_KEPT,
        mutants::WALLS_MET_AT_ONCE,
        mutants::FLOOR_AT_REST,
    ],
    limits: &[
        "Waves on a film level at rates that depend on where the surface lies within a cell: +2 to −4 % on 8 cells.",
        "Partly filled cells keep the inertia of full ones: unsteady shear below a surface is off by (1 − φ) of a cell over \
         the depth, and a block of 10 cells that hits a wall gives it 8 % too much (3 % with force by fill and inertia).",
        "In a pool whose surface is oblique to the grid a current of order F/mu remains, up to 1.5e-4 of √(gH) at \
         τ = 1.1 (10 degrees) and 5e-4 at τ = 0.56: above the aim of 1e-4. It does not grow. In Bingham fluid it is \
         below 1e-5.",
        "The force rule with inertia, made for free fall, lets a tilted pool of Bingham fluid speed up slowly: it is \
         not for fluid at rest. Gravity by fill makes a drop fall too slowly by about 1.5/R.",
        "The foot of a resting heap settles into the grid by up to a quarter of a cell; at 6 mm that is 1 mm within \
         30 s, at 0.04 mm/s, then nothing. Mass-weighted, the fluid moves at 0.015 mm/s.",
        "A parked mass falls at one cell in 16 steps whatever gravity is.",
    ],
    agreement: Agreement::Bits,
};
