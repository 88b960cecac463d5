//! A channel with side walls: half a duct.

use super::support::{ledger, level};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::exact::duct::RectangularDuct;
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, FreeSurface, Setup};
use lahar::solver::run::Backend;
use lahar::solver::steady::{SteadyRule, run_to_steady};

/// τ = 1.
const VISCOSITY: f64 = 1.0 / 6.0;

/// Width over depth in whole cells.
const WIDTH: f64 = 2.0;

/// 3 g h.
const PRESSURE: f64 = 1e-4;

fn flow(backend: &dyn Backend, depth: f64) -> Result<Sample, VerifyError> {
    let width = WIDTH * depth.round();
    let gravity = PRESSURE / (3.0 * depth);
    let along = 0.1 * gravity;
    let mut setup =
        Setup::periodic([1, width as usize, depth.ceil() as usize + 2], Law::Newtonian { mu: VISCOSITY });
    setup.faces[1] = [Face::NoSlip; 2];
    setup.faces[2] = [Face::NoSlip; 2];
    setup.force = BodyForce::Constant([along, 0.0, -gravity]);
    let fill = (0..setup.cells()).map(|cell| level(depth, setup.coordinates(cell)[2])).collect();
    setup.free_surface = Some(FreeSurface::new(fill));
    let mut run = backend.start(&setup)?;
    // The slowest mode decays as exp(−ν (π/2h)² t) and faster.
    let interval = 50 + (4.0 * depth * depth / (9.8 * VISCOSITY)) as u64;
    let rule = SteadyRule { tolerance: 1e-6, interval, max_steps: 80 * interval };
    let outcome = run_to_steady(run.as_mut(), rule)?;
    if !outcome.steady {
        return Err(VerifyError::not_steady(&outcome, rule.tolerance));
    }
    let fields = run.fields();
    let fastest = fields.velocity.iter().map(|u| u[0]).fold(0.0, f64::max);
    let flux: f64 = fields.velocity.iter().zip(&fields.fill).map(|(u, fill)| u[0] * fill).sum();
    // The surface is the plane of symmetry of a duct twice as deep; the uppermost cell lies around it, half a cell
    // beside the middle.
    let duct = RectangularDuct { mu: VISCOSITY, half_width: 0.5 * width, half_height: depth, force: along };
    let (exact, mean) = (duct.velocity(0.5, depth.ceil() - 0.5 - depth), duct.mean_velocity());
    let end = ledger(run.as_ref());
    Ok(Sample::relative(depth, fastest, exact)
        .with("discharge over the exact one", flux / (mean * width * depth))
        .with("conversions", end.conversions as f64)
        .with("mass residual", end.mass_residual.abs()))
}

/// Largest velocity at any level.
pub const LEVEL: Claim = Claim {
    id: "trough-level",
    title: "A channel with side walls flows as half a duct does, wherever the surface lies within a cell",
    tags: &["F1", "F2", "F3", "F9"],
    measures: "largest velocity in a channel twice as wide as deep, relative",
    reference: Reference {
        source: "rectangular duct, White, Viscous Fluid Flow, Sec. 3-3.3",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "h (cells)",
        short: &[9.98, 10.02, 10.25, 10.5, 10.75],
        full: &[
            5.02, 5.5, 9.98, 10.0, 10.02, 10.1, 10.25, 10.4, 10.5, 10.6, 10.75, 10.9, 14.02, 14.5, 19.98,
            20.02, 20.25, 20.5, 20.75,
        ],
    },
    order: None,
    tolerance: Tolerance {
        value: 0.02,
        at: Rung::Every,
        basis: Basis::Reference,
        because: "the aim for 10 cells; with all of the lateral stress in partly filled cells it is −11.7 % just above a cell face",
    },
    kind: Kind::Verification,
    measure: flow,
};
