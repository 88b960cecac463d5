//! Wrong variants that the claims of this study must catch.

use super::{books, contact, impact, inertia, rolling};
use crate::mutant::{Mutant, Subject};
use lahar::dem::union_moments::sum_of_spheres;
use lahar::dem::{Clump, ContactEquations, Integrator, V3};

/// The tangential spring is left where it was when the contact turns.
#[derive(Debug, Clone, Copy)]
pub struct SpringNotRotated;
impl ContactEquations for SpringNotRotated {
    #[inline(always)]
    fn rotate_spring(&self, s: &V3, _: &V3, _: &V3, _: f64) -> V3 {
        *s
    }
}

/// No Coulomb cap, in contacts with friction.
#[derive(Debug, Clone, Copy)]
pub struct NoCoulombCap;
impl ContactEquations for NoCoulombCap {
    #[inline(always)]
    fn friction_cap(&self, _: f64, _: f64) -> f64 {
        f64::MAX
    }
}

/// The product of 004 Eq 3.38 as printed, u = v + r × ω.
#[derive(Debug, Clone, Copy)]
pub struct ReversedProduct;
impl ContactEquations for ReversedProduct {
    #[inline(always)]
    fn surface_velocity(&self, v: &V3, omega: &V3, r: &V3) -> V3 {
        v + r.cross(omega)
    }
}

/// Spring not turned.
pub const NOT_ROTATED: Mutant = Mutant {
    id: "spring-not-rotated",
    erratum: "DESIGN [D2]",
    description: "The tangential spring stays where it was when the contact turns.",
    caught_by: "spring-turns-with-contact",
    rung: Some(2000.0),
    subject: Subject::Measure(|_, steps| contact::turned(&SpringNotRotated, steps)),
};

/// A spring that does not turn with its contact, in a run of many grains.
pub const NOT_ROTATED_RUN: Mutant = Mutant {
    id: "spring-not-rotated-run",
    erratum: "DESIGN [D2]",
    description: "The same, in a run of many grains.",
    caught_by: "energy-books",
    rung: Some(100.0),
    subject: Subject::Measure(|_, n| books::books(n, Integrator::Verlet, SpringNotRotated)),
};

/// No cap.
pub const NO_CAP: Mutant = Mutant {
    id: "no-coulomb-cap",
    erratum: "DESIGN [D2]",
    description: "The tangential force has no upper bound.",
    caught_by: "sliding-to-rolling-time",
    rung: Some(7e6),
    subject: Subject::Measure(|_, young| rolling::slip_time(young, NoCoulombCap)),
};

/// No cap, impact.
pub const NO_CAP_IMPACT: Mutant = Mutant {
    id: "no-coulomb-cap-impact",
    erratum: "DESIGN [D2]",
    description: "The same, in an oblique impact.",
    caught_by: "oblique-impact-slip",
    rung: Some(7e10),
    subject: Subject::Measure(|_, young| impact::slipping(young, NoCoulombCap)),
};

/// Sum of spheres.
pub const SUM_OF_SPHERES: Mutant = Mutant {
    id: "inertia-sum-of-spheres",
    erratum: "DESIGN [D4]",
    description: "Mass, centre and inertia of a clump are sums over its members, overlaps counted twice.",
    caught_by: "clump-two-spheres",
    rung: None,
    subject: Subject::Measure(|_, distance| {
        inertia::two(distance, |s| Clump::with_moments("two", s, &sum_of_spheres(s)))
    }),
};

/// Reversed product.
pub const REVERSED: Mutant = Mutant {
    id: "reversed-product",
    erratum: "ERRATA 18 (004 Eq 3.38)",
    description: "The surface of a grain moves with u = u_p + r x omega, as printed.",
    caught_by: "sliding-to-rolling-speed",
    rung: None,
    subject: Subject::Measure(|_, mu| rolling::with_arm(mu, ReversedProduct)),
};

/// Reversed product, books.
pub const REVERSED_BOOKS: Mutant = Mutant {
    id: "reversed-product-run",
    erratum: "ERRATA 18 (004 Eq 3.38)",
    description: "The same, in a run of many grains.",
    caught_by: "energy-books",
    rung: Some(100.0),
    subject: Subject::Measure(|_, n| books::books(n, Integrator::Verlet, ReversedProduct)),
};
