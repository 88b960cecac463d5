//! Wrong viscosities.

use crate::claims::mutants_physics::{Mistake, Mistaken};
use crate::mutant::{Mutant, Subject};

pub(super) const MUTANTS: &[Mutant] = &[
    Mutant {
        id: "dynamic-for-kinematic-viscosity",
        erratum: "ERRATA 7–10 (000 Eqs 2, 14; 001 Eqs 2, 6, 8; 004 Eqs 3.26, 3.34, 3.35, 3.68b)",
        description: "τ = ½ + 3μ: viscosity and yield stress are not divided by the density.",
        caught_by: "shear-wave-dense-fluid",
        rung: Some(1.1),
        subject: Subject::Backend(|| Box::new(Mistaken(Mistake::NoDensityInTau))),
    },
    Mutant {
        id: "viscosity-without-the-half-step",
        erratum: "004 Eq 3.69 without its ½",
        description: "τ = 3ν: the ½ that the discrete time step takes from the viscosity is forgotten.",
        caught_by: "sound-wave-damping",
        rung: Some(1.8),
        subject: Subject::Backend(|| Box::new(Mistaken(Mistake::NoHalfInTau))),
    },
    Mutant {
        id: "rates-swapped",
        erratum: "design K2 (H1: swapped ω⁺ and ω⁻)",
        description: "The even populations relax with ω⁻.",
        caught_by: "shear-wave-axis-trt",
        rung: Some(16.0),
        subject: Subject::Backend(|| Box::new(Mistaken(Mistake::SwappedRates))),
    },
    Mutant {
        id: "second-order-collision",
        erratum: "design K3 (004 Eq 3.25 keeps second order only)",
        description: "BGK, whose third moments lack ρ u u u, in place of the central-moment operator.",
        caught_by: "central-moment-galilean-order",
        rung: None,
        subject: Subject::Backend(|| Box::new(Mistaken(Mistake::AlwaysBgk))),
    },
];
