//! Grains that pass an open face are taken out and booked.

use super::Grains;
use crate::dem::{Checkpoint, Dem, DemError};
use crate::plan::grains::GrainPlan;
use crate::scene::dry::DryScene;

/// Takes out the free grains that are wholly beyond an open face.
///
/// # Errors
/// Those of [`Dem::resume`], which a state that has been running does not meet.
pub(super) fn take_out(grains: &mut Grains, scene: &DryScene, plan: &GrainPlan) -> Result<(), DemError> {
    let b = grains.dem.bodies();
    let gone: Vec<bool> = (0..b.len())
        .map(|i| {
            let reach = reach(grains, i);
            b.inverse_mass[i] > 0.0
                && (0..3).any(|k| {
                    let x = b.position[i][k];
                    let [low, high] = plan.open[k];
                    (low && x < -reach) || (high && x > scene.domain.size_m[k] + reach)
                })
        })
        .collect();
    if !gone.contains(&true) {
        return Ok(());
    }
    let before = grains.dem.energies().balance();
    let mass: f64 = (0..b.len()).filter(|&i| gone[i]).map(|i| b.mass[i]).sum();
    let number = gone.iter().filter(|&&g| g).count() as u64;
    let state = without(&grains.dem, &gone);
    keep(&mut grains.setup.grains, &gone);
    keep(&mut grains.ids, &gone);
    grains.dem = Dem::resume(&grains.setup, &state)?;
    grains.left.0 += number;
    grains.left.1 += mass;
    grains.left.2 += before - grains.dem.energies().balance();
    Ok(())
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

fn keep<T>(list: &mut Vec<T>, gone: &[bool]) {
    let mut at = 0;
    list.retain(|_| {
        at += 1;
        !gone[at - 1]
    });
}

/// The state without some of its grains; contacts of the others keep their history.
fn without(dem: &Dem, gone: &[bool]) -> Checkpoint {
    let mut state = dem.checkpoint();
    let mut number = Vec::new();
    let mut next = 0;
    for member in dem.members() {
        let stays = !gone[member.body as usize];
        number.push(stays.then_some(next));
        next += u32::from(stays);
    }
    for list in [&mut state.position, &mut state.velocity, &mut state.spin] {
        keep(list, gone);
    }
    for list in [&mut state.momentum, &mut state.force, &mut state.torque] {
        keep(list, gone);
    }
    keep(&mut state.orientation, gone);
    if let Some((force, torque)) = &mut state.external {
        keep(force, gone);
        keep(torque, gone);
    }
    if let Some((place, turn)) = &mut state.gear {
        keep(place, gone);
        keep(turn, gone);
    }
    let new = |member: u32| number.get(member as usize).copied().flatten();
    state.pairs =
        (state.pairs.iter()).filter_map(|(a, b, history)| Some((new(*a)?, new(*b)?, *history))).collect();
    state.walls.retain_mut(|contact| match new(contact.member) {
        Some(member) => {
            contact.member = member;
            true
        }
        None => false,
    });
    state
}
