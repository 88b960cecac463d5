//! The only numeric abstraction: a number, or a pack of numbers that behaves like independent numbers.
//!
//! # Exactness
//! A lane offers + − × ÷, √, |x|, comparison and selection, three primitives on the bits of a number
//! (exponent, power of two, row of a table), exp and ln built from these (see [`powers`]), and expm1
//! from `libm`. No fused multiply-add, no reciprocal estimate, no hardware minimum or maximum (ties of signed zeros), and
//! no lane reads another lane. An expression written once over [`Lane`] therefore gives the same
//! bits for `f64` and for each entry of a [`Pack`]; likewise, with the roundings of single precision, for
//! `f32` and each entry of [`Singles`].

mod dual;
mod pack;
pub mod powers;
mod single;
pub(crate) mod streaming;

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

pub use dual::Dual;
pub use pack::{Pack, Singles};

/// A function of two numbers over any lane.
pub trait OfTwo {
    /// Its value.
    fn at<L: Lane>(&self, a: L, b: L) -> L;
}

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
    /// self · 2ᵏ for an integral k, limited to \[−2044, 2044\]; rounded once, where the result is
    /// subnormal; infinite where it is too large. A k that is not integral gives an unspecified number.
    fn scale_by_power_of_two(self, k: Self) -> Self;
    /// (e, m) with x = m 2ᵉ and m in \[1, 2), for positive normal x. From zero, subnormal, infinite,
    /// negative and NaN arguments the bit fields are returned as they are: finite numbers without
    /// meaning, the same in every kind of lane.
    fn exponent_mantissa(self) -> (Self, Self);
    /// Row number trunc(x) of the table, lane by lane: below zero and for NaN the first row, beyond the
    /// end the last. An empty table gives NaN.
    fn lookup<const K: usize>(self, table: &[[f64; K]]) -> [Self; K];
    /// e^x, see [`powers::exp`].
    fn exp(self) -> Self;
    /// e^x − 1, from `libm`: accurate for small x.
    fn exp_m1(self) -> Self;
    /// Natural logarithm, see [`powers::ln`].
    fn ln(self) -> Self;
    /// `f(a, b)`, computed in `f64` where lanes are shorter and then rounded: for what needs more digits or a
    /// wider range on the way than in its result.
    #[inline(always)]
    fn in_double<F: OfTwo>(f: &F, a: Self, b: Self) -> Self {
        f.at(a, b)
    }
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

/// 2⁵²: in \[2⁵², 2⁵³) the low bits of a number are an integer.
const TWO_52: f64 = 4_503_599_627_370_496.0;

/// The mantissa field.
const MANTISSA: u64 = (1 << 52) - 1;

/// 2ᵏ for an integral k in \[−1022, 1023\]: k + bias put into the exponent field.
#[inline(always)]
fn power_of_two(k: f64) -> f64 {
    f64::from_bits(((k + powers::ROUNDER).to_bits() << 52).wrapping_add(1.0_f64.to_bits()))
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
    fn scale_by_power_of_two(self, k: Self) -> Self {
        let k = Self::larger(Self::smaller(k, 2044.0), -2044.0);
        // In two halves: neither 2^half leaves the range of normal numbers.
        let first = powers::nearest(0.5 * k);
        (self * power_of_two(first)) * power_of_two(k - first)
    }
    #[inline(always)]
    fn exponent_mantissa(self) -> (Self, Self) {
        let bits = self.to_bits();
        // The exponent field as a number: in the low bits of 2⁵², then without the 2⁵² and the bias.
        let field = f64::from_bits((bits >> 52) | TWO_52.to_bits());
        let mantissa = f64::from_bits((bits & MANTISSA) | 1.0_f64.to_bits());
        (field - (TWO_52 + 1023.0), mantissa)
    }
    #[inline(always)]
    fn lookup<const K: usize>(self, table: &[[f64; K]]) -> [Self; K] {
        // Conversion truncates and saturates; NaN becomes 0.
        let row = (self as u32 as usize).min(table.len().saturating_sub(1));
        table.get(row).copied().unwrap_or([f64::NAN; K])
    }
    #[inline(always)]
    fn exp(self) -> Self {
        powers::exp(self)
    }
    #[inline(always)]
    fn exp_m1(self) -> Self {
        libm::expm1(self)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        powers::ln(self)
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
