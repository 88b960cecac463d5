//! Wrong variants of the surface that the claims of this study must catch: misprints of the papers.

use crate::claims::mutants_physics::{Mistake, Mistaken};
use crate::mutant::{Mutant, Subject};

/// Wetted share from masses.
pub const MASSES: Mutant = Mutant {
    id: "exchange-of-masses",
    erratum: "ERRATA 20 (000 Eq 12)",
    description: "The wetted share of a link is the mean of the two masses instead of the mean of the two fills.",
    caught_by: "film-wave-speed",
    rung: Some(8.5),
    subject: Subject::Backend(|| Box::new(Mistaken(Mistake::ExchangeOfMasses))),
};

/// Wetted share with a minus.
pub const DIFFERENCES: Mutant = Mutant {
    id: "exchange-of-differences",
    erratum: "ERRATA 21 (004 Eq 3.31)",
    description: "The wetted share of a link is half the difference of the two fills: both cells gain the same mass.",
    caught_by: "dam-break-mass",
    rung: Some(500.0),
    subject: Subject::Backend(|| Box::new(Mistaken(Mistake::ExchangeOfDifferences))),
};

/// Reconstruction from the wrong node.
pub const NEIGHBOUR: Mutant = Mutant {
    id: "reconstruction-at-the-neighbour",
    erratum: "ERRATA 16 (004 Eq 3.32)",
    description: "The missing populations are reconstructed from the cell on the liquid side.",
    caught_by: "pool-at-rest",
    rung: Some(0.5),
    subject: Subject::Backend(|| Box::new(Mistaken(Mistake::ReconstructionAtNeighbour))),
};

/// Exchange of other populations than those that stream.
pub const BEFORE_COLLISION: Mutant = Mutant {
    id: "exchange-before-collision",
    erratum: "ERRATA 17 (000 Eq 11, 004 Eq 3.30)",
    description: "Mass is exchanged with the populations before collision, other ones than those that stream.",
    caught_by: "dam-break-mass",
    rung: Some(500.0),
    subject: Subject::Backend(|| Box::new(Mistaken(Mistake::ExchangeBeforeCollision))),
};

/// Excess forgotten.
pub const EXCESS_DROPPED: Mutant = Mutant {
    id: "excess-dropped",
    erratum: "ERRATA 25 (000 text)",
    description: "The mass that a conversion leaves over is dropped.",
    caught_by: "dam-break-mass",
    rung: Some(500.0),
    subject: Subject::Backend(|| Box::new(Mistaken(Mistake::ExcessDropped))),
};

/// Shares that are mean fills.
pub const MEAN_FILLS: Mutant = Mutant {
    id: "exchange-of-mean-fills",
    erratum: "ERRATA 20 (000 Eq 12)",
    description: "The wetted share of a link between interface cells is the mean of their fills, as the papers have it.",
    caught_by: "film-wave-speed",
    rung: Some(8.5),
    subject: Subject::Backend(|| Box::new(Mistaken(Mistake::ExchangeOfMeanFills))),
};

/// Lateral stress whatever the fill.
pub const LATERAL_STRESS: Mutant = Mutant {
    id: "lateral-stress-in-full",
    erratum: "F9",
    description: "Partly filled cells exchange viscous momentum with their neighbours and side walls as full ones do.",
    caught_by: "trough-level",
    rung: Some(10.02),
    subject: Subject::Backend(|| Box::new(Mistaken(Mistake::LateralStressInFull))),
};

/// No sink.
pub const VOIDS_KEPT: Mutant = Mutant {
    id: "voids-kept",
    erratum: "F8",
    description: "Partly filled cells without gas neighbour keep the volume that they lack.",
    caught_by: "voids-close",
    rung: Some(12.0),
    subject: Subject::Backend(|| Box::new(Mistaken(Mistake::VoidsKept))),
};

/// Bounce-back from the first drop on the wall.
pub const WALLS_MET_AT_ONCE: Mutant = Mutant {
    id: "walls-met-at-once",
    erratum: "F10",
    description: "Walls send back all that leaves a partly filled cell that meets them face on.",
    caught_by: "impact-wets-the-wall",
    rung: Some(20.0),
    subject: Subject::Backend(|| Box::new(Mistaken(Mistake::WallsMetAtOnce))),
};

/// The floor of τ⁻ at any speed.
pub const FLOOR_AT_REST: Mutant = Mutant {
    id: "floor-at-rest",
    erratum: "K3",
    description: "The floor of τ⁻ holds at rest, too: stress diffuses, and what is rigid creeps to make up for it.",
    caught_by: "rest-below-yield",
    rung: Some(6.0),
    subject: Subject::Backend(|| Box::new(Mistaken(Mistake::FloorAtRest))),
};
