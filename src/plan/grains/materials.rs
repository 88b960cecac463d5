//! Materials and pairs of a scene to those of the discrete element method.

use crate::dem::{Material, Materials, NormalLaw, PairProperties};
use crate::scene::Boundary;
use crate::scene::dry::{Contact, ContactLaw, DryScene, GrainMaterial};

/// The table, and the number of the material of frictionless faces if there are any.
pub(super) fn materials(scene: &DryScene) -> (Materials, Option<usize>) {
    let grains = &scene.grains;
    let index = |name: &str| scene.material(Some(name)).unwrap_or(0);
    let mut table = Materials {
        list: grains.materials.iter().map(material).collect(),
        default_pair: pair(&grains.contact),
        pairs: (grains.pairs.iter())
            .map(|p| (index(&p.between[0]), index(&p.between[1]), pair(&p.contact)))
            .collect(),
    };
    let mut faces = scene.domain.boundaries.by_axis().into_iter().flatten();
    let slippery = faces.any(|face| face == Boundary::FreeSlip).then(|| add_slippery(scene, &mut table));
    (table, slippery)
}

/// A copy of the walls' material that nothing rubs on.
fn add_slippery(scene: &DryScene, table: &mut Materials) -> usize {
    let wall = scene.material(scene.grains.wall_material.as_deref()).unwrap_or(0);
    let slippery = table.list.len();
    for other in 0..slippery {
        let smooth = PairProperties {
            friction: 0.0,
            rolling_friction: 0.0,
            tangential_damping: 0.0,
            ..table.properties(wall, other)
        };
        table.pairs.push((slippery, other, smooth));
    }
    let copy = Material { name: "free_slip".to_owned(), ..table.list[wall].clone() };
    table.list.push(copy);
    slippery
}

fn material(m: &GrainMaterial) -> Material {
    Material {
        name: m.name.clone(),
        density_kg_m3: m.density_kg_per_m3,
        young_pa: m.young_modulus_pa,
        poisson: m.poisson_ratio,
    }
}

fn pair(contact: &Contact) -> PairProperties {
    let normal = match contact.law {
        ContactLaw::ViscoElastic { dissipative_time_s } => {
            NormalLaw::ViscoElastic { time_s: dissipative_time_s }
        }
        ContactLaw::Tsuji { restitution } => NormalLaw::Tsuji { restitution },
        ContactLaw::TsujiDamping { alpha } => NormalLaw::TsujiAlpha { alpha },
        ContactLaw::Linear { stiffness_n_per_m, restitution, tangential_ratio } => {
            NormalLaw::Linear { stiffness_n_m: stiffness_n_per_m, restitution, tangential_ratio }
        }
    };
    PairProperties {
        normal,
        friction: contact.friction,
        rolling_friction: contact.rolling_friction,
        tangential_damping: contact.tangential_damping,
    }
}
