//! Norms of the difference between a computed field and its reference.

/// √(Σ (computed − reference)² / Σ reference²); the plain root mean square of the difference where
/// the reference vanishes. NaN if the lengths differ or the fields are empty.
pub fn relative_l2(computed: &[f64], reference: &[f64]) -> f64 {
    if computed.len() != reference.len() || computed.is_empty() {
        return f64::NAN;
    }
    let difference: f64 = computed.iter().zip(reference).map(|(c, r)| (c - r) * (c - r)).sum();
    let size: f64 = reference.iter().map(|r| r * r).sum();
    (difference / if size > 0.0 { size } else { reference.len() as f64 }).sqrt()
}

/// max |computed − reference| / max |reference|; max |computed| where the reference vanishes. NaN
/// if the lengths differ, the fields are empty or a value is NaN.
pub fn relative_linf(computed: &[f64], reference: &[f64]) -> f64 {
    if computed.len() != reference.len() || computed.is_empty() {
        return f64::NAN;
    }
    // Not f64::max, which would drop a NaN.
    let larger = |a: f64, b: f64| if b > a || b.is_nan() { b } else { a };
    let difference = computed.iter().zip(reference).map(|(c, r)| (c - r).abs()).fold(0.0, larger);
    let size = reference.iter().map(|r| r.abs()).fold(0.0, larger);
    if size == 0.0 { difference } else { difference / size }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limit_cases() {
        assert_eq!(relative_l2(&[3.0, 4.0], &[0.0, 4.0]), 0.75);
        assert_eq!(relative_l2(&[3.0, 3.0], &[0.0, 0.0]), 3.0);
        assert_eq!(relative_linf(&[3.0, 4.5], &[0.0, 4.0]), 0.75);
        assert_eq!(relative_linf(&[0.5], &[0.0]), 0.5);
        assert!(relative_l2(&[1.0], &[]).is_nan());
        assert!(relative_linf(&[f64::NAN, 1.0], &[1.0, 1.0]).is_nan());
    }
}
