//! What a coupled run tells about its grains.

use super::L3;
use super::books::CouplingBooks;
use super::immersed::Immersed;
use crate::fingerprint::Hasher;

/// Sums over all free grains, lattice units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GrainTotals {
    /// Σ m.
    pub mass: f64,
    /// Σ m U.
    pub momentum: L3,
    /// Σ ½ m U² + ½ ω·Jω.
    pub kinetic_energy: f64,
}

impl Immersed {
    /// What went between fluid and grains so far.
    #[must_use]
    pub(crate) fn books(&self) -> &CouplingBooks {
        &self.books
    }

    /// Sums over all free grains, in order.
    #[must_use]
    pub fn totals(&self) -> GrainTotals {
        let mut totals = GrainTotals::default();
        let bodies = self.dem.bodies();
        let energy = self.config.units.rho0_kg_per_m3
            * self.config.units.dx_m
            * self.config.units.dx_m
            * self.config.units.dx_m
            * self.config.units.velocity_unit()
            * self.config.units.velocity_unit();
        for grain in (0..self.grains()).filter(|&grain| !self.is_driven(grain)) {
            let (mass, w) = (self.mass(grain), self.motion(grain));
            totals.mass += mass;
            for a in 0..3 {
                totals.momentum[a] += mass * w[a];
            }
            totals.kinetic_energy +=
                (bodies.translational_energy(grain) + bodies.rotational_energy(grain)) / energy;
        }
        totals
    }

    /// Adds the state of the grains to a fingerprint.
    pub(crate) fn add_to_hash(&self, hasher: &mut Hasher) {
        let bodies = self.dem.bodies();
        for i in 0..bodies.len() {
            let vectors = [
                &bodies.position[i],
                &bodies.velocity[i],
                &bodies.spin[i],
                &bodies.force[i],
                &bodies.torque[i],
            ];
            for v in vectors.into_iter().flat_map(|v| v.iter()) {
                hasher.number(*v);
            }
            for q in bodies.orientation[i].coords.iter() {
                hasher.number(*q);
            }
            // Of a driven grain no state follows from what it meets.
            let contact = if self.is_driven(i) { [0.0; 6] } else { self.contact[i] };
            for x in self.loads[i].total().iter().chain(&contact) {
                hasher.number(*x);
            }
            for cell in &self.coverage.of(i).cells {
                hasher.number(f64::from(*cell));
            }
        }
    }
}
