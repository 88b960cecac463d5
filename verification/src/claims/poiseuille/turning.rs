//! Cylinders made of stairs: the mass between turning ones, torques, and the balance of an array.

use super::couette::cylinders;
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::exact::taylor_couette::TaylorCouette;
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Setup, SolidMotion};
use lahar::solver::run::Backend;

/// Radius of the outer cylinder, cells; the inner one has half of it.
const OUTER: f64 = 16.0;
/// Speed of the inner rim, cells per step.
const RIM: f64 = 0.04;

/// A ring of fluid around a turning cylinder whose axis lies beside the corners of the grid, so that no two
/// quarters of its stairs are alike.
fn ring() -> Setup {
    let cells = 2 * OUTER as usize + 4;
    let centre = [0.5 * cells as f64 + 0.21, 0.5 * cells as f64 - 0.13, 0.5];
    let mut setup = Setup::periodic([cells, cells, 1], Law::Newtonian { mu: 0.2 });
    let radius = |cell| {
        let at = setup.coordinates(cell);
        libm::hypot(at[0] as f64 + 0.5 - centre[0], at[1] as f64 + 0.5 - centre[1])
    };
    let number = |cell| match radius(cell) {
        r if r < 0.5 * OUTER => 1,
        r if r > OUTER => 2,
        _ => 0,
    };
    setup.solids = (0..setup.cells()).map(number).collect();
    let spin = [0.0, 0.0, RIM / (0.5 * OUTER)];
    setup.solid_motion = vec![SolidMotion { spin, centre, ..SolidMotion::default() }, SolidMotion::default()];
    setup
}

fn ring_mass(backend: &dyn Backend, turns: f64) -> Result<Sample, VerifyError> {
    let setup = ring();
    let mut run = backend.start(&setup)?;
    run.advance((turns * std::f64::consts::TAU * 0.5 * OUTER / RIM) as u64)?;
    let change = run.totals().mass_excess / run.fluid_cells() as f64;
    let fields = run.fields();
    let fluid = (0..setup.cells()).filter(|&cell| !setup.is_solid(cell));
    let (least, most) = fluid
        .map(|cell| fields.density[cell])
        .fold((f64::INFINITY, 0.0), |(least, most), rho| (f64::min(least, rho), f64::max(most, rho)));
    Ok(Sample::absolute(turns, change, 0.0)
        .with("largest − least density", most - least)
        .with("fluid cells", run.fluid_cells() as f64))
}

