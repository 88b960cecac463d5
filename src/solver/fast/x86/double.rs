//! Registers that hold populations in f64.
//!
//! # Safety
//! As in [`super`]: an operation is only executed on a processor that has it. The intrinsics are the only reason
//! for `unsafe` in this file.

#![allow(unsafe_code, reason = "intrinsics")]

use std::arch::x86_64::*;
use std::ops::Neg;

use crate::lane::{Lane, powers};
use crate::solver::fast::registers::Registers;

/// One register type of f64: its intrinsics, those on its bits, and what a mask is.
macro_rules! double {
    ($(#[$doc:meta])* $name:ident, $lanes:ident, $width:literal, $reg:ty, $mask:ty,
     $add:ident $sub:ident $mul:ident $div:ident $sqrt:ident $splat:ident $load:ident $store:ident $stream:ident,
     $to_int:ident $to_real:ident $splat_int:ident $add_int:ident $and_int:ident $or_int:ident $xor_int:ident
     $left:ident $right:ident,
     [$m:ident $a:ident $b:ident] $less:expr, $less_equal:expr, $select:expr, $and:expr, $not:expr, $any:expr,
     $up:expr, $down:expr) => {
        register!(
            $(#[$doc])* $name, $lanes, $width of f64, $reg, $mask,
            $add $sub $mul $div $sqrt $splat $load $store $stream,
            [$m $a $b] $less, $less_equal, $select, $and, $not, $any, $up, $down,
            lane {
                #[inline(always)]
                fn abs(self) -> Self {
                    // SAFETY: see the head of the folder.
                    Self(unsafe { $to_real($and_int($to_int(self.0), $splat_int(i64::MAX))) })
                }
                #[inline(always)]
                fn scale_by_power_of_two(self, k: Self) -> Self {
                    let k = Self::larger(Self::smaller(k, Self::splat(2044.0)), Self::splat(-2044.0));
                    let first = powers::nearest(Self::splat(0.5) * k);
                    (self * Self::power_of_two(first)) * Self::power_of_two(k - first)
                }
                #[inline(always)]
                fn exponent_mantissa(self) -> (Self, Self) {
                    const TWO_52: f64 = 4_503_599_627_370_496.0;
                    // SAFETY: see the head of the folder.
                    let (field, mantissa) = unsafe {
                        let bits = $to_int(self.0);
                        let high = $or_int($right::<52>(bits), $splat_int(TWO_52.to_bits() as i64));
                        let low = $and_int(bits, $splat_int((1 << 52) - 1));
                        ($to_real(high), $to_real($or_int(low, $splat_int(1.0_f64.to_bits() as i64))))
                    };
                    (Self(field) - Self::splat(TWO_52 + 1023.0), Self(mantissa))
                }
                #[inline(always)]
                fn lookup<const K: usize>(self, table: &[[f64; K]]) -> [Self; K] {
                    let mut columns = [[0.0; $width]; K];
                    let at = self.to_array();
                    for lane in 0..$width {
                        let row = at[lane].lookup(table);
                        for k in 0..K {
                            columns[k][lane] = row[k];
                        }
                    }
                    let mut out = [self; K];
                    for k in 0..K {
                        out[k] = Self::from_array(columns[k]);
                    }
                    out
                }
                #[inline(always)]
                fn exp(self) -> Self {
                    powers::exp(self)
                }
                #[inline(always)]
                fn exp_m1(self) -> Self {
                    let mut x = self.to_array();
                    for lane in &mut x {
                        *lane = libm::expm1(*lane);
                    }
                    Self::from_array(x)
                }
                #[inline(always)]
                fn ln(self) -> Self {
                    powers::ln(self)
                }
            }
            wide {
                #[inline(always)]
                fn load_wide(from: &[f64]) -> $name {
                    Self::load(from)
                }
                #[inline(always)]
                fn store_wide(pack: $name, to: &mut [f64]) {
                    Self::store(pack, to);
                }
            }
        );

        impl Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                // SAFETY: see the head of the folder.
                Self(unsafe { $to_real($xor_int($to_int(self.0), $splat_int(i64::MIN))) })
            }
        }

        impl $name {
            /// First numbers of a slice.
            #[inline(always)]
            pub(in crate::solver::fast) fn load(from: &[f64]) -> Self {
                <$lanes as Registers>::load(from)
            }
            /// Into the first numbers of a slice.
            #[inline(always)]
            pub(in crate::solver::fast) fn store(self, to: &mut [f64]) {
                <$lanes as Registers>::store(self, to);
            }
            #[inline(always)]
            fn from_array(x: [f64; $width]) -> Self {
                // SAFETY: the array holds as many numbers as the register; see the head of the folder.
                Self(unsafe { $load(x.as_ptr()) })
            }
            #[inline(always)]
            fn to_array(self) -> [f64; $width] {
                let mut x = [0.0; $width];
                // SAFETY: as above.
                unsafe { $store(x.as_mut_ptr(), self.0) };
                x
            }
            /// 2ᵏ for an integral k in \[−1022, 1023\], as for `f64`.
            #[inline(always)]
            fn power_of_two(k: Self) -> Self {
                let shifted = k + Self::splat(powers::ROUNDER);
                let one = 1.0_f64.to_bits() as i64;
                // SAFETY: see the head of the folder.
                Self(unsafe { $to_real($add_int($left::<52>($to_int(shifted.0)), $splat_int(one))) })
            }
        }
    };
}

