//! Turning cylinders made of stairs: the mass between them.

use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::rheology::Law;
use lahar::setup::{Setup, SolidMotion};
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
    let (least, most) = fluid.map(|cell| fields.density[cell]).fold((f64::INFINITY, 0.0), |(least, most), rho| {
        (f64::min(least, rho), f64::max(most, rho))
    });
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
