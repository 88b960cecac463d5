//! What a pass over a block reads, what it owns and what it finds.

use super::around::Around;
use super::block::Block;
use super::element::{Aligned, Element, index};
use super::layout::Layout;
use super::rim::Rim;
use super::sources::Sources;
use super::surface::record::{InterfaceCell, SurfaceView};
use crate::boundary::hand_over::HandOver;
use crate::lattice::Q;
use crate::setup::Setup;
use crate::solver::run::Stopped;

/// What all blocks of a pass share; everything here is only read.
pub(crate) struct Task<'a, P, E> {
    /// What is run.
    pub setup: &'a Setup,
    /// Equations.
    pub physics: &'a P,
    /// Which block is where.
    pub layout: &'a Layout,
    /// Where packs are gathered from.
    pub sources: &'a [Sources],
    /// All blocks, by number.
    pub blocks: &'a [Block],
    /// Populations after the last collision, or before the first one.
    pub old: &'a [Aligned<E>],
    /// Whether `old` holds populations before the first collision.
    pub fresh: bool,
    /// Body force of this step.
    pub force: [f64; 3],
    /// This step.
    pub step: u64,
    /// Wall velocities by number.
    pub velocities: &'a [[f64; 3]],
    /// What moving solids hand along their surfaces.
    pub hand_over: &'a HandOver,
    /// What comes back along cut links, by block.
    pub cut_returned: &'a [Vec<f64>],
    /// Whether stores go past the cache.
    pub past_cache: bool,
    /// Free surface, if any.
    pub surface: Option<SurfaceView<'a>>,
}

impl<'a, P, E: Element> Task<'a, P, E> {
    /// Around a block.
    #[inline(always)]
    pub(crate) fn around(&self, number: usize) -> Around<'a, E> {
        Around::new(self.old, self.layout, self.blocks, number)
    }

    /// Around the block after this one, if there is one that holds anything.
    #[inline(always)]
    pub(crate) fn around_next(&self, number: usize) -> Option<Around<'a, E>> {
        Around::next(self.old, self.layout, self.blocks, number)
    }
}

/// What a block owns in a pass.
pub(crate) struct Own<'a, E> {
    /// Number of the block.
    pub number: usize,
    /// Populations after this collision.
    pub new: &'a mut Aligned<E>,
    /// Cells at walls and open faces; empty if nothing is kept of them.
    pub rim: &'a mut [Rim],
    /// ρ − 1 by cell; empty unless somebody asks for it.
    pub density: &'a mut [f64],
    /// ω⁺ of the previous step; empty unless lagged.
    pub lag: &'a mut [f64],
    /// u by cell, x then y then z; empty unless the surface force has inertia.
    pub velocity: &'a mut [f64],
    /// Interface cells of the block.
    pub interface: &'a mut [InterfaceCell],
}

/// What a pass over a block found.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Outcome {
    /// First cell, by number in the box, that fails the guard.
    pub failed: Option<(usize, Stopped)>,
    /// Σ(ρ − 1) over liquid cells; only with a free surface.
    pub liquid_excess: f64,
}

/// Populations of a cell after the last collision.
#[inline]
pub(crate) fn after<P, E: Element>(task: &Task<P, E>, number: usize, local: usize) -> [f64; Q] {
    let own = task.old[number].get();
    std::array::from_fn(|i| own[index::<E>(local, i)].to_f64())
}
