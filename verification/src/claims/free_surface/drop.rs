//! Drops in free fall.

use super::support::ledger;
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::rheology::Law;
use lahar::setup::{BodyForce, FreeSurface, Setup, SurfaceForce};
use lahar::solver::run::{Backend, Run};

const GRAVITY: f64 = 1e-4;
/// 16 cells of fall.
const STEPS: u64 = 566;

/// A sphere in a periodic box with room to fall.
fn drop(radius: f64, force: SurfaceForce) -> Setup {
    let half = libm::ceil(radius) as usize + 3;
    let extents = [2 * half, 2 * half, 2 * half + 18];
    let mut setup = Setup::periodic(extents, Law::Newtonian { mu: 0.1 });
    setup.force = BodyForce::Constant([0.0, 0.0, -GRAVITY]);
    let centre = [half as f64, half as f64, (half + 18) as f64];
    let fills = (0..setup.cells()).map(|cell| inside(setup.coordinates(cell), centre, radius)).collect();
    setup.free_surface = Some(FreeSurface { force, ..FreeSurface::new(fills) });
    // Inside a drop nothing weighs on anything: it starts at the pressure of the gas.
    setup.initial = Some(std::sync::Arc::new(|_| lahar::setup::FlowPoint {
        density: 1.0,
        velocity: [0.0; 3],
        gradient: [[0.0; 3]; 3],
    }));
    setup
}

/// Share of a cell inside a sphere, by 4³ points.
fn inside(at: [usize; 3], centre: [f64; 3], radius: f64) -> f64 {
    let mut count = 0;
    for s in 0..64 {
        let part = [s % 4, (s / 4) % 4, s / 16];
        let d: [f64; 3] =
            std::array::from_fn(|a| at[a] as f64 + (f64::from(part[a]) + 0.5) / 4.0 - centre[a]);
        count += u32::from((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2] < radius * radius);
    }
    f64::from(count) / 64.0
}

/// Height of the centre of mass.
fn height(run: &dyn Run) -> f64 {
    let fields = run.fields();
    let (mut mass, mut moment) = (0.0, 0.0);
    for (cell, fill) in fields.fill.iter().enumerate() {
        let own = fill * fields.density[cell];
        mass += own;
        moment += own * (run.setup().coordinates(cell)[2] as f64 + 0.5);
    }
    moment / mass
}

/// Σφ over the number of cells that hold fluid.
fn mass_per_cell(fill: &[f64]) -> f64 {
    fill.iter().sum::<f64>() / fill.iter().filter(|fill| **fill > 0.0).count() as f64
}

/// Distance fallen against g t²/2.
fn fall(
    backend: &dyn Backend,
    radius: f64,
    force: SurfaceForce,
    share: fn(&[f64]) -> f64,
) -> Result<Sample, VerifyError> {
    let setup = drop(radius, force);
    let expected = setup.free_surface.as_ref().map_or(f64::NAN, |surface| share(&surface.fill));
    let mut run = backend.start(&setup)?;
    let start = height(run.as_ref());
    run.advance(STEPS)?;
    let fallen = start - height(run.as_ref());
    let t = STEPS as f64;
    let end = ledger(run.as_ref());
    Ok(Sample::relative(radius, fallen, expected * 0.5 * GRAVITY * t * t)
        .with("fallen/(g t²/2) − 1 [%]", 100.0 * (fallen / (0.5 * GRAVITY * t * t) - 1.0))
        .with("mass residual", end.mass_residual.abs())
        .with("conversions", end.conversions as f64))
}

const MEASURES: &str = "distance the centre of mass has fallen after 566 steps, g = 1e-4";
const SOURCE: Reference = Reference { source: "g t²/2", uncertainty: 0.0 };
const LADDER: Ladder = Ladder { parameter: "R (cells)", short: &[6.0], full: &[6.0, 9.0, 12.0] };

/// Full gravity.
pub const FULL: Claim = Claim {
    id: "falling-drop-full",
    title: "With full gravity in interface cells a drop falls as g t²/2",
    tags: &["F1", "F3", "F4"],
    measures: MEASURES,
    reference: SOURCE,
    metric: Metric::Relative,
    ladder: LADDER,
    order: None,
    tolerance: Tolerance {
        value: 0.02,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "the pattern of fills lags behind the flow (see `surface-pattern-carried`): the drop leaves some of its mass behind, 0.4/R² of the way",
    },
    kind: Kind::Verification,
    measure: |backend, radius| fall(backend, radius, SurfaceForce::Full, |_| 1.0),
};

/// By fill and inertia.
pub const INERTIA: Claim = Claim {
    id: "falling-drop-by-fill-and-inertia",
    title: "With gravity by fill and inertia a drop falls as g t²/2",
    tags: &["F1", "F3", "F4"],
    measures: MEASURES,
    reference: SOURCE,
    metric: Metric::Relative,
    ladder: LADDER,
    order: None,
    tolerance: Tolerance {
        value: 0.04,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "as with full gravity, and the smoothed acceleration, 0 at the start, is late by 16 of the 566 steps for \
                  the quarter of the inertia that is gas (R = 6): 1.4 %",
    },
    kind: Kind::Verification,
    measure: |backend, radius| fall(backend, radius, SurfaceForce::ByFillAndInertia, |_| 1.0),
};

/// By fill: too slow.
pub const BY_FILL: Claim = Claim {
    id: "falling-drop-by-fill",
    title: "With gravity by fill, the default, a drop falls too slowly: its surface cells have the inertia of full cells",
    tags: &["F1", "F3", "F4"],
    measures: MEASURES,
    reference: Reference {
        source: "(Σφ/number of fluid cells) g t²/2: a cell's populations weigh φ but have the inertia of a full cell",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: LADDER,
    order: None,
    tolerance: Tolerance {
        value: 0.1,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "the number of surface cells changes as the drop crosses the grid; part of the reflection at the gas \
                  acts on it too",
    },
    kind: Kind::PredictedFailure,
    measure: |backend, radius| fall(backend, radius, SurfaceForce::ByFill, mass_per_cell),
};
