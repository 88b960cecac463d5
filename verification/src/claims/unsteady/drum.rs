//! Unyielded material in a turning drum.

use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::rheology::Law;
use lahar::setup::{Setup, SolidMotion};
use lahar::solver::run::Backend;

/// Radius of the drum, cells, and speed of its rim, cells per step.
const RADIUS: f64 = 10.0;
const RIM: f64 = 0.02;

fn drum() -> Setup {
    let cells = 2 * RADIUS as usize + 4;
    let centre = [0.5 * cells as f64, 0.5 * cells as f64, 0.5];
    // Yield stress half of ρ u² at the rim, Reynolds number 5.
    let law = Law::Bingham { sigma0: 0.5 * RIM * RIM, mu: RIM * RADIUS / 5.0 };
    let mut setup = Setup::periodic([cells, cells, 1], law);
    let outside = |cell| {
        let at = setup.coordinates(cell);
        libm::hypot(at[0] as f64 + 0.5 - centre[0], at[1] as f64 + 0.5 - centre[1]) > RADIUS
    };
    setup.solids = (0..setup.cells()).map(|cell| u8::from(outside(cell))).collect();
    let spin = [0.0, 0.0, RIM / RADIUS];
    setup.solid_motion = vec![SolidMotion { spin, centre, ..SolidMotion::default() }];
    setup
}

fn measure(backend: &dyn Backend, turns: f64) -> Result<Sample, VerifyError> {
    let setup = drum();
    let mut run = backend.start(&setup)?;
    run.advance((turns * std::f64::consts::TAU * RADIUS / RIM) as u64)?;
    let (fields, [cx, cy, _]) = (run.fields(), setup.solid_motion[0].centre);
    let spin = RIM / RADIUS;
    let fluid = || (0..setup.cells()).filter(|&cell| !setup.is_solid(cell));
    let off = |cell: usize| {
        let (at, u) = (setup.coordinates(cell), fields.velocity[cell]);
        let [x, y] = [at[0] as f64 + 0.5 - cx, at[1] as f64 + 0.5 - cy];
        libm::hypot(u[0] + spin * y, u[1] - spin * x) / RIM
    };
    // Not f64::max, which would drop a NaN.
    let worst = fluid().map(off).fold(0.0, |worst: f64, x| if x <= worst { worst } else { x });
    let rigid = fluid().filter(|&cell| fields.omega[cell] == 0.0).count();
    Ok(Sample::absolute(turns, worst, 0.0)
        .with("share of cells that are unyielded", rigid as f64 / run.fluid_cells() as f64)
        .with("change of mass per cell", run.totals().mass_excess / run.fluid_cells() as f64))
}

/// Rigid mud in a drum.
pub const RIGID: Claim = Claim {
    id: "drum-rigid",
    title: "Unyielded mud in a turning drum turns with it",
    tags: &["B1", "B3", "K3", "Y3"],
    measures: "largest |u − Ω × r| over all cells, over the speed of the rim; Bingham, from rest, R = 10, rim 0.02",
    reference: Reference { source: "rigid rotation", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "turns", short: &[8.0], full: &[8.0, 80.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-3,
        at: Rung::Every,
        basis: Basis::Reference,
        because: "a thousandth of the rim was asked for before anything was measured; links to solids know the equilibrium \
                  to second order, which leaves u² = 4e-4 of u at the rim",
    },
    kind: Kind::Verification,
    measure,
};
