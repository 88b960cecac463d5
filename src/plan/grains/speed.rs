//! The impact speed a time step is chosen for.

use crate::dem::{Grain, Setup, V3};
use crate::plan::PlanProblem;
use crate::scene::Boundary;
use crate::scene::dry::DryScene;

/// Speed of the fastest impact to be expected, m/s: the fastest grain at time 0, with what it can gain by falling
/// through the box, towards the fastest wall. 0 if nothing moves.
pub(super) fn design(scene: &DryScene, setup: &Setup) -> f64 {
    let (pushed, free) = given_speeds(scene, setup);
    (free * free + 2.0 * setup.gravity.norm() * fall(scene, setup)).sqrt() + pushed
}

/// Speeds that the scene gives: of the fastest wall or driven grain, and of the fastest free grain, m/s.
pub(in crate::plan) fn given_speeds(scene: &DryScene, setup: &Setup) -> (f64, f64) {
    let size = V3::from(scene.domain.size_m);
    let fastest = |driven: bool| {
        let of = setup.grains.iter().filter(|g| g.driven == driven).map(surface_speed);
        of.fold(0.0, f64::max)
    };
    let walls = setup.walls.iter().map(|w| {
        // No point of a wall that matters is farther from its centre of rotation than the box's far corner.
        let far = (w.motion.about.abs() + size).norm();
        w.motion.velocity.norm() + w.motion.spin.norm() * far.min(size.norm())
    });
    let pushed = walls.fold(0.0, f64::max).max(fastest(true));
    (pushed, fastest(false))
}

pub(in crate::plan) fn surface_speed(grain: &Grain) -> f64 {
    grain.velocity.norm() + grain.spin.norm() * grain.radius
}

/// How far a grain can fall inside the box, m.
fn fall(scene: &DryScene, setup: &Setup) -> f64 {
    let strength = setup.gravity.norm();
    if strength == 0.0 {
        return 0.0;
    }
    let down = setup.gravity / strength;
    let size = V3::from(scene.domain.size_m);
    let faces = scene.domain.boundaries.by_axis();
    // Along periodic axes a grain never arrives; along others it ends at the far face.
    let room = |x: &V3| -> f64 {
        (0..3)
            .filter(|&k| faces[k][0] != Boundary::Periodic)
            .map(|k| if down[k] > 0.0 { down[k] * (size[k] - x[k]) } else { -down[k] * x[k] })
            .map(|room| room.max(0.0))
            .sum()
    };
    setup.grains.iter().filter(|g| !g.driven).map(|g| room(&g.position)).fold(0.0, f64::max)
}

/// Bytes of one grain with `members` spheres while a run is planned and computed: its state, its lists with the
/// number of neighbours of a dense packing, and the set-up it came from.
pub(in crate::plan) fn bytes_per_grain(members: f64, gear: bool) -> f64 {
    let body = 340.0 + if gear { 288.0 } else { 0.0 };
    // Neighbours of a dense packing within the skin, each pair listed once: 7 per sphere.
    let per_member = 230.0 + 7.0 * 230.0;
    let set_up = size_of::<Grain>() as f64;
    set_up + body + members * per_member
}

/// Refuses what cannot be numbered or does not fit into memory, before it is made.
pub(super) fn check_count(
    grains: f64,
    members_each: f64,
    gear: bool,
    available: Option<u64>,
) -> Result<(), PlanProblem> {
    // Spheres and their pairs are numbered in 32 bits.
    const MOST: f64 = 4e8;
    let spheres = grains * members_each;
    if spheres.is_nan() || spheres > MOST {
        return Err(PlanProblem::TooManyGrains { spheres, max: MOST });
    }
    let bytes = (grains * bytes_per_grain(members_each, gear)) as u64;
    match available {
        Some(available) if bytes > available => {
            Err(PlanProblem::GrainMemory { grains: grains as u64, bytes, available })
        }
        _ => Ok(()),
    }
}
