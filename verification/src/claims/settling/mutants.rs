//! Wrong variants that the claims of this study must catch.

use super::arrays;
use crate::claims::mutants_physics::{Mistake, Mistaken};
use crate::mutant::{Mutant, Subject};

/// Inverted.
pub const FRACTION_INVERTED: Mutant = Mutant {
    id: "fraction-inverted",
    erratum: "ERRATA 39 (000 Eq 18)",
    description: "The solid fraction is the volume of the cell over that of the sphere, as printed.",
    caught_by: "regular-array-misses-richardson-zaki",
    rung: Some(0.343),
    subject: Subject::Measure(|backend, c| arrays::excess(backend, c, |c| 1.0 / c)),
};

/// Wall factor.
pub const WALL_FACTOR: Mutant = Mutant {
    id: "grain-wall-factor",
    erratum: "ERRATA 14 (000 Eq 10)",
    description: "A moving surface gives 2 w rho u.c to a link instead of 6 w rho u.c.",
    caught_by: "cubic-array-settling",
    rung: Some(0.343),
    subject: Subject::Backend(|| Box::new(Mistaken(Mistake::WallFactor))),
};
