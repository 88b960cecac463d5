//! Instruction sets: the same pass compiled for each, chosen when a run starts.

use super::kernel::{Outcome, Own, Task, pass};
#[cfg(target_arch = "x86_64")]
use super::{
    x86::{Avx2, Avx512, Sse2},
    x86_single::{Avx2Single, Avx2Stored, Avx512Single, Avx512Stored, Sse2Single, Sse2Stored},
};
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

/// A pass over one block.
pub type Pass<P, E> = fn(Chosen, &Task<P, E>, &mut Own<E>) -> Outcome;

/// A pass compiled for every instruction set: portable registers, then those of x86_64.
macro_rules! passes {
    ($(#[$doc:meta])* $name:ident, $element:ty, $portable:ty, $sse2:ident $avx2:ident $avx512:ident) => {
        $(#[$doc])*
        pub fn $name<P: Physics>(
            chosen: Chosen,
            task: &Task<P, $element>,
            own: &mut Own<$element>,
        ) -> Outcome {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx2")]
                fn avx2<P: Physics>(task: &Task<P, $element>, own: &mut Own<$element>) -> Outcome {
                    pass::<$avx2, P>(task, own)
                }
                #[target_feature(enable = "avx512f,avx512dq,avx512bw,avx512vl")]
                fn avx512<P: Physics>(task: &Task<P, $element>, own: &mut Own<$element>) -> Outcome {
                    pass::<$avx512, P>(task, own)
                }
                match chosen.get() {
                    Instructions::Baseline => pass::<$sse2, P>(task, own),
                    // SAFETY: `Chosen` is only made of what the processor has.
                    Instructions::Avx2 => unsafe { avx2(task, own) },
                    // SAFETY: as above.
                    Instructions::Avx512 => unsafe { avx512(task, own) },
                }
            }
            #[cfg(not(target_arch = "x86_64"))]
            match chosen.get() {
                Instructions::Baseline | Instructions::Avx2 | Instructions::Avx512 => {
                    pass::<$portable, P>(task, own)
                }
            }
        }
    };
}

passes!(
    /// In f64.
    double, f64, super::registers::Double<2>, Sse2 Avx2 Avx512
);

passes!(
    /// In f32, stored in f32.
    single, f32, super::registers::Single<4>, Sse2Single Avx2Single Avx512Single
);

passes!(
    /// In f64, stored in f32.
    single_storage, f32, super::registers::Stored<2>, Sse2Stored Avx2Stored Avx512Stored
);
