//! Instruction sets: the same pass compiled for each, chosen when a run starts.

#![allow(unsafe_code, reason = "calls of code for an instruction set, after the processor has been asked")]

use super::kernel::pass;
use super::rim::{Alike, Columns, WallTask, correct_group};
use super::sources::Sources;
use super::surface::carry::carry_packs;
use super::surface::packed::{Near, stream_block};
use super::surface::record::InterfaceCell;
use super::surface::streaming::Streaming;
use super::task::{Outcome, Own, Task};
#[cfg(target_arch = "x86_64")]
use super::x86::{
    Avx2, Avx2Single, Avx2Stored, Avx512, Avx512Single, Avx512Stored, Sse2, Sse2Single, Sse2Stored,
};
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
pub(crate) struct Chosen(Instructions);

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
    pub(crate) const fn get(self) -> Instructions {
        self.0
    }
}

/// A collision of one block.
pub(crate) type Collide<P, E> = fn(Chosen, &Task<P, E>, &mut Own<E>) -> Outcome;

/// An exchange of one block: all its interface cells.
pub(crate) type Exchange<P, E> = fn(Chosen, &Streaming<P, E>, &Near<E>, &mut [InterfaceCell], &mut Entries);

/// Shares of packs of one block.
pub(crate) type Carry = fn(Chosen, &[&[f64]; 27], &[Sources], &[usize], &mut [f64]);

/// The passes over one block of a run, in its precision.
#[derive(Clone, Copy)]
pub(crate) struct Passes<P, E> {
    /// Gather, collide, store: see [`pass`].
    pub collide: Collide<P, E>,
    /// Streams the interface cells: see [`stream_block`].
    pub exchange: Exchange<P, E>,
    /// Shares of links between interface cells: see [`carry_packs`].
    pub carry: Carry,
}

/// A function of registers, compiled for every instruction set: `$run` with portable registers, then those
/// of x86_64. In the unit tests of this crate for one of them: the bits are the same, and others would take a minute to build.
macro_rules! compiled {
    (
        [$($generics:ident : $bound:path),*] ($($argument:ident : $type:ty),*) $(-> $result:ty)?,
        $chosen:expr, $run:ident, $portable:ty, $sse2:ident $avx2:ident $avx512:ident
    ) => {{
        #[cfg(all(target_arch = "x86_64", test))]
        {
            let _wider = core::marker::PhantomData::<($avx2, $avx512)>;
            match $chosen.get() {
                Instructions::Baseline | Instructions::Avx2 | Instructions::Avx512 => {
                    $run::<$sse2, $($generics),*>($($argument),*)
                }
            }
        }
        #[cfg(all(target_arch = "x86_64", not(test)))]
        {
            #[target_feature(enable = "avx2")]
            fn avx2<$($generics: $bound),*>($($argument: $type),*) $(-> $result)? {
                $run::<$avx2, $($generics),*>($($argument),*)
            }
            #[target_feature(enable = "avx512f,avx512dq,avx512bw,avx512vl")]
            fn avx512<$($generics: $bound),*>($($argument: $type),*) $(-> $result)? {
                $run::<$avx512, $($generics),*>($($argument),*)
            }
            match $chosen.get() {
                Instructions::Baseline => $run::<$sse2, $($generics),*>($($argument),*),
                // SAFETY: `Chosen` is only made of what the processor has.
                Instructions::Avx2 => unsafe { avx2::<$($generics),*>($($argument),*) },
                // SAFETY: as above.
                Instructions::Avx512 => unsafe { avx512::<$($generics),*>($($argument),*) },
            }
        }
        #[cfg(not(target_arch = "x86_64"))]
        match $chosen.get() {
            Instructions::Baseline | Instructions::Avx2 | Instructions::Avx512 => {
                $run::<$portable, $($generics),*>($($argument),*)
            }
        }
    }};
}

/// The collision in f64.
fn collide_double<P: Physics>(chosen: Chosen, task: &Task<P, f64>, own: &mut Own<f64>) -> Outcome {
    compiled!(
        [P: Physics](task: &Task<P, f64>, own: &mut Own<f64>) -> Outcome,
        chosen, pass, super::registers::Double<2>, Sse2 Avx2 Avx512
    )
}

