//! The mass that a conversion leaves over \[F4\].

/// e: the mass that a conversion leaves over, m − m′ \[F4\].
///
/// # Arguments
/// `mass`: m of the cell that converts. `full`: m′ of what it becomes, ρ for liquid and 0 for gas.
/// # Source
/// docs/method.md \[F4\]; docs/errata.md 25 (000 has no rule for it).
/// # Verified by
/// Claim `dam-break-mass`; mutant `excess-dropped`.
#[inline(always)]
#[must_use]
pub fn excess(mass: f64, full: f64) -> f64 {
    mass - full
}
