//! Moments of the weights \[L2\], in integers.

use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::lattice::{C, Q, W};
use lahar::solver::run::Backend;

/// 36 w_i as whole numbers.
///
/// # Errors
/// A weight is not the double nearest to a whole number of thirty-sixths.
fn weights_36() -> Result<[i64; Q], VerifyError> {
    let mut whole = [0; Q];
    for (n, w) in whole.iter_mut().zip(W) {
        *n = (36.0 * w).round() as i64;
        if *n as f64 / 36.0 != w {
            let detail = format!("{w} is not {n}/36");
            return Err(VerifyError::Numerics { what: "a lattice weight", detail });
        }
    }
    Ok(whole)
}

/// Σ 36 w c_a c_b … over the axes listed.
fn sum_36(weights: &[i64; Q], axes: &[usize]) -> i64 {
    let product = |i: usize| axes.iter().map(|&a| i64::from(C[i][a])).product::<i64>();
    (0..Q).map(|i| weights[i] * product(i)).sum()
}

/// What an isotropic set with c_s² = 1/3 gives, times 36: 36 (1/3)^(order/2) × the number of ways to
/// pair equal axes.
fn isotropic_36(axes: &[usize]) -> i64 {
    match axes {
        [] => 36,
        [a, rest @ ..] => {
            let pairings = |k: usize| {
                let mut left = rest.to_vec();
                let other = left.remove(k);
                if other == *a { isotropic_36(&left) / 3 } else { 0 }
            };
            (0..rest.len()).map(pairings).sum()
        }
    }
}

/// All lists of `order` axes.
fn all_axes(order: usize) -> Vec<Vec<usize>> {
    (0..3_usize.pow(order as u32))
        .map(|n| (0..order).map(|k| n / 3_usize.pow(k as u32) % 3).collect())
        .collect()
}

fn measure_identities(_: &dyn Backend, parameter: f64) -> Result<Sample, VerifyError> {
    let weights = weights_36()?;
    let lists = all_axes(parameter as usize);
    let residual = lists
        .iter()
        .map(|axes| (sum_36(&weights, axes) - isotropic_36(axes)).abs())
        .max()
        .unwrap_or(i64::MAX);
    Ok(Sample::absolute(parameter, residual as f64, 0.0).with("components [-]", lists.len() as f64))
}

/// \[L2\] to fifth order.
pub const IDENTITIES: Claim = Claim {
    id: "moment-identities",
    title: "Moments of the weights are isotropic to fifth order, exactly",
    tags: &["L1", "L2", "004 Table 3.1", "004 Eq 3.54"],
    measures: "largest |Σ 36 w c_a c_b … − isotropic value| over all components of one order, integers",
    reference: Reference {
        source: "isotropic tensors: 1, δ/3, (δδ + δδ + δδ)/9; odd orders vanish",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "order (of the moment)",
        short: &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0],
        full: &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 0.0,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "integer arithmetic: nothing is rounded",
    },
    kind: Kind::Verification,
    measure: measure_identities,
};

/// (axes, 36 × the value of this lattice, numerator and denominator of the isotropic value).
const SIXTH: [(&[usize; 6], i64, [f64; 2]); 3] = [
    (&[0, 0, 0, 0, 0, 0], 12, [15.0, 27.0]),
    (&[0, 0, 0, 0, 1, 1], 4, [3.0, 27.0]),
    (&[0, 0, 1, 1, 2, 2], 0, [1.0, 27.0]),
];

fn measure_sixth(_: &dyn Backend, parameter: f64) -> Result<Sample, VerifyError> {
    let weights = weights_36()?;
    let Some((axes, predicted, isotropic)) = SIXTH.get((parameter as usize).wrapping_sub(1)) else {
        return Err(VerifyError::Numerics {
            what: "sixth-order moment",
            detail: format!("no entry {parameter}"),
        });
    };
    let found = sum_36(&weights, *axes);
    Ok(Sample::absolute(parameter, found as f64, *predicted as f64)
        .with("value [-]", found as f64 / 36.0)
        .with("isotropic value [-]", isotropic[0] / isotropic[1]))
}

/// \[L2\], the sixth-order defects.
pub const SIXTH_ORDER: Claim = Claim {
    id: "moment-defects-sixth-order",
    title: "Sixth-order moments fail as predicted: ⟨c_x⁶⟩ = 1/3 instead of 15/27, ⟨c_x²c_y²c_z²⟩ = 0 instead of 1/27",
    tags: &["L2", "004 Eq 3.54"],
    measures: "36 ⟨c_x⁶⟩, 36 ⟨c_x⁴c_y²⟩, 36 ⟨c_x²c_y²c_z²⟩ as integers",
    reference: Reference {
        source: "counting: c_x⁶ = c_x² on this lattice; no velocity has three components",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "component (1 = xxxxxx, 2 = xxxxyy, 3 = xxyyzz)",
        short: &[1.0, 2.0, 3.0],
        full: &[1.0, 2.0, 3.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 0.0,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "integer arithmetic: nothing is rounded",
    },
    kind: Kind::PredictedFailure,
    measure: measure_sixth,
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_isotropic_values() {
        assert_eq!(isotropic_36(&[0, 0]), 12);
        assert_eq!(isotropic_36(&[0, 0, 0, 0]), 12);
        assert_eq!(isotropic_36(&[0, 1, 1, 0]), 4);
        assert_eq!(isotropic_36(&[0, 1, 1]), 0);
        assert_eq!(all_axes(2).len(), 9);
    }
}
