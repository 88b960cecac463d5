//! Stores that go past the cache.
//!
//! An ordinary store first reads the cache line it is about to overwrite: copying n bytes then moves
//! 3n over the memory bus, not 2n. A store that covers a whole line and goes past the cache moves 2n.
//! It pays only where the data are not wanted again before they would have left the cache anyway.
//!
//! The standard library offers such stores only for raw pointers, hence the `unsafe` here; the rest of it is in
//! `solver/fast` (`x86`, `stores`, `instructions`).

#![allow(unsafe_code, reason = "intrinsics without a safe form")]

/// Eight numbers, as long and as aligned as a cache line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(crate) struct Line(pub [f64; 8]);

impl Line {
    /// The same number eight times.
    #[must_use]
    pub(crate) const fn splat(x: f64) -> Self {
        Self([x; 8])
    }
}

/// Writes a whole line past the cache; an ordinary store where the processor has no such thing.
///
/// The values are those of `*to = Line(*from)`. Before another thread may read the line, the thread
/// that wrote it must call [`fence`]: without it the reader may see the values from before.
#[inline(always)]
pub(crate) fn store_line_past_cache(to: &mut Line, from: &[f64; 8]) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_mm_set_pd, _mm_stream_pd};
        let to = to.0.as_mut_ptr();
        for pair in 0..4 {
            // SAFETY: `to` is an exclusive reference to eight numbers, so that 2·pair and 2·pair + 1 lie
            // inside it; `Line` is aligned to 64 bytes, so that every pair is aligned to 16. SSE2 is
            // part of x86-64.
            unsafe { _mm_stream_pd(to.add(2 * pair), _mm_set_pd(from[2 * pair + 1], from[2 * pair])) };
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    {
        to.0 = *from;
    }
}

/// Orders all stores past the cache of this thread before its later stores. To be called before the
/// lines are handed to another thread.
#[inline]
pub(crate) fn fence() {
    #[cfg(target_arch = "x86_64")]
    {
        // SAFETY: SSE is part of x86-64; the instruction has no operands.
        #[allow(unused_unsafe, reason = "a safe function in newer versions of the standard library")]
        unsafe {
            std::arch::x86_64::_mm_sfence();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_lines_arrive_whole_and_nothing_beside_them_changes() {
        let mut lines = [Line::splat(-1.0); 3];
        let from = [0.0, -0.0, f64::INFINITY, 1.5, f64::MIN_POSITIVE, -2.0, 3.0, 1e-310];
        store_line_past_cache(&mut lines[1], &from);
        fence();
        assert_eq!(lines[1].0.map(f64::to_bits), from.map(f64::to_bits));
        assert_eq!([lines[0], lines[2]], [Line::splat(-1.0); 2]);
    }

    #[test]
    fn exact_lines_written_by_other_threads_after_a_fence() {
        let mut lines = vec![Line::splat(0.0); 4096];
        std::thread::scope(|scope| {
            for (t, part) in lines.chunks_mut(1024).enumerate() {
                scope.spawn(move || {
                    for (k, line) in part.iter_mut().enumerate() {
                        store_line_past_cache(line, &[(1024 * t + k) as f64; 8]);
                    }
                    fence();
                });
            }
        });
        assert!(lines.iter().enumerate().all(|(k, line)| *line == Line::splat(k as f64)));
    }
}
