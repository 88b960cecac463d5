//! Moments of the equilibrium, 004 Eq 3.55 corrected, and the inverse of the moment transform.

use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::lattice::equilibrium::equilibrium;
use lahar::lattice::moments::{density_excess, momentum, populations, second, third};
use lahar::lattice::{C, Q, W};
use lahar::solver::run::Backend;

/// Numbers in \[−½, ½), the same in every run: the linear congruential generator of Knuth's MMIX.
pub struct Sequence(u64);

impl Sequence {
    /// A sequence of its own for each seed.
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next number.
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    }

    /// Three numbers.
    pub fn vector(&mut self) -> [f64; 3] {
        [self.next(), self.next(), self.next()]
    }
}

/// Σ c_a c_b … f over the axes listed, f = h + w.
fn moment(h: &[f64; Q], axes: &[usize]) -> f64 {
    let product = |i: usize| axes.iter().map(|&a| f64::from(C[i][a])).product::<f64>();
    (0..Q).map(|i| (h[i] + W[i]) * product(i)).sum()
}

fn delta(a: usize, b: usize) -> f64 {
    f64::from(u8::from(a == b))
}

/// Densities and velocities of one speed in sixteen directions.
fn states(speed: f64) -> impl Iterator<Item = (f64, [f64; 3])> {
    let mut numbers = Sequence::new(3);
    (0..16).map(move |_| {
        let rho = 1.0 + 0.2 * numbers.next();
        let v = numbers.vector();
        let length = ((v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]).sqrt();
        (rho, v.map(|v| speed * v / length))
    })
}

/// How a formula for the moments of order 0 to 3 is checked: (order, number of components wrong by…).
pub struct Formula {
    /// Populations f^eq − w of density and velocity.
    pub equilibrium: fn(f64, &[f64; 3]) -> [f64; Q],
    /// Factor on the summand of direction i in a moment of an order.
    pub factor: fn(usize, usize) -> f64,
}

/// The right one.
pub const RIGHT: Formula =
    Formula { equilibrium: |rho, u| equilibrium(rho - 1.0, rho, u), factor: |_, _| 1.0 };

/// Largest difference of the moments of order 0 to 3 from 004 Eq 3.55.
pub fn largest_residual(formula: &Formula, speed: f64) -> Sample {
    let mut worst = [0.0_f64; 4];
    for (rho, u) in states(speed) {
        let h = (formula.equilibrium)(rho, &u);
        let weighted = |order: usize| {
            std::array::from_fn::<f64, Q, _>(|i| (h[i] + W[i]) * (formula.factor)(order, i) - W[i])
        };
        let fields: [[f64; Q]; 4] = std::array::from_fn(weighted);
        worst[0] = worst[0].max((moment(&fields[0], &[]) - rho).abs());
        for a in 0..3 {
            worst[1] = worst[1].max((moment(&fields[1], &[a]) - rho * u[a]).abs());
            for b in 0..3 {
                let expected = rho * u[a] * u[b] + rho / 3.0 * delta(a, b);
                worst[2] = worst[2].max((moment(&fields[2], &[a, b]) - expected).abs());
                for c in 0..3 {
                    let sum = (u[a] * delta(b, c) + u[b] * delta(a, c)) + u[c] * delta(a, b);
                    worst[3] = worst[3].max((moment(&fields[3], &[a, b, c]) - rho / 3.0 * sum).abs());
                }
            }
        }
    }
    let largest = worst.iter().fold(0.0, |m: f64, &w| if w <= m { m } else { w });
    let sample = Sample::absolute(speed, largest, 0.0);
    ["order 0 [-]", "order 1 [-]", "order 2 [-]", "order 3 [-]"]
        .iter()
        .zip(worst)
        .fold(sample, |sample, (name, w)| sample.with(name, w))
}

/// 19 summands with 8 operations each, absolute sum below 1.2: 27 half-units of 1.2.
const ROUNDING: f64 = 27.0 * 0.5 * f64::EPSILON * 1.2;

