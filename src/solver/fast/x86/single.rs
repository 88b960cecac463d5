//! Registers that hold populations in f32: computed with in f32, or widened to f64.
//!
//! The operations are those of [`super::double`] at twice the lanes; what is written for f64 (powers, tables) goes
//! through two registers of f64.
//!
//! # Safety
//! As in [`super`]: an operation is only executed on a processor that has it. The intrinsics are the only reason
//! for `unsafe` in this file.

#![allow(unsafe_code, reason = "intrinsics")]

use std::arch::x86_64::*;
use std::ops::Neg;

use super::double::{self, Eight, Four, Two};
use crate::lane::OfTwo;
use crate::solver::fast::registers::Registers;

/// One register type of f32: its intrinsics, what a mask is, and its two halves in f64.
macro_rules! single {
    ($(#[$doc:meta])* $name:ident, $lanes:ident, $width:literal, $reg:ty, $mask:ty, $half:ident, $half_width:literal,
     $add:ident $sub:ident $mul:ident $div:ident $sqrt:ident $splat:ident $load:ident $store:ident $stream:ident
     $xor:ident $andnot:ident,
     [$m:ident $a:ident $b:ident] $less:expr, $less_equal:expr, $select:expr, $and:expr, $not:expr, $any:expr,
     $up:expr, $down:expr, $low:expr, $high:expr, $join:expr) => {
        register!(
            $(#[$doc])* $name, $lanes, $width of f32, $reg, $mask,
            $add $sub $mul $div $sqrt $splat $load $store $stream,
            [$m $a $b] $less, $less_equal, $select, $and, $not, $any, $up, $down,
            lane {
                #[inline(always)]
                fn abs(self) -> Self {
                    // SAFETY: see the head of the folder.
                    Self(unsafe { $andnot($splat(-0.0), self.0) })
                }
                #[inline(always)]
                fn scale_by_power_of_two(self, k: Self) -> Self {
                    let ([x, y], [k, l]) = (self.halves(), k.halves());
                    Self::join([x.scale_by_power_of_two(k), y.scale_by_power_of_two(l)])
                }
                #[inline(always)]
                fn exponent_mantissa(self) -> (Self, Self) {
                    let [x, y] = self.halves();
                    let (x, y) = (x.exponent_mantissa(), y.exponent_mantissa());
                    (Self::join([x.0, y.0]), Self::join([x.1, y.1]))
                }
                #[inline(always)]
                fn lookup<const K: usize>(self, table: &[[f64; K]]) -> [Self; K] {
                    let [x, y] = self.halves();
                    let (x, y) = (x.lookup(table), y.lookup(table));
                    let mut out = [self; K];
                    for k in 0..K {
                        out[k] = Self::join([x[k], y[k]]);
                    }
                    out
                }
                #[inline(always)]
                fn exp(self) -> Self {
                    self.by_halves(#[inline(always)] |x| x.exp())
                }
                #[inline(always)]
                fn exp_m1(self) -> Self {
                    self.by_halves(#[inline(always)] |x| x.exp_m1())
                }
                #[inline(always)]
                fn ln(self) -> Self {
                    self.by_halves(#[inline(always)] |x| x.ln())
                }
                #[inline(always)]
                fn in_double<F: OfTwo>(f: &F, a: Self, b: Self) -> Self {
                    let (mut a, b) = (a.halves(), b.halves());
                    // Not written out twice: it is long, and is compiled for every kind of register.
                    for k in 0..2 {
                        a[k] = f.at(a[k], b[k]);
                    }
                    Self::join(a)
                }
            }
            wide {
                #[inline(always)]
                fn load_wide(from: &[f64]) -> $name {
                    $name::join([$half::load(from), $half::load(&from[$half_width..])])
                }
                #[inline(always)]
                fn store_wide(pack: $name, to: &mut [f64]) {
                    let [low, high] = pack.halves();
                    low.store(to);
                    high.store(&mut to[$half_width..]);
                }
                #[inline(always)]
                fn add_wide(pack: $name, to: &mut [f64]) {
                    let [low, high] = pack.halves();
                    (low + $half::load(to)).store(to);
                    let to = &mut to[$half_width..];
                    (high + $half::load(to)).store(to);
                }
            }
        );

        impl Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                // SAFETY: see the head of the folder.
                Self(unsafe { $xor(self.0, $splat(-0.0)) })
            }
        }

        impl $name {
            /// Exact.
            #[inline(always)]
            fn halves(self) -> [$half; 2] {
                let $a = self.0;
                // SAFETY: see the head of the folder.
                unsafe { [$half($low), $half($high)] }
            }
            /// A function in f64, rounded.
            #[inline(always)]
            fn by_halves(self, f: impl Fn($half) -> $half) -> Self {
                let mut halves = self.halves();
                for half in &mut halves {
                    *half = f(*half);
                }
                Self::join(halves)
            }
            /// Rounds.
            #[inline(always)]
            fn join([low, high]: [$half; 2]) -> Self {
                let ($a, $b) = (low.0, high.0);
                // SAFETY: see the head of the folder.
                Self(unsafe { $join })
            }
        }
    };
}

single!(
    /// Four numbers: what every x86_64 has.
    FourSingles, Sse2Single, 4, __m128, __m128, Two, 2,
    _mm_add_ps _mm_sub_ps _mm_mul_ps _mm_div_ps _mm_sqrt_ps _mm_set1_ps _mm_loadu_ps _mm_storeu_ps _mm_stream_ps
    _mm_xor_ps _mm_andnot_ps,
    [m a b] _mm_cmplt_ps(a, b),
    _mm_cmple_ps(a, b),
    _mm_or_ps(_mm_and_ps(m, a), _mm_andnot_ps(m, b)),
    _mm_and_ps(a, b),
    _mm_xor_ps(m, _mm_castsi128_ps(_mm_set1_epi32(-1))),
    _mm_movemask_ps(m) != 0,
    _mm_shuffle_ps::<0b10_01_10_00>(_mm_shuffle_ps::<0b00_00_11_11>(a, b), b),
    _mm_shuffle_ps::<0b10_00_10_01>(a, _mm_shuffle_ps::<0b00_00_11_11>(a, b)),
    _mm_cvtps_pd(a),
    _mm_cvtps_pd(_mm_movehl_ps(a, a)),
    _mm_movelh_ps(_mm_cvtpd_ps(a), _mm_cvtpd_ps(b))
);

single!(
    /// Eight numbers.
    EightSingles, Avx2Single, 8, __m256, __m256, Four, 4,
    _mm256_add_ps _mm256_sub_ps _mm256_mul_ps _mm256_div_ps _mm256_sqrt_ps _mm256_set1_ps _mm256_loadu_ps
    _mm256_storeu_ps _mm256_stream_ps _mm256_xor_ps _mm256_andnot_ps,
    [m a b] _mm256_cmp_ps::<_CMP_LT_OQ>(a, b),
    _mm256_cmp_ps::<_CMP_LE_OQ>(a, b),
    _mm256_blendv_ps(b, a, m),
    _mm256_and_ps(a, b),
    _mm256_xor_ps(m, _mm256_castsi256_ps(_mm256_set1_epi32(-1))),
    _mm256_movemask_ps(m) != 0,
    shift_eight::<12>(b, _mm256_permute2f128_ps::<0x21>(a, b)),
    shift_eight::<4>(_mm256_permute2f128_ps::<0x21>(a, b), a),
    _mm256_cvtps_pd(_mm256_castps256_ps128(a)),
    _mm256_cvtps_pd(_mm256_extractf128_ps::<1>(a)),
    _mm256_set_m128(_mm256_cvtpd_ps(b), _mm256_cvtpd_ps(a))
);

/// In both halves: `high` behind `low`, from byte `N` on.
///
/// # Safety
/// The processor has AVX2.
#[inline(always)]
unsafe fn shift_eight<const N: i32>(high: __m256, low: __m256) -> __m256 {
    // SAFETY: of the caller.
    unsafe {
        let (high, low) = (_mm256_castps_si256(high), _mm256_castps_si256(low));
        _mm256_castsi256_ps(_mm256_alignr_epi8::<N>(high, low))
    }
}

single!(
    /// Sixteen numbers.
    SixteenSingles, Avx512Single, 16, __m512, u16, Eight, 8,
    _mm512_add_ps _mm512_sub_ps _mm512_mul_ps _mm512_div_ps _mm512_sqrt_ps _mm512_set1_ps _mm512_loadu_ps
    _mm512_storeu_ps _mm512_stream_ps _mm512_xor_ps _mm512_andnot_ps,
    [m a b] _mm512_cmp_ps_mask::<_CMP_LT_OQ>(a, b),
    _mm512_cmp_ps_mask::<_CMP_LE_OQ>(a, b),
    _mm512_mask_blend_ps(m, b, a),
    a & b,
    !m,
    m != 0,
    _mm512_castsi512_ps(_mm512_alignr_epi32::<15>(_mm512_castps_si512(b), _mm512_castps_si512(a))),
    _mm512_castsi512_ps(_mm512_alignr_epi32::<1>(_mm512_castps_si512(b), _mm512_castps_si512(a))),
    _mm512_cvtps_pd(_mm512_castps512_ps256(a)),
    _mm512_cvtps_pd(_mm512_extractf32x8_ps::<1>(a)),
    _mm512_insertf32x8::<1>(_mm512_castps256_ps512(_mm512_cvtpd_ps(a)), _mm512_cvtpd_ps(b))
);

/// Registers of f64 for populations stored in f32.
macro_rules! stored {
    ($(#[$doc:meta])* $lanes:ident, $double:ident, $pack:ident, $width:literal, [$p:ident $to:ident] $load:expr, $store:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub(in crate::solver::fast) struct $lanes;

        impl Registers for $lanes {
            type Element = f32;
            type Pack = $pack;
            const WIDTH: usize = $width;

            #[inline(always)]
            fn load(from: &[f32]) -> $pack {
                let $p = from[..$width].as_ptr();
                // SAFETY: the slice holds as many numbers as the register; see the head of the folder.
                $pack(unsafe { $load })
            }
            #[inline(always)]
            fn store(pack: $pack, to: &mut [f32]) {
                let $p = pack.0;
                let $to = to[..$width].as_mut_ptr();
                // SAFETY: as above.
                unsafe { $store };
            }
            #[inline(always)]
            fn load_wide(from: &[f64]) -> $pack {
                $pack::load(from)
            }
            #[inline(always)]
            fn store_wide(pack: $pack, to: &mut [f64]) {
                pack.store(to);
            }
            #[inline(always)]
            fn shifted_up(before: $pack, pack: $pack) -> $pack {
                double::$double::shifted_up(before, pack)
            }
            #[inline(always)]
            fn shifted_down(pack: $pack, behind: $pack) -> $pack {
                double::$double::shifted_down(pack, behind)
            }
        }
    };
}

stored!(
    /// Two numbers.
    Sse2Stored, Sse2, Two, 2,
    [p to] _mm_cvtps_pd(_mm_castsi128_ps(_mm_loadl_epi64(p.cast()))),
    _mm_storel_epi64(to.cast(), _mm_castps_si128(_mm_cvtpd_ps(p)))
);

stored!(
    /// Four numbers.
    Avx2Stored, Avx2, Four, 4,
    [p to] _mm256_cvtps_pd(_mm_loadu_ps(p)),
    _mm_storeu_ps(to, _mm256_cvtpd_ps(p))
);

stored!(
    /// Eight numbers.
    Avx512Stored, Avx512, Eight, 8,
    [p to] _mm512_cvtps_pd(_mm256_loadu_ps(p)),
    _mm256_storeu_ps(to, _mm512_cvtpd_ps(p))
);
