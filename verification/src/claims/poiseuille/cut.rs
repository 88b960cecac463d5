//! Pipes whose walls lie in their place \[B4\].

use super::channel::{BINGHAM, THESIS};
use super::ducts_pipes::RoundPipe;
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use lahar::rheology::Law;
use lahar::setup::WallRule;
use lahar::solver::run::Backend;

const RADII: Ladder = Ladder { parameter: "R (cells)", short: &[6.0, 12.0], full: &[6.0, 8.0, 12.0, 24.0] };

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
