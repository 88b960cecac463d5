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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::{Grain, Material, Materials, NormalLaw, PairProperties, Setup, V3};
    use crate::run::view::Left;

    /// One sphere of 1 kg and a radius of 1/2 m, which holds 0.1 kg m² of inertia.
    fn sphere(velocity: V3, spin: V3, gravity: V3) -> Setup {
        let (name, volume) = ("stone".to_owned(), 4.0 / 3.0 * std::f64::consts::PI * 0.125);
        let material = Material { name, density_kg_m3: 1.0 / volume, young_pa: 1e7, poisson: 0.25 };
        let pair = PairProperties {
            normal: NormalLaw::Tsuji { restitution: 0.5 },
            friction: 0.0,
            rolling_friction: 0.0,
            tangential_damping: 0.0,
        };
        let mut setup = Setup::new(Materials::single(material, pair));
        setup.grains = vec![Grain::sphere(0.5, V3::new(0.0, 0.0, 3.0), 0).moving(velocity).spinning(spin)];
        setup.gravity = gravity;
        setup
    }

    /// The residual of a sphere whose balance was `more` less at time 0; `left`: what grains took along.
    fn residual(setup: &Setup, more: f64, left: f64) -> f64 {
        let dem = Dem::new(setup).unwrap();
        let left = Left { energy_j: left, ..Left::default() };
        let start = dem.energies().balance() - more;
        dry(&View { dem: &dem, setup, ids: &[0], left, start, time: 0.0 }).energy_residual
    }

    /// Unexplained energy over the largest of what is lost, in motion, and stored in height, of a sphere that has known ones.
    #[test]
    fn exact_share_of_unexplained_energy() {
        let (still, along) = (V3::zeros(), V3::new(4.0, 0.0, 0.0));
        let close = |found: f64, expected: f64| {
            // Few operations, each rounded.
            assert!((found / expected - 1.0).abs() < 1e-14, "{found} {expected}");
        };
        // ½ · 1 kg · (4 m/s)² = 8 J.
        close(residual(&sphere(along, still, still), 2.0, 0.0), 0.25);
        close(residual(&sphere(along, still, still), -2.0, 0.0), -0.25);
        // What left had a part of the balance.
        close(residual(&sphere(along, still, still), 2.0, 4.0), 0.75);
        // ½ · 0.1 kg m² · (20/s)² = 20 J of spin on top: 28 J.
        close(residual(&sphere(along, V3::new(0.0, 20.0, 0.0), still), 7.0, 0.0), 0.25);
        // 1 kg, 10 m/s², 3 m above or below the level of no height: 30 J, more than 8 J.
        for gravity in [V3::new(0.0, 0.0, -10.0), V3::new(0.0, 0.0, 10.0)] {
            close(residual(&sphere(along, still, gravity), 3.0, 0.0), 0.1);
        }
    }

    /// Where there is no energy at all to compare with, J.
    #[test]
    fn limit_of_a_sphere_without_energy() {
        let still = sphere(V3::zeros(), V3::zeros(), V3::zeros());
        assert_eq!(residual(&still, 0.5, 0.0), 0.5);
        assert_eq!(residual(&still, 0.0, 0.0), 0.0);
    }
}
