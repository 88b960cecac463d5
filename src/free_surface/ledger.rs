//! Compensated sums for the ledger \[F5\].

/// A sum that keeps what rounding drops (Neumaier's variant of Kahan's summation).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sum {
    total: f64,
    lost: f64,
}

impl Sum {
    /// Adds a term.
    #[inline(always)]
    pub fn add(&mut self, term: f64) {
        let sum = self.total + term;
        self.lost += if self.total.abs() >= term.abs() {
            (self.total - sum) + term
        } else {
            (term - sum) + self.total
        };
        self.total = sum;
    }

    /// The sum.
    #[must_use]
    pub fn value(&self) -> f64 {
        self.total + self.lost
    }
}

/// Three sums, for a vector.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VectorSum([Sum; 3]);

impl VectorSum {
    /// Adds a vector.
    #[inline(always)]
    pub fn add(&mut self, v: &[f64; 3]) {
        for (sum, term) in self.0.iter_mut().zip(v) {
            sum.add(*term);
        }
    }

    /// The sums.
    #[must_use]
    pub fn value(&self) -> [f64; 3] {
        self.0.map(|sum| sum.value())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_sum_of_terms_of_very_different_size() {
        let mut sum = Sum::default();
        for term in [1.0, 1e100, 1.0, -1e100] {
            sum.add(term);
        }
        assert_eq!(sum.value(), 2.0);
    }
}
