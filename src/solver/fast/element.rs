//! What populations are stored as, and lines of the cache.

use crate::lattice::Q;

/// Bytes of a cache line.
pub(crate) const LINE_BYTES: usize = 64;

/// Most cells side by side: a line of f32.
pub(crate) const MOST: usize = 16;

/// A stored population, f − w.
pub trait Element: Copy + Default + Send + Sync + PartialEq + 'static {
    /// Numbers per cache line of 64 bytes.
    const PER_LINE: usize;

    /// Rounds to the stored precision.
    fn from_f64(x: f64) -> Self;

    /// Exact.
    fn to_f64(self) -> f64;
}

impl Element for f64 {
    const PER_LINE: usize = 8;

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x
    }

    #[inline(always)]
    fn to_f64(self) -> f64 {
        self
    }
}

impl Element for f32 {
    const PER_LINE: usize = 16;

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x as Self
    }

    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
}

/// Numbers that start at a cache line.
#[derive(Clone, Debug, Default)]
pub(crate) struct Aligned<E> {
    data: Vec<E>,
    start: usize,
    len: usize,
}

impl<E: Element> Aligned<E> {
    /// `len` zeros.
    #[must_use]
    pub(crate) fn zeros(len: usize) -> Self {
        let data = vec![E::default(); len + E::PER_LINE];
        // Falls back to the first number where the address cannot be known; only speed depends on it.
        let start = match data.as_ptr().align_offset(LINE_BYTES) {
            offset if offset < E::PER_LINE => offset,
            _ => 0,
        };
        Self { data, start, len }
    }

    /// The numbers.
    #[inline(always)]
    #[must_use]
    pub(crate) fn get(&self) -> &[E] {
        &self.data[self.start..self.start + self.len]
    }

    /// The numbers.
    #[inline(always)]
    pub(crate) fn get_mut(&mut self) -> &mut [E] {
        &mut self.data[self.start..self.start + self.len]
    }

    /// Whether nothing is held.
    #[must_use]
    pub(crate) fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Bytes held.
    #[must_use]
    pub(crate) fn bytes(&self) -> u64 {
        (self.data.len() * size_of::<E>()) as u64
    }
}

/// Place of population `i` of a cell among the numbers of its block.
///
/// The 19 lines of a pack follow each other, then those of the next pack: a pass walks through memory from
/// front to back, on one page after the other, instead of on 38 pages at once.
#[inline(always)]
#[must_use]
pub(crate) const fn index<E: Element>(local: usize, i: usize) -> usize {
    (local / E::PER_LINE * Q + i) * E::PER_LINE + local % E::PER_LINE
}
