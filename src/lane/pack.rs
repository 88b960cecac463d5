//! Portable packs: `N` numbers side by side, each treated exactly as one alone.

use std::array::from_fn;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Lane, OfTwo, powers};

macro_rules! lanewise {
    ($name:ident, $trait:ident, $method:ident) => {
        impl<const N: usize> $trait for $name<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(from_fn(|i| self.0[i].$method(other.0[i])))
            }
        }
    };
}

/// A pack of numbers; in braces, how it takes what is written for `f64`.
macro_rules! pack {
    ($(#[$doc:meta])* $name:ident of $number:ident { $($wide:tt)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name<const N: usize>(pub [$number; N]);

        lanewise!($name, Add, add);
        lanewise!($name, Sub, sub);
        lanewise!($name, Mul, mul);
        lanewise!($name, Div, div);

        impl<const N: usize> Neg for $name<N> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(from_fn(|i| -self.0[i]))
            }
        }

        impl<const N: usize> Lane for $name<N> {
            type Mask = [bool; N];

            #[inline(always)]
            fn splat(x: f64) -> Self {
                Self([x as $number; N])
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(self.0.map($number::sqrt))
            }
            #[inline(always)]
            fn abs(self) -> Self {
                Self(self.0.map($number::abs))
            }
            #[inline(always)]
            fn scale_by_power_of_two(self, k: Self) -> Self {
                Self(from_fn(|i| self.0[i].scale_by_power_of_two(k.0[i])))
            }
            #[inline(always)]
            fn exponent_mantissa(self) -> (Self, Self) {
                let both = self.0.map($number::exponent_mantissa);
                (Self(both.map(|x| x.0)), Self(both.map(|x| x.1)))
            }
            #[inline(always)]
            fn lookup<const K: usize>(self, table: &[[f64; K]]) -> [Self; K] {
                let rows = self.0.map(|x| x.lookup(table));
                from_fn(|column| Self(from_fn(|i| rows[i][column])))
            }
            #[inline(always)]
            fn exp_m1(self) -> Self {
                Self(self.0.map(Lane::exp_m1))
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
            $($wide)*
        }
    };
}

pack!(
    /// `N` independent numbers.
    Pack of f64 {
        #[inline(always)]
        fn exp(self) -> Self {
            powers::exp(self)
        }
        #[inline(always)]
        fn ln(self) -> Self {
            powers::ln(self)
        }
    }
);

pack!(
    /// `N` independent numbers in `f32`.
    Singles of f32 {
        #[inline(always)]
        fn exp(self) -> Self {
            Self(self.0.map(Lane::exp))
        }
        #[inline(always)]
        fn ln(self) -> Self {
            Self(self.0.map(Lane::ln))
        }
        #[inline(always)]
        fn in_double<F: OfTwo>(f: &F, a: Self, b: Self) -> Self {
            let wide = f.at(Pack(a.0.map(f64::from)), Pack(b.0.map(f64::from)));
            Self(wide.0.map(|x| x as f32))
        }
    }
);
