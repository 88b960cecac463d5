//! Fluids of any viscosity law between walls that move at a good part of the speed of sound.

use super::channel::run_steady;
use super::couette::{N, between_walls};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::claims::mutants_physics::{Mistake, Mistaken};
use crate::mutant::{Mutant, Subject};
use lahar::rheology::Law;
use lahar::solver::run::Backend;

/// Laws by the share of the stress that is yield stress, and flow index.
const CASES: [(f64, f64); 4] = [(0.5, 1.0), (0.2, 0.64), (0.8, 0.4), (0.0, 1.5)];
/// Plastic τ − ½ at the shear rate between the walls: high, so that normal stresses are large.
const EXCESS: f64 = 1.5;

/// A law with a plastic viscosity of (τ − ½)/3 at a shear rate.
fn law((plug, n): (f64, f64), rate: f64) -> Law {
    let flowing = EXCESS / 3.0 * rate;
    let sigma0 = flowing * plug / (1.0 - plug);
    if n == 1.0 {
        Law::Bingham { sigma0, mu: EXCESS / 3.0 }
    } else {
        Law::HerschelBulkley { sigma0, k: flowing / libm::pow(rate, n), n }
    }
}

fn measure(backend: &dyn Backend, speed: f64) -> Result<Sample, VerifyError> {
    let exact: Vec<f64> = (0..N).map(|j| speed * (j as f64 + 0.5) / N as f64).collect();
    let mut worst = Sample::linf(speed, &exact, &exact);
    for case in CASES {
        let setup = between_walls(law(case, speed / N as f64), 1.0, 0.0, speed, true);
        let u = run_steady(backend, &setup, 1e-8, 500, 100_000)?.velocity(0);
        let found = Sample::linf(speed, &u, &exact);
        worst.error = if found.error <= worst.error { worst.error } else { found.error };
        worst = worst.with(&format!("plug {}, n = {}", case.0, case.1), found.error);
    }
    Ok(worst)
}

/// Walls that move fast.
pub const FAST_WALL: Claim = Claim {
    id: "couette-fast-wall",
    title: "A fast wall shears fluids of any law uniformly",
    tags: &["B3", "K3"],
    measures: "max |u − U y/H|/U over Bingham and Herschel-Bulkley fluids (plug 0, 0.2, 0.5, 0.8, n = 0.4, 0.64, 1.5) of plastic τ = 2, \
               N = 16",
    reference: Reference { source: "u linear between the walls", uncertainty: 0.0 },
    metric: Metric::LInf,
    ladder: Ladder {
        parameter: "wall speed (cells per step)",
        short: &[0.05, 0.1],
        full: &[0.02, 0.05, 0.1],
    },
    order: None,
    tolerance: Tolerance {
        value: 2e-3,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "0.0024 (U (τ − ½))², 1.4e-3 at 0.1 cells per step and the plug of 0.8, whose apparent τ is 8: seen over U, τ and plugs of 0 \
                  to 0.95; without the work of the wall it is up to 10 %",
    },
    kind: Kind::Verification,
    measure,
};

/// No work.
pub const IDLE: Mutant = Mutant {
    id: "idle-moving-wall",
    erratum: "design [B3]",
    description: "A moving wall returns no third moments: normal stresses in a layer of cells at it thin the fluid there.",
    caught_by: "couette-fast-wall",
    rung: Some(0.1),
    subject: Subject::Backend(|| Box::new(Mistaken(Mistake::IdleWall))),
};
