//! Instruction sets: the same pass compiled for each, chosen when a run starts.

use super::block::{Block, Place};
use super::kernel::{Outcome, Own, Task, pass};
use super::rim::{Rim, WallTask, correct};
use super::surface::InterfaceCell;
use super::surface::exchange::Streaming;
use super::surface::packed::{Near, stream_block};
#[cfg(target_arch = "x86_64")]
use super::x86;
use crate::solver::books::Entries;
use crate::solver::physics::Physics;

/// Instruction sets the pass is compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Instructions {
    /// What every processor of the architecture has: SSE2, NEON or none.
    Baseline,
    /// 256-bit registers.
    Avx2,
    /// 512-bit registers.
    Avx512,
}

impl Instructions {
    /// What this processor has, best last.
    #[must_use]
    pub fn available() -> Vec<Self> {
        let mut list = vec![Self::Baseline];
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") {
                list.push(Self::Avx2);
            }
            if is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512bw")
                && is_x86_feature_detected!("avx512vl")
            {
                list.push(Self::Avx512);
            }
        }
        list
    }

    /// Short name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }
}

/// Instruction sets that are known to be present.
#[derive(Clone, Copy, Debug)]
pub struct Chosen(Instructions);

impl Chosen {
    /// The one asked for, or the best one; `None` if the processor does not have it.
    #[must_use]
    pub fn new(wanted: Option<Instructions>) -> Option<Self> {
        let available = Instructions::available();
        match wanted {
            None => available.last().copied().map(Self),
            Some(wanted) => available.contains(&wanted).then_some(Self(wanted)),
        }
    }

    /// Which one.
    #[must_use]
    pub const fn get(self) -> Instructions {
        self.0
    }
}

/// A pass over one block in f64.
pub fn run<P: Physics>(chosen: Chosen, task: &Task<P, f64>, own: &mut Own<f64>) -> Outcome {
    match chosen.get() {
        Instructions::Baseline => baseline(task, own),
        #[cfg(target_arch = "x86_64")]
        // SAFETY: `Chosen` is only made of what the processor has.
        Instructions::Avx2 => unsafe { avx2(task, own) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Instructions::Avx512 => unsafe { avx512(task, own) },
        #[cfg(not(target_arch = "x86_64"))]
        Instructions::Avx2 | Instructions::Avx512 => baseline(task, own),
    }
}

#[cfg(target_arch = "x86_64")]
fn baseline<P: Physics>(task: &Task<P, f64>, own: &mut Own<f64>) -> Outcome {
    pass::<x86::Sse2, P>(task, own)
}

#[cfg(not(target_arch = "x86_64"))]
fn baseline<P: Physics>(task: &Task<P, f64>, own: &mut Own<f64>) -> Outcome {
    pass::<super::registers::Double<2>, P>(task, own)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn avx2<P: Physics>(task: &Task<P, f64>, own: &mut Own<f64>) -> Outcome {
    pass::<x86::Avx2, P>(task, own)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512bw,avx512vl")]
fn avx512<P: Physics>(task: &Task<P, f64>, own: &mut Own<f64>) -> Outcome {
    pass::<x86::Avx512, P>(task, own)
}

/// Streams the interface cells of one block.
pub fn exchange<P: Physics>(
    chosen: Chosen,
    streaming: &Streaming<P>,
    near: &Near,
    list: &mut [InterfaceCell],
    entries: &mut Entries,
) {
    match chosen.get() {
        Instructions::Baseline => exchange_baseline(streaming, near, list, entries),
        #[cfg(target_arch = "x86_64")]
        // SAFETY: `Chosen` is only made of what the processor has.
        Instructions::Avx2 => unsafe { exchange_avx2(streaming, near, list, entries) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Instructions::Avx512 => unsafe { exchange_avx512(streaming, near, list, entries) },
        #[cfg(not(target_arch = "x86_64"))]
        Instructions::Avx2 | Instructions::Avx512 => exchange_baseline(streaming, near, list, entries),
    }
}

fn exchange_baseline<P: Physics>(
    streaming: &Streaming<P>,
    near: &Near,
    list: &mut [InterfaceCell],
    entries: &mut Entries,
) {
    #[cfg(target_arch = "x86_64")]
    stream_block::<x86::Sse2, P>(streaming, near, list, entries);
    #[cfg(not(target_arch = "x86_64"))]
    stream_block::<super::registers::Double<2>, P>(streaming, near, list, entries);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn exchange_avx2<P: Physics>(
    streaming: &Streaming<P>,
    near: &Near,
    list: &mut [InterfaceCell],
    entries: &mut Entries,
) {
    stream_block::<x86::Avx2, P>(streaming, near, list, entries);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512bw,avx512vl")]
fn exchange_avx512<P: Physics>(
    streaming: &Streaming<P>,
    near: &Near,
    list: &mut [InterfaceCell],
    entries: &mut Entries,
) {
    stream_block::<x86::Avx512, P>(streaming, near, list, entries);
}

/// Wall corrections of one block, see [`correct`].
pub fn walls<P: Physics>(
    chosen: Chosen,
    task: &WallTask<P>,
    block: &Block,
    rim: &mut [Rim],
    force: &impl Fn(usize) -> Option<[f64; 3]>,
    is_fluid: &impl Fn(Place) -> bool,
) {
    match chosen.get() {
        Instructions::Baseline => walls_baseline(task, block, rim, force, is_fluid),
        #[cfg(target_arch = "x86_64")]
        // SAFETY: `Chosen` is only made of what the processor has.
        Instructions::Avx2 => unsafe { walls_avx2(task, block, rim, force, is_fluid) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Instructions::Avx512 => unsafe { walls_avx512(task, block, rim, force, is_fluid) },
        #[cfg(not(target_arch = "x86_64"))]
        Instructions::Avx2 | Instructions::Avx512 => walls_baseline(task, block, rim, force, is_fluid),
    }
}

fn walls_baseline<P: Physics>(
    task: &WallTask<P>,
    block: &Block,
    rim: &mut [Rim],
    force: &impl Fn(usize) -> Option<[f64; 3]>,
    is_fluid: &impl Fn(Place) -> bool,
) {
    #[cfg(target_arch = "x86_64")]
    correct::<x86::Sse2, P>(task, block, rim, force, is_fluid);
    #[cfg(not(target_arch = "x86_64"))]
    correct::<super::registers::Double<2>, P>(task, block, rim, force, is_fluid);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn walls_avx2<P: Physics>(
    task: &WallTask<P>,
    block: &Block,
    rim: &mut [Rim],
    force: &impl Fn(usize) -> Option<[f64; 3]>,
    is_fluid: &impl Fn(Place) -> bool,
) {
    correct::<x86::Avx2, P>(task, block, rim, force, is_fluid);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512bw,avx512vl")]
fn walls_avx512<P: Physics>(
    task: &WallTask<P>,
    block: &Block,
    rim: &mut [Rim],
    force: &impl Fn(usize) -> Option<[f64; 3]>,
    is_fluid: &impl Fn(Place) -> bool,
) {
    correct::<x86::Avx512, P>(task, block, rim, force, is_fluid);
}
