//! Voids below the surface close \[F8\].

use crate::lane::Lane;
use crate::lattice::{Q, W};

/// s: share of its missing volume that a void takes in per step, at most. Sixteen steps are several times what a sound wave
/// needs to cross the cell; with 1e-2 blocks that spread fast kept 1.5 % of voids, with 1e-3 mud on a stepped bed 8 %.
const RATE: f64 = 1.0 / 16.0;

/// Share of its excess over the pressure of the gas that a void gives up per step, at most: the pressure in it falls
/// smoothly to that of the gas, whatever the viscosity of what flows in.
const SHARE: f64 = 0.5;

/// What a partly filled cell without gas neighbour gives up of its density in a step: min(s(1 − φ), ½ δρ), where it is
/// pressed.
///
/// Such a cell is a void under fluid. It streams like liquid and cannot be compressed, so that nothing would ever fill
/// what it lacks. With this sink its neighbours flow in until it is full, and bring mass by their links \[F1\]. Below the
/// pressure of the gas a void stays: fluid is not sucked in.
///
/// # Arguments
/// `fill`: φ, 0 to 1. `d_rho`: ρ − 1 of what has streamed in.
/// # Source
/// docs/method.md \[F8\], ours.
/// # Verified by
/// Claims `voids-close`, `dam-break-viscous-planar`; mutant `voids-kept`.
#[inline(always)]
#[must_use]
pub fn sink(fill: f64, d_rho: f64) -> f64 {
    if d_rho > 0.0 && fill < 1.0 { f64::smaller(RATE * (1.0 - fill), SHARE * d_rho) } else { 0.0 }
}

/// Takes a density off the populations of a cell, without momentum: f_i − w_i s.
///
/// # Source
/// docs/method.md \[F8\].
/// # Verified by
/// As [`sink`].
#[inline(always)]
pub(crate) fn give_up(f: &mut [f64; Q], density: f64) {
    for (f, w) in f.iter_mut().zip(W) {
        *f -= w * density;
    }
}
