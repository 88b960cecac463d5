//! H2: two layers of very different viscosity between a fixed and a moving wall.

use std::sync::Arc;

use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::collision::{CollisionChoice, OddRate};
use lahar::rheology::Law;
use lahar::setup::{Face, FlowPoint, Setup};
use lahar::solver::run::Backend;
use lahar::solver::steady::{SteadyRule, run_to_steady};

/// τ⁺ below and above the jump, and speed of the upper wall.
const THIN: f64 = 0.51;
const THICK: f64 = 1.8;
const WALL_SPEED: f64 = 0.01;

fn viscosity(tau: f64) -> f64 {
    (tau - 0.5) / 3.0
}

/// Operators of the ladder extras.
pub const OPERATORS: [(&str, CollisionChoice); 4] = [
    ("BGK", CollisionChoice::Bgk),
    ("TRT 3/16", CollisionChoice::Trt(OddRate::fixed(3.0 / 16.0))),
    ("central moment", CollisionChoice::CentralMoment(OddRate::STANDARD)),
    ("regularised", CollisionChoice::Regularised),
];

/// Couette flow of two layers of equal height, started from the exact profile.
pub fn couette(cells: usize, tau: f64, collision: CollisionChoice) -> Setup {
    let (mu, thick) = (viscosity(tau), viscosity(THICK));
    let half = cells as f64 / 2.0;
    let stress = WALL_SPEED / (half / mu + half / thick);
    let mut setup = Setup::channel(cells, Law::Newtonian { mu }, 0.0);
    setup.fluids.push(Law::Newtonian { mu: thick });
    setup.fluid_of_cell = (0..cells).map(|j| u8::from(2 * j >= cells)).collect();
    setup.faces[1] = [Face::NoSlip, Face::Moving([WALL_SPEED, 0.0, 0.0])];
    setup.collision = collision;
    setup.initial = Some(Arc::new(move |[_, j, _]| {
        let y = j as f64 + 0.5;
        let below = 2 * j < cells;
        let u = if below { stress * y / mu } else { WALL_SPEED - stress * (2.0 * half - y) / thick };
        let mut point = FlowPoint { density: 1.0, velocity: [u, 0.0, 0.0], gradient: [[0.0; 3]; 3] };
        point.gradient[0][1] = stress / if below { mu } else { thick };
        point
    }));
    setup
}

/// What a steady two-layer flow shows.
pub struct Layers {
    /// Velocity at the interface, from the lower layer's line through its middle.
    pub interface: f64,
    /// Exact value, U μ₂/(μ₁ + μ₂).
    pub exact: f64,
    /// Largest relative departure of the shear stress from its mean, the two nodes at the jump left out.
    pub spread: f64,
    /// Largest relative departure of the shear stress from its mean at the two nodes at the jump.
    pub spread_at_jump: f64,
}

/// Runs to the steady state.
///
/// # Errors
/// The backend refused or stopped, or the flow did not become steady.
pub fn steady(
    backend: &dyn Backend,
    cells: usize,
    tau: f64,
    collision: CollisionChoice,
) -> Result<Layers, VerifyError> {
    let mut run = backend.start(&couette(cells, tau, collision))?;
    let interval = (cells * cells) as u64;
    let wanted = 1e-14;
    let rule = SteadyRule { tolerance: wanted, interval, max_steps: 60_000 * cells as u64 };
    let outcome = run_to_steady(&mut *run, rule)?;
    if !outcome.steady && outcome.residual > 1e-12 {
        return Err(VerifyError::not_steady(&outcome, wanted));
    }
    let fields = run.fields();
    let (mu, thick) = (viscosity(tau), viscosity(THICK));
    let middle = cells / 2;
    let away: Vec<usize> = (0..cells).filter(|&j| j + 1 != middle && j != middle).collect();
    let mean = away.iter().fold(0.0, |s, &j| s + fields.stress[j][3]) / away.len() as f64;
    let departure = |j: usize| (fields.stress[j][3] / mean - 1.0).abs();
    let u = |j: usize| fields.velocity[j][0];
    // The line through two nodes of the lower layer, away from wall and jump, continued to the jump.
    let (p, q) = (middle / 4, middle - 2);
    let slope = (u(q) - u(p)) / (q - p) as f64;
    Ok(Layers {
        interface: u(q) + slope * (middle as f64 - (q as f64 + 0.5)),
        exact: WALL_SPEED * thick / (mu + thick),
        spread: away.iter().fold(0.0, |m: f64, &j| m.max(departure(j))),
        spread_at_jump: departure(middle - 1).max(departure(middle)),
    })
}