double!(
    /// Two numbers: what every x86_64 has.
    Two, Sse2, 2, __m128d, __m128d,
    _mm_add_pd _mm_sub_pd _mm_mul_pd _mm_div_pd _mm_sqrt_pd _mm_set1_pd _mm_loadu_pd _mm_storeu_pd _mm_stream_pd,
    _mm_castpd_si128 _mm_castsi128_pd _mm_set1_epi64x _mm_add_epi64 _mm_and_si128 _mm_or_si128 _mm_xor_si128
    _mm_slli_epi64 _mm_srli_epi64,
    [m a b] _mm_cmplt_pd(a, b),
    _mm_cmple_pd(a, b),
    _mm_or_pd(_mm_and_pd(m, a), _mm_andnot_pd(m, b)),
    _mm_and_pd(a, b),
    _mm_xor_pd(m, _mm_castsi128_pd(_mm_set1_epi64x(-1))),
    _mm_movemask_pd(m) != 0,
    _mm_shuffle_pd::<0b01>(a, b),
    _mm_shuffle_pd::<0b01>(a, b)
);

double!(
    /// Four numbers.
    Four, Avx2, 4, __m256d, __m256d,
    _mm256_add_pd _mm256_sub_pd _mm256_mul_pd _mm256_div_pd _mm256_sqrt_pd _mm256_set1_pd _mm256_loadu_pd
    _mm256_storeu_pd _mm256_stream_pd,
    _mm256_castpd_si256 _mm256_castsi256_pd _mm256_set1_epi64x _mm256_add_epi64 _mm256_and_si256 _mm256_or_si256
    _mm256_xor_si256 _mm256_slli_epi64 _mm256_srli_epi64,
    [m a b] _mm256_cmp_pd::<_CMP_LT_OQ>(a, b),
    _mm256_cmp_pd::<_CMP_LE_OQ>(a, b),
    _mm256_blendv_pd(b, a, m),
    _mm256_and_pd(a, b),
    _mm256_xor_pd(m, _mm256_castsi256_pd(_mm256_set1_epi64x(-1))),
    _mm256_movemask_pd(m) != 0,
    _mm256_shuffle_pd::<0b0101>(_mm256_permute2f128_pd::<0x21>(a, b), b),
    _mm256_shuffle_pd::<0b0101>(a, _mm256_permute2f128_pd::<0x21>(a, b))
);

double!(
    /// Eight numbers.
    Eight, Avx512, 8, __m512d, u8,
    _mm512_add_pd _mm512_sub_pd _mm512_mul_pd _mm512_div_pd _mm512_sqrt_pd _mm512_set1_pd _mm512_loadu_pd
    _mm512_storeu_pd _mm512_stream_pd,
    _mm512_castpd_si512 _mm512_castsi512_pd _mm512_set1_epi64 _mm512_add_epi64 _mm512_and_si512 _mm512_or_si512
    _mm512_xor_si512 _mm512_slli_epi64 _mm512_srli_epi64
   ,
    [m a b] _mm512_cmp_pd_mask::<_CMP_LT_OQ>(a, b),
    _mm512_cmp_pd_mask::<_CMP_LE_OQ>(a, b),
    _mm512_mask_blend_pd(m, b, a),
    a & b,
    !m,
    m != 0,
    _mm512_castsi512_pd(_mm512_alignr_epi64::<7>(_mm512_castpd_si512(b), _mm512_castpd_si512(a))),
    _mm512_castsi512_pd(_mm512_alignr_epi64::<1>(_mm512_castpd_si512(b), _mm512_castpd_si512(a)))
);
