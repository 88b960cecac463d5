//! The only numeric abstraction: a number, or a pack of numbers that behaves like independent numbers.
//!
//! # Exactness
//! A lane offers + − × ÷, √, |x|, comparison and selection, and exp, expm1 and ln from `libm`. No fused
//! multiply-add, no reciprocal estimate, no hardware minimum or maximum (ties of signed zeros), and
//! no lane reads another lane. An expression written once over [`Lane`] therefore gives the same
//! bits for `f64` and for each entry of a [`Pack`].

mod dual;
mod pack;
pub mod streaming;

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

pub use dual::Dual;
pub use pack::Pack;

/// A number (`f64`), a pack of numbers ([`Pack`]) or a number with its derivative ([`Dual`]).
pub trait Lane:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Result of a comparison, one truth value per lane.
    type Mask: Copy;

    /// The same number in every lane.
    fn splat(x: f64) -> Self;
    /// Square root, correctly rounded.
    fn sqrt(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// e^x, from `libm`.
    fn exp(self) -> Self;
    /// e^x − 1, from `libm`: accurate for small x.
    fn exp_m1(self) -> Self;
    /// Natural logarithm, from `libm`.
    fn ln(self) -> Self;
    /// `self < other`, false where either is NaN.
    fn less(self, other: Self) -> Self::Mask;
    /// `self <= other`, false where either is NaN.
    fn less_equal(self, other: Self) -> Self::Mask;
    /// `then` where the mask is true, `otherwise` elsewhere; both sides are always evaluated.
    fn select(mask: Self::Mask, then: Self, otherwise: Self) -> Self;
    /// True in both.
    fn and(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Negation.
    fn not(a: Self::Mask) -> Self::Mask;
    /// Whether the mask is true in at least one lane. Only for leaving loops whose remaining rounds
    /// would change no lane.
    fn any(mask: Self::Mask) -> bool;

    /// The smaller one, `b` in a tie; by comparison, so that signed zeros are the same everywhere.
    fn smaller(a: Self, b: Self) -> Self {
        Self::select(a.less(b), a, b)
    }
    /// The larger one, `b` in a tie.
    fn larger(a: Self, b: Self) -> Self {
        Self::select(b.less(a), a, b)
    }
    /// Zero in every lane.
    fn zero() -> Self {
        Self::splat(0.0)
    }
    /// One in every lane.
    fn one() -> Self {
        Self::splat(1.0)
    }
}

impl Lane for f64 {
    type Mask = bool;

    #[inline(always)]
    fn splat(x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }
    #[inline(always)]
    fn exp(self) -> Self {
        libm::exp(self)
    }
    #[inline(always)]
    fn exp_m1(self) -> Self {
        libm::expm1(self)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        libm::log(self)
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
