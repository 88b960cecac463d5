//! The papers' scheme and its implicit form: what the viscosity clamp does, and what the scheme adds.

use super::channel::{Column, Scale, THESIS, THESIS_VISCOSITY_PER_TAU, run_steady};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::poiseuille::Channel;
use lahar::collision::CollisionChoice;
use lahar::rheology::Law;
use lahar::setup::{WallRule, YieldTreatment};
use lahar::solver::run::Backend;

const CLAMPED: Reference = Reference {
    source: "the exact flow of the clamped law, u = (1/G)∫γ̇(s) ds branch by branch (REFERENCES 2)",
    uncertainty: 0.0,
};
const LADDER: Ladder = Ladder {
    parameter: "N (cells across)",
    short: &[16.0, 24.0, 32.0],
    full: &[16.0, 24.0, 32.0, 48.0, 64.0],
};
const ORDER: Option<OrderBand> = Some(OrderBand { expected: 2.0, band: 0.2, at_least: true });

/// τ at a lattice viscosity of `viscosity` per Pa s that stands for the thesis' τ, same viscosity in Pa s.
pub fn tau(thesis: f64, viscosity: f64) -> f64 {
    0.5 + 3.0 * viscosity * THESIS_VISCOSITY_PER_TAU * (thesis - 0.5)
}

/// The papers' scheme: BGK, τ from the previous step, half-way walls.
pub fn lagged(n: usize, law: &Law, tau_max: f64, viscosity: f64, speed: f64) -> Column {
    let yielding =
        YieldTreatment::LaggedClamped { tau_min: tau(0.501, viscosity), tau_max: tau(tau_max, viscosity) };
    let (collision, wall) = (CollisionChoice::Bgk, WallRule::HalfWay);
    Column { yielding, collision, wall, ..Column::unit(n, law, viscosity, speed) }
}

/// Implicit and clamped, central moments, half-way walls.
pub fn implicit(n: usize, law: &Law, tau_max: f64, viscosity: f64, speed: f64) -> Column {
    let yielding =
        YieldTreatment::ImplicitClamped { tau_min: tau(0.501, viscosity), tau_max: tau(tau_max, viscosity) };
    Column { yielding, wall: WallRule::HalfWay, ..Column::unit(n, law, viscosity, speed) }
}

fn l2(backend: &dyn Backend, n: f64, column: &Column) -> Result<Sample, VerifyError> {
    // The slowest mode has the channel's width and the mean viscosity, several times that at the wall.
    let interval = (0.05 * column.relaxation_steps()?).max(50.0);
    let steady = run_steady(backend, &column.developed()?, 2e-6, interval as u64, (200.0 * interval) as u64)?;
    let theory = Sample::l2(n, &column.scheme()?, &column.reference()?).error;
    let ideal = Column { yielding: YieldTreatment::Exact, ..*column }.reference()?;
    let model = Sample::l2(n, &column.reference()?, &ideal).error;
    Ok(Sample::l2(n, &steady.velocity(0), &column.reference()?)
        .with("error of the scheme's closed form", theory)
        .with("model error against the ideal law", model)
        .with("steps", steady.steps as f64))
}

const fn implicit_claim(
    id: &'static str,
    title: &'static str,
    measure: fn(&dyn Backend, f64) -> Result<Sample, VerifyError>,
) -> Claim {
    Claim {
        id,
        title,
        tags: &["Y4", "Y5", "K3", "B1", "H4"],
        measures: "relative L2 error against the clamped law; n = 0.33, plug half of the channel, Δt/Δx² = 1",
        reference: CLAMPED,
        metric: Metric::L2,
        ladder: LADDER,
        order: ORDER,
        tolerance: Tolerance {
            value: 1.3e-2,
            at: Rung::At(32.0),
            basis: Basis::Derived,
            because: "the midpoint sum and the half cell at the wall, as for the ideal law: 11.6/N² = 1.13e-2 in \
                      closed form at N = 32, and the clamp's corner inside a cell",
        },
        kind: Kind::Verification,
        measure,
    }
}

const fn lagged_claim(
    id: &'static str,
    title: &'static str,
    measure: fn(&dyn Backend, f64) -> Result<Sample, VerifyError>,
) -> Claim {
    Claim {
        id,
        title,
        tags: &["Y4", "Y5", "K1", "B1", "H4", "000 Eq 14", "001 Eq 8", "004 Eq 3.34"],
        measures: "relative L2 error against the clamped law; n = 0.33, plug half of the channel, Δt/Δx² = 0.1",
        reference: CLAMPED,
        metric: Metric::L2,
        ladder: LADDER,
        order: ORDER,
        tolerance: Tolerance {
            value: 1.3e-2,
            at: Rung::At(32.0),
            basis: Basis::Derived,
            because: "the closed form of the scheme gives 1.2e-2 at N = 32: the midpoint sum and the half cell at the wall, \
                      less the 2G(τ − ½) by which BGK shifts every node, largest in the plug",
        },
        kind: Kind::Verification,
        measure,
    }
}

