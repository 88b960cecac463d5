//! What a member reaches: within its radius, but not on it, and seams of images that are no edges.

use super::*;
use crate::dem::{Orientation, Side};

const RADIUS: f64 = 0.5;

fn member(x: f64, y: f64, z: f64) -> Member {
    let position = V3::new(x, y, z);
    let (velocity, spin) = (V3::zeros(), V3::zeros());
    Member { position, radius: RADIUS, velocity, spin, inverse_mass: 1.0, body: 0, material: 0 }
}

fn floor() -> Wall {
    Wall::fixed("floor", Surface::Plane { point: V3::zeros(), normal: V3::z() }, 0)
}

/// A block from `low` to `high`.
fn block(low: [f64; 3], high: [f64; 3]) -> Wall {
    let (low, high) = (V3::from(low), V3::from(high));
    let (centre, half) = ((low + high) * 0.5, (high - low) * 0.5);
    let (orientation, side) = (Orientation::identity(), Side::Outside);
    Wall::fixed("block", Surface::Box { centre, half, orientation, side }, 0)
}

fn candidate(wall: u32, image: V3) -> Candidate {
    Candidate { wall, image, triangles: None }
}

/// Wall, image along x and distance of everything the member touches.
fn found(walls: Vec<Wall>, candidates: &[Candidate], member: &Member) -> Vec<(u32, f64, f64)> {
    let scenery = Scenery::new(walls);
    let touching = touches(member, &scenery, candidates);
    touching.iter().map(|(c, near)| (c.wall, c.image.x, near.distance)).collect()
}

/// A sphere above a floor, at a height of its radius and one bit more or less; below the floor, too.
#[test]
fn limit_a_floor_is_touched_within_the_radius_only() {
    let on = |z: f64| found(vec![floor()], &[candidate(0, V3::zeros())], &member(0.0, 0.0, z));
    let (below, above) = (RADIUS * (1.0 - f64::EPSILON), RADIUS * (1.0 + f64::EPSILON));
    assert_eq!(on(below), [(0, 0.0, below)]);
    assert_eq!(on(RADIUS), []);
    assert_eq!(on(above), []);
    assert_eq!(on(-0.25), [(0, 0.0, -0.25)]);
}

/// The member is looked at where its image is, and the wall where it has moved to.
#[test]
fn exact_reach_of_images_and_moved_walls() {
    let lifted = [candidate(0, V3::new(0.0, 0.0, 2.0))];
    assert_eq!(found(vec![floor()], &lifted, &member(0.0, 0.0, -1.75)), [(0, 0.0, 0.25)]);
    assert_eq!(found(vec![floor()], &lifted, &member(0.0, 0.0, 0.25)), []);
    let mut rising = floor();
    rising.motion.velocity = V3::new(0.0, 0.0, 4.0);
    let mut scenery = Scenery::new(vec![rising]);
    let at = [candidate(0, V3::zeros())];
    assert_eq!(touches(&member(0.0, 0.0, 0.75), &scenery, &at).len(), 0);
    // 4 m/s for 1/8 s: up by half a metre.
    scenery.set_time(0.125);
    let touching = touches(&member(0.0, 0.0, 0.75), &scenery, &at);
    assert_eq!((touching.len(), touching[0].1.distance, touching[0].1.normal), (1, 0.25, V3::z()));
}

/// A block as long as its period makes one floor: above the seam, and near it, there is one contact, with the nearer image.
#[test]
fn exact_one_contact_at_the_seam_of_two_images() {
    let slab = || vec![block([0.0, 0.0, -1.0], [2.0, 2.0, 0.0])];
    let images = [candidate(0, V3::zeros()), candidate(0, V3::new(-2.0, 0.0, 0.0))];
    assert_eq!(found(slab(), &images, &member(2.0, 1.0, 0.25)), [(0, 0.0, 0.25)]);
    assert_eq!(found(slab(), &images, &member(1.875, 1.0, 0.25)), [(0, 0.0, 0.25)]);
    assert_eq!(found(slab(), &images, &member(2.125, 1.0, 0.25)), [(0, -2.0, 0.25)]);
}

/// Two images that face each other across a gap are two contacts, and so are those of a block and of the next image that stands
/// out of its plane.
#[test]
fn exact_two_contacts_where_images_meet_at_an_edge() {
    let post = || vec![block([0.0, 0.0, -1.0], [1.25, 2.0, 1.0])];
    let images = [candidate(0, V3::zeros()), candidate(0, V3::new(-2.0, 0.0, 0.0))];
    // In the middle of a gap of 3/4 m.
    assert_eq!(found(post(), &images, &member(1.625, 1.0, 0.0)), [(0, 0.0, 0.375), (0, -2.0, 0.375)]);
    assert_eq!(found(post(), &images, &member(1.5, 1.0, 0.0)), [(0, 0.0, 0.25)]);
    // Nearer to one than to the other.
    assert_eq!(found(post(), &images, &member(1.6875, 1.0, 0.0)), [(0, 0.0, 0.4375), (0, -2.0, 0.3125)]);
}

/// Two walls are two contacts, in one plane or not, and two images of different walls as well; a corner of a room is three.
#[test]
fn exact_contacts_of_different_walls() {
    let walls = || vec![block([0.0, 0.0, -1.0], [1.0, 2.0, 0.0]), block([1.0, 0.0, -1.0], [2.0, 2.0, 0.0])];
    let here = [candidate(0, V3::zeros()), candidate(1, V3::zeros())];
    assert_eq!(found(walls(), &here, &member(1.0, 1.0, 0.25)), [(0, 0.0, 0.25), (1, 0.0, 0.25)]);
    let apart = [candidate(0, V3::zeros()), candidate(1, V3::new(2.0, 0.0, 0.0))];
    assert_eq!(found(walls(), &apart, &member(0.0, 1.0, 0.25)), [(0, 0.0, 0.25), (1, 2.0, 0.25)]);
    let room = Surface::Box {
        centre: V3::repeat(2.0),
        half: V3::repeat(2.0),
        orientation: Orientation::identity(),
        side: Side::Inside,
    };
    let corner =
        found(vec![Wall::fixed("room", room, 0)], &[candidate(0, V3::zeros())], &member(0.125, 0.25, 0.375));
    let distances: Vec<f64> = corner.iter().map(|near| near.2).collect();
    assert_eq!(distances, [0.125, 0.25, 0.375]);
}

/// The list has what a member reaches before it has moved by half a skin: within the radius and the skin.
#[test]
fn limit_candidates_are_within_radius_and_skin() {
    let scenery = Scenery::new(vec![floor()]);
    let listed = |z: f64| scenery.list(&[member(0.0, 0.0, z)], &[None; 3], 0.25, &[]).len();
    // 0.5 · 1.25.
    let reach = 0.625;
    assert_eq!((listed(0.1), listed(reach * (1.0 - f64::EPSILON))), (1, 1));
    assert_eq!((listed(reach), listed(0.7)), (0, 0));
}