/// Mass of a closed ring.
pub const RING: Claim = Claim {
    id: "turning-ring-mass",
    title: "The fluid around a turning cylinder made of stairs keeps its mass",
    tags: &["B1"],
    measures: "Σ(ρ − 1) over the fluid cells, per cell, after turns of the inner cylinder; R = 8 and 16, rim 0.04",
    reference: Reference { source: "conservation of mass", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "turns", short: &[1.0, 4.0], full: &[1.0, 4.0, 80.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-12,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding: 1e-18 per cell and step in either sense, over 1e5 steps; links that take ρ times their flux \
                  gained 4e-4 per turn",
    },
    kind: Kind::Verification,
    measure: ring_mass,
};

/// Balance of a periodic array: what the force brings in goes into the cylinder.
fn array(backend: &dyn Backend, steps: f64) -> Result<Sample, VerifyError> {
    let force = [2e-6, 1e-6, 0.0];
    let mut setup = Setup::periodic([24, 24, 2], Law::Bingham { sigma0: 1e-6, mu: 0.15 });
    let solid = |cell| {
        let at = setup.coordinates(cell);
        libm::hypot(at[0] as f64 - 11.3, at[1] as f64 - 11.9) < 5.2
    };
    setup.solids = (0..setup.cells()).map(|cell| u8::from(solid(cell))).collect();
    setup.solid_motion = vec![SolidMotion::default()];
    setup.loads = true;
    setup.force = BodyForce::Constant(force);
    let mut run = backend.start(&setup)?;
    let before = run.totals().momentum;
    run.advance(steps as u64)?;
    let (after, load) = (run.totals().momentum, run.loads().first().copied().unwrap_or_default());
    let volume = run.fluid_cells() as f64;
    let left = |a: usize| after[a] - before[a] - (force[a] * volume * steps - load.impulse[a]);
    let whole = force[0] * volume * steps;
    let worst = (0..3).map(left).fold(0.0, |worst: f64, x| if x.abs() <= worst { worst } else { x.abs() });
    Ok(Sample::absolute(steps, worst / whole, 0.0)
        .with("force on the cylinder/body force", load.force[0] / (force[0] * volume))
        .with("torque about its centre [force × cells]", load.torque[2] / (force[0] * volume)))
}

/// Momentum balance without a surface.
pub const ARRAY: Claim = Claim {
    id: "array-momentum-balance",
    title: "The load on a cylinder in a periodic box is the body force less what sets the fluid in motion",
    tags: &["C7", "B1"],
    measures: "largest component of Σρu − (F V t − impulse on the cylinder), over F V t; Bingham, from rest",
    reference: Reference { source: "conservation of momentum", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "steps", short: &[100.0, 3000.0], full: &[100.0, 3000.0, 100_000.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-11,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding: 1e-17 of each population and step, in 1e3 cells, against F V = 2e-3 per step, and the sum of \
                  their roots",
    },
    kind: Kind::Verification,
    measure: array,
};

/// Torques on both [`cylinders`].
fn torque(backend: &dyn Backend, outer: f64) -> Result<Sample, VerifyError> {
    let (inner, spin, mu) = (0.5 * outer, 0.02 / outer, 1.0 / 6.0);
    let mut setup = cylinders(outer);
    // A torque is about the centre of its solid.
    for solid in &mut setup.solid_motion {
        solid.centre = [0.5 * setup.extents[0] as f64, 0.5 * setup.extents[1] as f64, 0.5];
    }
    setup.loads = true;
    let mut run = backend.start(&setup)?;
    // Thirty times the slowest decay, (π/gap)² ν: 1e-13 of the start-up is left.
    let gap = outer - inner;
    run.advance((30.0 * gap * gap / (std::f64::consts::PI * std::f64::consts::PI * mu)) as u64)?;
    let loads = run.loads();
    let exact = TaylorCouette { inner_radius: inner, outer_radius: outer, inner_rate: spin, outer_rate: 0.0 };
    let on = |solid: usize| loads.get(solid).map_or(f64::NAN, |load| load.torque[2]);
    let sideways = loads.first().map_or(f64::NAN, |load| load.force[0]);
    Ok(Sample::relative(outer, on(1), exact.torque_per_length(mu))
        .with("sum of both torques/torque", (on(0) + on(1)) / on(1))
        .with("sideways force × R/torque", sideways * outer / on(1)))
}

/// Torque between cylinders.
pub const TORQUE: Claim = Claim {
    id: "taylor-couette-torque",
    title: "The torque between turning cylinders is 4πμB, as near as stairs allow",
    tags: &["C7", "B1"],
    measures: "torque on the outer cylinder by momentum exchange, R₁ = R₂/2, TRT, τ = 1",
    reference: Reference {
        source: "4πμ (Ω₁ − Ω₂) R₁²R₂²/(R₂² − R₁²); Landau & Lifshitz §18",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "R₂ (cells)",
        short: &[8.0, 12.0, 16.0],
        full: &[8.0, 12.0, 16.0, 24.0, 32.0, 48.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 0.25,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the torque goes as R₁²R₂²/(R₂² − R₁²); stairs put each wall up to a third of a cell from its place, which \
                  at R₂ = 8 is up to 8 % of R₁",
    },
    kind: Kind::Verification,
    measure: torque,
};
