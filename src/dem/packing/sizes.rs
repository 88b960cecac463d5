//! Distributions of grain size.

use super::Random;
use crate::dem::DemError;

/// A distribution of radii.
#[derive(Debug, Clone, PartialEq)]
pub enum Sizes {
    /// All equal, m.
    One(f64),
    /// Uniform by number between two radii, m.
    Uniform {
        /// Least radius, m.
        least: f64,
        /// Largest radius, m.
        largest: f64,
    },
    /// Log-normal by number: median radius (m), standard deviation of ln r; values outside the bounds are drawn
    /// again.
    LogNormal {
        /// Median radius, m.
        median: f64,
        /// Standard deviation of ln r.
        deviation: f64,
        /// Least radius, m.
        least: f64,
        /// Largest radius, m.
        largest: f64,
    },
    /// Sieve curve: (diameter in m, share of the mass that passes, 0 … 1), ascending, from 0 to 1. Between two
    /// sieves the mass is uniform in ln d.
    Sieve(Vec<(f64, f64)>),
}

impl Sizes {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Radii that are not above zero or not ascending; a curve that does not rise from 0 to 1.
    pub(crate) fn check(&self) -> Result<(), DemError> {
        let fail = |what, found, allowed| Err(DemError::Packing { what, found, allowed });
        let above = |x: f64| x > 0.0 && x.is_finite();
        match self {
            Sizes::One(r) if !above(*r) => fail("radius (m)", *r, "above 0"),
            Sizes::Uniform { least, .. } | Sizes::LogNormal { least, .. } if !above(*least) => {
                fail("smallest radius (m)", *least, "above 0")
            }
            Sizes::Uniform { least, largest } if !(largest >= least && largest.is_finite()) => {
                fail("largest radius (m)", *largest, "finite and at least the smallest")
            }
            Sizes::LogNormal { median, deviation, least, largest } => {
                if !(median >= least && median <= largest && largest.is_finite()) {
                    return fail("median radius (m)", *median, "between the smallest and the largest");
                }
                if !(*deviation >= 0.0 && deviation.is_finite()) {
                    return fail("deviation of ln r", *deviation, "0 or more");
                }
                Ok(())
            }
            Sizes::Sieve(curve) => {
                let (Some(first), Some(last)) = (curve.first(), curve.last()) else {
                    return fail("number of sieves", 0.0, "at least 2");
                };
                if curve.len() < 2
                    || first.1 != 0.0
                    || last.1 != 1.0
                    || !above(first.0)
                    || !last.0.is_finite()
                {
                    return fail(
                        "share passing the first and last sieve",
                        first.1,
                        "0 and 1, with diameters above 0",
                    );
                }
                for w in curve.windows(2) {
                    if !(w[1].0 > w[0].0 && w[1].1 >= w[0].1) {
                        return fail("sieve diameter (m)", w[1].0, "ascending, with shares that do not fall");
                    }
                }
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// Draws a radius, m.
    pub(crate) fn draw(&self, random: &mut Random) -> f64 {
        match self {
            Sizes::One(r) => *r,
            Sizes::Uniform { least, largest } => least + random.unit() * (largest - least),
            Sizes::LogNormal { median, deviation, least, largest } => {
                for _ in 0..1000 {
                    let r = median * libm::exp(deviation * random.normal());
                    if r >= *least && r <= *largest {
                        return r;
                    }
                }
                // Bounds so far out that nothing falls between them: the median does.
                *median
            }
            Sizes::Sieve(curve) => sieve(curve, random),
        }
    }
}

/// Number of grains between two sieves ∝ ∫ dm/d³ with dm ∝ d ln d, that is ∝ share (d₁⁻³ − d₂⁻³)/ln(d₂/d₁).
fn sieve(curve: &[(f64, f64)], random: &mut Random) -> f64 {
    let inverse_cube = |d: f64| 1.0 / (d * d * d);
    let weight = |w: &[(f64, f64)]| {
        (w[1].1 - w[0].1) * (inverse_cube(w[0].0) - inverse_cube(w[1].0)) / libm::log(w[1].0 / w[0].0)
    };
    let total: f64 = curve.windows(2).map(weight).sum();
    let mut left = random.unit() * total;
    let mut d = curve[0].0;
    for w in curve.windows(2) {
        let share = weight(w);
        if share <= 0.0 {
            continue;
        }
        let part = (left / share).min(1.0);
        let (a, b) = (inverse_cube(w[0].0), inverse_cube(w[1].0));
        d = 1.0 / libm::cbrt(a + part * (b - a));
        if left < share {
            break;
        }
        left -= share;
    }
    0.5 * d
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn log_normal_sizes_lie_within_their_bounds_and_about_their_median() {
        let (median, deviation) = (2.0, 0.5);
        let sizes = Sizes::LogNormal { median, deviation, least: 1.5, largest: 3.0 };
        let mut random = Random::new(5);
        let drawn: Vec<f64> = (0..20_000).map(|_| sizes.draw(&mut random)).collect();
        assert!(drawn.iter().all(|r| (1.5..=3.0).contains(r)));
        // Φ(ln(r/median)/deviation): of all that lies within, (0.5 − 0.2825)/(0.7913 − 0.2825) is below the median. Five
        // standard errors of a share.
        let below = drawn.iter().filter(|&&r| r < median).count() as f64 / 20_000.0;
        assert!((below - 0.4275).abs() < 5.0 * (0.25_f64 / 20_000.0).sqrt(), "{below}");
        // Bounds that nothing falls between.
        let sizes = Sizes::LogNormal { median, deviation: 1e3, least: 2.0, largest: 2.0 };
        assert_eq!(sizes.draw(&mut random), 2.0);
    }

    /// The drawn grains, weighed, give the sieve curve back within 5 standard errors (bootstrap by class).
    #[test]
    fn reference_sieve_curve_returned() {
        let curve = vec![(1.0, 0.0), (2.0, 0.3), (3.0, 0.3), (4.0, 1.0)];
        let sizes = Sizes::Sieve(curve.clone());
        sizes.check().unwrap();
        let mut r = Random::new(3);
        let n = 200_000;
        let (mut all, mut fine, mut squares) = (0.0, 0.0, 0.0);
        for _ in 0..n {
            let d = 2.0 * sizes.draw(&mut r);
            assert!((1.0..=4.0).contains(&d) && !(2.0 + 1e-9..3.0 - 1e-9).contains(&d));
            let m = d * d * d;
            all += m;
            squares += m * m;
            if d < 2.5 {
                fine += m;
            }
        }
        let error = squares.sqrt() / all;
        assert!((fine / all - 0.3).abs() < 5.0 * error, "{} {error}", fine / all);
    }

    #[test]
    fn bad_sizes_are_refused() {
        for s in [
            Sizes::One(0.0),
            Sizes::Uniform { least: 2.0, largest: 1.0 },
            Sizes::LogNormal { median: 3.0, deviation: 0.1, least: 1.0, largest: 2.0 },
            Sizes::Sieve(vec![(1.0, 0.0)]),
            Sizes::Sieve(vec![(1.0, 0.0), (0.5, 1.0)]),
        ] {
            assert!(matches!(s.check(), Err(DemError::Packing { .. })), "{s:?}");
        }
    }
}
