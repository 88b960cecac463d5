//! Voids below the surface of a spreading block.

use super::support::ledger;
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, FreeSurface, Setup};
use lahar::solver::run::Backend;

/// A block as high as wide, behind a mirror plane, with room to spread to three times its width; Bingham number of a
/// slump.
fn block(height: usize) -> Setup {
    let weight = 0.02 / (3.0 * height as f64);
    let law = Law::Bingham { sigma0: 0.05 * weight * height as f64, mu: 1.0 / 6.0 };
    let mut setup = Setup::periodic([3 * height, 1, height + 3], law);
    setup.faces[0] = [Face::FreeSlip, Face::NoSlip];
    setup.faces[2] = [Face::NoSlip; 2];
    setup.force = BodyForce::Constant([0.0, 0.0, -weight]);
    let fill = (0..setup.cells()).map(|cell| {
        let [i, _, k] = setup.coordinates(cell);
        if i < height && k < height { 1.0 } else { 0.0 }
    });
    setup.free_surface = Some(FreeSurface::new(fill.collect()));
    setup
}

/// Volume that is missing below the surface in the mean of ten outputs, over that of a row of the block.
fn share(backend: &dyn Backend, height: f64) -> Result<Sample, VerifyError> {
    let setup = block(height as usize);
    let weight = 0.02 / (3.0 * height);
    // A hundred times the time in which a layer of that depth falls by itself against its viscosity.
    let steps = 100.0 / (weight * height * 6.0);
    let mut run = backend.start(&setup)?;
    let (mut worst, mut last, mut sum) = (0.0_f64, 0.0, 0.0);
    for _ in 0..10 {
        run.advance((0.1 * steps).round() as u64)?;
        last = ledger(run.as_ref()).voids;
        worst = if last > worst { last } else { worst };
        sum += last;
    }
    let end = ledger(run.as_ref());
    Ok(Sample::absolute(height, 0.1 * sum / height, 0.0)
        .with("largest [cells]", worst)
        .with("at the end [cells]", last)
        .with("largest share of the volume [%]", 100.0 * worst / (height * height))
        .with("conversions", end.conversions as f64)
        .with("mass residual", end.mass_residual.abs()))
}

/// Voids close.
pub const CLOSE: Claim = Claim {
    id: "voids-close",
    title: "Less than the cell at the toe is missing below the surface of a block of mud that spreads",
    tags: &["F1", "F4", "F8"],
    measures: "volume missing in partly filled cells without gas neighbour, over that of a row of the block, mean of ten \
               outputs",
    reference: Reference { source: "incompressible mud has no voids", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "h (cells)", short: &[8.0, 12.0], full: &[8.0, 12.0, 16.0, 24.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.045,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "the toe buries a cell on the floor before that is full, one at a time: 0.022 to 0.037 on 8 to 24 cells, and 0.056 \
                  on 12 where they are kept",
    },
    kind: Kind::Verification,
    measure: share,
};