/// Implicit clamp, τ_max 0.6.
pub const IMPLICIT_06: Claim = implicit_claim(
    "poiseuille-clamped-implicit-0.6",
    "Implicit and clamped at τ_max = 0.6, the scheme converges to the clamped law",
    |backend, n| l2(backend, n, &implicit(n as usize, &THESIS, 0.6, 1.0, 1e-3)),
);
/// Implicit clamp, τ_max 1.5.
pub const IMPLICIT_15: Claim = implicit_claim(
    "poiseuille-clamped-implicit",
    "Implicit and clamped at τ_max = 1.5, the scheme converges to the clamped law",
    |backend, n| l2(backend, n, &implicit(n as usize, &THESIS, 1.5, 1.0, 1e-3)),
);
/// Implicit clamp, τ_max 1.8.
pub const IMPLICIT_18: Claim = implicit_claim(
    "poiseuille-clamped-implicit-1.8",
    "Implicit and clamped at τ_max = 1.8, the scheme converges to the clamped law",
    |backend, n| l2(backend, n, &implicit(n as usize, &THESIS, 1.8, 1.0, 1e-3)),
);
/// The papers' scheme, τ_max 0.6.
pub const LAGGED_06: Claim = lagged_claim(
    "poiseuille-clamped-lagged-0.6",
    "The papers' scheme at τ_max = 0.6 converges to the clamped law",
    |backend, n| l2(backend, n, &lagged(n as usize, &THESIS, 0.6, 0.1, 1e-3)),
);
/// The papers' scheme, τ_max 1.5.
pub const LAGGED_15: Claim = lagged_claim(
    "poiseuille-clamped-lagged",
    "The papers' scheme at τ_max = 1.5 converges to the clamped law",
    |backend, n| l2(backend, n, &lagged(n as usize, &THESIS, 1.5, 0.1, 1e-3)),
);
/// The papers' scheme, τ_max 1.8.
pub const LAGGED_18: Claim = lagged_claim(
    "poiseuille-clamped-lagged-1.8",
    "The papers' scheme at τ_max = 1.8 converges to the clamped law",
    |backend, n| l2(backend, n, &lagged(n as usize, &THESIS, 1.8, 0.1, 1e-3)),
);

/// What the clamp itself costs.
pub const MODEL_ERROR: Claim = Claim {
    id: "poiseuille-clamp-model-error",
    title: "A clamped plug is faster than the ideal one by what the clamp predicts",
    tags: &["Y4", "Y5", "H4", "ERRATA 77"],
    measures: "u(0)/u_plug, implicit and clamped, extrapolated from N = 32 and 64 with Δx²",
    reference: Reference {
        source: "u(0)/u_plug of the clamped law: 1.033006, 1.005751, 1.002761, 1.002096 (REFERENCES 2, HARD_CASES H4)",
        uncertainty: 5e-7,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "tau_max", short: &[0.6, 1.5], full: &[0.6, 1.0, 1.5, 1.8] },
    order: None,
    tolerance: Tolerance {
        value: 1e-4,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the corners of the clamped law fall at different places within a cell at the two resolutions: \
                  an eighth of γ̇ Δx² there, (1/8)(2/64)²/2 = 6e-5 of u_max of which the extrapolation leaves a part",
    },
    kind: Kind::PredictedFailure,
    measure: |backend, tau_max| {
        let centre = |n: usize| -> Result<f64, VerifyError> {
            let column = implicit(n, &THESIS, tau_max, 1.0, 1e-3);
            let steady = run_steady(backend, &column.developed()?, 1e-7, 2000, 400_000)?;
            // One cell's centre lies half a cell from the mid-plane; the clamped core is a parabola.
            let correction = column.exact()?.velocity(0.0) - column.exact()?.velocity(0.5);
            Ok((steady.velocity(0)[n / 2] + correction) / 1e-3)
        };
        let (coarse, fine) = (centre(32)?, centre(64)?);
        let (mu_min, mu_max) = (THESIS_VISCOSITY_PER_TAU * 0.001, THESIS_VISCOSITY_PER_TAU * (tau_max - 0.5));
        let law = crate::exact::poiseuille_clamped::Trilinear::new(THESIS, mu_min, mu_max)
            .map_err(|e| VerifyError::Numerics { what: "the clamped law", detail: e.to_string() })?;
        let clamped = Channel { law, half_width: 1.0, force: 1.0 }.velocity(0.0);
        let ideal = Channel { law: THESIS, half_width: 1.0, force: 1.0 }.velocity(0.0);
        Ok(Sample::relative(tau_max, fine + (fine - coarse) / 3.0, clamped / ideal).with("at N = 64", fine))
    },
};

