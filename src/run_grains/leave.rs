//! Grains that pass an open face are taken out and booked.

use super::Grains;
use crate::dem::{Dem, Setup, Shape, keep_marked};
use crate::plan::grains::GrainPlan;
use crate::scene::dry::DryScene;

/// Takes out the free grains that are wholly beyond an open face.
pub(super) fn take_out(grains: &mut Grains, scene: &DryScene, plan: &GrainPlan) {
    let Some(stays) = leaving(&grains.dem, &grains.setup, scene, plan) else { return };
    let before = grains.dem.energies().balance();
    let (number, mass) = count(&grains.dem, &stays);
    grains.dem.retain(&stays, grains.setup.walls.len());
    keep_marked(&mut grains.setup.grains, &stays);
    keep_marked(&mut grains.ids, &stays);
    grains.left.0 += number;
    grains.left.1 += mass;
    grains.left.2 += before - grains.dem.energies().balance();
}

/// Which grains stay; `None` if all do. Free grains that are wholly beyond an open face leave.
pub(crate) fn leaving(dem: &Dem, setup: &Setup, scene: &DryScene, plan: &GrainPlan) -> Option<Vec<bool>> {
    let b = dem.bodies();
    let stays = |i: usize| {
        let reach = reach(dem, setup, i);
        let gone = |k: usize| {
            let x = b.position[i][k];
            let [low, high] = plan.open[k];
            (low && x < -reach) || (high && x > scene.domain.size_m[k] + reach)
        };
        b.inverse_mass[i] == 0.0 || !(0..3).any(gone)
    };
    let stays: Vec<bool> = (0..b.len()).map(stays).collect();
    stays.contains(&false).then_some(stays)
}

/// Number and mass (kg) of those that do not stay.
pub(crate) fn count(dem: &Dem, stays: &[bool]) -> (u64, f64) {
    let gone = || stays.iter().enumerate().filter(|(_, stays)| !**stays);
    (gone().count() as u64, gone().map(|(i, _)| dem.bodies().mass[i]).sum())
}

/// Largest distance of a point of a grain from its centre, m.
fn reach(dem: &Dem, setup: &Setup, i: usize) -> f64 {
    let b = dem.bodies();
    match setup.grains[i].shape {
        Shape::Sphere => b.radius[i],
        Shape::Clump(k) => {
            let clump = &setup.clumps[k];
            clump.reach * b.radius[i] / clump.equivalent_radius()
        }
    }
}
