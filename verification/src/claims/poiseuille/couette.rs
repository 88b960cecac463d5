//! Couette flow: moving walls, stress and shear rate with their signs, rotating cylinders.

use std::sync::Arc;

use super::channel::{Scale, Steady, run_steady};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::exact::couette::PlaneCouette;
use crate::exact::taylor_couette::TaylorCouette;
use lahar::collision::{CollisionChoice, OddRate};
use lahar::rheology::Law;
use lahar::setup::{Face, FlowPoint, Setup, SolidMotion};
use lahar::solver::run::Backend;

pub(super) const N: usize = 16;
const LINEAR: Reference =
    Reference { source: "u linear between the walls, σ = σ(U/H) everywhere", uncertainty: 0.0 };

/// Walls moving at `low` and `high` along x, N cells apart; starts from the linear profile if asked.
pub(super) fn between_walls(law: Law, density: f64, low: f64, high: f64, developed: bool) -> Setup {
    let mut setup = Setup::channel(N, law, 0.0);
    setup.faces[1] = [Face::Moving([low, 0.0, 0.0]), Face::Moving([high, 0.0, 0.0])];
    setup.initial = Some(Arc::new(move |[_, j, _]| {
        let rate = if developed { (high - low) / N as f64 } else { 0.0 };
        let start = if developed { low } else { 0.0 };
        let mut gradient = [[0.0; 3]; 3];
        gradient[0][1] = rate;
        FlowPoint { density, velocity: [start + rate * (j as f64 + 0.5), 0.0, 0.0], gradient }
    }));
    setup
}

/// A Newtonian fluid between two moving walls, BGK.
pub const NEWTONIAN: Claim = Claim {
    id: "couette-newtonian",
    title: "A Newtonian fluid between two moving walls has the exact linear profile",
    tags: &["B1", "K1", "L6", "ERRATA 14", "004 Eq 3.37"],
    measures: "max |u − u_exact| / U, walls at −0.01 and 0.03, from rest, N = 16",
    reference: LINEAR,
    metric: Metric::LInf,
    ladder: Ladder { parameter: "tau", short: &[0.55, 0.8, 1.5], full: &[0.55, 0.6, 0.8, 1.0, 1.5, 2.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-11,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "without a force the half-way wall has no slip at any τ; the run stops at a change of 1e-13 of U per \
                  500 steps, of which the slowest mode (N²/π²ν = 1600 steps at τ = 0.55) leaves four times as much, \
                  and rounding is 1e-14",
    },
    kind: Kind::Verification,
    measure: |backend, tau| {
        let mut setup = between_walls(Law::Newtonian { mu: (tau - 0.5) / 3.0 }, 1.0, -0.01, 0.03, false);
        setup.collision = CollisionChoice::Bgk;
        let u = run_steady(backend, &setup, 1e-13, 500, 200_000)?.velocity(0);
        let exact: Vec<f64> = (0..N).map(|j| -0.01 + 0.04 * (j as f64 + 0.5) / N as f64).collect();
        Ok(Sample::linf(tau, &u, &exact))
    },
};

/// Laws of `couette-all-laws`, in units of gap 2, wall speed 1 (docs/references.md §4).
const LAWS: [Law; 5] = [
    Law::Newtonian { mu: 0.2 },
    Law::Bingham { sigma0: 0.5, mu: 0.2 },
    Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 0.33 },
    Law::PowerLaw { k: 0.2, n: 0.6 },
    Law::Papanastasiou { sigma0: 0.5, k: 0.2, n: 0.33, m: 20.0 },
];

