//! The exact flow of a case, in units of its own: length [`Case::length`], stress and shear rate 1 at the wall.

use super::case::{Case, Place};
use crate::claim::VerifyError;
use crate::exact::annulus::Annulus;
use crate::exact::duct::RectangularDuct;
use crate::exact::pipe::Pipe;
use crate::exact::poiseuille::Channel;
use crate::exact::turning_cylinders::TurningCylinders;
use lahar::rheology::Law;

/// An exact flow; films are half channels.
enum Exact {
    Plane(Channel<Law>),
    Duct(RectangularDuct),
    Pipe(Pipe<Law>),
    Annulus(Annulus<Law>),
    Couette,
    Cylinders(TurningCylinders<Law>),
}

/// What a case compares with.
pub struct Flow {
    exact: Exact,
    /// Body force.
    pub force: f64,
    /// Largest speed.
    pub fastest: f64,
    /// Thickness of the thinnest sheared layer.
    pub sheared: f64,
    /// Whether it is the exact flow of the case's law; if not it only sets the scale.
    pub known: bool,
}

impl Flow {
    /// Of a case.
    ///
    /// # Errors
    /// An exact solution has no root.
    pub fn of(case: &Case) -> Result<Self, VerifyError> {
        let law = case.law();
        let failed = |e: crate::exact::ExactError| VerifyError::Numerics {
            what: "an exact flow",
            detail: e.to_string(),
        };
        let layer = 1.0 - case.plug;
        let flow = match case.place {
            Place::Channel | Place::Film { .. } => {
                let exact = Channel { law, half_width: 1.0, force: 1.0 };
                Self {
                    fastest: exact.plug_velocity(),
                    exact: Exact::Plane(exact),
                    force: 1.0,
                    sheared: layer,
                    known: true,
                }
            }
            Place::Duct { aspect } => Self::in_duct(case, aspect),
            Place::Pipe => {
                let exact = Pipe { law, radius: 1.0, force: 2.0 };
                Self {
                    fastest: exact.plug_velocity(),
                    exact: Exact::Pipe(exact),
                    force: 2.0,
                    sheared: layer,
                    known: true,
                }
            }
            Place::Annulus { ratio } => {
                // The mean stress of both walls is 1.
                let force = 2.0 / (1.0 - ratio);
                let exact = Annulus::new(law, ratio, 1.0, force).map_err(failed)?;
                let [inside, outside] = exact.plug();
                let sheared = (inside - ratio).min(1.0 - outside);
                Self {
                    fastest: exact.plug_velocity(),
                    exact: Exact::Annulus(exact),
                    force,
                    sheared,
                    known: true,
                }
            }
            Place::Couette => {
                Self { exact: Exact::Couette, force: 0.0, fastest: 2.0, sheared: 2.0, known: true }
            }
            Place::Cylinders { ratio } => {
                let exact = TurningCylinders::of_stress(law, [ratio, 1.0], 1.0).map_err(failed)?;
                let sheared = exact.yield_radius() - ratio;
                let fastest = exact.velocity(ratio);
                Self { exact: Exact::Cylinders(exact), force: 0.0, fastest, sheared, known: true }
            }
        };
        Ok(flow)
    }

    /// Of a duct with sides of 2 and 2 × aspect.
    fn in_duct(case: &Case, aspect: f64) -> Self {
        // The mean stress at the wall is 1.
        let force = (1.0 + aspect) / aspect;
        let mu = 1.0 - case.plug;
        let exact = RectangularDuct { mu, half_width: 1.0, half_height: aspect, force };
        let newtonian = case.is_newtonian();
        // Other laws: the speed of a pipe of the same wall stress, which only sets the scale.
        let pipe = Pipe { law: case.law(), radius: 1.0, force: 2.0 }.plug_velocity();
        let fastest = if newtonian { exact.velocity(0.0, 0.0) } else { pipe };
        Self { exact: Exact::Duct(exact), force, fastest, sheared: 1.0 - case.plug, known: newtonian }
    }

    /// Speed at a point, from the middle of channels, pipes and cylinders, from the bed of films and from the resting wall of
    /// Couette flows; along the axis, or around it.
    pub fn speed(&self, [y, z]: [f64; 2]) -> f64 {
        let r = libm::sqrt(y * y + z * z);
        match &self.exact {
            Exact::Plane(exact) => exact.velocity(y),
            Exact::Duct(exact) if self.known => exact.velocity(y, z),
            Exact::Duct(exact) => self.fastest * exact.velocity(y, z) / exact.velocity(0.0, 0.0),
            Exact::Pipe(exact) => exact.velocity(r),
            Exact::Annulus(exact) => exact.velocity(r),
            Exact::Couette => (y + 1.0).clamp(0.0, 2.0),
            Exact::Cylinders(exact) => exact.velocity(r),
        }
    }
}
