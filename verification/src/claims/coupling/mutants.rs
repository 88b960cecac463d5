//! Wrong variants that the claims of this study must catch.

use super::{approach, free, surface};
use crate::claims::mutants_physics::{Mistake, Mistaken};
use crate::mutant::{Mutant, Subject};
use lahar::coupling::{CouplingEquations, StandardCoupling};
use std::f64::consts::PI;

/// Wall velocity with r × ω (004 Eq 3.38 as printed).
#[derive(Clone, Copy, Debug)]
pub struct ReversedProduct;
impl CouplingEquations for ReversedProduct {
    fn surface_velocity(&self, velocity: [f64; 3], spin: [f64; 3], arm: [f64; 3]) -> [f64; 3] {
        StandardCoupling.surface_velocity(velocity, spin.map(|w| -w), arm)
    }
}

/// Lubrication without π (000 Eq 15 as printed).
#[derive(Clone, Copy, Debug)]
pub struct LubricationWithoutPi;
impl CouplingEquations for LubricationWithoutPi {
    fn lubrication(&self, viscosity: f64, reduced: f64, gap: f64, cutoff: f64) -> f64 {
        StandardCoupling.lubrication(viscosity, reduced, gap, cutoff) * (1.0 / PI)
    }
}

/// The mass of covered cells is forgotten.
#[derive(Clone, Copy, Debug)]
pub struct CoveredMassDropped;
impl CouplingEquations for CoveredMassDropped {
    fn covering(&self, _: f64, _: [f64; 3]) -> (f64, [f64; 3]) {
        (0.0, [0.0; 3])
    }
}

/// Wall factor.
pub const WALL_FACTOR: Mutant = Mutant {
    id: "grain-wall-factor-twin",
    erratum: "ERRATA 14 (000 Eq 10)",
    description: "A moving surface gives 2 w rho u.c to a link instead of 6 w rho u.c.",
    caught_by: "galilean-twin",
    rung: Some(0.8),
    subject: Subject::Backend(|| Box::new(Mistaken(Mistake::WallFactor))),
};

/// Without π.
pub const LUBRICATION: Mutant = Mutant {
    id: "lubrication-without-pi",
    erratum: "ERRATA 35 (000 Eq 15)",
    description: "The lubrication force has no pi, as printed.",
    caught_by: "lubrication-approach",
    rung: Some(0.1),
    subject: Subject::Measure(|backend, gap| approach::approach(backend, gap, LubricationWithoutPi)),
};

/// Reversed product.
pub const REVERSED: Mutant = Mutant {
    id: "reversed-product-in-fluid",
    erratum: "ERRATA 18 (004 Eq 3.38)",
    description: "The surface of a grain in the fluid moves with u = u_p + r x omega, as printed.",
    caught_by: "sphere-spin-in-shear",
    rung: Some(2.0),
    subject: Subject::Measure(|backend, radius| free::sphere_spin(backend, radius, ReversedProduct)),
};

/// Covered mass dropped.
pub const COVERED_MASS: Mutant = Mutant {
    id: "covered-mass-dropped",
    erratum: "DESIGN [C3]",
    description: "The mass of cells that a grain covers is forgotten.",
    caught_by: "stirred-pool-books",
    rung: Some(10.0),
    subject: Subject::Measure(|backend, count| surface::ledgers(backend, count, CoveredMassDropped)),
};
