//! Pipes and turning cylinders whose walls lie in their place \[B4\].

use super::channel::{BINGHAM, THESIS, run_steady};
use super::couette::{cylinders, swirl, swirling};
use super::ducts_pipes::RoundPipe;
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use lahar::boundary::cut::cut_cells;
use lahar::rheology::Law;
use lahar::setup::WallRule;
use lahar::solver::run::Backend;

const RADII: Ladder =
    Ladder { parameter: "R (cells)", short: &[6.0, 12.0], full: &[6.0, 8.0, 12.0, 24.0, 44.0] };

/// Root mean square over R, R + ¼, R + ½, R + ¾: how the cells lie in the circle is chance.
fn over_quarters(
    backend: &dyn Backend,
    radius: f64,
    pipe: impl Fn(f64) -> RoundPipe,
) -> Result<Sample, VerifyError> {
    let mut squares = 0.0;
    for quarter in 0..4 {
        let error = pipe(radius + 0.25 * f64::from(quarter)).measure(backend)?.error;
        squares += 0.25 * error * error;
    }
    let mut sample = pipe(radius).measure(backend)?;
    let alone = sample.error;
    sample.error = squares.sqrt();
    Ok(sample.with("error at R alone", alone))
}

/// Newtonian pipe.
pub const PIPE: Claim = Claim {
    id: "pipe-newtonian-cut",
    title: "Newtonian pipe flow within a wall at its true place converges at second order",
    tags: &["K3", "B4", "L5"],
    measures: "root mean square over the radii R, R + ¼, R + ½, R + ¾ of the relative L2 error; τ = 1",
    reference: Reference { source: "u = G(R² − r²)/(4μ) (Hagen-Poiseuille)", uncertainty: 0.0 },
    metric: Metric::L2,
    ladder: RADII,
    order: Some(OrderBand { expected: 2.0, band: 0.3, at_least: true }),
    tolerance: Tolerance {
        value: 0.03,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "a link that is cut at q sees the curvature G/(2μ) times Λ = 3/16 to ¾ q², off by less than 9/16 of \
                  ½(G/2μ); over the root mean square GR²/(4√3 μ) of u that is 0.98/R², 0.027 at R = 6",
    },
    kind: Kind::Verification,
    measure: |backend, radius| {
        let law = Law::Newtonian { mu: 0.2 };
        over_quarters(backend, radius, |r| {
            RoundPipe::new(r, &law, 1.0 / 1.2, 0.01, WallRule::ViscosityIndependent).cut()
        })
    },
};

/// Bingham pipe.
pub const PIPE_BINGHAM: Claim = Claim {
    id: "pipe-bingham-cut",
    title: "In a Bingham pipe within a wall at its true place the error is of second order",
    tags: &["Y3", "K3", "B4"],
    measures: "root mean square over the radii R, R + ¼, R + ½, R + ¾ of the relative L2 error; plug half of the radius, \
               Δt/Δx² = 0.5",
    reference: Reference { source: "Buckingham 1921, Reiner 1926", uncertainty: 0.0 },
    metric: Metric::L2,
    ladder: RADII,
    order: None,
    tolerance: Tolerance {
        value: 0.05,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the rate bends by 2.5 over the sheared half of the radius: a bend that is missed over a cell, ½·5/R², over \
                  the root mean square velocity 0.65·0.625 is 6/R²; half of it is carried by the links, 0.085 at R = 6, \
                  and the law by stress leaves at most half of that",
    },
    kind: Kind::Verification,
    measure: |backend, radius| {
        over_quarters(backend, radius, |r| {
            RoundPipe::new(r, &BINGHAM, 0.5, 0.01, WallRule::ViscosityIndependent).cut()
        })
    },
};

/// Herschel-Bulkley pipe.
pub const PIPE_HB: Claim = Claim {
    id: "pipe-herschel-bulkley-cut",
    title: "In a Herschel-Bulkley pipe (n = 0.33) within a wall at its true place the error is below 5 % from R = 6 on",
    tags: &["Y3", "K3", "B4"],
    measures: "root mean square over the radii R, R + ¼, R + ½, R + ¾ of the relative L2 error; plug half of the radius, \
               Δt/Δx² = 0.5",
    reference: Reference { source: "Q = (8π/G³)∫σ²γ̇ dσ (Rabinowitsch 1929)", uncertainty: 0.0 },
    metric: Metric::L2,
    ladder: RADII,
    order: None,
    tolerance: Tolerance {
        value: 0.05,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "as `pipe-bingham-cut`; the bend of the rate is larger, and the law by stress follows it",
    },
    kind: Kind::Verification,
    measure: |backend, radius| {
        over_quarters(backend, radius, |r| {
            RoundPipe::new(r, &THESIS, 0.5, 0.01, WallRule::ViscosityIndependent).cut()
        })
    },
};

/// Turning cylinders.
pub const TAYLOR: Claim = Claim {
    id: "taylor-couette-cut",
    title: "Around a rotating cylinder at its true place the error is of second order, and mass is kept",
    tags: &["B4", "K2", "ERRATA 18", "004 Eq 3.38"],
    measures: "relative L2 error of u_θ between cylinders of radius R/2 (rotating) and R (at rest), TRT Λ = 3/16, τ = 1",
    reference: Reference { source: "u_θ = A r + B/r (Landau & Lifshitz, §18)", uncertainty: 0.0 },
    metric: Metric::L2,
    ladder: Ladder {
        parameter: "R (cells)",
        short: &[8.0, 12.0, 16.0],
        full: &[8.0, 12.0, 16.0, 24.0, 32.0, 48.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.5, at_least: true }),
    tolerance: Tolerance {
        value: 0.03,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "half of the curvature of u_θ at the inner wall, 2B/r³ with B = Ω(R/2)²·4/3 or 10.7 Ω/R, times the square \
                  of a link's q of at most 1: 5.3 Ω/R over the root mean square 0.28 ΩR of u_θ is 19/R² for the worst link; \
                  a tenth of it as links of all q average, 0.03 at R = 8",
    },
    kind: Kind::Verification,
    measure: |backend, radius| {
        let mut setup = cylinders(radius);
        let middle = 0.5 * setup.extents[0] as f64;
        setup.cuts = cut_cells(&setup, |[x, y, _]| {
            let r = ((x - middle) * (x - middle) + (y - middle) * (y - middle)).sqrt();
            r < 0.5 * radius || r > radius
        })
        .into();
        // From the exact flow: a sudden start leaves momentum of alternating sign, Σ(−1)^(x+t) j_x, which cut links keep for
        // ever, up to 6e-4 of the largest speed.
        setup.initial = Some(swirling(radius));
        let steady = run_steady(backend, &setup, 1e-4, 100, 100_000)?;
        let (computed, reference) = swirl(radius, &setup, &steady);
        let mass: f64 = steady.fields.density.iter().map(|rho| rho - 1.0).sum();
        Ok(Sample::l2(radius, &computed, &reference)
            .with("mass gained per cell", mass / computed.len() as f64)
            .with("steps", steady.steps as f64))
    },
};