/// Every law.
pub const ALL_LAWS: Claim = Claim {
    id: "couette-all-laws",
    title: "Every law carries its own stress between moving walls",
    tags: &["Y1", "Y2", "Y3", "B1"],
    measures: "largest of max |u − u_exact|/U and max |σ_xy − σ|/σ; 1 Newtonian, 2 Bingham, 3 Herschel-Bulkley, \
               4 power law, 5 Papanastasiou; walls at −U/4 and 3U/4, U = 1e-4, N = 16",
    reference: Reference {
        source: "σ(U/H); 0.6 for Bingham, 0.6591072968 for HB (REFERENCES 4)",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "law", short: &[1.0, 2.0, 3.0, 4.0, 5.0], full: &[1.0, 2.0, 3.0, 4.0, 5.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-7,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the Mach term is of the order of the squared wall velocity, 1e-8, times a few where σ hardly \
                  depends on γ̇; the run is steady to 1e-12 per 1000 steps",
    },
    kind: Kind::Verification,
    measure: |backend, number| {
        let law = LAWS[(number as usize).clamp(1, LAWS.len()) - 1];
        let speed = 1e-4;
        // Gap 2 and U = 1: shear rate ½, lattice shear rate U/N.
        let scale = Scale { n: N, rate: 2.0 * speed / N as f64, stress: 0.5 * 2.0 * speed / N as f64 };
        let setup = between_walls(scale.law(&law), 1.0, -0.25 * speed, 0.75 * speed, true);
        let steady = run_steady(backend, &setup, 1e-12, 1000, 200_000)?;
        let exact = PlaneCouette { law, wall_speed: 1.0, gap: 2.0 };
        let stresses: Vec<f64> = steady.fields.stress.iter().map(|s| s[3] / scale.stress).collect();
        let mut sample = Sample::linf(number, &stresses, &[exact.stress(); N]);
        let profile: Vec<f64> = (0..N).map(|j| speed * ((j as f64 + 0.5) / N as f64 - 0.25)).collect();
        let velocity = Sample::linf(number, &steady.velocity(0), &profile).error;
        // Not f64::max, which would drop a NaN.
        sample.error = if velocity <= sample.error { sample.error } else { velocity };
        Ok(sample.with("error of the velocity", velocity))
    },
};

/// du/dy of `shear-rate-couette`.
const RATE: f64 = 1.25e-5;

/// Sign and size of stress and shear rate.
pub const SHEAR_RATE: Claim = Claim {
    id: "shear-rate-couette",
    title: "Stress and shear rate come out with the right sign, factor and density",
    tags: &["Y1", "Y2", "001 Eq 9", "004 Eq 3.27", "004 Eq 3.3", "ERRATA 2", "ERRATA 3"],
    measures: "largest of |σ_xy − ρν du/dy|/ρν|du/dy| and |γ̇ − |du/dy||/|du/dy| in a Couette flow of density 1.2",
    reference: Reference {
        source: "du/dy = U/H = 1.25e-5, σ_xy = +ρν du/dy, γ̇ = √(2S:S) = |du/dy|",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "tau", short: &[0.6, 0.8, 1.5], full: &[0.6, 0.7, 0.8, 1.0, 1.5] },
    order: None,
    tolerance: Tolerance {
        value: 1e-7,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the cubic terms that the equilibrium lacks: of the order of the squared wall velocity, (2e-4)² = 4e-8; rounding is 1e-16 of U = 2e-4",
    },
    kind: Kind::Verification,
    measure: |backend, tau| shear_rate(backend, tau, |s| s),
};

/// Stress σ_xy and shear rate γ̇ as a solver reports them.
#[derive(Clone, Copy)]
pub struct Reported {
    /// σ_xy.
    pub stress: f64,
    /// γ̇.
    pub rate: f64,
    /// ρ.
    pub density: f64,
}

/// The measurement of `shear-rate-couette` with a hook for wrong formulas.
pub fn shear_rate(
    backend: &dyn Backend,
    tau: f64,
    formula: fn(Reported) -> Reported,
) -> Result<Sample, VerifyError> {
    let nu = (tau - 0.5) / 3.0;
    let speed = RATE * N as f64;
    let mut setup = between_walls(Law::Newtonian { mu: nu }, 1.2, 0.0, speed, true);
    setup.collision = CollisionChoice::Bgk;
    let fields = run_steady(backend, &setup, 1e-11, 500, 200_000)?.fields;
    let reported: Vec<Reported> = (0..N)
        .map(|j| Reported {
            stress: fields.stress[j][3],
            rate: fields.shear_rate[j],
            density: fields.density[j],
        })
        .map(formula)
        .collect();
    let each = |f: fn(&Reported) -> f64| -> Vec<f64> { reported.iter().map(f).collect() };
    let mut sample = Sample::linf(tau, &each(|r| r.stress), &[1.2 * nu * RATE; N]);
    let rate = Sample::linf(tau, &each(|r| r.rate), &[RATE; N]).error;
    sample.error = if rate <= sample.error { sample.error } else { rate };
    Ok(sample.with("error of the shear rate", rate))
}

/// Rotating inner cylinder.
pub const TAYLOR: Claim = Claim {
    id: "taylor-couette",
    title: "Around a rotating cylinder on a staircase of cells the error is at most 1.7/R: 5 % at R = 8 and still at 16",
    tags: &["B1", "K2", "ERRATA 18", "004 Eq 3.38"],
    measures: "relative L2 error of u_θ between cylinders of radius R/2 (rotating) and R (at rest), TRT Λ = 3/16, τ = 1",
    reference: Reference { source: "u_θ = A r + B/r (Landau & Lifshitz, §18)", uncertainty: 0.0 },
    metric: Metric::L2,
    ladder: Ladder {
        parameter: "R (cells)",
        short: &[8.0, 12.0, 16.0],
        full: &[8.0, 12.0, 16.0, 24.0, 32.0, 48.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 0.107,
        at: Rung::At(16.0),
        basis: Basis::Derived,
        because: "first order: the staircase puts a wall anywhere within half a cell of its place, 0.29 in root mean \
                  square; the shear there, 5Ω/3 over the root mean square 0.28ΩR of u_θ, makes that 1.72/R",
    },
    kind: Kind::Verification,
    measure: taylor_couette,
};

fn taylor_couette(backend: &dyn Backend, radius: f64) -> Result<Sample, VerifyError> {
    let setup = cylinders(radius);
    // The sudden start leaves momentum of alternating sign, Σ(−1)^(x+t) j_x, which bounce-back keeps for ever: 4e-5.
    let steady = run_steady(backend, &setup, 1e-4, 100, 100_000)?;
    let (computed, reference) = swirl(radius, &setup, &steady);
    Ok(Sample::l2(radius, &computed, &reference).with("steps", steady.steps as f64))
}

/// Angular velocity of the inner cylinder.
fn spin(radius: f64) -> f64 {
    0.02 / radius
}

/// A cell's centre from the axis, in cells.
fn from_axis(setup: &Setup, cell: usize) -> [f64; 2] {
    let middle = 0.5 * setup.extents[0] as f64;
    let [i, j, _] = setup.coordinates(cell);
    [i as f64 + 0.5 - middle, j as f64 + 0.5 - middle]
}

/// Cylinders of radius R/2 (turning) and R (at rest) on a staircase of cells.
pub(super) fn cylinders(radius: f64) -> Setup {
    let cells = 2 * radius as usize + 2;
    let middle = 0.5 * cells as f64;
    let spin = spin(radius);
    let mut setup = Setup::periodic([cells, cells, 1], Law::Newtonian { mu: 1.0 / 6.0 });
    setup.collision = CollisionChoice::Trt(OddRate::fixed(3.0 / 16.0));
    setup.solid_motion = vec![
        SolidMotion { spin: [0.0, 0.0, spin], centre: [middle, middle, 0.5], ..SolidMotion::default() },
        SolidMotion::default(),
    ];
    setup.solids = (0..setup.cells())
        .map(|cell| match from_axis(&setup, cell) {
            [x, y] if (x * x + y * y).sqrt() < 0.5 * radius => 1,
            [x, y] if (x * x + y * y).sqrt() > radius => 2,
            _ => 0,
        })
        .collect();
    setup
}

/// The exact flow between [`cylinders`].
fn between(radius: f64) -> TaylorCouette {
    TaylorCouette {
        inner_radius: 0.5 * radius,
        outer_radius: radius,
        inner_rate: spin(radius),
        outer_rate: 0.0,
    }
}

/// u_θ of every fluid cell, computed and exact.
pub(super) fn swirl(radius: f64, setup: &Setup, steady: &Steady) -> (Vec<f64>, Vec<f64>) {
    let exact = between(radius);
    (0..setup.cells())
        .filter(|&cell| !setup.is_solid(cell))
        .map(|cell| {
            let ([x, y], u) = (from_axis(setup, cell), steady.fields.velocity[cell]);
            let r = (x * x + y * y).sqrt();
            ((x * u[1] - y * u[0]) / r, exact.velocity(r))
        })
        .unzip()
}
