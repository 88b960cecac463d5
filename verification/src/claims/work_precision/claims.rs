//! What can be said about work in advance.

use super::trial::{Outcome, Trial};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use lahar::plan::work::{Case, Operator, Scheme, Walls};
use lahar::solver::fast::Fast;
use lahar::solver::plain::Plain;
use lahar::solver::run::Backend;

/// Updates that no run of a claim needs.
const BUDGET: f64 = 1e8;

const DEFAULT: Scheme = Scheme { operator: Operator::CentralMoment, walls: Walls::Independent };
const PAPERS: Scheme = Scheme { operator: Operator::LaggedClamp, walls: Walls::HalfWay };

fn updates(backend: &dyn Backend, n: f64) -> Result<Sample, VerifyError> {
    let outcome =
        Trial { case: Case::ChannelNewtonian, scheme: DEFAULT, n, step: 1.0 }.run(backend, BUDGET)?;
    let pi = core::f64::consts::PI;
    // The first mode holds 32/π³ of the parabola's height; relative L2: over √2 and over √(8/15).
    let first = 32.0 / (pi * pi * pi) / (2.0_f64 * 8.0 / 15.0).sqrt();
    let memory = n * n / (pi * pi * 0.2);
    Ok(Sample::relative(n, outcome.updates, n * memory * libm::log(1e6 * first)).with("error", outcome.error))
}

/// How work is counted.
pub const UPDATES: Claim = Claim {
    id: "work-updates",
    title: "A Newtonian channel from rest takes N³ ln(10⁶)/(π²ν) updates to come within 10⁻⁶ of its error",
    tags: &["L6", "B3"],
    measures: "cell updates until the relative L2 error stays within 10⁻⁶ of what it becomes, ν = 0.2",
    reference: Reference {
        source: "decay of the slowest mode of plane Poiseuille flow started from rest, e^(−νπ²t/N²), which holds 0.9993 \
                 of the profile in L2",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "N (cells across)",
        short: &[8.0, 16.0, 32.0],
        full: &[8.0, 16.0, 32.0, 48.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 0.02,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the error is looked at twenty times per relaxation time, rounded up to whole steps: one look in 276, and \
                  at N = 8 the interval of 5 steps stands for 1.6; the discrete decay differs by π²/(12N²) = 1.3 % at N = 8",
    },
    kind: Kind::Verification,
    measure: updates,
};

/// The cheapest run within an error: resolutions times steps.
fn cheapest(
    backend: &dyn Backend,
    scheme: Scheme,
    steps: &[f64],
    wanted: f64,
) -> Result<Option<(Trial, Outcome)>, VerifyError> {
    let mut best: Option<(Trial, Outcome)> = None;
    for n in [8.0, 16.0, 32.0] {
        for &step in steps {
            let trial = Trial { case: Case::ChannelBingham, scheme, n, step };
            let outcome = trial.run(backend, BUDGET)?;
            let cheaper = best.is_none_or(|(_, b)| outcome.updates < b.updates);
            if outcome.error <= wanted && cheaper {
                best = Some((trial, outcome));
            }
        }
    }
    Ok(best)
}

fn clamp(backend: &dyn Backend, percent: f64) -> Result<Sample, VerifyError> {
    let wanted = 0.01 * percent;
    let missed = |what: &str| VerifyError::Numerics {
        what: "the cheapest run",
        detail: format!("{what} does not reach {percent} %"),
    };
    let ours = cheapest(backend, DEFAULT, &[1.0, 4.0], wanted)?.ok_or_else(|| missed("the exact yield"))?;
    let papers = cheapest(backend, PAPERS, &[0.05, 0.2], wanted)?.ok_or_else(|| missed("the clamp"))?;
    let mut sample = Sample::absolute(percent, ours.1.updates, papers.1.updates);
    sample.error = ours.1.updates / papers.1.updates;
    Ok(sample
        .with("N, exact yield", ours.0.n)
        .with("N, clamp", papers.0.n)
        .with("step, exact yield", ours.0.step)
        .with("step, clamp", papers.0.step)
        .with("error, exact yield", ours.1.error)
        .with("error, clamp", papers.1.error))
}

/// The papers' scheme pays for its clamp.
pub const CLAMP: Claim = Claim {
    id: "work-of-the-clamp",
    title: "To 2 and 1 %, exact yield takes less than a twentieth of the updates of the papers' clamped scheme",
    tags: &["Y3", "Y4", "B3", "001 Sec 3.1"],
    measures: "updates of the cheapest run of a Bingham channel within the error, over those of the clamped scheme (BGK, \
               τ of the previous step, half-way walls); N = 8, 16, 32, Δt/Δx² = 1, 4 and 0.05, 0.2",
    reference: Reference {
        source: "both errors are against the exact profile of the ideal law",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "error wanted (per cent)", short: &[2.0, 1.0], full: &[2.0, 1.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.05,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the clamped core moves ahead by 2G(τ_max − ½) on the lattice, 6Gν_max(Δt/Δx²)²Δx² in the units of the \
                  channel with ν_max = 26.7, which is 2 % of the plug's 0.3125 at N = 16 for Δt/Δx² = 0.05: steps have to \
                  be eighty times shorter than the 4 of the exact yield; a factor of four is left for transients",
    },
    kind: Kind::Verification,
    measure: clamp,
};

fn rung(backend: &dyn Backend, case: Case, n: f64) -> Result<Sample, VerifyError> {
    let walls = if case == Case::Vortex { Walls::None } else { Walls::Independent };
    let trial = Trial { case, scheme: Scheme { walls, ..DEFAULT }, n, step: 1.0 };
    let outcome = trial.run(backend, BUDGET)?;
    Ok(Sample::absolute(n, outcome.error, 0.0)
        .with("cell updates", outcome.updates)
        .with("steps", outcome.steps as f64))
}

const EXACT: Reference = Reference { source: "the exact solution: an error of 0", uncertainty: 0.0 };

/// Bingham channel.
pub const ORDER_BINGHAM: Claim = Claim {
    id: "work-order-channel-bingham",
    title: "In a Bingham channel from rest four times the resolution buys an error sixteen times smaller",
    tags: &["Y3", "K3", "B3"],
    measures: "relative L2 error where the work is counted, τ = 1.1",
    reference: EXACT,
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "N (cells across)",
        short: &[8.0, 16.0, 32.0],
        full: &[8.0, 16.0, 32.0, 64.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.3, at_least: false }),
    tolerance: Tolerance {
        value: 0.05,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "midpoint rule for γ̇ over the cells: h²/8 times the slope of γ̇ per sheared length, 2/N² of the plug's \
                  velocity, 3.1 % at N = 8, plus the tenth that is left of the transient",
    },
    kind: Kind::Verification,
    measure: |backend, n| rung(backend, Case::ChannelBingham, n),
};

/// Herschel-Bulkley channel.
pub const ORDER_HERSCHEL_BULKLEY: Claim = Claim {
    id: "work-order-channel-herschel-bulkley",
    title: "In a Herschel-Bulkley channel from rest (n = 0.33) the error falls faster than N^1.4",
    tags: &["Y3", "K3", "B3"],
    measures: "relative L2 error where the work is counted, Δt/Δx² = 1",
    reference: EXACT,
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "N (cells across)",
        short: &[16.0, 24.0, 32.0],
        full: &[16.0, 24.0, 32.0, 48.0, 64.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.6, at_least: true }),
    tolerance: Tolerance {
        value: 0.05,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "midpoint rule for γ̇ ∝ s³, s the stress above yield, over M = N/4 sheared cells: 1/(2M²) of the plug's \
                  velocity, 3.1 % at N = 16, plus the tenth that is left of the transient and the cell that holds the yield \
                  surface. Order 2 is approached from below: with M = 4 the cells at the wall and at the plug are half of all",
    },
    kind: Kind::Verification,
    measure: |backend, n| rung(backend, Case::ChannelHerschelBulkley, n),
};