macro_rules! layer_claims {
    ($stress:ident, $interface:ident, $name:literal, $tags:expr, $collision:expr, $value:expr, $basis:expr, $because:expr) => {
        /// Shear stress of the two layers.
        pub const $stress: Claim = Claim {
            id: concat!("layers-stress-", $name),
            title: concat!("H2: the shear stress is constant across a viscosity ratio of 130, operator: ", $name),
            tags: $tags,
            measures: "largest departure of the shear stress from its mean, the two nodes at the jump left out; Couette flow of two layers, tau 0.51 and 1.8",
            reference: Reference { source: "exact: constant stress", uncertainty: 0.0 },
            metric: Metric::LInf,
            ladder: Ladder { parameter: "N (cells across)", short: &[8.0, 16.0], full: &[8.0, 16.0, 32.0] },
            order: None,
            tolerance: Tolerance { value: 1e-10, at: Rung::Every, basis: Basis::Reference, because: "the residual of 1e-14 U per N² steps leaves 1e-14 N² of rounding over a stress of mu U/N: 3e-12 at N = 32; H2 asks for 1e-10" },
            kind: Kind::Verification,
            measure: |backend, cells| {
                let layers = steady(backend, cells as usize, THIN, $collision)?;
                let mut sample = Sample::relative(cells, 1.0 + layers.spread, 1.0).with("at the jump", layers.spread_at_jump);
                sample.error = layers.spread;
                Ok(sample)
            },
        };
        /// Velocity between the two layers.
        pub const $interface: Claim = Claim {
            id: concat!("layers-interface-", $name),
            title: concat!("H2: the velocity between the layers is the exact one, operator: ", $name),
            tags: $tags,
            measures: "velocity at the jump, from the lower layer; Couette flow of two layers, tau 0.51 and 1.8",
            reference: Reference { source: "U mu2/(mu1 + mu2)", uncertainty: 0.0 },
            metric: Metric::Relative,
            ladder: Ladder { parameter: "N (cells across)", short: &[8.0, 12.0, 16.0], full: &[8.0, 12.0, 16.0, 32.0] },
            order: None,
            tolerance: Tolerance { value: $value, at: Rung::Every, basis: $basis, because: $because },
            kind: Kind::Verification,
            measure: |backend, cells| {
                let layers = steady(backend, cells as usize, THIN, $collision)?;
                Ok(Sample::relative(cells, layers.interface, layers.exact))
            },
        };
    };
}

/// A linear profile is an exact solution of these operators on both sides of a jump half-way between
/// two nodes: streaming hands the same stress across.
const EXACT: &str = "a linear profile is exact on both sides of a half-way jump; the residual of 1e-14 U per N² steps adds up over the 30 N² steps of the slowest mode to 3e-13";
/// Their fourth moments see the square of the shear.
const SHEAR: &str = "error of the operator in the square of the lattice shear, (2U/N)² = 6e-6 at N = 8, of which a sixth is allowed (H2 asks for O(1/N))";

layer_claims!(STRESS_BGK, INTERFACE_BGK, "bgk", &["K1", "H2"], OPERATORS[0].1, 1e-11, Basis::Derived, EXACT);
layer_claims!(STRESS_TRT, INTERFACE_TRT, "trt", &["K2", "H2"], OPERATORS[1].1, 1e-11, Basis::Derived, EXACT);
layer_claims!(
    STRESS_CENTRAL,
    INTERFACE_CENTRAL,
    "central-moment",
    &["K3", "H2"],
    OPERATORS[2].1,
    1e-6,
    Basis::AfterSeeing,
    SHEAR
);

/// A long run at the ratio 1300.
pub const LONG: Claim = Claim {
    id: "layers-long-run",
    title: "H2: two layers of viscosity ratio 1300 stay bounded for 1e6/N steps under the default operator",
    tags: &["K3", "H2"],
    measures: "largest speed over the wall speed after 1e6/N steps, N = 64, tau 0.501 and 1.8, started from the exact profile",
    reference: Reference {
        source: "exact: the wall is the fastest place, whose node lies half a cell inside",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "N (cells across)", short: &[64.0], full: &[64.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-3,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "the last node lies half a cell of the thick layer, 1e-5 U, below the wall, plus start-up error of the jump",
    },
    kind: Kind::Verification,
    measure: |backend, cells| {
        let mut run = backend.start(&couette(cells as usize, 0.501, CollisionChoice::default()))?;
        run.advance(1_000_000 / cells as u64)?;
        let fastest = run.fields().velocity.iter().fold(0.0, |m: f64, u| if u[0] <= m { m } else { u[0] });
        Ok(Sample::relative(cells, fastest, WALL_SPEED))
    },
};
