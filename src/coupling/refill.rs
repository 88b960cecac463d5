//! Populations of cells that a grain gives free \[C3\].

use super::host::Host;
use super::immersed::Immersed;
use crate::free_surface::conversion::neighbourhood;
use crate::lattice::Q;
use crate::lattice::equilibrium::equilibrium;
use crate::setup::suspension::GrainRefill;
use crate::vector::surface_velocity;

/// Largest difference of density to the neighbours that settling a debt may make: what a flow at a tenth of the
/// speed of sound has anyway.
const LARGEST_STEP: f64 = 5e-3;

impl Immersed {
    /// Equilibrium at the mean density of the fluid neighbours; velocity and non-equilibrium part by the rule.
    ///
    /// Neighbours that were given free in the same step have nothing to tell; without any other the cell starts
    /// at the reference density.
    ///
    /// `share`: ρ − 1 that would settle what the grain owes, that is has taken beyond the reference density and not
    /// given back. What goes into grains comes out of them, so that the mass of the fluid does not drift.
    pub(super) fn refill(&self, host: &dyn Host, cell: usize, grain: usize, share: f64) -> [f64; Q] {
        let w = self.motion(grain);
        let arm = self.shape.apart(&self.shape.centre(cell), &self.centre(grain));
        let wall = surface_velocity([w[0], w[1], w[2]], [w[3], w[4], w[5]], arm);
        let stress = self.config.refill == GrainRefill::WithStress;
        let Some(around) = neighbourhood(host, cell, stress) else { return equilibrium(0.0, 1.0, &wall) };
        let d_rho = around.d_rho + (share - around.d_rho).clamp(-LARGEST_STEP, LARGEST_STEP);
        let u = match self.config.refill {
            GrainRefill::WithStress | GrainRefill::Equilibrium => wall,
            GrainRefill::Neighbours => around.u,
        };
        let rest = equilibrium(d_rho, 1.0 + d_rho, &u);
        match self.config.refill {
            GrainRefill::WithStress => std::array::from_fn(|d| rest[d] + around.beyond[d]),
            GrainRefill::Equilibrium | GrainRefill::Neighbours => rest,
        }
    }
}