/// The collision in f32, stored in f32.
fn collide_single<P: Physics>(chosen: Chosen, task: &Task<P, f32>, own: &mut Own<f32>) -> Outcome {
    compiled!(
        [P: Physics](task: &Task<P, f32>, own: &mut Own<f32>) -> Outcome,
        chosen, pass, super::registers::Single<4>, Sse2Single Avx2Single Avx512Single
    )
}

/// The collision in f64, stored in f32.
fn collide_stored<P: Physics>(chosen: Chosen, task: &Task<P, f32>, own: &mut Own<f32>) -> Outcome {
    compiled!(
        [P: Physics](task: &Task<P, f32>, own: &mut Own<f32>) -> Outcome,
        chosen, pass, super::registers::Stored<2>, Sse2Stored Avx2Stored Avx512Stored
    )
}

/// The exchange of populations stored in f64.
fn exchange_double<P: Physics>(
    chosen: Chosen,
    streaming: &Streaming<P, f64>,
    near: &Near<f64>,
    list: &mut [InterfaceCell],
    entries: &mut Entries,
) {
    compiled!(
        [P: Physics](
            streaming: &Streaming<P, f64>,
            near: &Near<f64>,
            list: &mut [InterfaceCell],
            entries: &mut Entries
        ),
        chosen, stream_block, super::registers::Double<2>, Sse2 Avx2 Avx512
    );
}

/// The exchange of populations stored in f32; like all that is done with interface cells, in f64.
fn exchange_stored<P: Physics>(
    chosen: Chosen,
    streaming: &Streaming<P, f32>,
    near: &Near<f32>,
    list: &mut [InterfaceCell],
    entries: &mut Entries,
) {
    compiled!(
        [P: Physics](
            streaming: &Streaming<P, f32>,
            near: &Near<f32>,
            list: &mut [InterfaceCell],
            entries: &mut Entries
        ),
        chosen, stream_block, super::registers::Stored<2>, Sse2Stored Avx2Stored Avx512Stored
    );
}

/// Shares in blocks of populations in f64.
fn carry_double(chosen: Chosen, fill: &[&[f64]; 27], sources: &[Sources], packs: &[usize], to: &mut [f64]) {
    compiled!(
        [](fill: &[&[f64]; 27], sources: &[Sources], packs: &[usize], to: &mut [f64]),
        chosen, carry_packs, super::registers::Double<2>, Sse2 Avx2 Avx512
    );
}

/// Shares in blocks of populations in f32; like all that is done with interface cells, in f64.
fn carry_stored(chosen: Chosen, fill: &[&[f64]; 27], sources: &[Sources], packs: &[usize], to: &mut [f64]) {
    compiled!(
        [](fill: &[&[f64]; 27], sources: &[Sources], packs: &[usize], to: &mut [f64]),
        chosen, carry_packs, super::registers::Stored<2>, Sse2Stored Avx2Stored Avx512Stored
    );
}

impl<P: Physics> Passes<P, f64> {
    /// Everything in f64.
    pub(crate) const DOUBLE: Self =
        Self { collide: collide_double, exchange: exchange_double, carry: carry_double };
}

impl<P: Physics> Passes<P, f32> {
    /// Stored and collided in f32.
    pub(crate) const SINGLE: Self =
        Self { collide: collide_single, exchange: exchange_stored, carry: carry_stored };
    /// Stored in f32, collided in f64.
    pub(crate) const STORED: Self =
        Self { collide: collide_stored, exchange: exchange_stored, carry: carry_stored };
}

/// Wall corrections of cells side by side, see [`correct_group`]; in f64 whatever is stored.
pub(crate) fn walls<P: Physics>(chosen: Chosen, task: &WallTask<P>, columns: &mut Columns, alike: &Alike) {
    compiled!(
        [P: Physics](task: &WallTask<P>, columns: &mut Columns, alike: &Alike),
        chosen, correct_group, super::registers::Double<2>, Sse2 Avx2 Avx512
    );
}
