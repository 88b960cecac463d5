//! Median and spread of repeated measurements.

use serde::Serialize;

/// Median and extremes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Least value.
    pub low: f64,
    /// Median; the mean of the two middle values of an even number.
    pub median: f64,
    /// Largest value.
    pub high: f64,
}

impl Spread {
    /// Of some numbers; all NaN without any.
    #[must_use]
    pub fn of(values: &[f64]) -> Self {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let (Some(&low), Some(&high)) = (sorted.first(), sorted.last()) else {
            return Self { low: f64::NAN, median: f64::NAN, high: f64::NAN };
        };
        let half = sorted.len() / 2;
        let median =
            if sorted.len() % 2 == 1 { sorted[half] } else { 0.5 * (sorted[half - 1] + sorted[half]) };
        Self { low, median, high }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_median_and_extremes() {
        assert_eq!(Spread::of(&[3.0, 1.0, 7.0]), Spread { low: 1.0, median: 3.0, high: 7.0 });
        assert_eq!(Spread::of(&[4.0, 1.0, 7.0, 2.0]), Spread { low: 1.0, median: 3.0, high: 7.0 });
        assert!(Spread::of(&[]).median.is_nan());
    }
}
