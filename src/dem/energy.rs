//! Books of energy and momentum.

use super::V3;
use serde::{Deserialize, Serialize};

/// Where the energy is and where it went, J. Driven bodies do not count.
///
/// `kinetic + spin + potential + elastic terms + lost terms − work terms` stays at its start value, up to the
/// integrator's error (second order in the step).
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Energies {
    /// Translational kinetic energy.
    pub kinetic: f64,
    /// Rotational kinetic energy.
    pub rotational: f64,
    /// −m g·x.
    pub potential: f64,
    /// Stored by overlaps.
    pub elastic_normal: f64,
    /// Stored by tangential springs.
    pub elastic_tangential: f64,
    /// Stored by rolling springs.
    pub elastic_rolling: f64,
    /// Lost to normal damping (and to the cut-off of attraction).
    pub lost_normal: f64,
    /// Lost to friction: slip, tangential dashpot, change of stiffness.
    pub lost_friction: f64,
    /// Lost to rolling resistance.
    pub lost_rolling: f64,
    /// Work done on the grains by external forces and torques.
    pub work_external: f64,
    /// Work done on the grains by moving walls and driven bodies.
    pub work_driven: f64,
}

impl Energies {
    /// The sum that stays constant.
    pub fn balance(&self) -> f64 {
        self.mechanical() + self.lost() - self.work_external - self.work_driven
    }

    /// Kinetic + potential + elastic.
    pub fn mechanical(&self) -> f64 {
        self.kinetic
            + self.rotational
            + self.potential
            + self.elastic_normal
            + self.elastic_tangential
            + self.elastic_rolling
    }

    /// Everything dissipated.
    pub fn lost(&self) -> f64 {
        self.lost_normal + self.lost_friction + self.lost_rolling
    }
}

/// Sums over all bodies that are not driven, in the order of their numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ledger {
    /// kg.
    pub mass: f64,
    /// kg m/s.
    pub momentum: V3,
    /// About the origin, kg m²/s.
    pub angular_momentum: V3,
}
