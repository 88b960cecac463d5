//! Populations of cells that a grain gives free \[C3\].

use super::config::{GrainRefill, RefillMass};
use super::host::Host;
use super::immersed::Immersed;
use crate::boundary::bounce_back::surface_velocity;
use crate::boundary::links::Source;
use crate::lattice::equilibrium::equilibrium;
use crate::lattice::moments::{density_excess, moments};
use crate::lattice::{C, Q};
use crate::solver::conversion::mirrored;

/// Largest difference of density to the neighbours that settling a debt may make: what a flow at a tenth of the
/// speed of sound has anyway.
const LARGEST_STEP: f64 = 5e-3;

impl Immersed {
    /// Equilibrium at the mean density of the fluid neighbours; velocity and non-equilibrium part by the rule.
    ///
    /// Neighbours that were given free in the same step have nothing to tell; without any other the cell starts
    /// at the reference density.
    pub(super) fn refill(&self, host: &dyn Host, cell: usize, grain: usize, share: f64) -> [f64; Q] {
        let w = self.motion(grain);
        let arm = self.shape.apart(&self.shape.centre(cell), &self.centre(grain));
        let wall = surface_velocity([w[0], w[1], w[2]], [w[3], w[4], w[5]], arm);
        let mut rho = [0.0; Q];
        let mut u = [[0.0; Q]; 3];
        let mut parts = [[0.0; Q]; Q];
        let mut count = 0;
        for i in 1..Q {
            let Source::Cell { cell: from, direction } = self.shape.source(host.setup(), cell, i) else {
                continue;
            };
            if !Self::is_fluid(host, from as usize) {
                continue;
            }
            let direction = usize::from(direction);
            count += 1;
            let f = host.arrived(from as usize);
            let m = moments(&f, &[0.0; 3]);
            rho[i] = m.d_rho;
            let rest = equilibrium(m.d_rho, m.rho, &m.u);
            for a in 0..3 {
                u[a][i] = mirrored(i, direction, a) * m.u[a];
            }
            for (d, part) in parts.iter_mut().enumerate() {
                let from = reflected(d, i, direction);
                part[i] = f[from] - rest[from];
            }
        }
        if count == 0 {
            return equilibrium(0.0, 1.0, &wall);
        }
        let mean = |values: &[f64; Q]| density_excess(values) / f64::from(count);
        let around = mean(&rho);
        let d_rho = match self.config.refill_mass {
            RefillMass::Neutral => around + (share - around).clamp(-LARGEST_STEP, LARGEST_STEP),
            RefillMass::Neighbours => around,
        };
        let u = match self.config.refill {
            GrainRefill::WithStress | GrainRefill::Equilibrium => wall,
            GrainRefill::Neighbours => [mean(&u[0]), mean(&u[1]), mean(&u[2])],
        };
        let rest = equilibrium(d_rho, 1.0 + d_rho, &u);
        match self.config.refill {
            GrainRefill::WithStress => std::array::from_fn(|d| rest[d] + mean(&parts[d])),
            GrainRefill::Equilibrium | GrainRefill::Neighbours => rest,
        }
    }
}

/// Direction at the source that direction `d` at the receiver becomes through the mirror planes between direction `i`
/// and `from`.
fn reflected(d: usize, i: usize, from: usize) -> usize {
    let c = std::array::from_fn(|a| if C[i][a] == C[from][a] { C[d][a] } else { -C[d][a] });
    crate::lattice::direction(c).unwrap_or(d)
}
