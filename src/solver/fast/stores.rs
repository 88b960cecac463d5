//! Stores that do not read the line they overwrite.
//!
//! A step reads 19 populations per cell from one copy and writes 19 to the other: 304 bytes in f64. An
//! ordinary store first fetches the line it is about to overwrite, which makes 456. Non-temporal
//! stores leave that out; they need an intrinsic, hence the `unsafe` here.

#![allow(unsafe_code, reason = "intrinsics without a safe form, loads whose places are checked once")]

use super::element::{Element, LINE_BYTES};

/// Copies one line to memory without fetching it; an ordinary copy where the processor has no such store or
/// the place is not the start of a line.
#[inline(always)]
pub(crate) fn line_past_cache<E: Element>(to: &mut [E], from: &[E]) {
    debug_assert!(to.len() == E::PER_LINE && from.len() == E::PER_LINE);
    #[cfg(target_arch = "x86_64")]
    if to.as_ptr().addr().is_multiple_of(LINE_BYTES)
        && size_of_val(to) == LINE_BYTES
        && to.len() == from.len()
    {
        use std::arch::x86_64::{__m128i, _mm_loadu_si128, _mm_stream_si128};
        let (source, target) = (from.as_ptr().cast::<__m128i>(), to.as_mut_ptr().cast::<__m128i>());
        for k in 0..4 {
            // SAFETY: both slices hold 64 bytes, the target starts at a multiple of 64; SSE2 belongs to every
            // x86_64; any bit pattern is a valid number.
            unsafe { _mm_stream_si128(target.add(k), _mm_loadu_si128(source.add(k))) };
        }
        return;
    }
    to.copy_from_slice(from);
}

/// Makes earlier [`line_past_cache`] stores of this thread visible before anything later.
pub(crate) fn fence() {
    #[cfg(target_arch = "x86_64")]
    // SAFETY: SSE belongs to every x86_64.
    unsafe {
        std::arch::x86_64::_mm_sfence();
    }
}

/// Asks for the line of a number from memory, into the second-level cache; nothing happens where there is no
/// such instruction.
#[inline(always)]
pub(crate) fn prefetch_far<E: Element>(from: &[E], at: usize) {
    #[cfg(target_arch = "x86_64")]
    // SAFETY: a prefetch reads nothing and may name any address.
    unsafe {
        use std::arch::x86_64::{_MM_HINT_T1, _mm_prefetch};
        _mm_prefetch::<_MM_HINT_T1>(from.as_ptr().wrapping_add(at).cast());
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (from, at);
}

/// Asks for the line of a number from the second-level cache, into the first; as [`prefetch_far`].
#[inline(always)]
pub(crate) fn prefetch_near<E: Element>(from: &[E], at: usize) {
    #[cfg(target_arch = "x86_64")]
    // SAFETY: as above.
    unsafe {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        _mm_prefetch::<_MM_HINT_T0>(from.as_ptr().wrapping_add(at).cast());
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (from, at);
}

/// `len` numbers of a slice from a place on.
///
/// The 29 places that a pack is gathered from are tabulated for all blocks alike; to check each of them again for every
/// pack takes a fifth of the time of a step.
///
/// # Safety
/// `at + len <= from.len()`.
#[inline(always)]
pub(super) unsafe fn numbers<E: Element>(from: &[E], at: usize, len: usize) -> &[E] {
    debug_assert!(at + len <= from.len());
    // SAFETY: the caller's promise.
    unsafe { from.get_unchecked(at..at + len) }
}

/// An entry of the neighbourhood.
///
/// # Safety
/// `at < 27`.
#[inline(always)]
pub(super) unsafe fn entry<'a, E: Element>(slices: &[&'a [E]; 27], at: usize) -> &'a [E] {
    debug_assert!(at < slices.len());
    // SAFETY: the caller's promise.
    unsafe { slices.get_unchecked(at) }
}
