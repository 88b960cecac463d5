//! Fixed spheres in their place \[B4\].

use super::channel::run_steady;
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::exact::suspension::cubic_array::sangani_acrivos;
use lahar::boundary::cut::cut_cells;
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Setup, SolidMotion};
use lahar::solver::run::Backend;

/// A periodic box of 4R a side with a fixed sphere beside its middle, driven by a body force.
fn spheres(radius: f64, force: f64) -> Setup {
    let cells = (4.0 * radius) as usize;
    let mut setup = Setup::periodic([cells; 3], Law::Newtonian { mu: 1.0 / 6.0 });
    setup.force = BodyForce::Constant([force, 0.0, 0.0]);
    setup.solid_motion = vec![SolidMotion::default()];
    let middle = 0.5 * cells as f64;
    let centre = [middle + 0.21, middle - 0.13, middle + 0.37];
    let inside =
        |p: [f64; 3]| (0..3).map(|a| (p[a] - centre[a]) * (p[a] - centre[a])).sum::<f64>().sqrt() < radius;
    let solid = |cell: usize| inside(setup.coordinates(cell).map(|x| x as f64 + 0.5));
    setup.solids = (0..setup.cells()).map(|cell| u8::from(solid(cell))).collect();
    setup.cuts = cut_cells(&setup, inside).into();
    setup
}

/// Drag of a fixed sphere.
pub const SPHERE: Claim = Claim {
    id: "fixed-sphere-drag-cut",
    title: "The drag of a fixed sphere of 5 cells in its place is right within 2 %",
    tags: &["B4", "K3"],
    measures: "force on the fluid of a cubic array, fraction π/48, over 6πμRU, U the mean over the whole box; default operator, τ = 1",
    reference: Reference {
        source: "Sangani & Acrivos 1982, Int. J. Multiphase Flow 8, 343, series of 31 terms",
        uncertainty: 1e-6,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "R (cells)", short: &[4.0, 5.0], full: &[4.0, 5.0, 7.0, 10.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.02,
        at: Rung::At(5.0),
        basis: Basis::Reference,
        because: "the bound that was asked for at 10 cells before anything was measured",
    },
    kind: Kind::Verification,
    measure: sphere_drag,
};

fn sphere_drag(backend: &dyn Backend, radius: f64) -> Result<Sample, VerifyError> {
    let (mu, side) = (1.0 / 6.0, 4.0 * radius);
    let factor = sangani_acrivos(core::f64::consts::PI / 48.0)?;
    let stokes = 6.0 * core::f64::consts::PI * mu * radius;
    // A mean speed of 1e-3 cells per step: Reynolds numbers below 0.1.
    let force = 1e-3 * stokes * factor / (side * side * side);
    let setup = spheres(radius, force);
    let interval = (0.2 * side * side) as u64;
    let steady = run_steady(backend, &setup, 1e-4, interval, 200 * interval)?;
    let sum: f64 = (0..setup.cells())
        .filter(|&cell| !setup.is_solid(cell))
        .map(|cell| steady.fields.velocity[cell][0])
        .sum();
    let drag = force * side * side * side / (stokes * (sum / (side * side * side)));
    Ok(Sample::relative(radius, drag, factor).with("steps", steady.steps as f64))
}
