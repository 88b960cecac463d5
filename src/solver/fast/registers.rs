//! How many cells are computed side by side, and in which precision.

use super::element::Element;
use crate::lane::{Lane, Pack, Singles};

/// One way to hold populations in registers.
pub(crate) trait Registers: Copy + Send + Sync + 'static {
    /// What populations are stored as.
    type Element: Element;
    /// What they are computed with.
    type Pack: Lane;
    /// Cells per pack; divides [`Element::PER_LINE`].
    const WIDTH: usize;

    /// First [`Self::WIDTH`] numbers of a slice.
    fn load(from: &[Self::Element]) -> Self::Pack;
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
    /// Added to `f64`, in `f64`.
    #[inline(always)]
    fn add_wide(pack: Self::Pack, to: &mut [f64]) {
        Self::store_wide(Self::load_wide(to) + pack, to);
    }
    /// The last lane of the pack before, then all lanes of this one but the last.
    fn shifted_up(before: Self::Pack, pack: Self::Pack) -> Self::Pack;
    /// All lanes of this pack but the first, then the first lane of the pack behind.
    fn shifted_down(pack: Self::Pack, behind: Self::Pack) -> Self::Pack;
}

/// `N` numbers in f64, stored in f64: the reference precision.
#[allow(dead_code, reason = "it names a choice among types; there is no value of it")]
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
    fn shifted_up(before: Pack<N>, pack: Pack<N>) -> Pack<N> {
        let mut x = [before.0[N - 1]; N];
        x[1..].copy_from_slice(&pack.0[..N - 1]);
        Pack(x)
    }
    #[inline(always)]
    fn shifted_down(pack: Pack<N>, behind: Pack<N>) -> Pack<N> {
        let mut x = [behind.0[0]; N];
        x[..N - 1].copy_from_slice(&pack.0[1..]);
        Pack(x)
    }
}

/// `N` numbers in f32, stored in f32.
#[allow(dead_code, reason = "it names a choice among types; there is no value of it")]
#[derive(Clone, Copy, Debug)]
pub struct Single<const N: usize>;

impl<const N: usize> Registers for Single<N> {
    type Element = f32;
    type Pack = Singles<N>;
    const WIDTH: usize = N;

    #[inline(always)]
    fn load(from: &[f32]) -> Singles<N> {
        let mut x = [0.0; N];
        x.copy_from_slice(&from[..N]);
        Singles(x)
    }
    #[inline(always)]
    fn store(pack: Singles<N>, to: &mut [f32]) {
        to[..N].copy_from_slice(&pack.0);
    }
    #[inline(always)]
    fn load_wide(from: &[f64]) -> Singles<N> {
        let mut x = [0.0; N];
        for (x, from) in x.iter_mut().zip(&from[..N]) {
            *x = *from as f32;
        }
        Singles(x)
    }
    #[inline(always)]
    fn store_wide(pack: Singles<N>, to: &mut [f64]) {
        for (to, x) in to[..N].iter_mut().zip(&pack.0) {
            *to = f64::from(*x);
        }
    }
    #[inline(always)]
    fn add_wide(pack: Singles<N>, to: &mut [f64]) {
        for (to, x) in to[..N].iter_mut().zip(&pack.0) {
            *to += f64::from(*x);
        }
    }
    #[inline(always)]
    fn shifted_up(before: Singles<N>, pack: Singles<N>) -> Singles<N> {
        let mut x = [before.0[N - 1]; N];
        x[1..].copy_from_slice(&pack.0[..N - 1]);
        Singles(x)
    }
    #[inline(always)]
    fn shifted_down(pack: Singles<N>, behind: Singles<N>) -> Singles<N> {
        let mut x = [behind.0[0]; N];
        x[..N - 1].copy_from_slice(&pack.0[1..]);
        Singles(x)
    }
}

/// `N` numbers in f64, stored in f32.
#[allow(dead_code, reason = "it names a choice among types; there is no value of it")]
#[derive(Clone, Copy, Debug)]
pub struct Stored<const N: usize>;

impl<const N: usize> Registers for Stored<N> {
    type Element = f32;
    type Pack = Pack<N>;
    const WIDTH: usize = N;

    #[inline(always)]
    fn load(from: &[f32]) -> Pack<N> {
        let mut x = [0.0; N];
        for (x, from) in x.iter_mut().zip(&from[..N]) {
            *x = f64::from(*from);
        }
        Pack(x)
    }
    #[inline(always)]
    fn store(pack: Pack<N>, to: &mut [f32]) {
        for (to, x) in to[..N].iter_mut().zip(&pack.0) {
            *to = *x as f32;
        }
    }
    #[inline(always)]
    fn load_wide(from: &[f64]) -> Pack<N> {
        Double::load(from)
    }
    #[inline(always)]
    fn store_wide(pack: Pack<N>, to: &mut [f64]) {
        Double::store(pack, to);
    }
    #[inline(always)]
    fn shifted_up(before: Pack<N>, pack: Pack<N>) -> Pack<N> {
        Double::shifted_up(before, pack)
    }
    #[inline(always)]
    fn shifted_down(pack: Pack<N>, behind: Pack<N>) -> Pack<N> {
        Double::shifted_down(pack, behind)
    }
}
