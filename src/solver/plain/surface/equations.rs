//! The equations of the surface that need more than one cell, over the arrays of a run.

use crate::free_surface::{Kind, conversion::excess, exchange, voids};
use crate::lattice::opposite;
use crate::solver::cell::Cell;

/// The cells of a run between collision and streaming.
#[derive(Clone, Copy)]
pub struct Collided<'a> {
    /// Populations before the collision, f − w.
    pub before: &'a [Cell],
    /// Populations after it.
    pub after: &'a [Cell],
    /// Kinds.
    pub kinds: &'a [Kind],
    /// φ of every cell.
    pub fill: &'a [f64],
    /// c of interface cells, φ elsewhere.
    pub carried: &'a [f64],
}

/// A link between two cells.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceLink {
    /// The interface cell at which population `i` arrives.
    pub cell: usize,
    /// Arriving direction.
    pub i: usize,
    /// The cell it comes from.
    pub from: usize,
    /// Its direction there; another than `i` at a mirror plane.
    pub direction: usize,
}

/// The physics of the surface, given the arrays they are about: an implementation may read other cells or another
/// time level than the method. What is not overridden is right.
pub trait SurfacePhysics: Clone + Send + Sync + 'static {
    /// Δm that an interface cell gains over a link to another fluid cell \[F1\].
    #[inline(always)]
    fn gained(&self, cells: &Collided, link: &SurfaceLink) -> f64 {
        let SurfaceLink { cell, i, from, direction } = *link;
        let share = exchange::wetted_share(cells.kinds[from], cells.carried[cell], cells.carried[from]);
        exchange::link_mass(share, cells.after[from][direction], cells.after[cell][opposite(i)])
    }

    /// Population that the gas sends back to `cell` along −c_out \[F2\]; `after`: populations after collision,
    /// `u`: velocity of the cell.
    #[inline(always)]
    fn gas_link(&self, after: &[Cell], cell: usize, out: usize, u: &[f64; 3]) -> f64 {
        exchange::gas_link(after[cell][out], out, u)
    }

    /// Density that a void gives up \[F8\], see [`sink`](voids::sink).
    #[inline(always)]
    fn void_sink(&self, fill: f64, d_rho: f64) -> f64 {
        voids::sink(fill, d_rho)
    }

    /// 1 − A of a link between interface cells \[F9\]; `share`: what the method says.
    #[inline(always)]
    fn dry_share(&self, share: f64) -> f64 {
        share
    }

    /// 1 − A of a link to a wall \[F9\]; `share`: what the method says.
    #[inline(always)]
    fn dry_share_at_wall(&self, share: f64) -> f64 {
        share
    }

    /// w of a link to a wall \[F10\]; `share`: what the method says.
    #[inline(always)]
    fn meeting(&self, share: f64) -> f64 {
        share
    }

    /// Mass that a conversion leaves over \[F4\], see [`excess()`](excess::excess).
    #[inline(always)]
    fn excess(&self, mass: f64, full: f64) -> f64 {
        excess::excess(mass, full)
    }
}

/// The surface of the method.
#[derive(Clone, Copy, Debug, Default)]
pub struct Design;

impl SurfacePhysics for Design {}
