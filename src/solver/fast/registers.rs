//! How many cells are computed side by side, and in which precision.

use super::element::Element;
use crate::lane::{Lane, Pack};

/// One way to hold populations in registers.
pub trait Registers: Copy + Send + Sync + 'static {
    /// What populations are stored as.
    type Element: Element;
    /// What they are computed with.
    type Pack: Lane;
    /// Cells per pack; divides [`Element::PER_LINE`].
    const WIDTH: usize;

    /// First [`Self::WIDTH`] numbers of a slice.
    fn load(from: &[Self::Element]) -> Self::Pack;
    /// Numbers from a place on that is known to be inside; see [`super::stores::number`].
    #[inline(always)]
    fn load_at(from: &[Self::Element], at: usize) -> Self::Pack {
        Self::load(super::stores::numbers(from, at, Self::WIDTH))
    }
    /// Into the first numbers of a slice.
    fn store(pack: Self::Pack, to: &mut [Self::Element]);
    /// As [`Self::store`], past the cache where a pack is a whole line that starts at a multiple of its size.
    #[inline(always)]
    fn store_past_cache(pack: Self::Pack, to: &mut [Self::Element]) {
        Self::store(pack, to);
    }
    /// From `f64`, whatever is stored.
    fn load_wide(from: &[f64]) -> Self::Pack;
    /// To `f64`.
    fn store_wide(pack: Self::Pack, to: &mut [f64]);
    /// The same pack with another first lane.
    fn with_first(pack: Self::Pack, x: Self::Element) -> Self::Pack;
    /// The same pack with another last lane.
    fn with_last(pack: Self::Pack, x: Self::Element) -> Self::Pack;
}

/// `N` numbers in f64, stored in f64: the reference precision.
#[derive(Clone, Copy, Debug)]
pub struct Double<const N: usize>;

impl<const N: usize> Registers for Double<N> {
    type Element = f64;
    type Pack = Pack<N>;
    const WIDTH: usize = N;

    #[inline(always)]
    fn load(from: &[f64]) -> Pack<N> {
        let mut x = [0.0; N];
        x.copy_from_slice(&from[..N]);
        Pack(x)
    }
    #[inline(always)]
    fn store(pack: Pack<N>, to: &mut [f64]) {
        to[..N].copy_from_slice(&pack.0);
    }
    #[inline(always)]
    fn load_wide(from: &[f64]) -> Pack<N> {
        Self::load(from)
    }
    #[inline(always)]
    fn store_wide(pack: Pack<N>, to: &mut [f64]) {
        Self::store(pack, to);
    }
    #[inline(always)]
    fn with_first(mut pack: Pack<N>, x: f64) -> Pack<N> {
        pack.0[0] = x;
        pack
    }
    #[inline(always)]
    fn with_last(mut pack: Pack<N>, x: f64) -> Pack<N> {
        pack.0[N - 1] = x;
        pack
    }
}
