//! Grains that pass an open face are taken out and booked.

use super::Grains;
use crate::dem::keep_marked;
use crate::plan::grains::GrainPlan;
use crate::scene::dry::DryScene;

/// Takes out the free grains that are wholly beyond an open face.
pub(super) fn take_out(grains: &mut Grains, scene: &DryScene, plan: &GrainPlan) {
    let b = grains.dem.bodies();
    let stays: Vec<bool> = (0..b.len())
        .map(|i| {
            let reach = reach(grains, i);
            b.inverse_mass[i] == 0.0
                || !(0..3).any(|k| {
                    let x = b.position[i][k];
                    let [low, high] = plan.open[k];
                    (low && x < -reach) || (high && x > scene.domain.size_m[k] + reach)
                })
        })
        .collect();
    if !stays.contains(&false) {
        return;
    }
    let before = grains.dem.energies().balance();
    let mass: f64 = (0..b.len()).filter(|&i| !stays[i]).map(|i| b.mass[i]).sum();
    let number = stays.iter().filter(|&&s| !s).count() as u64;
    grains.dem.retain(&stays, grains.setup.walls.len());
    keep_marked(&mut grains.setup.grains, &stays);
    keep_marked(&mut grains.ids, &stays);
    grains.left.0 += number;
    grains.left.1 += mass;
    grains.left.2 += before - grains.dem.energies().balance();
}

/// Largest distance of a point of a grain from its centre, m.
fn reach(grains: &Grains, i: usize) -> f64 {
    let b = grains.dem.bodies();
    match grains.setup.grains[i].shape {
        crate::dem::Shape::Sphere => b.radius[i],
        crate::dem::Shape::Clump(k) => {
            let clump = &grains.setup.clumps[k];
            clump.reach * b.radius[i] / clump.equivalent_radius()
        }
    }
}