/// Vortices.
pub const ORDER_VORTEX: Claim = Claim {
    id: "work-order-vortices",
    title: "Taylor-Green vortices: four times the work, half the error",
    tags: &["L3", "L6", "K3"],
    measures: "relative L2 error of the velocity after it has halved, ν = 0.05, U = 1.6/N",
    reference: EXACT,
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "N (cells per wave)",
        short: &[16.0, 32.0, 64.0],
        full: &[16.0, 32.0, 64.0, 128.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.1, at_least: false }),
    tolerance: Tolerance {
        value: 0.05,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "at most k²/4 in the viscosity of each of the two wave components, k = 2π/16, times ln 2 of decay, and \
                  U² = 0.01; the work grows as N⁴",
    },
    kind: Kind::Verification,
    measure: |backend, n| rung(backend, Case::Vortex, n),
};

/// Bingham film.
pub const ORDER_FILM: Claim = Claim {
    id: "work-order-film-bingham",
    title: "The discharge of a Bingham film from rest converges at second order in the work's cube root",
    tags: &["F1", "F3", "Y3", "B3"],
    measures: "relative error of the discharge where the work is counted, N + ¼ and N + ¾ cells deep, the worse; τ = 0.8",
    reference: EXACT,
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "N (cells deep)", short: &[4.0, 8.0, 16.0], full: &[4.0, 8.0, 16.0, 32.0] },
    order: Some(OrderBand { expected: 2.0, band: 0.5, at_least: true }),
    tolerance: Tolerance {
        value: 0.05,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "midpoint rule, 1/(8H²) to 0.2/H² by fill as for the Newtonian film, doubled for the yield surface that may \
                  lie anywhere in its cell: 2.5 % at 4 cells; compression adds 3 g H cos θ = 0.12/H²",
    },
    kind: Kind::Verification,
    measure: |backend, n| rung(backend, Case::FilmBingham, n),
};

fn backends(backend: &dyn Backend, number: f64) -> Result<Sample, VerifyError> {
    let case = Case::ALL[(number as usize).min(Case::ALL.len() - 1)];
    let walls = if case == Case::Vortex { Walls::None } else { Walls::Independent };
    let trial = Trial { case, scheme: Scheme { walls, ..DEFAULT }, n: 16.0, step: 1.0 };
    // Never a backend against itself: the gate asks with the plain one, the study with the fast one.
    let fast = Fast::default();
    let partner: &dyn Backend = if backend.name() == fast.name() { &Plain } else { &fast };
    let (one, other) = (trial.run(backend, BUDGET)?, trial.run(partner, BUDGET)?);
    Ok(Sample::absolute(number, one.error, other.error)
        .with("difference in updates", (one.updates - other.updates).abs()))
}

/// One table for both backends.
pub const BACKENDS: Claim = Claim {
    id: "work-same-with-both-backends",
    title: "Errors and updates are the same with the fast backend as with the plain one",
    tags: &["L7"],
    measures: "error of a channel of each fluid (0 to 2) and of vortices (3) with 16 cells",
    reference: Reference {
        source: "the other backend, which packs cells and keeps them in blocks",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "flow (its number in the table)",
        short: &[0.0, 1.0, 2.0, 3.0],
        full: &[0.0, 1.0, 2.0, 3.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 0.0,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the same operations in the same order: the same bits",
    },
    kind: Kind::Verification,
    measure: backends,
};
