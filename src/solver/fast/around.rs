//! The populations around a block.

use super::block::{Block, numbers_around};
use super::element::{Aligned, Element};
use super::layout::{Layout, NONE};

/// The populations around a block: 27 slices, the block's own where there is none.
pub(crate) struct Around<'a, E> {
    /// As [`Layout::around`]; each holds a whole block.
    slices: [&'a [E]; 27],
}

impl<'a, E: Element> Around<'a, E> {
    /// Around a block.
    pub fn new(old: &'a [Aligned<E>], layout: &Layout, blocks: &[Block], number: usize) -> Self {
        let own = old[number].get();
        assert_eq!(own.len(), layout.block_len());
        let numbers = numbers_around(layout, blocks[number].place);
        let slices = numbers.map(|n| match n {
            NONE => own,
            n => Some(old[n as usize].get()).filter(|other| other.len() == own.len()).unwrap_or(own),
        });
        Self { slices }
    }

    /// Around the block after this one, if there is one that holds anything.
    #[inline]
    pub(crate) fn next(
        old: &'a [Aligned<E>],
        layout: &Layout,
        blocks: &[Block],
        number: usize,
    ) -> Option<Self> {
        let next = old.get(number + 1)?;
        (next.get().len() == old[number].get().len()).then(|| Self::new(old, layout, blocks, number + 1))
    }

    /// All 27, each of [`Self::block_len`] numbers.
    #[inline(always)]
    pub(crate) fn all(&self) -> &[&'a [E]; 27] {
        &self.slices
    }

    /// Numbers in each of the 27: those of the block itself, which all others were compared with.
    #[inline(always)]
    pub(crate) fn block_len(&self) -> usize {
        self.slices[13].len()
    }
}
