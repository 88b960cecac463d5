//! Sums for the ledger \[F5\] that do not depend on the order of their terms.

use crate::state::{State, StateError, Tape, state};

/// One unit of a sum is 2⁻⁹⁰: far below the rounding of any term that matters, and 2³⁶ still fits.
const BITS: i32 = 90;

/// Terms of this size or more do not fit.
const TOO_LARGE: f64 = 68_719_476_736.0;

/// A sum in fixed point: terms are cut to whole units (towards zero, so that −x gives exactly the opposite)
/// and then added without rounding. Blocks, threads and backends may add in any order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Sum {
    units: i128,
    /// A term was not finite or too large.
    spoilt: bool,
}

impl Sum {
    /// Adds a term; one that is not finite, or 2³⁶ and more, makes the sum NaN.
    #[inline(always)]
    pub(crate) fn add(&mut self, term: f64) {
        if term != 0.0 {
            self.add_times(term, 1);
        }
    }

    /// Adds the same term `count` times.
    #[inline(always)]
    pub(crate) fn add_times(&mut self, term: f64, count: u64) {
        let bits = term.to_bits();
        let exponent = (bits >> 52 & 0x7ff) as i32;
        let fraction = (bits & ((1 << 52) - 1)) as i128;
        let mantissa = if exponent == 0 { fraction } else { fraction | 1 << 52 };
        let shift = exponent.max(1) - 1075 + BITS;
        if exponent == 0x7ff || term.abs() >= TOO_LARGE {
            self.spoilt = true;
            return;
        }
        let magnitude = if shift >= 0 {
            mantissa << shift
        } else if shift > -64 {
            mantissa >> -shift
        } else {
            0
        };
        let signed = if bits >> 63 == 0 { magnitude } else { -magnitude };
        self.units = self.units.wrapping_add(signed.wrapping_mul(i128::from(count)));
    }

    /// Adds another sum.
    pub(crate) fn merge(&mut self, other: &Self) {
        self.units = self.units.wrapping_add(other.units);
        self.spoilt |= other.spoilt;
    }

    /// The sum, rounded once.
    #[must_use]
    pub(crate) fn value(&self) -> f64 {
        if self.spoilt {
            return f64::NAN;
        }
        // 2⁻⁹⁰, a power of two: the product only moves the exponent.
        self.units as f64 * f64::from_bits(((1023 - BITS) as u64) << 52)
    }
}

/// Three sums, for a vector.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct VectorSum([Sum; 3]);

impl VectorSum {
    /// Adds a vector.
    #[inline(always)]
    pub(crate) fn add(&mut self, v: &[f64; 3]) {
        for (sum, term) in self.0.iter_mut().zip(v) {
            sum.add(*term);
        }
    }

    /// Adds the same vector `count` times.
    pub(crate) fn add_times(&mut self, v: &[f64; 3], count: u64) {
        for (sum, term) in self.0.iter_mut().zip(v) {
            sum.add_times(*term, count);
        }
    }

    /// Adds another sum.
    pub(crate) fn merge(&mut self, other: &Self) {
        for (sum, term) in self.0.iter_mut().zip(&other.0) {
            sum.merge(term);
        }
    }

    /// The sums.
    #[must_use]
    pub(crate) fn value(&self) -> [f64; 3] {
        self.0.map(|sum| sum.value())
    }
}

state!(Sum: units spoilt);

impl State for VectorSum {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        self.0.state(tape)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_sum_of_terms_of_very_different_size() {
        // 2⁻⁸⁰.
        let small = f64::from_bits((1023 - 80) << 52);
        let mut sum = Sum::default();
        for term in [1.0, 3e10, small, -3e10, -1.0] {
            sum.add(term);
        }
        assert_eq!(sum.value(), small);
        let mut thrice = Sum::default();
        thrice.add_times(-0.1, 3);
        let mut each = Sum::default();
        for _ in 0..3 {
            each.add(-0.1);
        }
        assert_eq!(thrice, each);
        assert_eq!(thrice.value(), -(3.0 * 0.1));
    }

    #[test]
    fn exact_whatever_the_order() {
        let terms: Vec<f64> = (1..200).map(|k| (f64::from(k) * 0.37 - 31.0) / f64::from(k * k)).collect();
        let (mut forth, mut back) = (Sum::default(), Sum::default());
        terms.iter().for_each(|&x| forth.add(x));
        terms.iter().rev().for_each(|&x| back.add(x));
        assert_eq!(forth, back);
        // Against plain addition: 200 roundings of numbers below 40.
        assert!((forth.value() - terms.iter().sum::<f64>()).abs() < 200.0 * 40.0 * f64::EPSILON);
    }

    #[test]
    fn limit_of_terms_that_do_not_fit() {
        for term in [f64::NAN, f64::INFINITY, -1e12] {
            let mut sum = Sum::default();
            sum.add(term);
            sum.add(1.0);
            assert!(sum.value().is_nan());
        }
        let mut tiny = Sum::default();
        tiny.add(5e-324);
        assert_eq!(tiny.value(), 0.0);
    }
}
