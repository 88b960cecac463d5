//! What the claims of this study share: boxes with a surface, speeds, pseudo-random fills.

use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, FreeSurface, Setup};
use lahar::solver::run::{Ledger, Run};

/// A box with walls on all faces but periodic along y when it is one cell thick, force along −z, filled by
/// `fill` of the cell's coordinates.
pub fn tank(extents: [usize; 3], law: Law, gravity: f64, fill: impl Fn([usize; 3]) -> f64) -> Setup {
    let mut setup = Setup::periodic(extents, law);
    for axis in 0..3 {
        if extents[axis] > 1 {
            setup.faces[axis] = [Face::NoSlip; 2];
        }
    }
    setup.force = BodyForce::Constant([0.0, 0.0, -gravity]);
    let fills = (0..setup.cells()).map(|cell| fill(setup.coordinates(cell))).collect();
    setup.free_surface = Some(FreeSurface::new(fills));
    setup
}

/// Fill of the cell at height k under a level surface.
pub fn level(height: f64, k: usize) -> f64 {
    (height - k as f64).clamp(0.0, 1.0)
}

/// Largest speed; NaN if there is one.
pub fn speed(run: &dyn Run) -> f64 {
    let square = |u: &[f64; 3]| (u[0] * u[0] + u[1] * u[1]) + u[2] * u[2];
    let largest = |m: f64, x: f64| if x <= m || m.is_nan() { m } else { x };
    run.fields().velocity.iter().map(square).fold(0.0, largest).sqrt()
}

/// The ledger of a run with a surface; NaN residuals without one.
pub fn ledger(run: &dyn Run) -> Ledger {
    let none = Ledger { mass_residual: f64::NAN, momentum_residual: f64::NAN, ..Ledger::default() };
    run.ledger().unwrap_or(none)
}

/// Numbers in 0..1 from a 64-bit linear congruential generator (Knuth's constants), the same every run.
pub struct Dice(pub u64);

impl Dice {
    /// The next number, from the upper 53 bits.
    pub fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}
