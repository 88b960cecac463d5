//! Grains at the end of a run, in numbers.

use crate::dem::Dem;
use crate::fingerprint::Hasher;
use crate::run::summary::{DryPart, GrainFingerprint, GrainPart};
use crate::run::view::View;

/// Fingerprint of a state.
#[must_use]
pub fn fingerprint(dem: &Dem) -> GrainFingerprint {
    let (b, mut hasher) = (dem.bodies(), Hasher::default());
    for i in 0..b.len() {
        let q = b.orientation[i].coords;
        let vectors = [b.position[i], b.velocity[i], b.spin[i]];
        for x in vectors.iter().flat_map(|v| v.iter()).chain(q.iter()) {
            hasher.number(*x);
        }
    }
    GrainFingerprint { step: dem.steps(), hash: hasher.finish(), kinetic_energy_j: dem.kinetic_energy() }
}

/// What is said of grains with or without a fluid.
pub(in crate::run) fn part(grains: &View<'_>) -> GrainPart {
    let dem = grains.dem;
    let ledger = dem.ledger();
    GrainPart {
        number: grains.free().count(),
        driven: dem.bodies().driven.len(),
        left: grains.left.number,
        left_kg: grains.left.mass_kg,
        mass_kg: ledger.mass,
        momentum_n_s: ledger.momentum.into(),
        max_speed_m_per_s: grains.max_speed(),
        contacts: dem.pair_counts().1,
        energies_j: dem.energies(),
    }
}

/// What is said of grains without a fluid.
pub(super) fn dry(grains: &View<'_>) -> DryPart {
    let dem = grains.dem;
    let energies = dem.energies();
    let scale = [energies.lost(), energies.kinetic + energies.rotational, energies.potential.abs()];
    let scale = scale.into_iter().fold(0.0, f64::max);
    let unexplained = grains.unexplained();
    DryPart {
        grains: part(grains),
        energy_residual: if scale > 0.0 { unexplained / scale } else { unexplained },
        lists: dem.list_renewals(),
        fingerprint: fingerprint(dem),
    }
}
