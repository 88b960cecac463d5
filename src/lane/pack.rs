//! A portable pack: `N` numbers side by side, each treated exactly as `f64` is.

use std::array::from_fn;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Lane, powers};

/// `N` independent numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pack<const N: usize>(pub [f64; N]);

macro_rules! lanewise {
    ($trait:ident, $method:ident) => {
        impl<const N: usize> $trait for Pack<N> {
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

impl<const N: usize> Neg for Pack<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(from_fn(|i| -self.0[i]))
    }
}

impl<const N: usize> Lane for Pack<N> {
    type Mask = [bool; N];

    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self([x; N])
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.map(f64::abs))
    }
    #[inline(always)]
    fn scale_by_power_of_two(self, k: Self) -> Self {
        Self(from_fn(|i| self.0[i].scale_by_power_of_two(k.0[i])))
    }
    #[inline(always)]
    fn exponent_mantissa(self) -> (Self, Self) {
        let both = self.0.map(f64::exponent_mantissa);
        (Self(both.map(|x| x.0)), Self(both.map(|x| x.1)))
    }
    #[inline(always)]
    fn lookup<const K: usize>(self, table: &[[f64; K]]) -> [Self; K] {
        let rows = self.0.map(|x| x.lookup(table));
        from_fn(|column| Self(from_fn(|i| rows[i][column])))
    }
    #[inline(always)]
    fn exp(self) -> Self {
        powers::exp(self)
    }
    #[inline(always)]
    fn exp_m1(self) -> Self {
        Self(self.0.map(libm::expm1))
    }
    #[inline(always)]
    fn ln(self) -> Self {
        powers::ln(self)
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