/// Yield stress five times the wall stress: nothing should move.
pub const OVER_YIELDED: Law = Law::HerschelBulkley { sigma0: 5.0, k: 0.2, n: 0.33 };

/// The over-yielded channel with wall stress 1, scaled so that the clamped fluid's creep is 1e-4.
pub fn over_yielded(n: usize) -> Column {
    let creep = 0.5 / THESIS_VISCOSITY_PER_TAU;
    Column::new(&Scale::new(n, 1.0 / (3.0 * THESIS_VISCOSITY_PER_TAU), creep, 1e-4), &OVER_YIELDED)
}

/// H3a: the papers' scheme.
pub const OVER_YIELD_LAGGED: Claim = Claim {
    id: "over-yield-lagged",
    title: "With the papers' scheme an over-yielded channel creeps as a Newtonian fluid of μ_max",
    tags: &["Y4", "H3", "ERRATA 30", "ERRATA 31"],
    measures: "u(0) less the slip of BGK at τ_max = 1.5, G = h = 1, σ0 = 5",
    reference: Reference {
        source: "G h²/(2μ_max) = 0.01875 (REFERENCES 2, HARD_CASES H3a)",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "N (cells across)", short: &[16.0, 32.0, 64.0], full: &[16.0, 32.0, 64.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-9,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "all of the error is the slip of half-way walls, which is known; 5e-11 is left by the last change \
                  allowed and rounding",
    },
    kind: Kind::PredictedFailure,
    measure: |backend, n| {
        let yielding = YieldTreatment::LaggedClamped { tau_min: 0.501, tau_max: 1.5 };
        let (collision, wall) = (CollisionChoice::Bgk, WallRule::HalfWay);
        let column = Column { yielding, collision, wall, ..over_yielded(n as usize) };
        let steady = run_steady(backend, &column.setup(), 1e-12, 500, 100_000)?;
        let middle = column.n / 2;
        let half_cell = column.exact()?.velocity(0.0) - column.exact()?.velocity(0.5);
        let slip = crate::exact::slip::slip_velocity_bgk(column.force, 1.0, 1.5);
        let u = (steady.velocity(0)[middle] - slip + half_cell) / 1e-4 * 0.01875;
        let raw = (steady.velocity(0)[middle] + half_cell) / 1e-4 * 0.01875;
        Ok(Sample::relative(n, u, 0.01875).with("u(0) with the slip", raw))
    },
};

/// Fastest cell of the over-yielded channel with exact yield, from rest.
fn creep(backend: &dyn Backend, column: &Column) -> Result<f64, VerifyError> {
    let mut run = backend.start(&column.setup())?;
    // The longest elastic wave decays as exp(−t θ(π/N)²/…), at least 20 e-folds in 160 N² steps.
    run.advance(160 * (column.n * column.n) as u64)?;
    let fields = run.fields();
    Ok(fields.velocity.iter().map(|u| u[0]).fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a }))
}

/// H3a: exact yield, half-way walls.
pub const OVER_YIELD_EXACT: Claim = Claim {
    id: "over-yield-exact",
    title: "With exact yield and half-way walls the solid slips by 2θG/ρ, as predicted",
    tags: &["Y3", "K3", "B1", "H3"],
    measures: "largest u in an over-yielded channel from rest, θ = 0.05; column: its ratio to the papers' creep",
    reference: Reference { source: "2θG/ρ, θ the least τ⁻ − ½", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "N (cells across)", short: &[16.0, 32.0], full: &[16.0, 32.0, 64.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-6,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "what is left of the elastic waves of the start after 160 N² steps (1e-8 measured), and rounding: 1e-16 of the \
                  populations against a slip of 1e-8 to 1e-9",
    },
    kind: Kind::PredictedFailure,
    measure: |backend, n| {
        let column = Column { wall: WallRule::HalfWay, ..over_yielded(n as usize) };
        let u = creep(backend, &column)?;
        Ok(Sample::relative(n, u, 2.0 * 0.05 * column.force).with("over the papers' creep", u / 1e-4))
    },
};

/// H3a: exact yield, viscosity-independent walls.
pub const OVER_YIELD_REST: Claim = Claim {
    id: "over-yield-rest",
    title: "With exact yield and viscosity-independent walls an over-yielded channel comes to rest",
    tags: &["Y3", "K3", "B3", "H3"],
    measures: "largest |u| over the papers' creep; channel started from rest",
    reference: Reference { source: "zero", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "N (cells across)", short: &[16.0, 32.0], full: &[16.0, 32.0, 64.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-10,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding: 1e-16 of the populations is 1e-12 of the creep, times the N = 64 cells that feel one wall",
    },
    kind: Kind::Verification,
    measure: |backend, n| Ok(Sample::absolute(n, creep(backend, &over_yielded(n as usize))? / 1e-4, 0.0)),
};