/// 004 Eq 3.55.
pub const MOMENTS: Claim = Claim {
    id: "equilibrium-moments",
    title: "The equilibrium has the moments ρ, ρu, ρuu + ρ/3 δ and ρ/3 (uδ + uδ + uδ)",
    tags: &["L3", "004 Eq 3.25", "004 Eq 3.55"],
    measures: "largest difference over all components, 16 densities and directions",
    reference: Reference {
        source: "004 Eq 3.55, without the weight printed in 3.55c (ERRATA 57)",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "|u| (speed, lattice units)",
        short: &[0.0, 0.01, 0.1, 0.3],
        full: &[0.0, 0.01, 0.1, 0.3],
    },
    order: None,
    tolerance: Tolerance {
        value: ROUNDING,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding: 19 summands of 8 operations each with absolute sum below 1.2",
    },
    kind: Kind::Verification,
    measure: |_, speed| Ok(largest_residual(&RIGHT, speed)),
};

/// Third moments of this equilibrium minus those of the Maxwell distribution, in the worst component
/// relative to ρ|u|³; predicted −ρ u_a u_b u_c.
fn measure_cubic(_: &dyn Backend, speed: f64) -> Result<Sample, VerifyError> {
    let mut worst = (0.0, 0.0, -1.0);
    for (rho, u) in states(speed) {
        let h = equilibrium(rho - 1.0, rho, &u);
        for (a, b, c) in [(0, 0, 0), (0, 0, 1), (0, 1, 2), (1, 1, 2), (2, 2, 2)] {
            let sum = (u[a] * delta(b, c) + u[b] * delta(a, c)) + u[c] * delta(a, b);
            let maxwell = rho / 3.0 * sum + rho * u[a] * u[b] * u[c];
            let found = (moment(&h, &[a, b, c]) - maxwell) / rho;
            let predicted = -(u[a] * u[b] * u[c]);
            let error = (found - predicted).abs();
            if error > worst.2 {
                worst = (found, predicted, error);
            }
        }
    }
    Ok(Sample::absolute(speed, worst.0, worst.1))
}

/// The cubic defect of the second-order equilibrium.
pub const CUBIC_DEFECT: Claim = Claim {
    id: "equilibrium-cubic-defect",
    title: "Third moments of the equilibrium lack exactly the cubic term ρ u_a u_b u_c",
    tags: &["L2", "L3", "004 Eq 3.55"],
    measures: "third moment minus that of the Maxwell distribution over ρ, component with the largest deviation from −u_a u_b u_c",
    reference: Reference {
        source: "−u_a u_b u_c: the third-order Hermite term that the expansion leaves out",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "|u| (speed, lattice units)",
        short: &[0.01, 0.1, 0.3],
        full: &[0.01, 0.1, 0.3],
    },
    order: None,
    tolerance: Tolerance {
        value: ROUNDING / 0.9,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding as for equilibrium-moments, divided by the smallest density 0.9",
    },
    kind: Kind::PredictedFailure,
    measure: measure_cubic,
};

fn measure_inverse(_: &dyn Backend, size: f64) -> Result<Sample, VerifyError> {
    let mut numbers = Sequence::new(5);
    let mut worst = 0.0_f64;
    for _ in 0..1000 {
        let h: [f64; Q] = std::array::from_fn(|_| size * numbers.next());
        let (m2, m3) = (second(&h), third(&h));
        let fourth = |a: usize, b: usize| -> f64 {
            (0..Q).map(|i| h[i] * f64::from(C[i][a] * C[i][a] * C[i][b] * C[i][b])).sum()
        };
        let m4 = [fourth(0, 1), fourth(0, 2), fourth(1, 2)];
        let back = populations(density_excess(&h), &momentum(&h), &m2, &m3, &m4);
        for (a, b) in h.iter().zip(back) {
            let error = (a - b).abs();
            worst = if error <= worst { worst } else { error };
        }
    }
    Ok(Sample::absolute(size, worst / size, 0.0))
}

/// The inverse transform of \[K3\].
pub const INVERSE: Claim = Claim {
    id: "moment-transform-inverse",
    title: "Nineteen raw moments give back the nineteen populations",
    tags: &["K3"],
    measures: "largest |f − f(moments(f))| over the size of the populations, 1000 arbitrary states",
    reference: Reference { source: "identity", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "size (range of the populations)",
        short: &[1e-12, 1e-3, 1.0],
        full: &[1e-12, 1e-6, 1e-3, 1.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 60.0 * 0.5 * f64::EPSILON * 3.0,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding: about 60 operations on sums of up to ten populations of half that size, below 3 in all",
    },
    kind: Kind::Verification,
    measure: measure_inverse,
};
