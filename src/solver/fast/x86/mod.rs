//! Registers of x86_64 as lanes.
//!
//! With arrays instead ([`crate::lane::Pack`]) the compiler has to find the vectors again: it takes five times
//! as long to build and the code is up to four times slower. The intrinsics are the only reason for
//! `unsafe` in this folder.
//!
//! # Safety
//! An operation of a register type may only be executed on a processor that has its instruction set. The
//! types are private to the fast backend, which uses them only inside functions that are entered through
//! [`super::instructions`], after the processor has been asked.

#![allow(unsafe_code, reason = "intrinsics")]

/// An operator of a register type.
macro_rules! operator {
    ($name:ident, $trait:ident, $method:ident, $intrinsic:ident) => {
        impl std::ops::$trait for $name {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: see the head of the folder.
                Self(unsafe { $intrinsic(self.0, other.0) })
            }
        }
    };
}

/// One register type, whatever it holds: its intrinsics, and what a mask is.
///
/// `lane`: what [`Lane`](crate::lane::Lane) asks for besides, on the bits of numbers. `wide`: what
/// [`Registers`](super::registers::Registers) asks for besides, from and to `f64`.
macro_rules! register {
    ($(#[$doc:meta])* $name:ident, $lanes:ident, $width:literal of $element:ty, $reg:ty, $mask:ty,
     $add:ident $sub:ident $mul:ident $div:ident $sqrt:ident $splat:ident $load:ident $store:ident $stream:ident,
     [$m:ident $a:ident $b:ident] $less:expr, $less_equal:expr, $select:expr, $and:expr, $not:expr, $any:expr,
     $up:expr, $down:expr,
     lane { $($lane:tt)* } wide { $($wide:tt)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub(in crate::solver::fast) struct $name(pub(super) $reg);

        operator!($name, Add, add, $add);
        operator!($name, Sub, sub, $sub);
        operator!($name, Mul, mul, $mul);
        operator!($name, Div, div, $div);

        impl crate::lane::Lane for $name {
            type Mask = $mask;

            #[inline(always)]
            fn splat(x: f64) -> Self {
                // SAFETY: see the head of the folder; so in the whole block.
                Self(unsafe { $splat(x as $element) })
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                // SAFETY: see the head of the folder.
                Self(unsafe { $sqrt(self.0) })
            }
            #[inline(always)]
            fn less(self, other: Self) -> $mask {
                let ($a, $b) = (self.0, other.0);
                // SAFETY: see the head of the folder.
                unsafe { $less }
            }
            #[inline(always)]
            fn less_equal(self, other: Self) -> $mask {
                let ($a, $b) = (self.0, other.0);
                // SAFETY: see the head of the folder.
                unsafe { $less_equal }
            }
            #[inline(always)]
            fn select(mask: $mask, then: Self, otherwise: Self) -> Self {
                let ($m, $a, $b) = (mask, then.0, otherwise.0);
                // SAFETY: see the head of the folder.
                Self(unsafe { $select })
            }
            #[inline(always)]
            fn and($a: $mask, $b: $mask) -> $mask {
                // Masks of 512-bit registers are plain numbers.
                #[allow(unused_unsafe)]
                // SAFETY: see the head of the folder.
                unsafe {
                    $and
                }
            }
            #[inline(always)]
            fn not($m: $mask) -> $mask {
                #[allow(unused_unsafe)]
                // SAFETY: see the head of the folder.
                unsafe {
                    $not
                }
            }
            #[inline(always)]
            fn any($m: $mask) -> bool {
                #[allow(unused_unsafe)]
                // SAFETY: see the head of the folder.
                unsafe {
                    $any
                }
            }
            $($lane)*
        }

        /// These registers, populations stored in the precision they are computed with.
        #[derive(Clone, Copy, Debug)]
        pub(in crate::solver::fast) struct $lanes;

        impl crate::solver::fast::registers::Registers for $lanes {
            type Element = $element;
            type Pack = $name;
            const WIDTH: usize = $width;

            #[inline(always)]
            fn load(from: &[$element]) -> $name {
                let from = &from[..$width];
                // SAFETY: the slice holds as many numbers as the register; see the head of the folder.
                $name(unsafe { $load(from.as_ptr()) })
            }
            #[inline(always)]
            fn store(pack: $name, to: &mut [$element]) {
                let to = &mut to[..$width];
                // SAFETY: as above.
                unsafe { $store(to.as_mut_ptr(), pack.0) };
            }
            #[inline(always)]
            fn store_past_cache(pack: $name, to: &mut [$element]) {
                let to = &mut to[..$width];
                if to.as_ptr().addr() % size_of::<$name>() == 0 {
                    // SAFETY: as above, and the place is aligned to the register.
                    unsafe { $stream(to.as_mut_ptr(), pack.0) };
                } else {
                    Self::store(pack, to);
                }
            }
            #[inline(always)]
            fn shifted_up(before: $name, pack: $name) -> $name {
                let ($a, $b) = (before.0, pack.0);
                // SAFETY: see the head of the folder.
                $name(unsafe { $up })
            }
            #[inline(always)]
            fn shifted_down(pack: $name, behind: $name) -> $name {
                let ($a, $b) = (pack.0, behind.0);
                // SAFETY: see the head of the folder.
                $name(unsafe { $down })
            }
            $($wide)*
        }
    };
}

mod double;
mod single;

pub(super) use double::{Avx2, Avx512, Sse2};
pub(super) use single::{Avx2Single, Avx2Stored, Avx512Single, Avx512Stored, Sse2Single, Sse2Stored};
