//! What the memory of this machine can do: read, copy, triad and scaling in place, with ordinary stores
//! and with stores past the cache.
//!
//! Bytes are those a kernel asks for: 8 per element for a read, 16 for a copy or in place, 24 for a
//! triad. The lines that ordinary stores read before they overwrite them are not counted: an
//! algorithm cannot avoid them by asking for less.

use std::hint::black_box;
use std::sync::Barrier;
use std::time::Instant;

use serde::Serialize;

use super::error::BenchError;
use super::statistics::Spread;
use crate::lane::streaming::{Line, fence, store_line_past_cache};

/// Bytes of one cell update that no f64 scheme with 19 stored populations goes below: all read, all written.
pub(crate) const BYTES_PER_UPDATE: f64 = 2.0 * 19.0 * BYTES_PER_NUMBER;
/// Of a population in double precision.
pub(crate) const BYTES_PER_NUMBER: f64 = 8.0;

/// One way to use the memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kernel {
    /// Σ b.
    Read,
    /// a = s·b, s = 1 at run time: a plain copy would be left to the C library, which picks its own stores.
    Copy,
    /// a = s·b past the cache.
    CopyPastCache,
    /// a = b + s·c.
    Triad,
    /// a = b + s·c past the cache.
    TriadPastCache,
    /// a = s·a.
    InPlace,
    /// a = s·a past the cache.
    InPlacePastCache,
}

impl Kernel {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Read,
        Self::Copy,
        Self::CopyPastCache,
        Self::Triad,
        Self::TriadPastCache,
        Self::InPlace,
        Self::InPlacePastCache,
    ];

    /// As printed.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Read => "read",
            Self::Copy => "copy",
            Self::CopyPastCache => "copy, past the cache",
            Self::Triad => "triad",
            Self::TriadPastCache => "triad, past the cache",
            Self::InPlace => "in place",
            Self::InPlacePastCache => "in place, past the cache",
        }
    }

    /// Bytes counted per element.
    #[must_use]
    pub(crate) const fn bytes_per_element(self) -> u64 {
        match self {
            Self::Read => 8,
            Self::Copy | Self::CopyPastCache | Self::InPlace | Self::InPlacePastCache => 16,
            Self::Triad | Self::TriadPastCache => 24,
        }
    }
}

/// Speed of one kernel at one number of threads.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Speed {
    /// The kernel.
    pub kernel: Kernel,
    /// Threads.
    pub threads: usize,
    /// Best of all repeats, 10⁹ bytes per second.
    pub best_gb_per_s: f64,
    /// Median of all repeats.
    pub median_gb_per_s: f64,
}

/// The arrays of one thread. Every thread makes its own, so that its pages lie where it runs.
struct Part {
    a: Vec<Line>,
    b: Vec<Line>,
    c: Vec<Line>,
}

impl Part {
    fn new(lines: usize) -> Self {
        Self {
            a: vec![Line::splat(1.0); lines],
            b: vec![Line::splat(2.0); lines],
            c: vec![Line::splat(3.0); lines],
        }
    }

    /// One pass; the result keeps the compiler from leaving the reads out.
    fn pass(&mut self, kernel: Kernel, s: f64) -> f64 {
        match kernel {
            Kernel::Read => return self.sum(),
            Kernel::Copy => {
                for (a, b) in self.a.iter_mut().zip(&self.b) {
                    a.0 = b.0.map(|b| s * b);
                }
            }
            Kernel::CopyPastCache => {
                for (a, b) in self.a.iter_mut().zip(&self.b) {
                    store_line_past_cache(a, &b.0.map(|b| s * b));
                }
            }
            Kernel::Triad => {
                for ((a, b), c) in self.a.iter_mut().zip(&self.b).zip(&self.c) {
                    a.0 = triad(b, c, s);
                }
            }
            Kernel::TriadPastCache => {
                for ((a, b), c) in self.a.iter_mut().zip(&self.b).zip(&self.c) {
                    store_line_past_cache(a, &triad(b, c, s));
                }
            }
            Kernel::InPlace => {
                for a in &mut self.a {
                    a.0 = a.0.map(|a| s * a);
                }
            }
            Kernel::InPlacePastCache => {
                for a in &mut self.a {
                    let scaled = a.0.map(|a| s * a);
                    store_line_past_cache(a, &scaled);
                }
            }
        }
        fence();
        self.a.first().map_or(0.0, |line| line.0[0])
    }

    /// Eight sums side by side, so that the additions do not wait for each other.
    fn sum(&self) -> f64 {
        let mut sums = [0.0; 8];
        for line in &self.b {
            for (sum, b) in sums.iter_mut().zip(line.0) {
                *sum += b;
            }
        }
        sums.iter().sum()
    }
}

#[inline(always)]
fn triad(b: &Line, c: &Line, s: f64) -> [f64; 8] {
    std::array::from_fn(|i| b.0[i] + s * c.0[i])
}

/// Measures every kernel on three arrays of `array_bytes` each, split evenly among the threads.
///
/// # Errors
/// The threads cannot be started.
pub(crate) fn measure(array_bytes: u64, threads: usize, repeats: usize) -> Result<Vec<Speed>, BenchError> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(BenchError::Threads)?;
    let lines = (array_bytes as usize / size_of::<Line>() / threads).max(1);
    let barrier = Barrier::new(threads);
    let of_threads = pool.broadcast(|_| {
        let mut part = Part::new(lines);
        Kernel::ALL.map(|kernel| timed(&mut part, kernel, repeats, &barrier))
    });
    let Some(seconds) = of_threads.into_iter().next() else { return Ok(Vec::new()) };
    let elements = (lines * threads * 8) as u64;
    let speeds = Kernel::ALL.into_iter().zip(seconds).map(|(kernel, seconds)| {
        let bytes = (elements * kernel.bytes_per_element()) as f64;
        let speeds: Vec<f64> = seconds.iter().map(|s| 1e-9 * bytes / s).collect();
        let spread = Spread::of(&speeds);
        Speed { kernel, threads, best_gb_per_s: spread.high, median_gb_per_s: spread.median }
    });
    Ok(speeds.collect())
}

/// Seconds of each repeat, from the moment all threads start to the moment all are done. The first
/// pass is not counted.
fn timed(part: &mut Part, kernel: Kernel, repeats: usize, barrier: &Barrier) -> Vec<f64> {
    let mut seconds = Vec::with_capacity(repeats);
    for repeat in 0..=repeats {
        barrier.wait();
        let clock = Instant::now();
        black_box(part.pass(kernel, black_box(1.0)));
        barrier.wait();
        if repeat > 0 {
            seconds.push(clock.elapsed().as_secs_f64().max(1e-9));
        }
    }
    seconds
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_results_of_every_kernel() {
        for (kernel, expected) in
            Kernel::ALL.into_iter().zip([f64::NAN, 4.0, 4.0, 8.0, 8.0, 2.0, 2.0]).skip(1)
        {
            let mut part = Part::new(5);
            assert_eq!(part.pass(kernel, 2.0), expected, "{kernel:?}");
            assert!(part.a.iter().all(|line| *line == Line::splat(expected)), "{kernel:?}");
        }
        assert_eq!(Part::new(5).pass(Kernel::Read, 2.0), 80.0);
    }

    #[test]
    fn every_kernel_is_measured_on_several_threads() {
        let speeds = measure(1 << 16, 3, 2).unwrap();
        assert_eq!(speeds.len(), Kernel::ALL.len());
        for speed in speeds {
            assert!(speed.best_gb_per_s >= speed.median_gb_per_s && speed.median_gb_per_s > 0.0, "{speed:?}");
        }
    }
}
