//! Numbers in single precision as lanes: half the bytes of `f64`, 24 bits of mantissa.
//!
//! + − × ÷ and √ round to `f32`; whatever takes powers of two or tables is written for `f64` and is
//! computed there, then rounded once more.

use std::array::from_fn;
use std::ops::{Add, Div, Mul, Neg, Sub};

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

/// `N` independent numbers in `f32`, each treated exactly as one alone: the portable pack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Singles<const N: usize>(pub [f32; N]);

macro_rules! lanewise {
    ($trait:ident, $method:ident) => {
        impl<const N: usize> $trait for Singles<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(from_fn(|i| self.0[i].$method(other.0[i])))
            }
        }
    };
}

lanewise!(Add, add);
lanewise!(Sub, sub);
lanewise!(Mul, mul);
lanewise!(Div, div);

impl<const N: usize> Neg for Singles<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(f32::neg))
    }
}

impl<const N: usize> Lane for Singles<N> {
    type Mask = [bool; N];

    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self([x as f32; N])
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(f32::sqrt))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.map(f32::abs))
    }
    #[inline(always)]
    fn scale_by_power_of_two(self, k: Self) -> Self {
        Self(from_fn(|i| self.0[i].scale_by_power_of_two(k.0[i])))
    }
    #[inline(always)]
    fn exponent_mantissa(self) -> (Self, Self) {
        let both = self.0.map(f32::exponent_mantissa);
        (Self(both.map(|x| x.0)), Self(both.map(|x| x.1)))
    }
    #[inline(always)]
    fn lookup<const K: usize>(self, table: &[[f64; K]]) -> [Self; K] {
        let rows = self.0.map(|x| x.lookup(table));
        from_fn(|column| Self(from_fn(|i| rows[i][column])))
    }
    #[inline(always)]
    fn exp(self) -> Self {
        Self(self.0.map(Lane::exp))
    }
    #[inline(always)]
    fn exp_m1(self) -> Self {
        Self(self.0.map(Lane::exp_m1))
    }
    #[inline(always)]
    fn ln(self) -> Self {
        Self(self.0.map(Lane::ln))
    }
    #[inline(always)]
    fn in_double<F: OfTwo>(f: &F, a: Self, b: Self) -> Self {
        let wide = f.at(super::Pack(a.0.map(f64::from)), super::Pack(b.0.map(f64::from)));
        Self(wide.0.map(|x| x as f32))
    }
    #[inline(always)]
    fn less(self, other: Self) -> Self::Mask {
        from_fn(|i| self.0[i] < other.0[i])
    }
    #[inline(always)]
    fn less_equal(self, other: Self) -> Self::Mask {
        from_fn(|i| self.0[i] <= other.0[i])
    }
    #[inline(always)]
    fn select(mask: Self::Mask, then: Self, otherwise: Self) -> Self {
        Self(from_fn(|i| if mask[i] { then.0[i] } else { otherwise.0[i] }))
    }
    #[inline(always)]
    fn and(a: Self::Mask, b: Self::Mask) -> Self::Mask {
        from_fn(|i| a[i] && b[i])
    }
    #[inline(always)]
    fn not(a: Self::Mask) -> Self::Mask {
        a.map(|x| !x)
    }
    #[inline(always)]
    fn any(mask: Self::Mask) -> bool {
        mask.iter().any(|&x| x)
    }
}
