//! Numbers in single precision as lanes: half the bytes of `f64`, 24 bits of mantissa.
//!
//! Sums, products, quotients and roots round to `f32`; whatever takes powers of two or tables is written
//! for `f64` and is computed there, then rounded once more.

use super::{Lane, OfTwo};

impl Lane for f32 {
    type Mask = bool;

    #[inline(always)]
    fn splat(x: f64) -> Self {
        x as Self
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self::abs(self)
    }
    #[inline(always)]
    fn scale_by_power_of_two(self, k: Self) -> Self {
        f64::from(self).scale_by_power_of_two(f64::from(k)) as Self
    }
    #[inline(always)]
    fn exponent_mantissa(self) -> (Self, Self) {
        let (exponent, mantissa) = f64::from(self).exponent_mantissa();
        (exponent as Self, mantissa as Self)
    }
    #[inline(always)]
    fn lookup<const K: usize>(self, table: &[[f64; K]]) -> [Self; K] {
        let row = f64::from(self).lookup(table);
        let mut out = [0.0; K];
        for k in 0..K {
            out[k] = row[k] as Self;
        }
        out
    }
    #[inline(always)]
    fn exp(self) -> Self {
        Lane::exp(f64::from(self)) as Self
    }
    #[inline(always)]
    fn exp_m1(self) -> Self {
        Lane::exp_m1(f64::from(self)) as Self
    }
    #[inline(always)]
    fn ln(self) -> Self {
        Lane::ln(f64::from(self)) as Self
    }
    #[inline(always)]
    fn in_double<F: OfTwo>(f: &F, a: Self, b: Self) -> Self {
        f.at(f64::from(a), f64::from(b)) as Self
    }
    #[inline(always)]
    fn less(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn less_equal(self, other: Self) -> bool {
        self <= other
    }
    #[inline(always)]
    fn select(mask: bool, then: Self, otherwise: Self) -> Self {
        if mask { then } else { otherwise }
    }
    #[inline(always)]
    fn and(a: bool, b: bool) -> bool {
        a && b
    }
    #[inline(always)]
    fn not(a: bool) -> bool {
        !a
    }
    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }
}
