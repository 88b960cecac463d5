//! Quantiles by mass.

/// The least value that more than a share of the mass does not exceed; NaN without any mass.
///
/// # Arguments
/// `values`: value and mass ≥ 0 of each part, in any order. `share`: 0 to 1, no unit; from 1 on the largest value.
pub(super) fn quantile(mut values: Vec<(f64, f64)>, share: f64) -> f64 {
    // By mass too, so that the sums do not depend on the order in which the parts came.
    values.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let total: f64 = values.iter().map(|v| v.1).sum();
    let mut below = 0.0;
    for (value, mass) in &values {
        below += mass;
        if below > share * total {
            return *value;
        }
    }
    values.last().map_or(f64::NAN, |v| v.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_quantiles_by_mass() {
        let places = vec![(3.0, 1.0), (1.0, 2.0), (2.0, 1.0)];
        assert_eq!(quantile(places.clone(), 0.0), 1.0);
        assert_eq!(quantile(places.clone(), 0.5), 2.0);
        assert_eq!(quantile(places.clone(), 0.75), 3.0);
        assert_eq!(quantile(places, 1.0), 3.0);
        assert!(quantile(Vec::new(), 0.5).is_nan());
    }
}
